// What denoising gains: the relative mean squared error of pictures of few samples, as they are and
// by each denoiser, against a reference of many, and the seconds that it takes.
#include "figures.h"
#include "front.h"
#include "pictures.h"

#include "core/error.h"
#include "core/timer.h"
#include "denoise/find_oidn.h"
#include "image/compare.h"
#include "image/image_io.h"
#include "scene/load.h"
#include "session/choices.h"
#include "session/machine.h"
#include "session/session.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace onde::bench {
namespace {

namespace fs = std::filesystem;

struct Options : PictureOptions {
    fs::path references, pictures;
    std::string device, kernels;
    DenoiserOptions denoiser;
    uint32_t reference_samples = 4096;

    Options() { width = height = 256; }
};

constexpr std::array<uint32_t, 3> SAMPLES{8, 16, 64};

/// Other random numbers than the pictures have that are compared with it.
constexpr uint32_t REFERENCE_SEED = 12345;

struct Way {
    const char* name;
    Denoiser denoiser;
    DenoiseQuality quality = DenoiseQuality::high;
};

/// The ways to make a picture on this machine.
std::vector<Way> ways(const DenoiserOptions& choices) {
    std::vector<Way> all{{"as it is", Denoiser::off}, {"onde", Denoiser::own}};
    const char* place = std::getenv(OIDN_VARIABLE);
    if (!choices.oidn.empty() || (place && *place) || installed_oidn()) {
        all.push_back({"oidn fast", Denoiser::open_image, DenoiseQuality::fast});
        all.push_back({"oidn high", Denoiser::open_image, DenoiseQuality::high});
    }
    return all;
}

/// A scene of which pictures are made.
struct Subject {
    Machine& machine;
    const Options& options;
    Scene scene;
    std::string name;

    Session session(const Way& way, uint32_t samples, uint32_t seed) const {
        RenderChoices choices;
        choices.width = options.width;
        choices.height = options.height;
        choices.samples = samples;
        choices.seed = seed;
        choices.integrator = IntegratorKind::path;
        if (way.denoiser != Denoiser::off) choices.aovs = denoiser_aovs();
        SessionOptions session{.render =
                                   resolve_options(choices, scene, machine.device.facts()).options};
        session.denoiser = options.denoiser;
        session.denoiser.denoiser = way.denoiser;
        session.denoiser.quality = way.quality;
        return Session(machine.programs, scene, session);
    }
};

/// From the folder of references, where it is there; else it is rendered, and kept there.
Image reference_of(const Subject& subject) {
    const Options& o = subject.options;
    const fs::path file = o.references / fmt::format("{}-{}x{}-{}.exr", scene_hash(subject.scene),
                                                     o.width, o.height, o.reference_samples);
    if (!o.references.empty() && fs::exists(file)) return read_image(file);
    Session session = subject.session({"", Denoiser::off}, o.reference_samples, REFERENCE_SEED);
    const Timer timer;
    session.render();
    fmt::print("{}: reference of {} samples in {:.0f} s\n", subject.name, o.reference_samples,
               timer.seconds());
    Image image = session.picture();
    if (!o.references.empty()) write_exr(file, image, {}, ExrDepth::full_float);
    return image;
}

/// The ratio of two pictures' means: 1 where no light was lost.
double light_kept(const Metrics& metrics) {
    return metrics.mean_a / std::max(metrics.mean_b, 1e-30);
}

struct Made {
    double error = 0, light = 0, seconds = 0;
};

Made make(const Subject& subject, const Way& way, uint32_t samples, const Image& reference) {
    Session session = subject.session(way, samples, 0);
    session.render();
    DenoisedImage image;
    if (way.denoiser == Denoiser::off)
        image.picture = session.picture();
    else
        image = session.denoised();
    const Metrics metrics = compare(image.picture, reference);
    if (const fs::path& folder = subject.options.pictures; !folder.empty())
        write_png(folder / fmt::format("{} {} {}.png", subject.name, samples, way.name),
                  image.picture, {}, {});
    return {metrics.relative_mse, light_kept(metrics), image.seconds};
}

void measure(const Subject& subject) {
    const Image reference = reference_of(subject);
    for (uint32_t samples : SAMPLES)
        for (const Way& way : ways(subject.options.denoiser)) {
            const Made made = make(subject, way, samples, reference);
            fmt::print("{:<24} {:>3} samples  {:<10} relative MSE {:.5f}  light {:.4f}  {:.3f} s\n",
                       subject.name, samples, way.name, made.error, made.light, made.seconds);
            std::fflush(stdout);
        }
}

void run(const Options& options) {
    Machine machine(options.device, gpu::KernelSources::from(options.kernels));
    fmt::print("{}x{} on {}, commit {}\n", options.width, options.height,
               machine.device.facts().name, source_commit());
    const LoadOptions load = load_options(options);
    for (const fs::path& path : options.scenes)
        measure({machine, options, load_scene(path, load), path.stem().string()});
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("denoise", "What denoising gains, and the seconds that it takes");
    onde::Command root = line.root();
    onde::bench::add_pictures(root, options);
    root.option("--samples", &options.reference_samples, "of the references",
                {.value = "N", .show_default = true, .least = 1, .most = 1 << 24});
    root.option("--references", &options.references,
                "Folder in which references are kept for the next time", {.value = "DIR"});
    root.option("--pictures", &options.pictures, "Folder for every picture", {.value = "DIR"});
    root.option("--denoiser-library", &options.denoiser.oidn, "As of onde render",
                {.value = "PATH"});
    onde::bench::add_device(root, options.device);
    onde::bench::add_kernels(root, options.kernels);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
