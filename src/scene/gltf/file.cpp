// Opens glTF files: container, JSON, document, extensions, buffers, in this order.
#include "scene/gltf/file.h"

#include "core/error.h"
#include "core/files.h"
#include "core/shown.h"
#include "scene/gltf/container.h"
#include "scene/gltf/extensions.h"
#include "scene/gltf/meshopt.h"
#include "scene/gltf/uri.h"
#include "scene/json_parse.h"
#include "scene/references.h"

#include <nlohmann/json.hpp>

namespace onde::gltf {
namespace fs = std::filesystem;

namespace {

std::span<const uint8_t> bytes_of(std::string_view text) {
    return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

/// The file's bytes, read when they are first asked for.
std::string_view file_bytes(File& file, const fs::path& path) {
    if (const auto found = file.files.find(path); found != file.files.end()) return found->second;
    std::error_code error;
    const uint64_t size = fs::file_size(path, error); // read_file says what is wrong
    if (!error) file.context.spend(size, 1, path.string());
    return file.files.emplace(path, read_file(path)).first->second;
}

void check_extensions(File& file) {
    for (const std::string& name : file.document.extensions_required)
        if (support_of(name) == Support::none)
            throw InputError("{}: requires the extension {}, which Onde does not have; export "
                             "without it",
                             file.name, shown(name));
    for (const std::string& name : file.document.extensions_used)
        if (!is_understood(support_of(name)))
            file.notes.add("The extension " + shown(name) + " is ignored");
}

std::span<const uint8_t> load_buffer(File& file, size_t index,
                                     const std::optional<std::string_view>& binary) {
    const Buffer& buffer = file.document.buffers[index];
    const std::string where = file.where(fmt::format("buffer {}", index));
    std::span<const uint8_t> bytes;
    if (buffer.uri) {
        const auto found = uri_bytes(file, *buffer.uri, where);
        if (!found)
            throw InputError("{}: the file '{}' does not exist; check the name", where,
                             shown(*buffer.uri));
        bytes = *found;
    } else if (index == 0 && binary) {
        bytes = bytes_of(*binary);
    } else {
        throw InputError("{}: it names no file and the file holds no data for it; export it again",
                         where);
    }
    if (buffer.length > bytes.size())
        throw InputError("{}: it claims {} bytes, but has {}; export it again", where,
                         buffer.length, bytes.size());
    return bytes.first(size_t(buffer.length)); // exporters may leave spare bytes behind it
}

/// Loads what some view uses; others may be missing.
void load_buffers(File& file, const std::optional<std::string_view>& binary) {
    const Document& document = file.document;
    std::vector<bool> used(document.buffers.size(), false);
    for (size_t i = 0; i < document.views.size(); ++i) {
        const BufferView& view = document.views[i];
        const uint32_t buffer = view.meshopt ? view.meshopt->buffer : view.buffer;
        at(file, document.buffers, buffer, "buffer", fmt::format("buffer view {}", i));
        used[buffer] = true;
    }
    file.buffers.resize(used.size());
    for (size_t i = 0; i < used.size(); ++i)
        if (used[i]) file.buffers[i] = load_buffer(file, i, binary);
}

void decode_views(File& file) {
    for (uint32_t i = 0; i < file.document.views.size(); ++i) {
        const BufferView& view = file.document.views[i];
        if (!view.meshopt) continue;
        const std::string user = fmt::format("buffer view {}", i), where = file.where(user);
        const auto stream = range_of(
            file, {view.meshopt->buffer, view.meshopt->offset, view.meshopt->length, 0, {}}, i,
            user);
        file.context.spend(view.meshopt->count, view.meshopt->stride, where);
        file.decoded_views[i] = decode_meshopt(*view.meshopt, stream, where);
    }
}

} // namespace

std::optional<std::span<const uint8_t>> uri_bytes(File& file, const std::string& uri,
                                                  const std::string& where) {
    if (auto data = decode_data_uri(uri, where)) {
        file.context.spend(data->size(), 1, where);
        return bytes_of(file.decoded.emplace_back(std::move(*data)));
    }
    const fs::path path = file.context.resolve(file.folder, decode_uri(uri), where);
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return std::nullopt;
    return bytes_of(file_bytes(file, path));
}

File open_file(const fs::path& path, LoadContext& context) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    File file{context, path, folder, path.string(), context.notes_of(path), {}, {}, {}, {},
              {},      {},   {}};
    const std::string_view bytes = file_bytes(file, path);
    const bool binary = bytes.starts_with("glTF") || path.extension() == ".glb";
    const Container container = split_container(bytes, file.name, binary);
    file.json =
        std::make_shared<const nlohmann::json>(parse_json(container.json, file.name, context));
    file.document = read_document(JsonReader(*file.json, file.name, ""));
    if (!file.document.version.starts_with("2."))
        throw InputError("{}: glTF version '{}' is not 2.x; convert it", file.name,
                         shown(file.document.version));
    check_extensions(file);
    load_buffers(file, container.binary);
    decode_views(file);
    return file;
}

} // namespace onde::gltf
