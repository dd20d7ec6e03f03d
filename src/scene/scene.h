// A scene as plain values, in world units and linear RGB. What the loaders make, what upload packs,
// what the tests' reference renders. It knows nothing of files or devices.
//
// Conventions: right-handed, Y up as in glTF; a camera looks along its local -Z with +Y up;
// radiometric units (radiance W/(sr m^2), intensity W/sr, irradiance W/m^2), per RGB channel.
#pragma once

#include "core/enum_words.h"
#include "image/image.h"
#include "scene/lesson.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace onde {

enum class Wrap : uint32_t { repeat, clamp, mirror };

constexpr auto enum_words(Wrap) {
    return std::array{EnumWord{Wrap::repeat, "repeat"}, EnumWord{Wrap::clamp, "clamp"},
                      EnumWord{Wrap::mirror, "mirror"}};
}

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
    phong,              ///< the chapter's (C6 to C9); path tracing maps it, see path_material()
};

constexpr auto enum_words(MaterialKind) {
    return std::array{EnumWord{MaterialKind::diffuse, "diffuse"},
                      EnumWord{MaterialKind::conductor, "conductor"},
                      EnumWord{MaterialKind::dielectric, "dielectric"},
                      EnumWord{MaterialKind::metallic_roughness, "metallic-roughness"},
                      EnumWord{MaterialKind::phong, "phong"}};
}

/// What the Whitted integrator does at a surface; base_color is the chapter's Co, Material::ior its
/// n2 / n1. docs/whitted.md says how each number is used, and what other kinds are mapped to.
struct Phong {
    float ambient = 1.0f, diffuse = 1.0f, specular = 0.0f; ///< weights of the three parts, >= 0
    float exponent = 20.0f;                                ///< of the specular part, >= 0
    float reflection = 0.0f;   ///< factor of light that comes along the mirror direction, in [0, 1]
    float transmission = 0.0f; ///< factor of light that comes through, in [0, 1]
    float abbe = 0.0f;         ///< Abbe number V_d of the index, > 0; 0: no dispersion
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
    Phong phong;
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

enum class ShapeKind : uint32_t { sphere, disk, cylinder, cone, torus };

constexpr auto enum_words(ShapeKind) {
    return std::array{EnumWord{ShapeKind::sphere, "sphere"}, EnumWord{ShapeKind::disk, "disk"},
                      EnumWord{ShapeKind::cylinder, "cylinder"}, EnumWord{ShapeKind::cone, "cone"},
                      EnumWord{ShapeKind::torus, "torus"}};
}

/// An analytic shape: a canonical one in object space, placed by an affine, invertible transform.
/// sphere: radius 1 about the origin. disk: radius 1 in the XZ plane, front toward +Y.
/// cylinder: radius 1 about the Y axis, y in [-1, 1]. cone: base of radius 1 at y = 0, tip at
/// y = 1. torus: about the Y axis, major radius 1. Cylinder and cone are closed solids. Front faces
/// look outward.
struct Shape {
    ShapeKind kind = ShapeKind::sphere;
    uint32_t material = 0;
    float minor_radius = 0.25f; ///< torus only, in (0, 1)
    glm::mat4 object_to_world{1.0f};
};

/// Lights have two measures: a radiometric one for integrators that follow light, and `strength`,
/// the chapter's is * Cs, for Whitted. Loaders set at least one; complete_scene() the other.
struct PointLight {
    glm::vec3 position{0.0f};
    glm::vec3 intensity{1.0f}; ///< W/sr
    glm::vec3 strength{0.0f};
};

struct DirectionalLight {
    glm::vec3 to_light{0.0f, 1.0f, 0.0f}; ///< unit, pointing from the scene toward the light
    glm::vec3 irradiance{1.0f};           ///< on a surface facing the light
    glm::vec3 strength{0.0f};
};

enum class AreaLightKind : uint32_t { rectangle, disk, sphere };

constexpr auto enum_words(AreaLightKind) {
    return std::array{EnumWord{AreaLightKind::rectangle, "rectangle"},
                      EnumWord{AreaLightKind::disk, "disk"},
                      EnumWord{AreaLightKind::sphere, "sphere"}};
}

/// An extended source as the Whitted integrator sees it. The geometry that emits `radiance` is
/// among the scene's meshes, spheres and shapes as well.
struct AreaLight {
    AreaLightKind kind = AreaLightKind::rectangle;
    glm::vec3 position{0.0f};           ///< rectangle: a corner; disk, sphere: the centre
    glm::vec3 edge1{0.0f}, edge2{0.0f}; ///< rectangle: its edges; disk: two radii
    float radius = 0.0f;                ///< sphere
    uint32_t two_sided = 0;             ///< else light leaves only toward cross(edge1, edge2)
    uint32_t samples = 4;               ///< a grid of samples x samples shadow rays, in [1, 64]
    uint32_t material = 0;              ///< of the geometry
    glm::vec3 strength{0.0f};
};

/// Light from infinity: `radiance` times the equirectangular `map` if there is one.
/// Map row 0 is straight up (+Y); the centre column is -Z; +X is to the right of it.
/// rotation (radians) turns the map counter-clockwise about +Y seen from above.
struct Environment {
    glm::vec3 radiance{0.0f};
    std::optional<Image> map; ///< 3 channels
    float rotation = 0.0f;
};

/// The chapter's screen (C3): a window of real size at a distance before the eye.
struct ScreenWindow {
    glm::vec2 size{1.0f};                 ///< a, b, world units
    float distance = 1.0f;                ///< f
    std::optional<glm::vec2> first_pixel; ///< centre of the lower left pixel, from the view axis;
                                          ///< else the window is centred on the axis
};

struct Camera {
    std::string name;
    glm::mat4 camera_to_world{1.0f};    ///< rotation and translation
    float vertical_fov = 0.7f;          ///< radians, in (0, pi)
    float aperture_radius = 0.0f;       ///< thin lens, world units; 0 is a pinhole
    float focus_distance = 1.0f;        ///< along the view axis, world units
    float orthographic_height = 0.0f;   ///< of the view, world units; 0: perspective
    std::optional<ScreenWindow> screen; ///< replaces vertical_fov
};

/// The surface-by-surface estimator of chapter 2, after T. Whitted, "An improved illumination
/// model for shaded display", 1980.
struct WhittedSettings {
    bool given = false; ///< by a scene file: then those of included files are left out
    std::optional<glm::vec3> ambient;    ///< intensity * colour; else the environment's radiance
    std::optional<glm::vec3> background; ///< what a miss sees; else the environment
    bool saturate = true;                ///< sums are cut at 1 at every node
    bool source_reflectivity = false;    ///< the factor of the point that sends the light (C8)
    bool distance_falloff = false;       ///< indirect light is divided by the squared distance
    bool fresnel = false;                ///< splits transparent surfaces by Fresnel's formula
    float epsilon = 0.0f;     ///< rays whose product of factors is not above it are not followed
    uint32_t wavelengths = 7; ///< that a white ray splits into at a dispersive surface, in [3, 16]

