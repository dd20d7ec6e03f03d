#include "app/volumes_report.h"

#include "app/markup.h"

#include <fmt/format.h>

#include <cmath>

namespace onde::app {

namespace {

double rejected_share(const LabReport& report, const VolumeReport& volume) {
    return double(volume.rejected) / double(report.rays);
}

/// Of the rays that hit nothing, those that the volume spares.
double spared_share(const LabReport& report, const VolumeReport& volume) {
    return double(volume.rejected) / std::max(double(report.rays - report.hits), 1.0);
}

struct Bar {
    std::string name;
    double value;
};

/// One chart of horizontal bars from `top` on; lengths by value, or by its logarithm.
std::string chart(const std::string& title, const std::vector<Bar>& bars, double top,
                  bool logarithmic) {
    constexpr double LEFT = 190, WIDTH = 420, HEIGHT = 22;
    double largest = 0;
    for (const Bar& bar : bars) largest = std::max(largest, bar.value);
    std::string svg = fmt::format("<text x=\"20\" y=\"{}\" font-weight=\"bold\">{}</text>\n", top,
                                  escaped(title));
    for (size_t i = 0; i < bars.size(); ++i) {
        const double y = top + 10 + HEIGHT * double(i), value = std::max(bars[i].value, 0.0);
        const double length =
            logarithmic ? std::log1p(value) / std::log1p(largest) : value / largest;
        svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>"
                           "<rect x=\"{}\" y=\"{}\" width=\"{:.1f}\" height=\"14\" "
                           "fill=\"#36c\"/><text x=\"{:.1f}\" y=\"{}\">{:.4g}</text>\n",
                           LEFT - 8, y + 12, escaped(bars[i].name), LEFT, y,
                           largest > 0 ? WIDTH * length : 0.0,
                           LEFT + 6 + (largest > 0 ? WIDTH * length : 0.0), y + 12, value);
    }
    return svg;
}

} // namespace

std::string lab_text(const LabReport& report) {
    std::string text = fmt::format(
        "{} triangles; {} lines that meet a ball of 1.5 times the smallest sphere's radius, "
        "{} hits ({:.1f} %)\n\n",
        report.triangles, report.rays, report.hits,
        100 * double(report.hits) / double(report.rays));
    text += fmt::format("{:<21} {:>11} {:>11} {:>9} {:>10} {:>13} {:>8}\n", "volume", "volume",
                        "surface", "rejected", "of misses", "tests/hit", "ns/ray");
    for (const VolumeReport& volume : report.volumes)
        text +=
            fmt::format("{:<21} {:11.5g} {:11.5g} {:8.2f}% {:9.2f}% {:13.0f} {:8.3f}\n",
                        volume_name(volume.kind), volume.size.volume, volume.size.area,
                        100 * rejected_share(report, volume), 100 * spared_share(report, volume),
                        volume.tests_per_hit, volume.ns_per_test);
    text += fmt::format("\n{:<21} {:>11} {:>11} {:>9} {:>10} {:>13} {:>8}\n", "hierarchy", "nodes",
                        "boxes/ray", "tri./ray", "depth", "tests/hit", "ns/ray");
    for (size_t i = 0; i < report.hierarchies.size(); ++i) {
        const HierarchyReport& h = report.hierarchies[i];
        const double rays = double(h.rays);
        text += fmt::format(
            "{:<21} {:11} {:11.1f} {:9.1f} {:10} {:13.0f} {:8.1f}\n", builder_name(BUILDERS[i]),
            BUILDERS[i] == BvhBuilder::none ? 0 : h.tree.nodes, double(h.boxes) / rays,
            double(h.triangles) / rays, BUILDERS[i] == BvhBuilder::none ? 0 : h.tree.depth,
            h.tests_per_hit(), h.ns_per_ray());
    }
    if (report.flat_rays < report.rays)
        text += fmt::format("(none: of the first {} lines only)\n", report.flat_rays);
    return text;
}

std::string trials_text(const VolumeTrials& trials) {
    std::string text = fmt::format("\n{} random rays at corners, edges and faces, {} of them hit "
                                   "in double precision\n",
                                   trials.rays, trials.hits);
    for (size_t i = 0; i < VOLUME_KINDS.size(); ++i)
        text += fmt::format("{:<21} rejected {} rays that hit\n", volume_name(VOLUME_KINDS[i]),
                            trials.wrongly_rejected[i]);
    return text;
}

std::string lab_svg(const LabReport& report, const std::string& title) {
    std::vector<Bar> rejected, costs, tests, times;
    for (const VolumeReport& volume : report.volumes) {
        rejected.push_back({volume_name(volume.kind), 100 * rejected_share(report, volume)});
        costs.push_back({volume_name(volume.kind), volume.ns_per_test});
    }
    for (size_t i = 0; i < report.hierarchies.size(); ++i) {
        tests.push_back({builder_name(BUILDERS[i]), report.hierarchies[i].tests_per_hit()});
        times.push_back({builder_name(BUILDERS[i]), report.hierarchies[i].ns_per_ray()});
    }
    return fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"700\" height=\"620\" "
               "font-family=\"sans-serif\" font-size=\"13\">\n"
               "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
               "<text x=\"20\" y=\"28\" font-size=\"16\">{}: {} triangles, {} lines</text>\n",
               escaped(title), report.triangles, report.rays) +
           chart("volumes: rays rejected, percent", rejected, 60, false) +
           chart("volumes: nanoseconds per ray", costs, 210, false) +
           chart("hierarchies: tests per hit, logarithmic", tests, 360, true) +
           chart("hierarchies: nanoseconds per ray, logarithmic", times, 490, true) + "</svg>\n";
}

} // namespace onde::app
