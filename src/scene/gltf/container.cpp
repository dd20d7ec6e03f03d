#include "scene/gltf/container.h"

#include "core/error.h"

#include <cstring>

namespace onde::gltf {

static constexpr uint32_t MAGIC = 0x46546c67, JSON_CHUNK = 0x4e4f534a, BINARY_CHUNK = 0x004e4942;

static uint32_t word(std::string_view bytes, size_t offset) {
    uint32_t value;
    std::memcpy(&value, bytes.data() + offset, 4);
    return value;
}

Container split_container(std::string_view bytes, const std::string& name, bool binary) {
    if (!binary) return {bytes, std::nullopt};
    const auto require = [&](bool holds, const char* problem) {
        if (!holds) throw InputError("{}: not a valid GLB: {}; export it again", name, problem);
    };
    require(bytes.size() >= 20, "it is shorter than its header");
    require(word(bytes, 0) == MAGIC, "it doesn't begin with 'glTF'");
    require(word(bytes, 4) == 2, "its container version is not 2");
    require(word(bytes, 8) <= bytes.size(), "it is truncated");
    bytes = bytes.substr(0, word(bytes, 8)); // what follows its stated length is not part of it
    require(bytes.size() >= 20, "its stated length is shorter than its header");
    const uint64_t json = word(bytes, 12);
    require(word(bytes, 16) == JSON_CHUNK, "its first chunk is not JSON");
    require(20 + json <= bytes.size(), "its JSON chunk overruns the file");
    Container container{bytes.substr(20, size_t(json)), std::nullopt};
    while (container.json.ends_with('\0')) container.json.remove_suffix(1); // wrong padding
    const std::string_view rest = bytes.substr(size_t(20 + json));
    if (rest.size() < 8) return container;
    const uint64_t length = word(rest, 0);
    require(8 + length <= rest.size(), "its binary chunk overruns the file");
    if (word(rest, 4) == BINARY_CHUNK) container.binary = rest.substr(8, size_t(length));
    return container;
}

} // namespace onde::gltf
