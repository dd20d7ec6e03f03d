// The header of a PLY file: which elements follow it, and what values each of them consists of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace onde::ply {

enum class Encoding { ascii, little_endian, big_endian };

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one value in a binary file.
size_t size_of(Type type);

struct Property {
    std::string name;
    Type type = Type::float32;      ///< of the value, or of each item of the list
    std::optional<Type> count_type; ///< of the list's length; nothing for a single value
};

struct Element {
    std::string name;
    uint64_t count = 0; ///< as the file claims
    std::vector<Property> properties;
};

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements; ///< names differ, as do those of the properties of each
    size_t size = 0;               ///< bytes of the header; the values follow
    std::string texture;           ///< the first that a comment names (MeshLab's TextureFile)
};

/// Reads the header of the file whose bytes these are. Lines may end in LF, CR LF or CR. Throws
/// InputError, beginning with `name` and the line.
Header read_header(const std::string& name, std::string_view file);

} // namespace onde::ply
