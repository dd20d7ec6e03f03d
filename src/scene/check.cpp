#include "scene/check.h"

#include "core/error.h"
#include "scene/load.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace onde {

namespace {

bool finite(float x) {
    return std::isfinite(x);
}
bool finite(const glm::vec2& v) {
    return finite(v.x) && finite(v.y);
}
bool finite(const glm::vec3& v) {
    return finite(v.x) && finite(v.y) && finite(v.z);
}
bool finite(const glm::mat4& m) {
    return std::all_of(&m[0][0], &m[0][0] + 16, [](float x) { return finite(x); });
}
/// False for NaN.
bool in_unit(float x) {
    return x >= 0.0f && x <= 1.0f;
}
bool not_negative(const glm::vec3& v) {
    return finite(v) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f;
}
bool is_unit(const glm::vec3& v) {
    return std::abs(glm::length(v) - 1.0f) < 1e-3f;
}

void require(bool holds, const char* list, size_t index, const std::string& name,
             const char* problem) {
    if (holds) return;
    const std::string label = name.empty() ? "" : " '" + name + "'";
    throw InputError("{} {}{}: {}", list, index, label, problem);
}

void check_texture(const Texture& texture, size_t i) {
    const ByteImage& image = texture.image;
    require(image.width > 0 && image.height > 0, "texture", i, texture.name, "it has no pixels");
    require(image.rgba.size() == size_t(4) * image.width * image.height, "texture", i, texture.name,
            "its size and its pixels disagree");
}

} // namespace

void check_material(const Scene& scene, size_t i) {
    const Material& m = scene.materials[i];
    const auto check = [&](bool holds, const char* problem) {
        require(holds, "material", i, m.name, problem);
    };
    check(in_unit(m.base_color.x) && in_unit(m.base_color.y) && in_unit(m.base_color.z),
          "its base colour must lie between 0 and 1");
    check(in_unit(m.roughness), "its roughness must lie between 0 and 1");
    check(in_unit(m.metallic), "its metallic must lie between 0 and 1");
    check(finite(m.ior) && m.ior > 0.0f, "its ior must be above 0");
    check(not_negative(m.emission), "its emission must be finite and not negative");
    check(finite(m.normal_scale), "its normal scale must be finite");
    const Phong& p = m.phong;
    check(finite(p.ambient) && finite(p.diffuse) && finite(p.specular) && p.ambient >= 0.0f &&
              p.diffuse >= 0.0f && p.specular >= 0.0f,
          "its ambient, diffuse and specular must be finite and not negative");
    check(finite(p.exponent) && p.exponent >= 0.0f, "its exponent must not be negative");
    check(in_unit(p.reflection) && in_unit(p.transmission),
          "its reflection and transmission must lie between 0 and 1");
    check(finite(p.abbe) && p.abbe >= 0.0f, "its Abbe number must not be negative");
    for (int32_t texture :
         {m.base_color_texture, m.metallic_roughness_texture, m.emission_texture, m.normal_texture})
        check(texture >= NO_TEXTURE && texture < int64_t(scene.textures.size()),
              "it names a texture that does not exist");
}

namespace {

template <class T>
bool all_finite(const std::vector<T>& values) {
    return std::all_of(values.begin(), values.end(), [](const T& value) { return finite(value); });
}

void check_mesh(const Scene& scene, size_t i) {
    const Mesh& mesh = scene.meshes[i];
    const size_t vertices = mesh.positions.size(), materials = scene.materials.size();
    const auto check = [&](bool holds, const char* problem) {
        require(holds, "mesh", i, mesh.name, problem);
    };
    const auto in_range = [&](const glm::uvec3& t) {
        return t.x < vertices && t.y < vertices && t.z < vertices;
    };
    check(all_finite(mesh.positions), "a position is not finite");
    check(mesh.normals.empty() || mesh.normals.size() == vertices, "normals are missing");
    check(std::all_of(mesh.normals.begin(), mesh.normals.end(), is_unit), "a normal is not unit");
    check(mesh.uvs.empty() || mesh.uvs.size() == vertices, "texture coordinates are missing");
    check(all_finite(mesh.uvs), "a texture coordinate is not finite");
    check(std::all_of(mesh.triangles.begin(), mesh.triangles.end(), in_range),
          "a triangle names a vertex that does not exist");
    check(mesh.materials.size() == mesh.triangles.size(), "triangles and materials disagree");
    check(std::all_of(mesh.materials.begin(), mesh.materials.end(),
                      [&](uint32_t material) { return material < materials; }),
          "a triangle names a material that does not exist");
}

} // namespace

void check_transform(const glm::mat4& m, const char* list, size_t i) {
    require(finite(m), list, i, "", "its transform is not finite");
    require(m[0][3] == 0.0f && m[1][3] == 0.0f && m[2][3] == 0.0f && m[3][3] == 1.0f, list, i, "",
            "its transform is not affine");
    require(glm::determinant(m) != 0.0f && finite(glm::inverse(m)), list, i, "",
            "its transform is not invertible");
}

