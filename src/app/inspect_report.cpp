#include "app/inspect_report.h"

#include "shared/whitted.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

namespace onde::app {
namespace {

std::string text(const float (&v)[3]) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
}

/// A name as a quoted text of Graphviz and of people.
std::string quoted(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return c == '"' || c == '\\' || uint8_t(c) < 32; }, '_');
    return '\'' + name + '\'';
}

std::string material_name(const Scene& scene, uint32_t material) {
    const std::string& name = scene.materials.at(material).name;
    return name.empty() ? fmt::format("material {}", material) : quoted(name);
}

std::string hit_text(const HitReport& hit, const Scene& scene, const PackedScene& packed) {
    if (hit.primitive == BVH_NONE)
        return fmt::format("leaves the scene toward {}", text(hit.direction));
    const uint32_t flags = packed.surfaces.at(hit.primitive).any.tag;
    const char* kind = flags & SURFACE_SPHERE  ? "sphere"
                       : flags & SURFACE_SHAPE ? "shape"
                                               : "primitive";
    std::string words =
        fmt::format("meets {} ({} {}", material_name(scene, hit.material), kind, hit.primitive);
    if (hit.instance != BVH_NONE) words += fmt::format(" of instance {}", hit.instance);
    return words + fmt::format(") from {} at {}, normal {}, after {:.6g}",
                               hit.front ? "outside" : "inside", text(hit.position),
                               text(hit.normal), hit.t);
}

std::string node_kind(const TreeReport& report, uint32_t i) {
    const NodeReport& node = report.nodes[i];
    if (node.level == 0) return "camera ray";
    const HitReport& from = report.nodes[node.parent].hit;
    const glm::vec3 n(from.normal[0], from.normal[1], from.normal[2]);
    const glm::vec3 d(node.hit.direction[0], node.hit.direction[1], node.hit.direction[2]);
    std::string words = glm::dot(n, d) > 0 ? "mirrored ray" : "transmitted ray";
    if (node.kind & KIND_WAVELENGTH)
        words += fmt::format(", wavelength {}", (node.kind & KIND_WAVELENGTH) - 1);
    if (node.kind & KIND_TAKES_FACTOR) words += ", with the factor of what it meets";
    return words;
}

class TreeWriter {
  public:
    TreeWriter(const TreeReport& report, const Scene& scene, const PackedScene& packed)
        : report_(report), scene_(scene), packed_(packed), children_(report.nodes.size()) {
        for (uint32_t i = 1; i < report.nodes.size(); i++)
            if (report.nodes[i].level > 0) children_[report.nodes[i].parent].push_back(i);
    }

    std::string write() {
        write_node(0);
        return text_;
    }

  private:
    void line(uint32_t level, const std::string& words) {
        text_ += std::string(2 * size_t(level), ' ') + words + '\n';
    }

    void write_node(uint32_t i) {
        const NodeReport& node = report_.nodes[i];
        const uint32_t level = node.level;
        line(level, fmt::format("[{}] {}: {}", i, node_kind(report_, i),
                                hit_text(node.hit, scene_, packed_)));
        if (level > 0)
            line(level, fmt::format("    factor {}, product so far {:.6g}", text(node.factor),
                                    node.product));
        if (!node.alive)
            line(level, "    its product of factors is not above epsilon: it counts nothing");
        else if (node.hit.primitive != BVH_NONE)
            write_light(i);
        line(level, fmt::format("    own colour {}", text(node.own)));
        for (uint32_t child : children_[i]) write_node(child);
        line(level, fmt::format("    [{}] returns {}", i, text(node.returned)));
    }

    void write_light(uint32_t i) {
        const NodeReport& node = report_.nodes[i];
        line(node.level,
             fmt::format("    emission {}, ambient {}", text(node.emission), text(node.ambient)));
        for (size_t s = 0; s < report_.sources[i].size(); s++) {
            const SourceReport& source = report_.sources[i][s];
            line(node.level,
                 fmt::format("    source {}: {:.4g} % arrives, diffuse {}, specular {}", s,
                             100 * source.visible, text(source.diffuse), text(source.specular)));
        }
    }

    const TreeReport& report_;
    const Scene& scene_;
    const PackedScene& packed_;
    std::vector<std::vector<uint32_t>> children_;
    std::string text_;
};

std::string dot_label(const HitReport& hit, const Scene& scene) {
    return hit.primitive == BVH_NONE ? "background" : material_name(scene, hit.material);
}

