// What a scene file may leave out: a camera, and something that shines.
#include "scene/load.h"
#include "scene/merge.h"
#include "scene/phong.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde {

static glm::mat4 look_at(const glm::vec3& eye, const glm::vec3& target) {
    const glm::vec3 back = glm::normalize(eye - target);
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back));
    const glm::vec3 up = glm::cross(back, right);
    return glm::mat4(glm::vec4(right, 0.0f), glm::vec4(up, 0.0f), glm::vec4(back, 0.0f),
                     glm::vec4(eye, 1.0f));
}

/// Half the smaller angle of view, for the film's shape that the settings ask for.
static float half_view_angle(const Camera& camera, const RenderSettings& settings) {
    const float half = 0.5f * camera.vertical_fov;
    if (!settings.width || !settings.height || *settings.width >= *settings.height) return half;
    return std::atan(std::tan(half) * float(*settings.width) / float(*settings.height));
}

/// From the front (+Z), a little from the right and from above; the sphere around the bounds fits.
static Camera framing_camera(const Scene& scene) {
    const SceneBounds bounds = scene_bounds(scene);
    const glm::vec3 center = 0.5f * bounds.low + 0.5f * bounds.high;
    const float radius = std::max(0.5f * glm::length(bounds.high - bounds.low), 1e-6f);
    Camera camera;
    camera.name = "framed";
    camera.focus_distance = 1.02f * radius / std::sin(half_view_angle(camera, scene.settings));
    const glm::vec3 direction = glm::normalize(glm::vec3(0.55f, 0.4f, 1.0f));
    camera.camera_to_world = look_at(center + camera.focus_distance * direction, center);
    return camera;
}

/// A rectangular light with soft edges, in spherical coordinates about its centre.
struct Softbox {
    float azimuth, elevation; ///< of its centre, radians; azimuth 0 is -Z, pi/2 is +X
    float half_width, half_height, softness; ///< radians
    float radiance;
};

static float edge(float distance, float half_size, float softness) {
    const float t = std::clamp((half_size + softness - distance) / softness, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static float radiance_toward(const Softbox& box, float azimuth, float elevation) {
    const float turn = std::remainder(azimuth - box.azimuth, 2.0f * std::numbers::pi_v<float>);
    return box.radiance * edge(std::abs(turn), box.half_width, box.softness) *
           edge(std::abs(elevation - box.elevation), box.half_height, box.softness);
}

/// A grey gradient, brighter above, with a key light from the upper left of the framing camera, a
/// fill from its right and a rim from behind.
static Image studio_map() {
    constexpr float PI = std::numbers::pi_v<float>;
    // The framing camera stands toward +Z: behind it is azimuth pi, its left is -X.
    const Softbox boxes[] = {{-0.80f * PI, 0.75f, 0.40f, 0.30f, 0.25f, 9.0f},
                             {0.62f * PI, 0.35f, 0.45f, 0.45f, 0.40f, 1.6f},
                             {0.10f * PI, 0.85f, 0.60f, 0.12f, 0.20f, 3.0f}};
    Image map(64, 32, 3);
    for (uint32_t y = 0; y < map.height; ++y)
        for (uint32_t x = 0; x < map.width; ++x) {
            const float elevation = PI * (0.5f - (float(y) + 0.5f) / float(map.height));
            const float azimuth = 2.0f * PI * ((float(x) + 0.5f) / float(map.width) - 0.5f);
            float radiance = 0.30f + 0.25f * std::sin(elevation);
            for (const Softbox& box : boxes) radiance += radiance_toward(box, azimuth, elevation);
            std::ranges::fill(map.pixel(x, y), radiance);
        }
    return map;
}

/// The mean of a texture's largest colour channel, linear, from every 16th texel.
static float mean_brightness(const Scene& scene, const Texture& texture) {
    const std::vector<uint8_t>& rgba = image_of(scene.textures, texture).rgba;
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i + 3 < rgba.size(); i += 4 * 16) {
        const float value = float(std::max({rgba[i], rgba[i + 1], rgba[i + 2]})) / 255.0f;
        sum += texture.srgb ? std::pow(value, 2.2f) : value;
        count += 1.0;
    }
    return count > 0.0 ? float(sum / count) : 0.0f;
}

/// Whether a material lights a scene. Small glowing details, as in many glTF models' emission
/// textures, don't: without more light the rest of the model would be black.
static bool lights_scene(const Scene& scene, const Material& material) {
    const float emission =
        std::max({material.emission.x, material.emission.y, material.emission.z});
    if (emission <= 0.0f || material.emission_texture == NO_TEXTURE) return emission > 0.0f;
    return emission * mean_brightness(scene, scene.textures[size_t(material.emission_texture)]) >
           0.1f;
}

static bool anything_emits(const Scene& scene) {
    bool found = emits(scene.environment);
    for_each_light_list(scene, [&](const auto& lights, const auto&, const char*) {
        found = found || !lights.empty();
    });
    if (found) return true;
    std::vector<bool> lights;
    for (const Material& material : scene.materials)
        lights.push_back(lights_scene(scene, material));
    for (const Sphere& sphere : scene.spheres)
        if (lights[sphere.material]) return true;
    for (const Shape& shape : scene.shapes)
        if (lights[shape.material]) return true;
    for (const Instance& instance : scene.instances) {
        const std::vector<uint32_t>& materials = scene.meshes[instance.mesh].materials;
        if (std::ranges::any_of(materials, [&](uint32_t m) { return lights[m]; })) return true;
    }
    return false;
}

void complete_scene(Scene& scene) {
    complete_lights(scene);
    if (scene.cameras.empty()) {
        scene.cameras.push_back(framing_camera(scene));
        scene.notes.push_back("The file has no camera: one was added that sees the whole scene.");
    }
    if (!anything_emits(scene)) {
        scene.environment = {.radiance = glm::vec3(1.0f), .map = studio_map(), .rotation = 0.0f};
        scene.notes.push_back("Nothing in the file lights the scene: a neutral studio was added.");
    }
}

} // namespace onde
