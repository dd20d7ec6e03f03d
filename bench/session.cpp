// How soon the next picture of a session starts after an edit: the time until its first launch,
// beside that of the first picture. Medians are printed.
#include "front.h"

#include "scene/load.h"
#include "session/choices.h"
#include "session/machine.h"
#include "session/session.h"

#include "core/timer.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <functional>

namespace onde::bench {
namespace {

struct Options {
    std::string scene, device, kernels;
    uint32_t width = 0, height = 0, repetitions = 9;
};

double ready_after(Session& session, const std::function<void()>& edit) {
    const Timer timer;
    edit();
    session.prepare();
    session.device().finish();
    return timer.seconds();
}

void race(Session& session, const char* name, uint32_t repetitions,
          const std::function<void(float)>& edit) {
    std::vector<double> seconds;
    for (uint32_t i = 0; i < repetitions; ++i)
        seconds.push_back(ready_after(session, [&] { edit(0.01f * float(i + 1)); }));
    std::ranges::sort(seconds);
    fmt::print("{:<20} {:9.2f} ms, spread {:.2f} to {:.2f}\n", name,
               1e3 * seconds[seconds.size() / 2], 1e3 * seconds.front(), 1e3 * seconds.back());
}

void race_edits(Session& session, uint32_t repetitions) {
    const Scene first = session.scene();
    race(session, "another camera", repetitions, [&](float by) {
        Camera camera = session.camera();
        camera.camera_to_world[3] += glm::vec4(by, 0, 0, 0);
        session.set_camera(camera);
    });
    race(session, "another material", repetitions, [&](float by) {
        Material material = first.materials[0];
        material.base_color *= 1 - by;
        session.set_material(0, material);
    });
    if (first.instances.empty()) return;
    race(session, "a moved instance", repetitions, [&](float by) {
        const glm::mat4 move = glm::translate(glm::mat4(1.0f), glm::vec3(0, by, 0));
        session.set_instance_transform(0, move * first.instances[0].object_to_world);
    });
}

void run(const Options& options) {
    Machine machine(options.device, gpu::KernelSources::from(options.kernels));
    Scene scene = load_scene(options.scene);
    RenderChoices choices;
    if (options.width > 0) choices.width = options.width;
    if (options.height > 0) choices.height = options.height;
    const RenderOptions render = resolve_options(choices, scene, machine.device.facts()).options;
    const Timer timer;
    Session session(machine.programs, std::move(scene), {.render = render});
    session.prepare();
    fmt::print("{} triangles at {}x{} on {}\n", session.packed().bvh.statistics.triangles,
               render.width, render.height, machine.device.facts().name);
    fmt::print("{:<20} {:9.2f} ms, of them {:.2f} to pack the scene and {:.2f} to {} kernels\n",
               "the first picture", 1e3 * timer.seconds(), 1e3 * session.pack_seconds(),
               1e3 * session.prepare().seconds, session.prepare().from_cache ? "load" : "compile");
    race_edits(session, options.repetitions);
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("session", "How soon the next picture starts after an edit");
    onde::Command root = line.root();
    root.option("scene", &options.scene, "A scene file", {.value = "SCENE", .required = true});
    root.option("--width", &options.width, "of the picture (the scene's)",
                {.least = 1, .most = 16384});
    root.option("--height", &options.height, "of the picture (the scene's)",
                {.least = 1, .most = 16384});
    onde::bench::add_device(root, options.device);
    onde::bench::add_kernels(root, options.kernels);
    onde::bench::add_repetitions(root, options.repetitions);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
