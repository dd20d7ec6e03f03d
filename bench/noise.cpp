// Whether what --noise says holds: the share of the pixels that are off by more than the target,
// against a reference of many samples, over seeds; and how many samples all pixels would need for
// the same share.
#include "figures.h"
#include "front.h"
#include "pictures.h"

#include "scene/load.h"
#include "session/choices.h"
#include "session/machine.h"
#include "session/session.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace onde::bench {
namespace {

namespace fs = std::filesystem;

struct Options : PictureOptions {
    std::string device, kernels;
    uint32_t seeds = 100, reference_samples = 1u << 16;
    float noise = 0.02f;

    Options() { width = 64, height = 48; }
};

/// Other random numbers than the pictures have that are compared with it.
constexpr uint32_t REFERENCE_SEED = 12345;

/// Pictures with as many samples everywhere that are compared.
constexpr uint32_t UNIFORM_SEEDS = 4;

/// A scene of which pictures are made.
struct Subject {
    Machine& machine;
    const Options& options;
    Scene scene;
    std::string name;

    Session session(float noise) const {
        RenderChoices choices;
        choices.width = options.width;
        choices.height = options.height;
        choices.noise = noise;
        choices.integrator = IntegratorKind::path;
        return Session(machine.programs, scene,
                       {.render = resolve_options(choices, scene, machine.device.facts()).options});
    }
    double exposure() const { return std::exp2(scene.settings.exposure.value_or(0.0f)); }
};

void set_seed(Session& session, uint32_t seed, uint32_t samples) {
    RenderOptions options = session.options();
    options.seed = seed;
    options.samples = samples;
    session.set_options(options);
}

/// The share of the pixels that are off by more than the target.
double share_off(const Subject& subject, const Image& image, const Image& reference) {
    const size_t pixels = image.pixels.size() / 3;
    size_t off = 0;
    for (size_t i = 0; i < pixels; i++) {
        double squares = 0;
        for (size_t k = 3 * i; k < 3 * i + 3; k++) {
            const double error = shown(subject.exposure() * image.pixels[k]) -
                                 shown(subject.exposure() * reference.pixels[k]);
            squares += error * error / 3;
        }
        off += std::sqrt(squares) > subject.options.noise;
    }
    return double(off) / double(pixels);
}

double mean(const std::vector<double>& numbers) {
    return std::accumulate(numbers.begin(), numbers.end(), 0.0) / double(numbers.size());
}

/// Samples of every pixel that leave that share off; at least 64, at most those of the reference.
double uniform_samples(const Subject& subject, const Image& reference, double share) {
    double before = 1, samples = FILM_BLOCK;
    std::vector<std::unique_ptr<Session>> sessions;
    for (uint32_t seed = 1; seed <= UNIFORM_SEEDS; seed++)
        sessions.emplace_back(new Session(subject.session(0)));
    for (; samples < subject.options.reference_samples; samples *= std::sqrt(2.0)) {
        double off = 0;
        for (uint32_t i = 0; i < UNIFORM_SEEDS; i++) {
            set_seed(*sessions[i], i + 1, uint32_t(samples));
            sessions[i]->render();
            off += share_off(subject, sessions[i]->picture(), reference) / UNIFORM_SEEDS;
        }
        if (off <= share) {
            if (samples == FILM_BLOCK) return samples;
            const double way = std::log(before / share) / std::log(before / std::max(off, 1e-9));
            return samples * std::pow(2.0, 0.5 * (way - 1));
        }
        before = off;
    }
    return subject.options.reference_samples;
}

void measure(const Subject& subject) {
    const Options& o = subject.options;
    Session many = subject.session(0);
    set_seed(many, REFERENCE_SEED, o.reference_samples);
    many.render();
    const Image reference = many.picture();

    std::vector<double> shares, samples, told;
    size_t held = 0;
    Session session = subject.session(o.noise);
    for (uint32_t seed = 1; seed <= o.seeds; seed++) {
        set_seed(session, seed, session.options().samples);
        samples.push_back(session.render().samples);
        shares.push_back(share_off(subject, session.picture(), reference));
        told.push_back(session.noise()->share);
        held += shares.back() <= NOISY_SHARE;
    }
    const double share = mean(shares);
    const double needed = uniform_samples(subject, reference, share);
    fmt::print("| {} | {} of {} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} | {:.2f} |\n",
               subject.name, held, o.seeds, 100 * share, 100 * *std::ranges::max_element(shares),
               100 * mean(told), mean(samples), needed, needed / mean(samples));
    std::fflush(stdout);
}

void run(const Options& options) {
    Machine machine(options.device, gpu::KernelSources::from(options.kernels));
    fmt::print("{}x{}, --noise {}, on {}, commit {}\n\n", options.width, options.height,
               options.noise, machine.device.facts().name, source_commit());
    fmt::print(
        "| scene | at most {:.0f} % off | off, % | worst seed, % | told, % | samples a pixel | "
        "uniform, as few off | ratio |\n|---|---|---|---|---|---|---|---|\n",
        100 * NOISY_SHARE);
    const LoadOptions load = load_options(options);
    for (const fs::path& path : options.scenes)
        measure({machine, options, load_scene(path, load), path.stem().string()});
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("noise", "Whether what --noise says holds, and what it saves");
    onde::Command root = line.root();
    onde::bench::add_pictures(root, options);
    root.option("--noise", &options.noise, "As of onde render",
                {.value = "ERROR", .show_default = true, .least = 1e-4, .most = 1});
    root.option("--seeds", &options.seeds, "Pictures of each scene",
                {.value = "N", .show_default = true, .least = 1, .most = 100000});
    root.option("--samples", &options.reference_samples, "of the references",
                {.value = "N", .show_default = true, .least = 64, .most = 1 << 24});
    onde::bench::add_device(root, options.device);
    onde::bench::add_kernels(root, options.kernels);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
