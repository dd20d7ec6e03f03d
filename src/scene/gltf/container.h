// The two containers of glTF: a JSON text, and the binary file of chunks (glTF 2.0, section 4.4).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace onde::gltf {

struct Container {
    std::string_view json;
    std::optional<std::string_view> binary; ///< the data of the first buffer
};

/// The parts of the file's bytes. Throws InputError "NAME: ..." where chunks overrun the file.
Container split_container(std::string_view bytes, const std::string& name, bool binary);

} // namespace onde::gltf
