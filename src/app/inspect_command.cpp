#include "app/inspect_command.h"

#include "app/inspect_report.h"
#include "app/render_request.h"

#include "core/error.h"
#include "core/log.h"
#include "core/output.h"

#include <memory>

namespace onde::app {
namespace {

struct InspectRequest {
    RenderRequest render; ///< scene, size, depth, ...: as the picture was rendered
    std::string pixel;
    uint32_t sample = 0;
    std::filesystem::path dot;
};

PixelSample parse_pixel(const InspectRequest& request) {
    const auto pair = parse_pair(request.pixel, ',', "--pixel");
    if (!pair)
        throw InputError("--pixel {} is not of the form X,Y, for example 120,80", request.pixel);
    PixelSample at;
    std::tie(at.x, at.y) = *pair;
    at.sample = request.sample;
    return at;
}

void run(const InspectRequest& request) {
    set_up_logging(true); // the sample alone is wanted
    check_request(request.render);
    const PixelSample at = parse_pixel(request);
    if (!request.dot.empty()) check_writable(request.dot);
    Machine machine = open_machine(request.render.machine);
    Scene scene = load_requested_scene(request.render);
    check_not_read(request.dot, scene.files);
    Session session = open_session(machine, std::move(scene), request.render);
    const SampleReport report = session.inspect(at);
    fmt::print("pixel {},{} of {}x{}, sample {}\n{}", at.x, at.y, session.options().width,
               session.options().height, at.sample,
               sample_text(report, session.scene(), session.packed()));
    if (!request.dot.empty())
        write_file(request.dot, sample_dot(report, session.scene(), session.packed()));
}

} // namespace

void add_inspect_command(Command& root) {
    const auto request = std::make_shared<InspectRequest>(); // what runs later is copied
    Command command = root.add_command(
        "inspect", "Replay one sample of a pixel: its ray tree, or its path, in words");
    command.option("--pixel", &request->pixel, "From the upper left",
                   {.value = "X,Y", .required = true});
    command.option("--sample", &request->sample, "Of the pixel, from 0", {.value = "S"});
    command.option("--dot", &request->dot, "Write it as a graph for Graphviz too",
                   {.value = "FILE"});
    declare_replay_options(command, request->render);
    command.on_run([request] { run(*request); });
}

} // namespace onde::app