    bool operator==(const WhittedSettings&) const = default;
};

enum class IntegratorKind : uint32_t { path, whitted, light, depth_buffer, painter };

constexpr auto enum_words(IntegratorKind) {
    return std::array{EnumWord{IntegratorKind::path, "path"},
                      EnumWord{IntegratorKind::whitted, "whitted"},
                      EnumWord{IntegratorKind::light, "light"},
                      EnumWord{IntegratorKind::depth_buffer, "depth-buffer"},
                      EnumWord{IntegratorKind::painter, "painter"}};
}

enum class Filter : uint32_t { box, tent, gaussian, blackman_harris };

constexpr auto enum_words(Filter) {
    return std::array{EnumWord{Filter::box, "box"}, EnumWord{Filter::tent, "tent"},
                      EnumWord{Filter::gaussian, "gaussian"},
                      EnumWord{Filter::blackman_harris, "blackman-harris"}};
}

/// What a scene file may ask for; the command line overrides each.
struct RenderSettings {
    std::optional<uint32_t> width, height, samples, depth, seed;
    std::optional<Filter> filter;
    std::optional<float> exposure;
    std::optional<IntegratorKind> integrator;
};

/// How many lights were given in one measure only (see PointLight), by the one that was derived.
struct DerivedLights {
    uint32_t strengths = 0, measures = 0;
};

struct Scene {
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Sphere> spheres;
    std::vector<Shape> shapes;
    std::vector<PointLight> point_lights;
    std::vector<DirectionalLight> directional_lights;
    std::vector<AreaLight> area_lights;
    DerivedLights derived_lights; ///< filled in by complete_scene()
    Environment environment;
    std::vector<Camera> cameras;
    RenderSettings settings;
    WhittedSettings whitted;
    std::optional<Lesson> lesson;
    std::vector<std::string> notes; ///< what was mapped, ignored or added, a sentence each
};

} // namespace onde