/// Of the lobes that the surface has, and no others.
std::string lobes_text(const BounceReport& b) {
    std::vector<std::string> parts;
    const auto has = [&](uint32_t lobe) { return b.lobes >> lobe & 1u; };
    if (has(LOBE_COAT)) parts.push_back("varnish");
    if (has(LOBE_SHEEN)) parts.push_back("sheen");
    const bool is_black = b.diffuse[0] == 0 && b.diffuse[1] == 0 && b.diffuse[2] == 0;
    if (has(LOBE_DIFFUSE) && !(is_black && has(LOBE_GLOSSY)))
        parts.push_back("diffuse " + text(b.diffuse));
    if (has(LOBE_BEHIND)) parts.push_back("diffuse to the far side");
    if (has(LOBE_GLOSSY)) parts.push_back("f0 " + text(b.f0));
    if (has(LOBE_DIELECTRIC)) parts.push_back(fmt::format("dielectric, eta {:.6g}", b.eta));
    if (has(LOBE_THIN)) parts.push_back("a thin wall");
    if (has(LOBE_GLOSSY) || has(LOBE_DIELECTRIC))
        parts.push_back(fmt::format("alpha {:.4g}", b.alpha));
    std::string words =
        parts.empty() ? "scatters no light" : fmt::format("{}", fmt::join(parts, ", "));
#define ONDE_WORDS(NAME, name, Type, transmits)                                                    \
    if (b.probability[LOBE_##NAME] > 0 && b.probability[LOBE_##NAME] < 1)                          \
        words += fmt::format(", " #name " lobe chosen with {:.4g}", b.probability[LOBE_##NAME]);
    LOBES(ONDE_WORDS)
#undef ONDE_WORDS
    return words;
}

std::string light_text(const BounceReport& b) {
    if (b.light == NO_INDEX) return "no light to sample";
    if (!(b.light_distance > 0))
        return fmt::format("light {} chosen (pdf {:.6g}): nothing to gain", b.light, b.light_pdf);
    return fmt::format("light {} chosen (pdf {:.6g}), toward {}: {} {}", b.light, b.light_pdf,
                       text(b.light_direction), b.blocked ? "blocked, would add" : "adds",
                       text(b.light_radiance));
}

std::string text_of(const TreeReport& report, const Scene& scene, const PackedScene& packed) {
    return TreeWriter(report, scene, packed).write();
}

std::string dot_of(const TreeReport& report, const Scene& scene, const PackedScene&) {
    std::string dot = "digraph tree {\n  node [shape=box];\n";
    for (uint32_t i = 0; i < report.nodes.size(); i++) {
        const NodeReport& node = report.nodes[i];
        if (i > 0 && node.level == 0) continue;
        dot += fmt::format("  n{} [label=\"{}\\nown {}\\nreturns {}\"];\n", i,
                           dot_label(node.hit, scene), text(node.own), text(node.returned));
        if (node.level > 0)
            dot += fmt::format("  n{} -> n{} [label=\"{}\\nfactor {}\"];\n", node.parent, i,
                               node_kind(report, i), text(node.factor));
    }
    return dot + "}\n";
}

/// Where a bounce meets the ground under the scene, as sees_ground() of kernels/path/ground.h
/// decides: a ray that shows the scene and has met nothing else.
std::optional<glm::vec3> ground_point(const PathReport& report, size_t i,
                                      const PackedScene& packed) {
    const HitReport& hit = report.bounces[i].hit;
    const bool shows = i == 0 || report.bounces[i - 1].next_pdf == 0.0f;
    const float height = packed.ground_height;
    if (!packed.features.ground || hit.primitive != BVH_NONE || !shows) return std::nullopt;
    if (!(hit.direction[1] < 0.0f && hit.origin[1] > height)) return std::nullopt;
    const float t = (height - hit.origin[1]) / hit.direction[1];
    return glm::vec3(hit.origin[0] + t * hit.direction[0], height,
                     hit.origin[2] + t * hit.direction[2]);
}

std::string next_text(const BounceReport& b, bool on_ground) {
    if (!b.alive) return "ends here";
    const std::string toward = text(b.next_direction);
    if (on_ground) return fmt::format("is reflected by its varnish toward {}", toward);
    const std::string pdf =
        b.next_pdf > 0 ? fmt::format("{:.6g}", b.next_pdf) : "of a single direction";
    return fmt::format("goes on toward {}, pdf {}", toward, pdf);
}

std::string text_of(const PathReport& report, const Scene& scene, const PackedScene& packed) {
    std::string words;
    for (size_t i = 0; i < report.bounces.size(); i++) {
        const BounceReport& b = report.bounces[i];
        const auto ground = ground_point(report, i, packed);
        const std::string hit =
            ground ? fmt::format("meets the ground at ({:.6g}, {:.6g}, {:.6g}), which shows what "
                                 "is behind it, less the scene's shadow",
                                 ground->x, ground->y, ground->z)
                   : hit_text(b.hit, scene, packed);
        words += fmt::format("[{}] throughput {}: {}\n    light found {}\n", i, text(b.throughput),
                             hit, text(b.emitted));
        if (b.hit.primitive != BVH_NONE)
            words += fmt::format("    {}\n    {}\n", lobes_text(b), light_text(b));
        if (b.hit.primitive != BVH_NONE || ground)
            words += fmt::format("    {}\n", next_text(b, ground.has_value()));
    }
    const glm::vec3& sum = report.radiance;
    return words + fmt::format("radiance ({:.6g}, {:.6g}, {:.6g})\n", sum.x, sum.y, sum.z);
}

std::string dot_of(const PathReport& report, const Scene& scene, const PackedScene& packed) {
    std::string dot = "digraph path {\n  node [shape=box];\n";
    for (size_t i = 0; i < report.bounces.size(); i++) {
        const BounceReport& b = report.bounces[i];
        const bool on_ground = ground_point(report, i, packed).has_value();
        dot += fmt::format("  n{} [label=\"{}\\nfound {}\"];\n", i,
                           on_ground ? "ground" : dot_label(b.hit, scene), text(b.emitted));
        if (i > 0)
            dot += fmt::format("  n{} -> n{} [label=\"throughput {}\"];\n", i - 1, i,
                               text(b.throughput));
        if (b.light_distance > 0)
            dot += fmt::format("  n{} -> l{} [style=dashed,label=\"{}\"];\n  l{} [label=\"light "
                               "{}\",shape=ellipse];\n",
                               i, i, b.blocked ? "blocked" : text(b.light_radiance), i, b.light);
    }
    return dot + "}\n";
}

} // namespace

std::string sample_text(const SampleReport& report, const Scene& scene, const PackedScene& packed) {
    return std::visit([&](const auto& sample) { return text_of(sample, scene, packed); }, report);
}

std::string sample_dot(const SampleReport& report, const Scene& scene, const PackedScene& packed) {
    return std::visit([&](const auto& sample) { return dot_of(sample, scene, packed); }, report);
}

} // namespace onde::app
