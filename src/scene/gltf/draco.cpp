#include "scene/gltf/draco.h"

#include "core/error.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#pragma GCC diagnostic pop

#include <optional>

namespace onde::gltf {

namespace {

/// Bytes that the library's tables and ours take for a point and for a face, roughly.
constexpr uint64_t POINT_BYTES = 128, FACE_BYTES = 128;

struct DracoSizes {
    uint64_t points = 0, faces = 0;
};

/// What the header claims, before the library allocates by it; nothing if it is no header.
std::optional<DracoSizes> claimed_sizes(std::span<const uint8_t> bytes) {
    constexpr uint16_t HAS_METADATA = 0x8000;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    char magic[5];
    uint8_t major, minor, type, method;
    uint16_t flags;
    if (!buffer.Decode(magic, sizeof(magic)) || !buffer.Decode(&major) || !buffer.Decode(&minor) ||
        !buffer.Decode(&type) || !buffer.Decode(&method) || !buffer.Decode(&flags))
        return std::nullopt;
    if (major != 2 || type != draco::TRIANGULAR_MESH) return std::nullopt;
    buffer.set_bitstream_version(uint16_t(major << 8 | minor));
    if (flags & HAS_METADATA) {
        draco::GeometryMetadata ignored;
        if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &ignored))
            return std::nullopt;
    }
    const bool is_edgebreaker = method == draco::MESH_EDGEBREAKER_ENCODING;
    uint8_t traversal;
    uint32_t first, second;
    if (is_edgebreaker && !buffer.Decode(&traversal)) return std::nullopt;
    if (minor < 2) { // sizes are plain numbers
        if (!buffer.Decode(&first) || !buffer.Decode(&second)) return std::nullopt;
    } else if (!draco::DecodeVarint(&first, &buffer) || !draco::DecodeVarint(&second, &buffer)) {
        return std::nullopt;
    }
    if (is_edgebreaker) return DracoSizes{first, second};
    return DracoSizes{second, first};
}

[[noreturn]] void throw_damaged(const std::string& where) {
    throw InputError("{}: its Draco compression is damaged; export it again", where);
}

std::unique_ptr<draco::Mesh> decode_mesh(File& file, std::span<const uint8_t> bytes,
                                         const std::string& where) {
    const auto sizes = claimed_sizes(bytes);
    if (!sizes) throw_damaged(where);
    // No encoder comes near: a face takes a fraction of a bit at the least.
    constexpr uint64_t MOST_PER_BYTE = 1 << 10;
    if (sizes->faces > MOST_PER_BYTE * bytes.size() || sizes->points > MOST_PER_BYTE * bytes.size())
        throw_damaged(where);
    file.context.spend(sizes->points, POINT_BYTES, where);
    file.context.spend(sizes->faces, FACE_BYTES, where);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    try {
        auto result = decoder.DecodeMeshFromBuffer(&buffer);
        if (result.ok()) return std::move(result).value();
    } catch (const std::exception&) { // out of memory
    }
    throw_damaged(where);
}

std::optional<ComponentType> component_type(draco::DataType type) {
    switch (type) {
    case draco::DT_INT8:
        return ComponentType::int8;
    case draco::DT_UINT8:
        return ComponentType::uint8;
    case draco::DT_INT16:
        return ComponentType::int16;
    case draco::DT_UINT16:
        return ComponentType::uint16;
    case draco::DT_UINT32:
        return ComponentType::uint32;
    case draco::DT_FLOAT32:
        return ComponentType::float32;
    default:
        return std::nullopt;
    }
}

Elements attribute_elements(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                            const std::string& where) {
    const auto type = component_type(attribute.data_type());
    if (!type) throw_damaged(where);
    Elements elements{{}, mesh.num_points(), *type, uint32_t(attribute.num_components())};
    const size_t size = size_t(attribute.byte_stride());
    elements.bytes.resize(size * elements.count);
    for (uint32_t i = 0; i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(i));
        if (value.value() >= attribute.size()) throw_damaged(where);
        attribute.GetValue(value, elements.bytes.data() + i * size);
    }
    return elements;
}

Elements face_indices(const draco::Mesh& mesh) {
    Elements elements{{}, uint64_t(mesh.num_faces()) * 3, ComponentType::uint32, 1};
    elements.bytes.resize(elements.count * 4);
    for (uint32_t i = 0; i < mesh.num_faces(); ++i) {
        const auto& face = mesh.face(draco::FaceIndex(i));
        const uint32_t corners[3] = {face[0].value(), face[1].value(), face[2].value()};
        std::memcpy(elements.bytes.data() + size_t(i) * sizeof(corners), corners, sizeof(corners));
    }
    return elements;
}

} // namespace

void decode_draco(File& file, const Primitive& primitive, const std::string& user) {
    file.decoded_elements.clear();
    if (!primitive.draco) return;
    const Draco& source = *primitive.draco;
    const std::string where = file.where(user);
    const auto mesh = decode_mesh(file, view_bytes(file, source.view, user), where);
    for (const auto& [name, id] : source.attributes) {
        const auto accessor = primitive.attributes.find(name);
        if (accessor == primitive.attributes.end()) continue;
        const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id);
        if (!attribute)
            throw InputError("{}: {}: its Draco data has no attribute {}; export it again", where,
                             name, id);
        file.decoded_elements.insert_or_assign(accessor->second,
                                               attribute_elements(*mesh, *attribute, where));
    }
    if (primitive.indices)
        file.decoded_elements.insert_or_assign(*primitive.indices, face_indices(*mesh));
}

} // namespace onde::gltf
