// URIs as glTF uses them: relative references and data.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace onde::gltf {

/// The bytes of a data URI (RFC 2397), whatever its media type and parameters, in base64 or with
/// percent escapes; nothing for another URI. Throws InputError, beginning with `where`, for one
/// that is damaged.
std::optional<std::string> decode_data_uri(std::string_view uri, const std::string& where);

} // namespace onde::gltf
