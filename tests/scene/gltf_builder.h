// glTF files made of a few numbers.
#pragma once

#include "scratch.h"

#include <fmt/format.h>

namespace onde::test {

/// A glTF file whose buffer grows with its accessors.
class Builder {
  public:
    /// The index of an accessor of these values, `type` of them each.
    template <class T>
    size_t add(int component, const std::string& type, size_t width,
               std::initializer_list<T> values, bool normalized = false) {
        views_ += fmt::format("{}{{\"buffer\": 0, \"byteOffset\": {}, \"byteLength\": {}}}",
                              count_ ? ", " : "", bytes_.size(), values.size() * sizeof(T));
        accessors_ += fmt::format("{}{{\"bufferView\": {}, \"componentType\": {}, \"type\": "
                                  "\"{}\", \"count\": {}, \"normalized\": {}}}",
                                  count_ ? ", " : "", count_, component, type,
                                  values.size() / width, normalized);
        bytes_ += bytes_of<T>(values);
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return count_++;
    }
    size_t floats(size_t width, std::initializer_list<float> values) {
        const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        return add<float>(5126, width == 16 ? "MAT4" : types[width], width, values);
    }

    /// `body` are the root's other keys.
    std::filesystem::path write(const ScratchFolder& folder, const std::string& body) const {
        folder.write("b.bin", bytes_);
        return folder.write("p.gltf",
                            fmt::format("{{\"asset\": {{\"version\": \"2.0\"}}, \"buffers\": "
                                        "[{{\"uri\": \"b.bin\", \"byteLength\": {}}}], "
                                        "\"bufferViews\": [{}], \"accessors\": [{}], {}}}",
                                        bytes_.size(), views_, accessors_, body));
    }
    Scene load(const std::string& body, const LoadOptions& options = {}) const {
        ScratchFolder folder;
        return load_scene(write(folder, body), options);
    }

  private:
    std::string bytes_, views_, accessors_;
    size_t count_ = 0;
};

/// With the triangle (0 0 0), (1 0 0), (0 1 0) as accessor 0.
inline Builder triangle() {
    Builder builder;
    builder.floats(3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    return builder;
}

} // namespace onde::test