namespace {

void check_instance(const Scene& scene, size_t i) {
    const Instance& instance = scene.instances[i];
    require(instance.mesh < scene.meshes.size(), "instance", i, "",
            "it names a mesh that does not exist");
    check_transform(instance.object_to_world, "instance", i);
}

void check_shape(const Scene& scene, size_t i) {
    const Shape& shape = scene.shapes[i];
    require(shape.material < scene.materials.size(), "shape", i, "",
            "it names a material that does not exist");
    require(shape.kind != ShapeKind::torus ||
                (shape.minor_radius > 0.0f && shape.minor_radius < 1.0f),
            "shape", i, "", "its minor radius must lie between 0 and the major one");
    check_transform(shape.object_to_world, "shape", i);
}

void check_lights(const Scene& scene) {
    for (size_t i = 0; i < scene.point_lights.size(); ++i) {
        const PointLight& light = scene.point_lights[i];
        require(finite(light.position), "point light", i, "", "its position is not finite");
        require(not_negative(light.intensity), "point light", i, "",
                "its intensity must be finite and not negative");
        require(not_negative(light.strength), "point light", i, "",
                "its strength must be finite and not negative");
    }
    for (size_t i = 0; i < scene.directional_lights.size(); ++i) {
        const DirectionalLight& light = scene.directional_lights[i];
        require(is_unit(light.to_light), "directional light", i, "", "its direction is not unit");
        require(not_negative(light.irradiance), "directional light", i, "",
                "its irradiance must be finite and not negative");
        require(not_negative(light.strength), "directional light", i, "",
                "its strength must be finite and not negative");
    }
}

void check_area_light(const Scene& scene, size_t i) {
    const AreaLight& light = scene.area_lights[i];
    const auto check = [&](bool holds, const char* problem) {
        require(holds, "area light", i, "", problem);
    };
    check(finite(light.position) && finite(light.edge1) && finite(light.edge2) &&
              finite(light.radius),
          "its position and size must be finite");
    check(not_negative(light.strength), "its strength must be finite and not negative");
    check(light.samples >= 1 && light.samples <= 64, "its samples must lie between 1 and 64");
    check(light.material < scene.materials.size(), "it names a material that does not exist");
}

void check_environment(const Environment& environment) {
    if (!not_negative(environment.radiance) || !finite(environment.rotation))
        throw InputError(
            "environment: radiance and rotation must be finite, radiance not negative");
    if (!environment.map) return;
    const Image& map = *environment.map;
    if (map.width == 0 || map.height == 0 || map.channels != 3 ||
        map.pixels.size() != size_t(3) * map.width * map.height)
        throw InputError("environment: its map must have pixels of 3 channels");
    if (!std::all_of(map.pixels.begin(), map.pixels.end(),
                     [](float x) { return finite(x) && x >= 0.0f; }))
        throw InputError("environment: its map must be finite and not negative");
}

} // namespace

void check_camera(const Camera& camera, size_t i) {
    const glm::mat4& m = camera.camera_to_world;
    const glm::mat3 axes(m);
    const auto check = [&](bool holds, const char* problem) {
        require(holds, "camera", i, camera.name, problem);
    };
    check(finite(m), "its transform is not finite");
    check(is_unit(axes[0]) && is_unit(axes[1]) && is_unit(axes[2]) &&
              std::abs(glm::determinant(axes) - 1.0f) < 1e-2f,
          "its transform must be a rotation and a translation");
    check(camera.vertical_fov > 0.0f && camera.vertical_fov < 3.14159f,
          "its vertical field of view must lie between 0 and 180 degrees");
    check(finite(camera.aperture_radius) && camera.aperture_radius >= 0.0f,
          "its aperture must not be negative");
    check(finite(camera.focus_distance) && camera.focus_distance > 0.0f,
          "its focus distance must be above 0");
    check(finite(camera.orthographic_height) && camera.orthographic_height >= 0.0f,
          "its orthographic height must not be negative");
    if (!camera.screen) return;
    check(finite(camera.screen->size) && camera.screen->size.x > 0.0f &&
              camera.screen->size.y > 0.0f && finite(camera.screen->distance) &&
              camera.screen->distance > 0.0f &&
              finite(camera.screen->first_pixel.value_or(glm::vec2(0.0f))),
          "its screen must have a size and a distance above 0");
}

namespace {

void check_settings(const RenderSettings& settings) {
    if (settings.width.value_or(1) == 0 || settings.height.value_or(1) == 0)
        throw InputError("film: its width and height must be at least 1");
    if (settings.samples.value_or(1) == 0 || settings.depth.value_or(1) == 0)
        throw InputError("render: samples and depth must be at least 1");
    if (!finite(settings.exposure.value_or(0.0f)))
        throw InputError("render: exposure must be finite");
}

bool has_geometry(const Scene& scene) {
    return !scene.spheres.empty() || !scene.shapes.empty() ||
           std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const Instance& instance) {
                           return !scene.meshes[instance.mesh].triangles.empty();
                       });
}

} // namespace

void check_scene(const Scene& scene) {
    for (size_t i = 0; i < scene.textures.size(); ++i) check_texture(scene.textures[i], i);
    for (size_t i = 0; i < scene.materials.size(); ++i) check_material(scene, i);
    for (size_t i = 0; i < scene.meshes.size(); ++i) check_mesh(scene, i);
    for (size_t i = 0; i < scene.instances.size(); ++i) check_instance(scene, i);
    for (size_t i = 0; i < scene.spheres.size(); ++i) {
        const Sphere& sphere = scene.spheres[i];
        require(finite(sphere.center), "sphere", i, "", "its centre is not finite");
        require(finite(sphere.radius) && sphere.radius > 0.0f, "sphere", i, "",
                "its radius must be above 0");
        require(sphere.material < scene.materials.size(), "sphere", i, "",
                "it names a material that does not exist");
    }
    for (size_t i = 0; i < scene.shapes.size(); ++i) check_shape(scene, i);
    check_lights(scene);
    for (size_t i = 0; i < scene.area_lights.size(); ++i) check_area_light(scene, i);
    check_environment(scene.environment);
    for (size_t i = 0; i < scene.cameras.size(); ++i) check_camera(scene.cameras[i], i);
    check_settings(scene.settings);
    if (!has_geometry(scene)) throw InputError("the scene is empty; add a shape or a mesh");
}

} // namespace onde
