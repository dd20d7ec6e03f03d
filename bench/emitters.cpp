// What the light tree saves among many lights: the variance of pictures whose paths choose lights
// by their power over that of paths that choose by the tree, which is how many times fewer samples
// have the same error; and the time of a sample.
#include "figures.h"
#include "front.h"
#include "variance.h"

#include "scene/load.h"

#include <cmath>
#include <filesystem>
#include <random>

namespace onde::bench {
namespace {

struct Options : VarianceOptions {
    std::vector<std::filesystem::path> scenes;
    std::filesystem::path environment;
    uint32_t least = 4, most = 10000; ///< lights
};

constexpr uint32_t COUNTS[] = {4, 8, 12, 16, 24, 32, 100, 1000, 10000, 100000};

constexpr float HALL = 20; ///< metres, the side of its floor

class Hall {
  public:
    /// A floor with pillars, over which as many little triangles float and shine, each another way,
    /// some four times as bright as others. The camera looks down from below them, so that all
    /// noise is that of the light on floor and pillars.
    static Scene with(uint32_t lights) { return Hall().built(lights); }

  private:
    Scene built(uint32_t lights) {
        scene_.materials.emplace_back();
        scene_.materials[0].base_color = glm::vec3(0.6f);
        scene_.meshes.emplace_back();
        add_face({0, 0, 0}, {0, 0, HALL}, {HALL, 0, 0}, 0);
        for (uint32_t i = 0; i < 12; i++) add_pillar(place(0));
        const float side = 2.0f / std::sqrt(float(lights));
        for (uint32_t i = 0; i < 4; i++) {
            Material glow;
            glow.base_color = glm::vec3(0.2f);
            glow.emission = glm::vec3(1, 0.8f, 0.6f) * float(std::pow(4, i));
            scene_.materials.push_back(glow);
        }
        for (uint32_t i = 0; i < lights; i++) add_lamp(side, 1 + i % 4);
        scene_.instances.emplace_back();
        scene_.cameras.push_back(camera());
        return std::move(scene_);
    }

    static Camera camera() {
        const glm::vec3 eye(2, 1, 2), to = glm::normalize(glm::vec3(1, -1, 1));
        const glm::vec3 right = glm::normalize(glm::cross(to, glm::vec3(0, 1, 0)));
        Camera camera;
        camera.camera_to_world = glm::mat4(glm::vec4(right, 0), glm::vec4(glm::cross(right, to), 0),
                                           glm::vec4(-to, 0), glm::vec4(eye, 1));
        camera.vertical_fov = 0.9f;
        return camera;
    }

    float unit() { return std::uniform_real_distribution<float>()(generator_); }
    glm::vec3 place(float height) { return {HALL * unit(), height, HALL * unit()}; }

    void add_face(glm::vec3 corner, glm::vec3 a, glm::vec3 b, uint32_t material) {
        Mesh& mesh = scene_.meshes[0];
        const auto first = uint32_t(mesh.positions.size());
        for (const glm::vec3 p : {corner, corner + a, corner + a + b, corner + b})
            mesh.positions.push_back(p);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
        mesh.materials.insert(mesh.materials.end(), 2, material);
    }
    void add_pillar(glm::vec3 at) {
        const glm::vec3 x(0.6f, 0, 0), y(0, 3, 0), z(0, 0, 0.6f);
        add_face(at, y, x, 0);
        add_face(at, z, y, 0);
        add_face(at + x, y, z, 0);
        add_face(at + z, x, y, 0);
    }
    void add_lamp(float side, uint32_t material) {
        const glm::vec3 at = place(1.1f + 2 * unit());
        const auto way = [&] { return glm::vec3(unit(), unit(), unit()) - 0.5f; };
        const glm::vec3 a = glm::normalize(way());
        const glm::vec3 b = glm::normalize(glm::cross(a, way()));
        Mesh& mesh = scene_.meshes[0];
        const auto first = uint32_t(mesh.positions.size());
        for (const glm::vec3 p : {at, at + side * a, at + side * b}) mesh.positions.push_back(p);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.materials.push_back(material);
    }

    Scene scene_;
    std::mt19937 generator_{7};
};

void run(const Options& options) {
    Machine machine(options.device, gpu::KernelSources::from(options.kernels));
    fmt::print("{}x{}, {} samples, {} seeds, on {}, commit {}\n\n", options.width, options.height,
               options.samples, options.seeds, machine.device.facts().name, source_commit());
    fmt::print(
        "| lights | variance by power | by the tree | samples saved, times | time of a sample "
        "| means apart, % |\n|---|---|---|---|---|---|\n");
    const auto measure = [&](const Scene& scene, const std::string& name) {
        const auto variance_by = [&](LightSampler sampler) {
            Session session = variance_session(machine, scene, options, {.sampler = sampler});
            return variance_over_seeds(session, options.seeds);
        };
        const Variance power = variance_by(LightSampler::power);
        const Variance tree = variance_by(LightSampler::tree);
        fmt::print("| {} | {:.3g} | {:.3g} | {:.2f} | {:.2f} | {:.2g} |\n", name, power.trimmed,
                   tree.trimmed, power.trimmed / tree.trimmed, tree.seconds / power.seconds,
                   100 * std::abs(tree.mean / power.mean - 1));
        std::fflush(stdout);
    };
    for (const uint32_t count : COUNTS)
        if (options.scenes.empty() && count >= options.least && count <= options.most)
            measure(Hall::with(count), std::to_string(count));
    LoadOptions load;
    if (!options.environment.empty())
        load.environment = load_environment(options.environment, glm::vec3(1.0f), 0);
    for (const std::filesystem::path& path : options.scenes)
        measure(load_scene(path, load), path.stem().string());
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("emitters", "What the light tree saves among many lights");
    onde::Command root = line.root();
    root.option("scenes", &options.scenes, "Scene files instead of halls of lights",
                {.value = "SCENE"});
    root.option("--environment", &options.environment, "Light them with this map too",
                {.value = "FILE"});
    root.option("--least", &options.least, "The fewest lights", {.show_default = true});
    root.option("--most", &options.most, "The most lights, to 100000", {.show_default = true});
    onde::bench::add_variance(root, options);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
