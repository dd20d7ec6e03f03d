// What a scene file may leave out: a camera, and something that shines.
#include "scene/load.h"
#include "scene/merge.h"
#include "scene/phong.h"
#include "scene/stage.h"
#include "scene/studio.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace onde {

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
    for_each_medium(scene,
                    [&](const Medium& m) { found = found || m.emission != glm::vec3(0.0f); });
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

static void add_studio(Scene& scene, const char* reason) {
    scene.environment = {.radiance = glm::vec3(1.0f), .map = studio_map(), .rotation = 0.0f};
    scene.has_studio = true;
    scene.notes.push_back(fmt::format("{}: a neutral studio was added (--studio off).", reason));
}

static void complete_light(Scene& scene, const LoadOptions& options, bool is_model) {
    if (options.studio == Studio::off || emits(scene.environment)) return;
    if (!anything_emits(scene))
        add_studio(scene, "Nothing in the file lights the scene");
    else if (options.studio == Studio::on || is_model)
        add_studio(scene, "The file has no environment");
}

static Stage stage_of(const Scene& scene, const LoadOptions& options, bool is_model) {
    if (options.stage) return *options.stage;
    StageFit fit(scene, options, is_model);
    fit.add(scene);
    return fit.stage();
}

void complete_scene(Scene& scene, const LoadOptions& options, bool is_model) {
    complete_lights(scene);
    const Stage stage = stage_of(scene, options, is_model);
    if (stage.camera) {
        scene.cameras.push_back(*stage.camera);
        scene.notes.push_back("The file has no camera: one was added that sees the whole scene.");
    }
    complete_light(scene, options, is_model);
    if (options.ground == GroundPlane::off) scene.environment.ground.reset();
    if (stage.ground) scene.environment.ground = stage.ground;
    if (stage.ground && options.ground == GroundPlane::automatic)
        scene.notes.push_back("A ground was added under the model that shows only its shadow and "
                              "reflection (--ground off).");
}

} // namespace onde
