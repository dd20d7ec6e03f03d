#include "scene/gltf/animation.h"

#include "core/error.h"
#include "core/shown.h"
#include "scene/gltf/choice.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace onde::gltf {

namespace {

using Values = std::vector<double>;

/// Where a moment lies among keys: between `key` and the next.
struct Moment {
    size_t key = 0;
    double fraction = 0.0, span = 1.0; ///< of the way to the next; its length in seconds
};

Moment moment_of(const std::vector<float>& times, double time) {
    if (times.size() < 2 || time <= times.front()) return {};
    if (time >= times.back()) return {times.size() - 1, 0.0, 1.0};
    const size_t key = size_t(std::ranges::upper_bound(times, time) - times.begin()) - 1;
    const double span = double(times[key + 1]) - double(times[key]);
    return {key, (time - double(times[key])) / span, span};
}

bool rises(const std::vector<float>& times) {
    if (times.empty() || !std::ranges::all_of(times, [](float t) { return std::isfinite(t); }))
        return false;
    return std::ranges::adjacent_find(times, std::greater_equal<>()) == times.end();
}

/// The keys of a channel: `width` numbers each, three times for splines.
struct Track {
    std::vector<float> times, values;
    size_t width = 1;
    Interpolation interpolation = Interpolation::linear;

