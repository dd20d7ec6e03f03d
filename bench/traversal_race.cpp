#include "traversal_race.h"

#include "traversal_embree.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <thread>

namespace onde::bench {

namespace {

/// Wall-clock seconds, or processor seconds of all threads over their number, which other work on
/// the machine disturbs less.
double now(bool cpu_time) {
    if (cpu_time)
        return double(std::clock()) / CLOCKS_PER_SEC / std::thread::hardware_concurrency();
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

bool differs(const Hit& hit, const Hit& expected) {
    return !(std::abs(hit.t - expected.t) <= 1e-4f * std::abs(expected.t));
}
bool differs(uint32_t blocked, uint32_t expected) {
    return blocked != expected;
}

template <class Answer>
size_t count_mismatches(const std::vector<Answer>& answers, const std::vector<Answer>& expected) {
    size_t count = 0;
    for (size_t i = 0; i < answers.size(); ++i) count += differs(answers[i], expected[i]);
    return count;
}

class Race {
  public:
    Race(const RaySet& set, const gpu::Device& device, const EmbreeScene& embree, OndeTracers& onde,
         const RaceOptions& options)
        : set_(set), device_(device), options_(options), on_device_(device, set.rays),
          hits_(set.rays.size()), blocked_(set.rays.size()) {
        ask(embree, EMBREE_SINGLE);
        expected_hits_ = hits_;
        expected_blocked_ = blocked_;
        for (const EmbreeMode& mode : embree_modes(embree)) add(embree, mode);
        add_traversals("onde", Side::onde, onde.wide);
        add_traversals("onde portable", Side::onde, onde.portable);
        add_single("onde watertight single", Side::onde_watertight, onde.watertight);
        add_single("onde compressed single", Side::onde, onde.compressed);
        add_single("onde binary single", Side::onde, onde.binary);
        if (onde.against) add_traversals("against", Side::against, *onde.against);
    }

    std::vector<Timing> run() {
        std::vector<Timing> timings;
        for (const Contender& contender : contenders_) { // warms up as well
            contender.run();
            timings.push_back({contender.name, contender.side, contender.mismatches()});
        }
        for (uint32_t repetition = 0; repetition < options_.repetitions; ++repetition)
            for (size_t i = 0; i < contenders_.size(); ++i) {
                const double start = now(options_.cpu_time);
                contenders_[i].run();
                timings[i].seconds.push_back(now(options_.cpu_time) - start);
            }
        return timings;
    }

  private:
    struct Contender {
        std::string name;
        Side side;
        std::function<void()> run;
        std::function<size_t()> mismatches; ///< of the last run
    };

    void ask(const EmbreeScene& embree, EmbreeMode mode) {
        if (set_.any_hit)
            embree_occluded(embree, mode, set_.rays, blocked_);
        else
            embree_closest(embree, mode, set_.rays, hits_);
    }

    bool takes_part(const std::string& name) const {
        const auto is_in = [&](const std::string& traversal) {
            return name.find(traversal) != std::string::npos;
        };
        return options_.traversals.empty() || is_in("single") ||
               std::ranges::any_of(options_.traversals, is_in);
    }

    void add(const EmbreeScene& embree, EmbreeMode mode) {
        if (!takes_part(mode.name())) return;
        contenders_.push_back({mode.name(), Side::embree,
                               [this, &embree, mode] { ask(embree, mode); },
                               [this] { return mismatches(hits_, blocked_); }});
    }

    using Traversal = void (RayQuery::*)(const QueryRays&);

    void add(const std::string& name, Side side, RayQuery& onde, Traversal traversal) {
        if (!takes_part(name)) return;
        contenders_.push_back(
            {name, side, [this, &onde, traversal] { (onde.*traversal)(on_device_); },
             [this] {
                 return mismatches(on_device_.hits.read(device_), on_device_.blocked.read(device_));
             }});
    }
    void add_single(const std::string& name, Side side, RayQuery& onde) {
        add(name, side, onde, set_.any_hit ? &RayQuery::occluded : &RayQuery::closest);
    }
    /// Ray by ray, in streams, and interleaved where they look for closest hits.
    void add_traversals(const std::string& who, Side side, RayQuery& onde) {
        add_single(who + " single", side, onde);
        if (set_.any_hit) return add(who + " stream", side, onde, &RayQuery::occluded_stream);
        add(who + " stream", side, onde, &RayQuery::closest_stream);
        add(who + " interleaved", side, onde, &RayQuery::closest_interleaved);
    }

    size_t mismatches(const std::vector<Hit>& hits, const std::vector<uint32_t>& blocked) const {
        return set_.any_hit ? count_mismatches(blocked, expected_blocked_)
                            : count_mismatches(hits, expected_hits_);
    }

    const RaySet& set_;
    const gpu::Device& device_;
    const RaceOptions& options_;
    QueryRays on_device_;
    std::vector<Hit> hits_, expected_hits_;
    std::vector<uint32_t> blocked_, expected_blocked_;
    std::vector<Contender> contenders_;
};

} // namespace

std::vector<Timing> race(const RaySet& set, const gpu::Device& device, const EmbreeScene& embree,
                         OndeTracers& onde, const RaceOptions& options) {
    return Race(set, device, embree, onde, options).run();
}

} // namespace onde::bench
