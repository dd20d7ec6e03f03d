#include "app/compare_command.h"

#include "app/json.h"
#include "core/error.h"
#include "core/files.h"
#include "core/output.h"
#include "image/compare.h"
#include "image/image_io.h"

#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace onde::app {

namespace {

struct CompareOptions {
    std::filesystem::path a;
    std::filesystem::path b;
    std::filesystem::path difference; ///< empty: none wanted
    std::filesystem::path variance;   ///< of a sample of B; empty: no test
    uint32_t samples = 0;             ///< of A
    bool json = false;
};

/// What is asked of two pictures.
struct Comparison {
    Metrics metrics;
    std::optional<double> within_noise;
};

void print_table(const Comparison& comparison) {
    const Metrics& m = comparison.metrics;
    fmt::print("mean A       {:.6g}\n", m.mean_a);
    fmt::print("mean B       {:.6g}\n", m.mean_b);
    fmt::print("RMSE         {:.6g}\n", m.rmse);
    fmt::print("relative MSE {:.6g}\n", m.relative_mse);
    fmt::print("PSNR         {:.2f} dB (peak 1)\n", m.psnr);
    fmt::print("max error    {:.6g} at x {} y {} channel {}: A {:.6g}, B {:.6g}\n", m.max_error,
               m.worst.x, m.worst.y, m.worst.channel, m.worst.a, m.worst.b);
    fmt::print("pixels       {} compared, {} not finite in A, {} not finite in B\n", m.pixels,
               m.non_finite_a, m.non_finite_b);
    if (comparison.within_noise)
        fmt::print("within noise {:.3f} % of all samples\n", 100.0 * *comparison.within_noise);
}

void print_json(const Comparison& comparison) {
    const Metrics& m = comparison.metrics;
    const Json worst = {{"x", m.worst.x},
                        {"y", m.worst.y},
                        {"channel", m.worst.channel},
                        {"a", m.worst.a},
                        {"b", m.worst.b}};
    Json line = {{"mean_a", m.mean_a},
                 {"mean_b", m.mean_b},
                 {"rmse", m.rmse},
                 {"relative_mse", m.relative_mse},
                 {"psnr", m.psnr},
                 {"max_error", m.max_error},
                 {"worst", worst},
                 {"pixels", m.pixels},
                 {"non_finite_a", m.non_finite_a},
                 {"non_finite_b", m.non_finite_b}};
    if (comparison.within_noise) line["within_noise"] = *comparison.within_noise;
    fmt::print("{}", json_line(line));
}

void write_difference(const std::filesystem::path& path, const Image& difference) {
    const std::string extension = lower_extension(path);
    if (extension == ".exr")
        write_exr(path, difference, {});
    else if (extension == ".png")
        write_png(path, difference, {}, {});
    else
        throw InputError("{}: a difference is written as .exr or .png; change the extension",
                         path.string());
}

void run_compare(const CompareOptions& options) {
    check_not_read(options.difference, std::array{options.a, options.b});
    if (options.variance.empty() != (options.samples == 0))
        throw InputError("--variance and --samples go together; give both, or neither");
    const Image a = read_image(options.a), b = read_image(options.b);
    Comparison comparison{.metrics = compare(a, b), .within_noise = {}};
    if (options.samples > 0)
        comparison.within_noise =
            share_within_noise(a, b, read_image(options.variance), options.samples);
    if (!options.difference.empty()) write_difference(options.difference, difference_image(a, b));
    options.json ? print_json(comparison) : print_table(comparison);
}

} // namespace

void add_compare_command(Command& root) {
    Command command = root.add_command("compare", "Measure how far picture A is from picture B");
    const auto options = std::make_shared<CompareOptions>(); // what runs later is copied
    command.option("A", &options->a, "The picture to compare", {.required = true});
    command.option("B", &options->b, "The reference", {.required = true});
    command.option("--diff", &options->difference, "Write |A - B| to this .exr or .png");
    command.option("--variance", &options->variance,
                   "Picture of the variance of one sample of B, for a test whether A is B but for "
                   "noise");
    command.option("--samples", &options->samples, "Samples per pixel that A has, for the same");
    command.flag("--json", options->json, "Print the figures as one line of JSON");
    command.on_run([options] { run_compare(*options); });
}

} // namespace onde::app
