#include "model.h"

#include "core/error.h"
#include "core/log.h"
#include "scene/load.h"

#include <glm/gtc/matrix_transform.hpp>

#include <filesystem>

namespace onde::bench {

namespace {

void append(Model& model, const Mesh& mesh, const glm::mat4& object_to_world) {
    const auto first = uint32_t(model.positions.size());
    for (glm::vec3 position : mesh.positions)
        model.positions.emplace_back(object_to_world * glm::vec4(position, 1.0f));
    for (glm::uvec3 triangle : mesh.triangles) model.triangles.push_back(triangle + first);
}

void measure(Model& model) {
    model.low = model.high = model.positions.at(0);
    for (glm::vec3 position : model.positions) {
        model.low = glm::min(model.low, position);
        model.high = glm::max(model.high, position);
    }
    const glm::vec3 middle = 0.5f * (model.low + model.high);
    model.light = {middle.x, model.low.y + 0.9f * (model.high.y - model.low.y), middle.z};
}

} // namespace

Model load_model(const std::string& path) {
    const Scene scene = load_scene(path);
    Model model;
    const std::filesystem::path file(path);
    model.name = (file.parent_path().filename() / file.stem()).string();
    for (const Instance& instance : scene.instances)
        append(model, scene.meshes[instance.mesh], instance.object_to_world);
    if (model.triangles.empty())
        throw InputError("{}: has no triangles; choose a scene with a mesh", path);
    measure(model);
    model.camera = scene.cameras.at(0);
    if (!scene.point_lights.empty()) model.light = scene.point_lights[0].position;
    return model;
}

std::vector<Model> load_models(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) // all of them before the first, which may be long
        if (!std::filesystem::is_regular_file(path))
            throw InputError("{}: no such file; check the path", path);
    std::vector<Model> models;
    for (const std::string& path : paths) {
        spdlog::info("loading {}", path);
        models.push_back(load_model(path));
    }
    if (models.empty()) models.push_back(terrain_model(720));
    return models;
}

Model terrain_model(uint32_t cells) {
    Model model;
    model.name = "terrain";
    const auto height = [](float x, float z) {
        return 0.15f * std::sin(5 * x) * std::cos(4 * z) + 0.03f * std::sin(31 * x + 7 * z) +
               0.008f * std::cos(97 * x * z + 50 * z);
    };
    for (uint32_t row = 0; row <= cells; ++row)
        for (uint32_t column = 0; column <= cells; ++column) {
            const float x = 2.0f * float(column) / float(cells) - 1.0f;
            const float z = 2.0f * float(row) / float(cells) - 1.0f;
            model.positions.emplace_back(x, height(x, z), z);
            if (row == cells || column == cells) continue;
            const uint32_t a = row * (cells + 1) + column, b = a + cells + 1;
            model.triangles.emplace_back(a, b, a + 1);
            model.triangles.emplace_back(a + 1, b, b + 1);
        }
    measure(model);
    model.light = {0.3f, 1.0f, 0.2f};
    model.camera.camera_to_world =
        glm::inverse(glm::lookAt(glm::vec3(0.9f, 0.45f, 0.9f), glm::vec3(0), glm::vec3(0, 1, 0)));
    return model;
}

} // namespace onde::bench
