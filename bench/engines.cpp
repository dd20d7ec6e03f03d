// Whole frames of every engine, beside a native path tracer in the same process: the pictures are
// compared first, then all contenders take turns, again and again.
#include "engines_report.h"
#include "front.h"

#include "core/error.h"
#include "core/output.h"
#include "image/compare.h"
#include "scene/load.h"

#include <cmath>
#include <cstdlib>
#include <thread>

namespace onde::bench {
namespace {

struct Options {
    std::vector<std::filesystem::path> scenes;
    std::vector<std::string> variants;
    std::string size = "640x480";
    FrameOptions frame;
    uint32_t repetitions = 5, threads = 0;
    std::filesystem::path environment;
    std::string device, json;
};

/// Throws unless the pictures of two variants are the same, bit for bit.
void check_same(const Result& a, const Image& picture_a, const Result& b, const Image& picture_b) {
    if (picture_a.pixels == picture_b.pixels) return;
    const WorstPixel worst = compare(picture_a, picture_b).worst;
    throw std::runtime_error(fmt::format("the pictures of {} and {} differ, most at pixel {},{}: "
                                         "{} and {}; speeds are not compared",
                                         a.variant, b.variant, worst.x, worst.y, worst.a, worst.b));
}

/// Throws unless the means agree within 2 % and, for small frames, the noise (4 deviations).
void check_near(const std::string& variant, const Image& picture, NativeTracer& native) {
    const Metrics metrics = compare(picture, native.picture());
    const double noise = 4 * std::sqrt(2.0) * native.standard_error();
    if (std::abs(metrics.mean_a - metrics.mean_b) <= 0.02 * metrics.mean_b + noise) return;
    throw std::runtime_error(fmt::format("the mean of {} is {} and of the native tracer {}; speeds "
                                         "are not compared",
                                         variant, metrics.mean_a, metrics.mean_b));
}

/// Throws unless a frame traced as many rays as the first one.
void check_same_work(const Result& result, const Frame& frame) {
    if (frame.rays == result.first.rays) return;
    throw std::runtime_error(fmt::format("{} traced {} rays in one frame and {} in another",
                                         result.variant, result.first.rays, frame.rays));
}

/// One scene and all who render it.
class Race {
  public:
    Race(const gpu::Device& device, const Scene& scene, const Options& options, uint32_t threads)
        : native_(scene, options.frame, threads) {
        for (const Variant& variant : choose_variants(device.facts(), options.variants)) {
            engines_.push_back(std::make_unique<OndeEngine>(device, scene, options.frame, variant));
            results_.push_back({variant.name,
                                gpu::describe(variant.settings),
                                engines_.back()->compile_seconds(),
                                {}});
        }
        results_.push_back({NATIVE, fmt::format("Embree, {} threads", threads), 0, {}});
    }

    /// One frame of each, whose pictures are compared.
    void warm_up() {
        for (size_t i = 0; i < results_.size(); i++) results_[i].first = contender(i).render();
        const Image picture = engines_[0]->picture();
        for (size_t i = 1; i < engines_.size(); i++)
            check_same(results_[0], picture, results_[i], engines_[i]->picture());
        check_near(results_[0].variant, picture, native_);
    }

    void run(uint32_t repetitions) {
        for (uint32_t repetition = 0; repetition < repetitions; repetition++)
            for (size_t i = 0; i < results_.size(); i++) {
                const Frame frame = contender(i).render();
                check_same_work(results_[i], frame);
                results_[i].seconds.push_back(frame.seconds);
            }
    }

    SceneReport report(const std::string& scene) {
        const BvhStatistics& bvh = engines_[0]->bvh();
        return {scene, bvh.triangles, bvh.spheres, results_};
    }

  private:
    Contender& contender(size_t i) {
        if (i < engines_.size()) return *engines_[i];
        return native_;
    }

    std::vector<std::unique_ptr<OndeEngine>> engines_;
    NativeTracer native_;
    std::vector<Result> results_; ///< the native tracer's last
};

Scene load(const std::filesystem::path& path, const Options& options) {
    Scene scene = load_scene(path);
    if (!options.environment.empty())
        scene.environment = load_environment(options.environment, glm::vec3(1.0f), 0.0f);
    return scene;
}

std::vector<std::filesystem::path> default_scenes() {
    const auto folder = std::filesystem::path(ONDE_SOURCE_DIR) / "scenes";
    return {folder / "cornell.toml", folder / "spheres.toml",
            folder / "chapter" / "five-objects.toml"};
}

uint32_t native_threads(const Options& options, const gpu::DeviceFacts& facts) {
    if (options.threads > 0) return options.threads;
    return facts.is_cpu ? facts.compute_units : std::max(1u, std::thread::hardware_concurrency());
}

void run(Options options) {
    const auto size = parse_pair(options.size, 'x', "--size");
    if (!size) throw InputError("--size {} is not of the form 640x480", options.size);
    std::tie(options.frame.width, options.frame.height) = *size;
    if (!options.json.empty()) check_writable(options.json);
    const gpu::Device device = gpu::open_device(options.device);
    const uint32_t threads = native_threads(options, device.facts());
    const Circumstances circumstances =
        describe_circumstances(device.facts(), options.frame, threads, options.repetitions);
    print_header(circumstances);
    std::vector<SceneReport> reports;
    for (const auto& path : options.scenes.empty() ? default_scenes() : options.scenes) {
        Race race(device, load(path, options), options, threads);
        race.warm_up();
        race.run(options.repetitions);
        const std::filesystem::path name = path.parent_path().filename() / path.stem();
        reports.push_back(race.report(name.string()));
        print_report(reports.back(), options.frame);
    }
    if (!options.json.empty()) write_json(circumstances, reports, options.json);
}

void declare(Command& root, Options& o) {
    const OptionRules counted{.value = "N", .show_default = true, .least = 1, .most = 1 << 20};
    root.option("scenes", &o.scenes, "scene files; without any, three of the project's own",
                {.value = "SCENE"});
    root.option("--size", &o.size, "pixels", {.value = "WxH", .show_default = true});
    root.option("--spp", &o.frame.samples, "samples per pixel", counted);
    root.option("--depth", &o.frame.depth, "the most surfaces of a path", counted);
    root.option("--threads", &o.threads, "of the native tracer; as many as the device's units",
                {.value = "N"});
    root.option("--environment", &o.environment, "light the scenes with this picture",
                {.value = "FILE"});
    root.option("--variants", &o.variants, "only these, with commas between",
                {.value = "NAMES", .delimiter = ','});
    add_repetitions(root, o.repetitions);
    add_device(root, o.device);
    add_json(root, o.json);
}

/// Drivers keep compiled kernels too, but the seconds of a first compilation are wanted.
void forbid_driver_caches() {
    setenv("POCL_KERNEL_CACHE", "0", 1);
    setenv("CUDA_CACHE_DISABLE", "1", 1);
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::forbid_driver_caches();
    onde::bench::Options options;
    onde::CommandLine line("engines", "Whole frames of Onde's engines beside a native path tracer");
    onde::Command root = line.root();
    onde::bench::declare(root, options);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
