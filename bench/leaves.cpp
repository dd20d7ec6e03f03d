// What leaves cost that are cut out by a texture: a crown of quads with masks, beside the same
// crown of cut geometry, and of whole quads. Rendered in turn; medians are printed.
#include "figures.h"
#include "front.h"

#include "session/choices.h"
#include "session/machine.h"
#include "session/session.h"

#include <array>
#include <memory>
#include <random>

namespace onde::bench {
namespace {

struct Options {
    std::string device, kernels, json;
    uint32_t leaves = 500000, size = 512, samples = 8, repetitions = 5;
};

enum class Kind { masked, cut, whole };
constexpr std::array KINDS{Kind::masked, Kind::cut, Kind::whole};
constexpr std::array<const char*, 3> NAMES{"masked quads", "cut geometry", "whole quads"};

/// Half of a leaf's width at these parts of its length; both outlines run straight between them.
constexpr std::array<float, 5> HALF_WIDTHS{0.0f, 0.375f, 0.5f, 0.375f, 0.0f};
constexpr uint32_t STEPS = HALF_WIDTHS.size() - 1;

float half_width(float along) {
    const float at = along * STEPS;
    const auto step = std::min(uint32_t(at), STEPS - 1);
    return glm::mix(HALF_WIDTHS[step], HALF_WIDTHS[step + 1], at - float(step));
}

/// White where the leaf is, and nothing around it.
TexelImage outline() {
    constexpr uint32_t SIZE = 256;
    TexelImage image{SIZE, SIZE, {}};
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            const float across = std::abs((float(y) + 0.5f) / SIZE - 0.5f);
            const bool leaf = across <= half_width((float(x) + 0.5f) / SIZE);
            image.rgba.insert(image.rgba.end(), {255, 255, 255, uint8_t(leaf ? 255 : 0)});
        }
    return image;
}

void add_triangle(Mesh& mesh, glm::uvec3 corners) {
    mesh.triangles.push_back(corners);
    mesh.materials.push_back(0);
}

/// A leaf between `from` and `from` + `along` + `across`.
void add_leaf(Mesh& mesh, Kind kind, glm::vec3 from, glm::vec3 along, glm::vec3 across) {
    const auto first = uint32_t(mesh.positions.size());
    const auto add = [&](float u, float v) {
        mesh.positions.push_back(from + along * u + across * v);
        mesh.uvs.emplace_back(u, v);
    };
    if (kind != Kind::cut) {
        for (const glm::vec2 uv : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) add(uv.x, uv.y);
        add_triangle(mesh, first + glm::uvec3(0, 1, 2));
        add_triangle(mesh, first + glm::uvec3(0, 2, 3));
        return;
    }
    for (uint32_t i = 0; i <= STEPS; i++)
        for (const float side : {-1.0f, 1.0f}) add(float(i) / STEPS, 0.5f + side * HALF_WIDTHS[i]);
    for (uint32_t i = 0; i < STEPS; i++) {
        const uint32_t k = first + 2 * i; // the first and last pair of points are one each
        if (i + 1 < STEPS) add_triangle(mesh, {k, k + 2, k + 3});
        if (i > 0) add_triangle(mesh, {k, k + 3, k + 1});
    }
}

/// Leaves in a ball of radius 1, every way round; the same for every kind.
Scene crown(Kind kind, uint32_t leaves) {
    std::minstd_rand random(1);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> uniform;
    const auto direction = [&] {
        const float x = normal(random), y = normal(random), z = normal(random);
        return glm::normalize(glm::vec3(x, y, z));
    };
    const float length = 2.0f / std::sqrt(float(leaves)) * 8.0f; // they cover it many times
    Scene scene;
    Mesh& mesh = scene.meshes.emplace_back();
    for (uint32_t i = 0; i < leaves; i++) {
        const glm::vec3 along = direction(), any = direction();
        const glm::vec3 across = 0.6f * glm::normalize(glm::cross(along, any));
        const glm::vec3 center = direction() * std::cbrt(uniform(random));
        add_leaf(mesh, kind, center - 0.5f * length * (along + across), along * length,
                 across * length);
    }
    scene.instances.push_back({0, glm::mat4(1.0f)});
    Material material;
    material.base_color = {0.3f, 0.6f, 0.2f};
    if (kind == Kind::masked) {
        material.alpha_mode = AlphaMode::mask;
        material.base_color_texture = 0;
        scene.textures.push_back({.name = "leaf", .image = outline()});
    }
    scene.materials.push_back(material);
    scene.environment.radiance = glm::vec3(1.0f);
    scene.cameras.push_back(Camera{});
    scene.cameras[0].camera_to_world[3] = glm::vec4(0, 0, 3, 1);
    return scene;
}

struct Contender {
    std::unique_ptr<Session> session;
    Samples seconds;
};

Contender make_contender(Machine& machine, Kind kind, const Options& options) {
    Scene scene = crown(kind, options.leaves);
    RenderChoices choices;
    choices.width = choices.height = options.size;
    choices.samples = options.samples;
    const RenderOptions render = resolve_options(choices, scene, machine.device.facts()).options;
    auto session = std::make_unique<Session>(machine.programs, std::move(scene),
                                             SessionOptions{.render = render});
    session->prepare();
    return {std::move(session), {}};
}

double mean(const Image& picture) {
    double sum = 0;
    for (const float value : picture.pixels) sum += value;
    return sum / double(picture.pixels.size());
}

void run(const Options& options) {
    Machine machine(options.device, gpu::KernelSources::from(options.kernels));
    std::vector<Contender> contenders;
    for (const Kind kind : KINDS) contenders.push_back(make_contender(machine, kind, options));
    for (uint32_t r = 0; r <= options.repetitions; r++) // the first warms up
        for (Contender& contender : contenders) {
            contender.session->clear();
            const double seconds = contender.session->render().seconds;
            if (r > 0) contender.seconds.push_back(seconds);
        }
    fmt::print("{} leaves, {}x{}, {} samples on {}\n", options.leaves, options.size, options.size,
               options.samples, machine.device.facts().name);
    Json json;
    const double fastest = median(contenders[1].seconds);
    for (size_t i = 0; i < contenders.size(); i++) {
        Contender& contender = contenders[i];
        const double seconds = median(contender.seconds);
        const BvhStatistics& tree = contender.session->packed().bvh.statistics;
        fmt::print(
            "{:<13} {:9} triangles  {:8.3f} s  {:5.2f} of the cut geometry's  spread {:4.1f} %"
            "  mean {:.5f}\n",
            NAMES[i], tree.triangles, seconds, seconds / fastest, 100 * spread(contender.seconds),
            mean(contender.session->picture()));
        json.push_back({{"leaves", NAMES[i]},
                        {"triangles", tree.triangles},
                        {"seconds", contender.seconds},
                        {"mean", mean(contender.session->picture())}});
    }
    if (!options.json.empty()) write_json(json, options.json);
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("leaves", "Leaves cut out by a texture beside leaves of cut geometry");
    onde::Command root = line.root();
    root.option("--leaves", &options.leaves, "in the crown", {.least = 1, .most = 4000000});
    root.option("--size", &options.size, "of the picture, a square", {.least = 1, .most = 4096});
    root.option("--spp", &options.samples, "per pixel", {.least = 1, .most = 65536});
    onde::bench::add_device(root, options.device);
    onde::bench::add_kernels(root, options.kernels);
    onde::bench::add_repetitions(root, options.repetitions);
    onde::bench::add_json(root, options.json);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
