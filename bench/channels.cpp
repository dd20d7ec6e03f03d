// What each channel costs: the time of a frame that has it over that of one without, and the bytes
// of the film and of paths in flight. First that the picture has the same bits.
#include "figures.h"
#include "front.h"

#include "core/error.h"
#include "core/timer.h"
#include "render/film.h"
#include "scene/load.h"
#include "session/choices.h"
#include "session/machine.h"
#include "session/session.h"

#include <memory>

namespace onde::bench {
namespace {

struct Options {
    std::string scene, device, kernels;
    uint32_t width = 640, height = 480, samples = 16, repetitions = 5;
};

/// A frame with some channels, timed again and again.
struct Contender {
    std::string name;
    std::unique_ptr<Session> session;
    Samples seconds{};
};

class Race {
  public:
    Race(const Options& options)
        : options_(options), machine_(options.device, gpu::KernelSources::from(options.kernels)),
          scene_(load_scene(options.scene)) {
        add("none", 0, false, false);
        for (const FilmChannel& channel : FILM_CHANNELS)
            if (channel.sums < AOV_COUNT) add(channel.name, 1u << channel.sums, false, false);
        add("light-groups", 0, true, false);
        add("ids and Cryptomatte", 0, false, true);
        add("all", (1u << AOV_COUNT) - 1, true, true);
    }

    void run() {
        const Image plain = rendered(contenders_.front());
        for (Contender& contender : contenders_)
            if (rendered(contender).pixels != plain.pixels)
                throw InputError("{} changes the picture", contender.name);
        for (Contender& contender : contenders_) contender.seconds.clear();
        for (uint32_t i = 0; i < options_.repetitions; i++)
            for (Contender& contender : contenders_) rendered(contender);
        print();
    }

  private:
    void add(std::string_view name, uint32_t aovs, bool light_groups, bool ids) {
        RenderChoices choices;
        choices.aovs = aovs;
        choices.light_groups = light_groups;
        choices.ids = ids;
        choices.width = options_.width;
        choices.height = options_.height;
        choices.samples = options_.samples;
        choices.integrator = IntegratorKind::path;
        if (choices.aovs >> AOV_CLAMPED & 1) choices.clamp = 1e30f; // nothing is cut off
        const RenderOptions render =
            resolve_options(choices, scene_, machine_.device.facts()).options;
        contenders_.push_back(
            {std::string(name), std::make_unique<Session>(machine_.programs, scene_,
                                                          SessionOptions{.render = render})});
    }

    static Image rendered(Contender& contender) {
        contender.session->clear();
        const Timer timer;
        contender.session->render();
        contender.seconds.push_back(timer.seconds());
        return contender.session->picture();
    }

    void print() {
        const double plain = median(contenders_.front().seconds);
        fmt::print("{}x{}, {} samples, on {}, commit {}\n\n", options_.width, options_.height,
                   options_.samples, machine_.device.facts().name, source_commit());
        fmt::print("| channel | frame, s | over none | spread | film, MiB | paths, MiB |\n"
                   "|---|---|---|---|---|---|\n");
        for (Contender& contender : contenders_) {
            const double seconds = median(contender.seconds);
            const MemoryPlan plan = contender.session->memory_plan();
            fmt::print("| {} | {:.3f} | {:+.1f} % | {:.1f} % | {:.1f} | {:.1f} |\n", contender.name,
                       seconds, 100 * (seconds / plain - 1), 100 * spread(contender.seconds),
                       mebibytes(plan.film), mebibytes(plan.paths));
        }
    }

    static double mebibytes(const std::vector<gpu::BufferSize>& buffers) {
        return double(gpu::total_bytes(buffers)) / (1 << 20);
    }

    Options options_;
    Machine machine_;
    Scene scene_;
    std::vector<Contender> contenders_;
};

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("channels", "What each channel of a picture costs");
    onde::Command root = line.root();
    root.option("scene", &options.scene, "A scene file", {.value = "SCENE", .required = true});
    root.option("--width", &options.width, "of the picture",
                {.show_default = true, .least = 1, .most = 16384});
    root.option("--height", &options.height, "of the picture",
                {.show_default = true, .least = 1, .most = 16384});
    root.option("--samples", &options.samples, "per pixel",
                {.value = "N", .show_default = true, .least = 1, .most = 65536});
    onde::bench::add_device(root, options.device);
    onde::bench::add_kernels(root, options.kernels);
    onde::bench::add_repetitions(root, options.repetitions);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::Race(options).run(); });
}
