#include "upload/light_tree.h"

#include "accel/parallel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace onde {
namespace {

constexpr double PI = std::numbers::pi;

/// A float of 16 bits: the nearest, or the next that is not below a number, or not above it.
enum class Rounding { nearest, up, down };
uint32_t short_float(double value, Rounding rounding) {
    const auto word = std::bit_cast<uint32_t>(float(value));
    if (rounding == Rounding::nearest) return (word + 0x8000u) >> 16;
    const uint32_t toward_zero = word >> 16;
    const double held = double(std::bit_cast<float>(toward_zero << 16));
    const bool is_off = rounding == Rounding::up ? held < value : held > value;
    return is_off ? toward_zero + 1 : toward_zero; // away from zero
}

double number_of(uint32_t short_float) {
    return double(std::bit_cast<float>(short_float << 16));
}

uint32_t pair_of(uint32_t first, uint32_t second) {
    return first << 16 | second;
}

/// Branches whose importance is their power.
LightBranch everywhere_branch(double power, uint32_t next) {
    LightBranch branch{};
    branch.radius_reach = pair_of(short_float(-1, Rounding::down), 0);
    branch.power = float(power);
    branch.next = next;
    return branch;
}

LightBranch local_branch(const LightBounds& b, uint32_t next) {
    constexpr double AXIS_ERROR = 0.004; // of cosines to an axis of short components, and more
    constexpr double ALMOST_ALL = 2.9;   // radians: there cosines tell too little
    LightBranch branch{};
    const glm::dvec3 center = 0.5 * (b.low + b.high);
    for (glm::length_t k = 0; k < 3; k++) branch.center[k] = float(center[k]);
    // Rounded up, with room for that of the centre.
    const double size = std::max(glm::length(center), glm::length(b.high - b.low));
    const double radius = (0.5 * glm::length(b.high - b.low) + 1e-7 * size) * (1 + 1e-6);
    const bool is_all = b.spread + b.reach > ALMOST_ALL;
    const double spread = is_all ? -1 : std::cos(b.spread);
    const double reach = std::max(std::cos(b.reach) - AXIS_ERROR, -1.0);
    branch.radius_reach =
        pair_of(short_float(radius, Rounding::up), short_float(reach, Rounding::down));
    const auto part = [](double x) { return short_float(x, Rounding::nearest); };
    branch.axis_xy = pair_of(part(b.axis.x), part(b.axis.y));
    branch.axis_z_spread = pair_of(part(b.axis.z), short_float(spread, Rounding::down));
    branch.power = float(b.power);
    branch.next = next;
    return branch;
}

/// Lights as the heuristic counts them, in constant time: the resultant of their normals tells how
/// wide they look. That of a cone's cap is half of 1 + the cosine of its half angle.
struct Estimate {
    glm::dvec3 low{INFINITY}, high{-INFINITY}, normals{0.0};
    double power = 0, reach = 0;
    uint32_t count = 0;

    void add(const LightBounds& b) {
        low = glm::min(low, b.low);
        high = glm::max(high, b.high);
        normals += b.axis * (0.5 + 0.5 * std::cos(b.spread));
        power += b.power;
        reach = std::max(reach, b.reach);
        count++;
    }
    void add(const Estimate& e) {
        low = glm::min(low, e.low);
        high = glm::max(high, e.high);
        normals += e.normals;
        power += e.power;
        reach = std::max(reach, e.reach);
        count += e.count;
    }
    /// Of the box, and a little for its length, since lights may stand in a row.
    double area() const {
        const glm::dvec3 d = high - low;
        return d.x * d.y + d.y * d.z + d.z * d.x + 1e-3 * glm::dot(d, d);
    }
    /// The solid angle into which they may shine, weighted by the cosine beyond their normals
    /// (Conty Estevez and Kulla 2018, equation 1).
    double orientation() const {
        const double cosine = std::clamp(2 * glm::length(normals) / count - 1, -1.0, 1.0);
        const double spread = std::acos(cosine), sine = std::sin(spread);
        const double beyond = std::min(spread + reach, PI);
        return 2 * PI * (1 - cosine) +
               PI / 2 *
                   (2 * beyond * sine - std::cos(spread - 2 * beyond) - 2 * spread * sine + cosine);
    }
    double cost() const { return power * area() * orientation(); }
};

constexpr size_t BINS = 12;

/// Where lights are divided: by their centres along an axis, in bins.
struct Split {
    glm::length_t axis;
    double low, scale;
    size_t first_right; ///< bin
    double cost;

