// An open glTF file and bounds-checked access to its binary data.
#pragma once

#include "scene/gltf/document.h"
#include "scene/load_context.h"
#include "scene/notes.h"

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace onde::gltf {

/// What compressed data decodes to in place of an accessor's elements, packed.
struct Elements {
    std::string bytes;
    uint64_t count = 0;
    ComponentType type = ComponentType::float32;
    uint32_t components = 1;
};

/// What the file says, with its buffers in memory. Indices and ranges in `document` are unchecked.
struct File {
    LoadContext& context;
    std::filesystem::path path;
    std::filesystem::path folder;
    std::string name; ///< the path in sentences
    Notes notes;
    std::shared_ptr<const nlohmann::json> json; ///< whose objects the document's readers read
    Document document;
    std::map<std::filesystem::path, std::string> files; ///< bytes, each file read once
    std::deque<std::string> decoded;                    ///< bytes of data URIs
    std::vector<std::span<const uint8_t>> buffers;      ///< one for each of the document's
    std::map<uint32_t, std::string> decoded_views;      ///< of views that are compressed
    std::map<uint32_t, Elements> decoded_elements;      ///< of the primitive in work, by accessor

    /// "FILE: what".
    std::string where(const std::string& what) const { return name + ": " + what; }

    /// Of all loaded buffers.
    uint64_t buffer_bytes() const {
        uint64_t sum = 0;
        for (const auto& buffer : buffers) sum += buffer.size();
        return sum;
    }
};

/// Parses .gltf or .glb and loads the buffers that its views name; images stay encoded. Throws
/// InputError for damaged files, versions other than 2, references out of the folder and required
/// extensions that would change what the data means.
File open_file(const std::filesystem::path& path, LoadContext& context);

/// The bytes of a reference of the file: of a data URI, or of a file, which is read once. They live
/// as long as `file`. Nothing where there is no such file. Throws InputError that begins with
/// `where` for damaged data and for references out of the folder.
std::optional<std::span<const uint8_t>> uri_bytes(File& file, const std::string& uri,
                                                  const std::string& where);

/// Element `index` of a list of the file; throws InputError when there is none.
template <class T>
const T& at(const File& file, const std::vector<T>& list, uint32_t index, const char* kind,
            const std::string& user);

[[noreturn]] void throw_missing(const File& file, const char* kind, uint32_t index, size_t count,
                                const std::string& user);

/// A range of a buffer, checked; the sentence speaks of buffer view `index`.
std::span<const uint8_t> range_of(const File& file, const BufferView& view, uint32_t index,
                                  const std::string& user);

/// The bytes of a buffer view, decompressed, checked against its buffer.
std::span<const uint8_t> view_bytes(const File& file, uint32_t view, const std::string& user);

/// The floats of an accessor with that many components, integers normalised where it says so,
/// sparse values applied; they may not be finite. `user` names what asks, as in "mesh 0 POSITION".
std::vector<glm::vec2> read_vec2(const File& file, uint32_t accessor, const std::string& user);
std::vector<glm::vec3> read_vec3(const File& file, uint32_t accessor, const std::string& user);

/// The same for any number of components, one element after the other.
std::vector<float> read_floats(const File& file, uint32_t accessor, uint32_t components,
                               const std::string& user);

/// The unsigned integers of an accessor of four components, for joints.
std::vector<glm::uvec4> read_uvec4(const File& file, uint32_t accessor, const std::string& user);

/// The same of an accessor with three or four components, the fourth 1 where it is missing; may not
/// be finite. Integers are normalised even where it does not say so, as some exporters forget it.
std::vector<glm::vec4> read_color(const File& file, uint32_t accessor, const std::string& user);
std::vector<glm::vec4> read_any_vec4(const File& file, uint32_t accessor, const std::string& user);

/// The unsigned integers of a scalar accessor.
std::vector<uint32_t> read_indices(const File& file, uint32_t accessor, const std::string& user);

template <class T>
const T& at(const File& file, const std::vector<T>& list, uint32_t index, const char* kind,
            const std::string& user) {
    if (index >= list.size()) throw_missing(file, kind, index, list.size(), user);
    return list[index];
}

} // namespace onde::gltf
