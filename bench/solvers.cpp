// The chapter's three ways to solve a ray and a triangle (C11) beside the renderer's own test:
// every ray against every triangle, answers compared first, then every contender in turn, again
// and again. Medians and spreads are printed.
#include "front.h"

#include "core/timer.h"
#include "gpu/program.h"
#include "shared/items.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace onde::bench {
namespace {

struct Options {
    uint32_t repetitions = 15, rays = 1u << 18, triangles = 256, width = 16;
    std::string device, kernels;
};

const std::map<std::string, uint32_t> LANES{{"1", 1}, {"8", 8}, {"16", 16}};

float uniform(std::mt19937& generator) {
    return 2.0f * float(generator() >> 8) * 0x1p-24f - 1.0f;
}

/// Columns of origins on the cube [-2, 2]^3 and directions toward the middle.
std::vector<float> random_rays(uint32_t count) {
    std::mt19937 generator(1);
    std::vector<float> columns(6 * size_t(count));
    for (uint32_t i = 0; i < count; ++i)
        for (size_t k = 0; k < 3; ++k) {
            columns[k * count + i] = 2 * uniform(generator);
            columns[(3 + k) * count + i] = uniform(generator) - 0.5f * columns[k * count + i];
        }
    return columns;
}

std::vector<float> random_triangles(uint32_t count) {
    std::mt19937 generator(2);
    std::vector<float> numbers(9 * size_t(count));
    for (size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = uniform(generator) * (i % 9 < 3 ? 1.0f : 0.4f);
    return numbers;
}

struct Contender {
    const char *name, *kernel;
    std::vector<double> seconds{};
    size_t differences = 0;
};

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

class Race {
  public:
    Race(gpu::Programs& programs, const Options& options)
        : device_(programs.device()), options_(options),
          rays_(device_, std::span<const float>(random_rays(options.rays))),
          triangles_(device_, std::span<const float>(random_triangles(options.triangles))),
          nearest_(device_, options.rays), program_(programs.build(request(options))) {}

    void run() {
        trace(contenders_.back());
        const std::vector<float> expected = nearest_.read(device_);
        for (Contender& contender : contenders_) { // warms up as well
            trace(contender);
            contender.differences = differences(nearest_.read(device_), expected);
        }
        for (uint32_t i = 0; i < options_.repetitions; ++i)
            for (Contender& contender : contenders_) {
                const Timer timer;
                trace(contender);
                contender.seconds.push_back(timer.seconds());
            }
        print();
    }

  private:
    static gpu::ProgramRequest request(const Options& options) {
        gpu::ProgramRequest request{
            "chapter/solvers.cl", {fmt::format("ONDE_WIDTH={}", options.width)}, {}};
        for (const char* kernel : {"inverse", "gauss", "cramer", "production"})
            request.kernels.push_back({kernel, 16, options.rays / SOLVER_ITEMS});
        return request;
    }

    void trace(const Contender& contender) {
        gpu::Kernel& kernel = program_.kernel(contender.kernel);
        kernel.set_from(0, options_.rays, rays_, triangles_, options_.triangles, nearest_);
        kernel.launch(options_.rays / SOLVER_ITEMS);
        device_.finish();
    }

    static size_t differences(const std::vector<float>& a, const std::vector<float>& b) {
        size_t count = 0;
        for (size_t i = 0; i < a.size(); ++i)
            count += a[i] != b[i] && !(std::abs(a[i] - b[i]) <= 1e-4f * std::abs(b[i]));
        return count;
    }

    void print() const {
        fmt::print("{} rays against {} triangles on {}, {} lanes\n", options_.rays,
                   options_.triangles, device_.facts().name, options_.width);
        fmt::print("  {:<22} {:>8} {:>7} {:>7} {:>10}\n", "solver", "ns/test", "ratio", "spread",
                   "different");
        const double pairs = double(options_.rays) * options_.triangles;
        for (const Contender& c : contenders_) {
            const auto [fastest, slowest] = std::ranges::minmax(c.seconds);
            fmt::print("  {:<22} {:8.3f} {:7.2f} {:6.0f}% {:10}\n", c.name,
                       median(c.seconds) / pairs * 1e9,
                       median(c.seconds) / median(contenders_.back().seconds),
                       100 * (slowest - fastest) / median(c.seconds), c.differences);
        }
    }

    const gpu::Device& device_;
    const Options& options_;
    gpu::Buffer<float> rays_, triangles_, nearest_;
    gpu::Program program_;
    std::vector<Contender> contenders_{{"inverse matrix", "inverse"},
                                       {"Gaussian elimination", "gauss"},
                                       {"Cramer's rule", "cramer"},
                                       {"production", "production"}};
};

void run(const Options& options) {
    const gpu::Device device = gpu::open_device(options.device);
    gpu::Programs programs(device, gpu::KernelSources::from(options.kernels));
    Race(programs, options).run();
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("solvers",
                           "Ways to solve a ray and a triangle, beside the renderer's test");
    onde::Command root = line.root();
    root.option("--rays", &options.rays, "cut to a multiple of 256",
                {.show_default = true, .least = 256, .most = 1 << 24});
    root.option("--triangles", &options.triangles, "that each ray is tested against",
                {.show_default = true, .least = 1, .most = 1 << 20});
    root.choice("--lanes", options.width, onde::bench::LANES, "of the three solvers (16)");
    onde::bench::add_device(root, options.device);
    onde::bench::add_kernels(root, options.kernels);
    onde::bench::add_repetitions(root, options.repetitions);
    return onde::bench::run_main(line, argc, argv, [&] {
        options.rays -= options.rays % 256;
        onde::bench::run(options);
    });
}
