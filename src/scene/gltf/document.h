// What a glTF file says, as typed values: every key has its type, every number its range. Whether
// indices have an element, and ranges their bytes, is checked where they are used.
#pragma once

#include "scene/json_reader.h"

#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace onde::gltf {

using Index = std::optional<uint32_t>; ///< of an element of a list

struct Buffer {
    std::optional<std::string> uri;
    uint64_t length = 0;
};

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential, color };

/// A compressed range of a buffer (EXT_meshopt_compression, KHR_meshopt_compression).
struct Meshopt {
    uint32_t buffer = 0;
    uint64_t offset = 0, length = 0, count = 0;
    uint32_t stride = 0;
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
};

/// A range of a buffer.
struct BufferView {
    uint32_t buffer = 0;
    uint64_t offset = 0, length = 0, stride = 0; ///< stride 0: elements are packed
    std::optional<Meshopt> meshopt;              ///< stands for the range
};

enum class ComponentType : uint32_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126
};

struct Sparse {
    uint64_t count = 0;
    uint32_t indices_view = 0, values_view = 0;
    uint64_t indices_offset = 0, values_offset = 0;
    ComponentType indices_type = ComponentType::uint32;
};

struct Accessor {
    Index view; ///< without one, all elements are zero
    uint64_t offset = 0, count = 0;
    ComponentType type = ComponentType::float32;
    uint32_t components = 1; ///< 16 of a MAT4
    bool normalized = false;
    std::optional<Sparse> sparse;
};

/// An encoded picture: a file, a data URI, or a buffer view.
struct ImageSource {
    std::string name;
    std::optional<std::string> uri;
    Index view;
};

struct Sampler {
    uint32_t wrap_u = 10497, wrap_v = 10497;
    std::optional<uint32_t> magnify, minify;
};

struct TextureSource {
    Index image, sampler;
    std::vector<uint32_t> fallbacks; ///< the same picture in more common formats
};

using Attributes = std::map<std::string, uint32_t>; ///< names to accessors

/// A compressed primitive (KHR_draco_mesh_compression).
struct Draco {
    uint32_t view = 0;
    Attributes attributes; ///< names to identifiers in the compressed data
};

/// The material of a primitive in one of the file's variants (KHR_materials_variants).
struct VariantMaterial {
    uint32_t variant = 0, material = 0;
};

struct Primitive {
    Attributes attributes;
    Index indices, material;
    uint32_t mode = 4;
    std::vector<Attributes> targets;
    std::optional<Draco> draco;
    std::vector<VariantMaterial> variants;
};

struct MeshSource {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<double> weights; ///< of the morph targets
};

struct Node {
    std::string name;
    std::vector<uint32_t> children;
    Index mesh, camera, skin, light;
    std::optional<std::array<double, 16>> matrix; ///< else what follows
    std::array<double, 3> translation{0, 0, 0}, scale{1, 1, 1};
    std::array<double, 4> rotation{0, 0, 0, 1}; ///< a quaternion x, y, z, w
    std::vector<double> weights;                ///< of the mesh's morph targets, over its own
    bool visible = true;                        ///< KHR_node_visibility; its children too
    std::optional<Attributes> instancing;       ///< EXT_mesh_gpu_instancing
};

struct Skin {
    std::string name;
    std::vector<uint32_t> joints; ///< nodes
    Index inverse_bind_matrices;  ///< accessor; without one, identities
};

enum class Interpolation { linear, step, cubic_spline };

struct AnimationSampler {
    uint32_t input = 0, output = 0; ///< accessors: times, values
    Interpolation interpolation = Interpolation::linear;
};

enum class AnimatedPath { translation, rotation, scale, weights, pointer };

/// What a sampler moves.
struct Channel {
    uint32_t sampler = 0;
    Index node; ///< without one, the channel is to be ignored
    AnimatedPath path = AnimatedPath::translation;
};

struct Animation {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<Channel> channels;
};

struct CameraSource {
    std::string name;
    bool perspective = true;
    double yfov = 0, ymag = 0;
    std::optional<double> aspect_ratio; ///< of a perspective, or xmag over ymag
};

struct LightSource {
    std::string name, type;
    std::array<double, 3> color{1, 1, 1};
    double intensity = 1;
    double inner_cone = 0, outer_cone = std::numbers::pi / 4; ///< radians, of a spot
};

struct SceneSource {
    std::string name;
    std::vector<uint32_t> nodes;
};

struct Document {
    std::string version;
    std::vector<std::string> extensions_used, extensions_required;
    std::vector<Buffer> buffers;
    std::vector<BufferView> views;
    std::vector<Accessor> accessors;
    std::vector<ImageSource> images;
    std::vector<Sampler> samplers;
    std::vector<TextureSource> textures;
    std::vector<JsonReader> materials; ///< read by material.cpp
    std::vector<MeshSource> meshes;
    std::vector<Node> nodes;
    std::vector<CameraSource> cameras;
    std::vector<LightSource> lights;
    std::vector<SceneSource> scenes;
    Index scene; ///< the default one
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<std::string> variants; ///< their names
};

/// Reads the root of a glTF file, which must outlive the document's readers. Throws InputError as
/// JsonReader does.
Document read_document(const JsonReader& root);

} // namespace onde::gltf
