#include "app/volumes_command.h"

#include "app/render_request.h"
#include "app/volumes_report.h"
#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/output.h"
#include "gpu/settings.h"
#include "scene/load.h"

#include <cmath>
#include <memory>

namespace onde::app {
namespace {

struct VolumesRequest {
    std::filesystem::path scene, plot;
    LoadRequest load;
    MachineRequest machine;
    uint32_t rays = 1u << 18;
    double trials = 0;
};

void check(const VolumesRequest& request) {
    if (request.rays < 64 || request.rays > 1u << 24)
        throw InputError("--rays {} is out of range; use 64 to {}", request.rays, 1u << 24);
    if (!(request.trials >= 0 && request.trials <= 1e12))
        throw InputError("--trials {} is out of range; use 0 to 1e12", request.trials);
    if (request.plot.empty()) return;
    if (lower_extension(request.plot) != ".svg")
        throw InputError("{}: plots are written as .svg; change the extension",
                         request.plot.string());
    check_writable(request.plot);
}

/// Beyond these, squares and products of floats are lost.
void check_size(const SphereVolume& sphere) {
    constexpr float SMALLEST = 1e-7f, LARGEST = 1e9f;
    if (sphere.radius == 0 || (sphere.radius >= SMALLEST && sphere.radius <= LARGEST)) return;
    throw InputError("the scene's triangles fill a sphere of radius {:g}; the laboratory measures "
                     "{:g} to {:g}: scale the scene",
                     sphere.radius, SMALLEST, LARGEST);
}

void run(const VolumesRequest& request) {
    set_up_logging(false);
    check(request);
    Machine machine = open_machine(request.machine);
    const Scene scene = load_scene(request.scene, load_options(request.load));
    check_not_read(request.plot, scene.files);
    const TriangleSoup object = scene_triangles(scene);
    if (const size_t left_out = scene.spheres.size() + scene.shapes.size())
        spdlog::info("volumes are put around triangles; left out: {} spheres or other shapes",
                     left_out);
    const FittedVolumes volumes = fit_volumes(object.positions);
    check_size(volumes.sphere);
    VolumeTester tester(machine.programs, volumes,
                        gpu::default_settings(machine.device.facts()).width);
    const LabReport report =
        run_laboratory(machine.programs, object, volumes, tester, request.rays);
    fmt::print("{}", lab_text(report));
    if (request.trials > 0)
        fmt::print("{}", trials_text(try_volumes(machine.device, tester, object,
                                                 uint64_t(request.trials), 1)));
    if (!request.plot.empty())
        write_file(request.plot, lab_svg(report, request.scene.filename().string()));
}

} // namespace

void add_volumes_command(Command& root) {
    const auto request = std::make_shared<VolumesRequest>(); // what runs later is copied
    Command command = root.add_command(
        "volumes", "Compare bounding volumes and hierarchies of boxes around a scene's triangles");
    command.option("scene", &request->scene, fmt::format("A {} file", SCENE_FILES),
                   {.value = "SCENE", .required = true});
    command.option("--rays", &request->rays, "Random lines (262144)", {.value = "N"});
    command.option("--trials", &request->trials,
                   "Also check that no volume rejects a hit, with that many rays, such as 1e8",
                   {.value = "N"});
    command.option("--plot", &request->plot, "Write the figures as a picture, .svg",
                   {.value = "FILE"});
    declare_load(command, request->load);
    declare_machine(command, request->machine);
    command.on_run([request] { run(*request); });
}

} // namespace onde::app