    /// Part 0 is the in-tangent, 1 the value, 2 the out-tangent.
    Values at(size_t key, size_t part = 1) const {
        const bool spline = interpolation == Interpolation::cubic_spline;
        const size_t first = (spline ? 3 * key + part : key) * width;
        return Values(values.begin() + std::ptrdiff_t(first),
                      values.begin() + std::ptrdiff_t(first + width));
    }
};

Values spline(const Track& track, const Moment& m) {
    const double t = m.fraction, t2 = t * t, t3 = t2 * t;
    const Values a = track.at(m.key), out = track.at(m.key, 2);
    const Values b = track.at(m.key + 1), in = track.at(m.key + 1, 0);
    Values result(track.width);
    for (size_t i = 0; i < result.size(); ++i)
        result[i] = (2 * t3 - 3 * t2 + 1) * a[i] + m.span * (t3 - 2 * t2 + t) * out[i] +
                    (3 * t2 - 2 * t3) * b[i] + m.span * (t3 - t2) * in[i];
    return result;
}

Values between(const Values& a, const Values& b, double t, bool rotation) {
    if (rotation) {
        const glm::dquat from(a[3], a[0], a[1], a[2]), to(b[3], b[0], b[1], b[2]);
        const glm::dquat q = glm::slerp(glm::normalize(from), glm::normalize(to), t);
        return {q.x, q.y, q.z, q.w};
    }
    Values result(a.size());
    for (size_t i = 0; i < a.size(); ++i) result[i] = a[i] + t * (b[i] - a[i]);
    return result;
}

Values sample(const Track& track, double time, bool rotation) {
    const Moment m = moment_of(track.times, time);
    if (m.fraction == 0.0 || track.interpolation == Interpolation::step) return track.at(m.key);
    if (track.interpolation == Interpolation::cubic_spline) return spline(track, m);
    return between(track.at(m.key), track.at(m.key + 1), m.fraction, rotation);
}

/// How many numbers a channel moves; 0 where it moves nothing.
size_t width_of(const File& file, const Node& node, AnimatedPath path) {
    switch (path) {
    case AnimatedPath::translation:
    case AnimatedPath::scale:
        return 3;
    case AnimatedPath::rotation:
        return 4;
    case AnimatedPath::weights: {
        if (!node.mesh) return 0;
        const MeshSource& mesh = at(file, file.document.meshes, *node.mesh, "mesh", "an animation");
        size_t targets = 0;
        for (const Primitive& primitive : mesh.primitives)
            targets = std::max(targets, primitive.targets.size());
        return targets;
    }
    case AnimatedPath::pointer:
        break;
    }
    return 0;
}

Track read_track(const File& file, const AnimationSampler& sampler, AnimatedPath path, size_t width,
                 const std::string& user) {
    const uint32_t components =
        path == AnimatedPath::weights ? 1 : (path == AnimatedPath::rotation ? 4 : 3);
    Track track{read_floats(file, sampler.input, 1, user + " input"),
                read_floats(file, sampler.output, components, user + " output"), width,
                sampler.interpolation};
    const size_t parts = sampler.interpolation == Interpolation::cubic_spline ? 3 : 1;
    if (track.values.size() != track.times.size() * width * parts)
        throw InputError("{}: {}: it has {} numbers for {} keys of {}; export it again", file.name,
                         user, track.values.size(), track.times.size(), width * parts);
    return track;
}

void move(Node& node, AnimatedPath path, const Values& values) {
    node.matrix.reset(); // such a node may not be animated, by the specification
    const auto copy = [&](auto& array) { std::ranges::copy(values, array.begin()); };
    if (path == AnimatedPath::translation) copy(node.translation);
    if (path == AnimatedPath::rotation) copy(node.rotation);
    if (path == AnimatedPath::scale) copy(node.scale);
    if (path == AnimatedPath::weights) node.weights = values;
}

using Target = std::pair<uint32_t, AnimatedPath>;

void apply(File& file, const Animation& animation, double time, const std::string& name) {
    for (const Channel& channel : animation.channels) {
        if (!channel.node) continue;
        at(file, file.document.nodes, *channel.node, "node", name);
        const AnimationSampler& sampler =
            at(file, animation.samplers, channel.sampler, "sampler", name);
        Node& node = file.document.nodes[*channel.node];
        const size_t width = width_of(file, node, channel.path);
        if (width == 0) continue;
        const Track track = read_track(file, sampler, channel.path, width,
                                       fmt::format("{} sampler {}", name, channel.sampler));
        const auto is_finite = [](double value) { return std::isfinite(value); };
        Values values;
        if (rises(track.times))
            values = sample(track, time, channel.path == AnimatedPath::rotation);
        if (!values.empty() && std::ranges::all_of(values, is_finite))
            move(node, channel.path, values);
        else
            file.notes.wrong("Animations whose times do not rise, or with numbers that are not "
                             "finite, are left out",
                             name);
    }
}

std::set<Target> targets_of(const Animation& animation) {
    std::set<Target> targets;
    for (const Channel& channel : animation.channels)
        if (channel.node) targets.insert({*channel.node, channel.path});
    return targets;
}

/// The animation that was asked for, or all that get along with those before them.
std::vector<size_t> chosen(const File& file) {
    const std::vector<Animation>& animations = file.document.animations;
    const std::string& word = file.context.options().animation;
    if (!word.empty()) return {choose(file, animations, word, "--animation", "animation")};
    std::vector<size_t> result;
    std::set<Target> taken;
    for (size_t i = 0; i < animations.size(); ++i) {
        const std::set<Target> targets = targets_of(animations[i]);
        if (std::ranges::any_of(targets, [&](const Target& t) { return taken.contains(t); }))
            continue;
        taken.insert(targets.begin(), targets.end());
        result.push_back(i);
    }
    return result;
}

} // namespace

void animate_nodes(File& file) {
    const Document& document = file.document;
    if (document.animations.empty()) return;
    file.context.found_animation();
    const auto& options = file.context.options();
    const std::vector<size_t> indices = chosen(file); // a wrong name is wrong at any second
    if (!options.at) {
        file.notes.add("The rest pose is shown; --at SECONDS shows the animation",
                       names_of(document.animations));
        return;
    }
    for (size_t i : indices)
        apply(file, document.animations[i], *options.at, fmt::format("animation {}", i));
    if (indices.size() < document.animations.size() && options.animation.empty())
        file.notes.add("Animations that move the same as an earlier one are left out; --animation "
                       "chooses one",
                       names_of(document.animations));
}

} // namespace onde::gltf
