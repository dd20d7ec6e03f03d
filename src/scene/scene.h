// A scene as plain values, in world units and linear RGB. What the loaders make, what upload packs,
// what the tests' reference renders. It knows nothing of files or devices.
//
// Conventions: right-handed, Y up as in glTF; a camera looks along its local -Z with +Y up;
// radiometric units (radiance W/(sr m^2), intensity W/sr, irradiance W/m^2), per RGB channel.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace onde {

enum class Wrap : uint32_t { repeat, clamp, mirror };

/// An 8-bit RGBA texture; `srgb` says that its colour channels need linearising (alpha never does).
struct Texture {
    std::string name;
    ByteImage image;
    bool srgb = true;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
};

inline constexpr int32_t NO_TEXTURE = -1;

enum class MaterialKind : uint32_t {
    diffuse,    ///< Lambert: base_color is the albedo
    conductor,  ///< GGX with Schlick Fresnel: base_color is the reflectance at normal incidence
    dielectric, ///< GGX glass: exact Fresnel from ior, base_color tints what goes through
    metallic_roughness, ///< the glTF 2.0 mix (appendix B of its specification)
};

/// Surface appearance. Textures multiply the factor beside them, as in glTF:
/// base_color (rgb), roughness (g) and metallic (b) of one texture, emission (rgb).
/// GGX alpha is roughness^2; an alpha below 1e-3 is perfectly smooth (a delta distribution).
struct Material {
    std::string name;
    MaterialKind kind = MaterialKind::diffuse;
    glm::vec3 base_color{0.8f};
    float roughness = 1.0f;   ///< in [0, 1]
    float metallic = 0.0f;    ///< in [0, 1]; metallic_roughness only
    float ior = 1.5f;         ///< interior over exterior index, > 0; dielectric only
    glm::vec3 emission{0.0f}; ///< radiance, from the front face only (both faces if two_sided)
    bool two_sided = true;    ///< whether emission leaves the back face as well
    int32_t base_color_texture = NO_TEXTURE;
    int32_t metallic_roughness_texture = NO_TEXTURE;
    int32_t emission_texture = NO_TEXTURE;
    int32_t normal_texture = NO_TEXTURE; ///< tangent-space normals, +Y up as in glTF
    float normal_scale = 1.0f;
};

/// Triangles in object space. Counter-clockwise seen from the front face.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< per vertex, unit; empty means flat shading
    std::vector<glm::vec2> uvs;     ///< per vertex, v downward as in glTF; may be empty
    std::vector<glm::uvec3> triangles;
    std::vector<uint32_t> materials; ///< one per triangle
};

/// A mesh placed in the world. The transform is affine and invertible.
struct Instance {
    uint32_t mesh = 0;
    glm::mat4 object_to_world{1.0f};
};

/// An analytic sphere in world space.
struct Sphere {
    glm::vec3 center{0.0f};
    float radius = 1.0f;
    uint32_t material = 0;
};

struct PointLight {
    glm::vec3 position{0.0f};
    glm::vec3 intensity{1.0f}; ///< W/sr
};

struct DirectionalLight {
    glm::vec3 to_light{0.0f, 1.0f, 0.0f}; ///< unit, pointing from the scene toward the light
    glm::vec3 irradiance{1.0f};           ///< on a surface facing the light
};

/// Light from infinity: `radiance` times the equirectangular `map` if there is one.
/// Map row 0 is straight up (+Y); the centre column is -Z; +X is to the right of it.
/// rotation (radians) turns the map counter-clockwise about +Y seen from above.
struct Environment {
    glm::vec3 radiance{0.0f};
    std::optional<Image> map; ///< 3 channels
    float rotation = 0.0f;
};

struct Camera {
    std::string name;
    glm::mat4 camera_to_world{1.0f}; ///< rotation and translation
    float vertical_fov = 0.7f;       ///< radians, in (0, pi)
    float aperture_radius = 0.0f;    ///< thin lens, world units; 0 is a pinhole
    float focus_distance = 1.0f;     ///< along the view axis, world units
};

enum class Filter : uint32_t { box, tent, gaussian, blackman_harris };

/// What a scene file may ask for; the command line overrides each.
struct RenderSettings {
    std::optional<uint32_t> width, height, samples, depth, seed;
    std::optional<Filter> filter;
    std::optional<float> exposure;
};

struct Scene {
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Sphere> spheres;
    std::vector<PointLight> point_lights;
    std::vector<DirectionalLight> directional_lights;
    Environment environment;
    std::vector<Camera> cameras;
    RenderSettings settings;
    std::vector<std::string> notes; ///< what was mapped, ignored or added, a sentence each
};

} // namespace onde
