// Opens glTF files by tinygltf, which trusts its input: what it would not survive (deep nesting,
// chunks that overrun the file) is refused before it sees it.
#include "scene/gltf_file.h"

#include "core/error.h"
#include "core/files.h"
#include "scene/references.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace onde::gltf {
namespace fs = std::filesystem;

namespace {

constexpr uint64_t MAX_BYTES = (uint64_t(1) << 31) - 1; // tinygltf counts in int
constexpr int MAX_NESTING = 200;

/// tinygltf copies JSON values by recursion; a file of a million brackets would end the program.
void check_nesting(const std::string& name, std::string_view json) {
    int depth = 0;
    bool in_text = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_text) {
            if (c == '\\') ++i;
            if (c == '"') in_text = false;
        } else if (c == '"') {
            in_text = true;
        } else if (c == '{' || c == '[') {
            if (++depth > MAX_NESTING)
                throw InputError("{}: its JSON is nested more than {} deep; the file is damaged",
                                 name, MAX_NESTING);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

uint32_t word(const std::string& bytes, size_t offset) {
    uint32_t value;
    std::memcpy(&value, bytes.data() + offset, 4);
    return value;
}

/// The JSON text of a binary file. Cuts the file at its stated length (glTF 2.0, section 4.4).
std::string_view check_chunks(const std::string& name, const std::string& bytes) {
    const auto require = [&](bool holds, const char* problem) {
        if (!holds) throw InputError("{}: not a valid GLB: {}; export it again", name, problem);
    };
    require(bytes.size() >= 20, "it is shorter than its header");
    require(word(bytes, 0) == 0x46546c67, "it doesn't begin with 'glTF'");
    require(word(bytes, 4) == 2, "its container version is not 2");
    require(word(bytes, 8) <= bytes.size(), "it is truncated");
    const uint64_t length = word(bytes, 8), json = word(bytes, 12);
    require(word(bytes, 16) == 0x4e4f534a, "its first chunk is not JSON");
    require(20 + json <= length, "its JSON chunk overruns the file");
    if (20 + json + 8 <= length)
        require(28 + json + word(bytes, size_t(20 + json)) <= length,
                "its binary chunk overruns the file");
    return std::string_view(bytes).substr(20, size_t(json));
}

bool file_exists(const std::string&, void*) {
    return true;
} // read_whole_file says what is wrong

std::string expand_path(const std::string& path, void*) {
    return path;
}

/// Reads a file that the scene refers to; tinygltf has joined the folder and the decoded URI.
bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& joined,
                     void* user) {
    const File& file = *static_cast<const File*>(user);
    const std::string prefix = file.folder.string() + "/";
    const std::string reference = joined.substr(std::min(prefix.size(), joined.size()));
    const fs::path path = resolve_inside(file.folder, reference, file.path.string());
    if (!fs::is_regular_file(path)) {
        *error = "no such file";
        return false;
    }
    const std::string bytes = read_file(path, MAX_BYTES);
    out->assign(bytes.begin(), bytes.end());
    return true;
}

/// Keeps the encoded bytes; images in buffer views are found again by their view.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text.empty() ? "no reason given" : text.substr(0, 300);
}

/// Extensions that we understand, or that only refine materials.
bool is_harmless(const std::string& name) {
    constexpr std::array KNOWN = {"KHR_lights_punctual", "KHR_mesh_quantization",
                                  "KHR_texture_transform", "KHR_xmp_json_ld",
                                  "KHR_animation_pointer"};
    return name.starts_with("KHR_materials_") ||
           std::any_of(KNOWN.begin(), KNOWN.end(),
                       [&](const char* known) { return name == known; });
}

bool is_understood(const std::string& name) {
    constexpr std::array KNOWN = {
        "KHR_lights_punctual", "KHR_mesh_quantization",      "KHR_materials_emissive_strength",
        "KHR_materials_ior",   "KHR_materials_transmission", "KHR_texture_transform"};
    return std::any_of(KNOWN.begin(), KNOWN.end(),
                       [&](const char* known) { return name == known; });
}

void check_extensions(File& file) {
    for (const std::string& name : file.model.extensionsRequired)
        if (!is_harmless(name))
            throw InputError("{}: requires the extension {}, which Onde does not have; export "
                             "without it",
                             file.path.string(), name);
    for (const std::string& name : file.model.extensionsUsed)
        if (!is_understood(name)) file.notes.add("The extension " + name + " is ignored");
}

} // namespace

File open_file(const fs::path& path) {
    File file;
    file.path = path;
    file.folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const std::string bytes = read_file(path, MAX_BYTES), name = path.string();
    const bool binary = bytes.starts_with("glTF") || path.extension() == ".glb";
    check_nesting(name, binary ? check_chunks(name, bytes) : std::string_view(bytes));

    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keep_encoded, nullptr);
    parser.SetFsCallbacks({file_exists, expand_path, read_whole_file, nullptr, &file});
    std::string error, warning;
    bool parsed = false;
    try {
        const std::string folder = file.folder.string();
        const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
        const unsigned size = unsigned(bytes.size());
        parsed =
            binary ? parser.LoadBinaryFromMemory(&file.model, &error, &warning, data, size, folder)
                   : parser.LoadASCIIFromString(&file.model, &error, &warning, bytes.data(), size,
                                                folder);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& thrown) {
        error = thrown.what();
    }
    check_extensions(file); // first: it explains most of what fails to parse
    if (!parsed) throw InputError("{}: not valid glTF: {}; export it again", name, one_line(error));
    if (!file.model.asset.version.starts_with("2."))
        throw InputError("{}: glTF version '{}' is not 2.x; convert it", name,
                         file.model.asset.version);
    return file;
}

} // namespace onde::gltf