    size_t bin(const LightBounds& b) const {
        const double at = (0.5 * (b.low[axis] + b.high[axis]) - low) * scale;
        return std::min(size_t(std::max(at, 0.0)), BINS - 1);
    }
};

class Builder {
  public:
    Builder(std::span<const LightBounds> lights, std::vector<uint32_t> members, LightTree& tree)
        : lights_(lights), tree_(tree), order_(std::move(members)) {}

    /// The lights at places [begin, end) below a branch: their pairs lie from `base` on. Returns
    /// what bounds them, and the branch's `next`.
    std::pair<LightBounds, uint32_t> build(size_t begin, size_t end, uint32_t base, uint32_t level,
                                           uint32_t trail) {
        if (end - begin == 1) {
            const uint32_t light = order_[begin];
            tree_.trails[light] = trail;
            return {lights_[light], LIGHT_LEAF | light};
        }
        const size_t middle = divide(begin, end, MOST_LIGHT_LEVELS - level - 1);
        const auto first_pairs = uint32_t(base + 2);
        const auto second_pairs = uint32_t(first_pairs + 2 * (middle - begin - 1));
        std::pair<LightBounds, uint32_t> first, second;
        accel::run_both(
            end - begin > PARALLEL_FROM,
            [&] { first = build(begin, middle, first_pairs, level + 1, trail); },
            [&] { second = build(middle, end, second_pairs, level + 1, trail | 1u << level); });
        tree_.branches[base] = local_branch(first.first, first.second);
        tree_.branches[base + 1] = local_branch(second.first, second.second);
        return {joined(first.first, second.first), base};
    }

  private:
    static constexpr size_t PARALLEL_FROM = 4096;

    /// Orders the lights of both sides; returns the place of the first one on the right. Neither
    /// side has more than can be told apart by the levels that are left.
    size_t divide(size_t begin, size_t end, uint32_t levels_left) {
        const size_t most = size_t(1) << levels_left;
        if (const std::optional<Split> split = best_split(begin, end)) {
            const auto is_left = [&](uint32_t i) {
                return split->bin(lights_[i]) < split->first_right;
            };
            const auto first = order_.begin() + ptrdiff_t(begin);
            const auto middle =
                std::stable_partition(first, order_.begin() + ptrdiff_t(end), is_left);
            const auto place = size_t(middle - order_.begin());
            if (place > begin && place < end && place - begin <= most && end - place <= most)
                return place;
        }
        return halve(begin, end);
    }

    size_t halve(size_t begin, size_t end) {
        const size_t middle = begin + (end - begin) / 2;
        const glm::length_t axis = longest_axis(estimate(begin, end));
        const auto key = [&](uint32_t i) {
            return std::pair(lights_[i].low[axis] + lights_[i].high[axis], i);
        };
        const auto at = [&](size_t place) { return order_.begin() + ptrdiff_t(place); };
        std::nth_element(at(begin), at(middle), at(end),
                         [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
        return middle;
    }

    Estimate estimate(size_t begin, size_t end) const {
        Estimate all;
        for (size_t i = begin; i < end; i++) all.add(lights_[order_[i]]);
        return all;
    }

    static glm::length_t longest_axis(const Estimate& e) {
        const glm::dvec3 d = e.high - e.low;
        return d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
    }

    std::optional<Split> best_split(size_t begin, size_t end) const {
        const Estimate all = estimate(begin, end);
        const glm::dvec3 size = all.high - all.low;
        const double longest = size[longest_axis(all)];
        std::optional<Split> best;
        for (glm::length_t axis = 0; axis < 3; axis++) {
            if (!(size[axis] > 1e-6 * longest)) continue;
            const Split split = best_along(axis, begin, end, longest / size[axis]);
            if (!best || split.cost < best->cost) best = split;
        }
        return best;
    }

    /// `penalty`: against boxes that become thin.
    Split best_along(glm::length_t axis, size_t begin, size_t end, double penalty) const {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = begin; i < end; i++) {
            const LightBounds& b = lights_[order_[i]];
            low = std::min(low, 0.5 * (b.low[axis] + b.high[axis]));
            high = std::max(high, 0.5 * (b.low[axis] + b.high[axis]));
        }
        Split split{axis, low, double(BINS) / std::max(high - low, 1e-300), 0, INFINITY};
        std::array<Estimate, BINS> bins{}, from{};
        for (size_t i = begin; i < end; i++) {
            const LightBounds& b = lights_[order_[i]];
            bins[split.bin(b)].add(b);
        }
        from = bins;
        for (size_t k = BINS - 1; k-- > 0;) from[k].add(from[k + 1]);
        Estimate left;
        for (size_t k = 1; k < BINS; k++) {
            left.add(bins[k - 1]);
            if (left.count == 0 || from[k].count == 0) continue;
            const double cost = penalty * (left.cost() + from[k].cost());
            if (cost < split.cost) {
                split.cost = cost;
                split.first_right = k;
            }
        }
        return split;
    }

    std::span<const LightBounds> lights_;
    LightTree& tree_;
    std::vector<uint32_t> order_;
};

/// Lights [begin, end) of `powers`, which come after `before` others, in halves.
uint32_t build_everywhere(LightTree& tree, std::span<const double> powers, uint32_t before,
                          uint32_t level, uint32_t trail) {
    if (powers.size() == 1) {
        tree.trails[before] = trail;
        return LIGHT_LEAF | before;
    }
    const size_t half = powers.size() / 2;
    const auto base = uint32_t(tree.branches.size());
    tree.branches.resize(base + 2);
    const auto add = [&](uint32_t side, std::span<const double> part, uint32_t first) {
        const uint32_t next = build_everywhere(tree, part, first, level + 1, trail | side << level);
        const double power = std::accumulate(part.begin(), part.end(), 0.0);
        tree.branches[base + side] = everywhere_branch(power, next);
    };
    add(0, powers.first(half), before);
    add(1, powers.subspan(half), before + uint32_t(half));
    return base;
}

} // namespace

BranchBounds bounds_of(const LightBranch& b) {
    const auto first = [](uint32_t word) { return number_of(word >> 16); };
    const auto second = [](uint32_t word) { return number_of(word & 0xffff); };
    return {{b.center[0], b.center[1], b.center[2]},
            {first(b.axis_xy), second(b.axis_xy), first(b.axis_z_spread)},
            first(b.radius_reach),
            second(b.axis_z_spread),
            second(b.radius_reach)};
}

LightTree build_light_tree(std::span<const LightBounds> local, std::span<const double> everywhere) {
    LightTree tree;
    const auto outside = uint32_t(local.size());
    tree.trails.assign(local.size() + everywhere.size(), LIGHT_OUTSIDE_TREE);
    std::vector<uint32_t> members;
    for (uint32_t i = 0; i < outside; i++)
        if (local[i].power > 0) members.push_back(i);
    if (members.size() + everywhere.size() < 2) return tree;
    // A pair for the two kinds, where there are both.
    const bool both = !members.empty() && !everywhere.empty();
    const uint32_t level = both ? 1 : 0, base = both ? 2 : 0;
    const size_t count = members.size();
    tree.branches.resize(base + (count > 0 ? 2 * (count - 1) : 0));
    uint32_t next = 0;
    double power = 0;
    for (const uint32_t i : members) power += local[i].power;
    if (count > 0) next = Builder(local, members, tree).build(0, count, base, level, 0).second;
    if (!everywhere.empty()) {
        const uint32_t other = build_everywhere(tree, everywhere, outside, level, both ? 1 : 0);
        if (both)
            tree.branches[1] = everywhere_branch(
                std::accumulate(everywhere.begin(), everywhere.end(), 0.0), other);
    }
    if (both) tree.branches[0] = everywhere_branch(power, next);
    return tree;
}

} // namespace onde
