// Rays through trees of every layout that suits the device, against brute force in double
// precision, and the traversals against each other, bit for bit.
#include "doctor/brute_force.h"
#include "doctor/checks.h"
#include "doctor/tally.h"
#include "doctor/traversal_worlds.h"
#include "upload/layout_choice.h"

namespace onde::doctor {

namespace {

using namespace traversal;

/// Some of them along an axis, which box tests must bear.
std::vector<Ray> mixed_rays(size_t count) {
    std::vector<Ray> rays = random_rays(count, 5, 4.0f);
    for (size_t i = 0; i < count; i += 8) {
        glm::vec3 axis(0.0f);
        axis[glm::length_t(i / 8 % 3)] = i / 24 % 2 ? 1.0f : -1.0f;
        rays[i].origin = 0.25f * rays[i].origin - 5.0f * axis;
        rays[i].direction = axis;
    }
    return rays;
}

/// What each ray hits; nothing for close calls, at the rims of things.
std::vector<std::optional<Hit>> exact_hits(const World& world, const std::vector<Ray>& rays) {
    const BruteForce exact(world, 0), wide(world, 1e-4), narrow(world, -1e-4);
    std::vector<std::optional<Hit>> hits(rays.size());
    for (size_t i = 0; i < rays.size(); ++i)
        if (same_primitive(wide.closest(rays[i]), narrow.closest(rays[i])))
            hits[i] = exact.closest(rays[i]);
    return hits;
}

bool is_right(const Hit& got, const Hit& wanted) {
    return same_primitive(got, wanted) && same_distance(got.t, wanted.t) &&
           std::abs(got.u - wanted.u) < 1e-2f && std::abs(got.v - wanted.v) < 1e-2f;
}

void compare(Tally& tally, const CheckContext& context, BvhLayout layout, size_t count) {
    const World world = grove({.layout = layout});
    const std::vector<Ray> rays = mixed_rays(count);
    const std::vector<std::optional<Hit>> wanted = exact_hits(world, rays);
    Tracer tracer(context.programs, world);
    const std::vector<Hit> hits = tracer.closest(rays);
    const std::vector<uint32_t> blocked = tracer.occluded(rays);
    const bool streams = layout == BvhLayout::wide;
    const std::vector<Hit> stream = streams ? tracer.closest_stream(rays) : hits;
    const std::vector<Hit> interleaved = streams ? tracer.closest_interleaved(rays) : hits;
    const std::vector<uint32_t> blocked_stream = streams ? tracer.occluded_stream(rays) : blocked;
    for (size_t i = 0; i < rays.size(); ++i) {
        const auto expect = [&](bool right, const char* what) {
            tally.expect(right, [&] {
                return fmt::format("layout {}, ray {}, {}", word_of(layout), i, what);
            });
        };
        if (wanted[i]) {
            expect(is_right(hits[i], *wanted[i]), "its closest hit");
            expect(blocked[i] == uint32_t(is_hit(*wanted[i])), "whether anything blocks it");
        }
        expect(stream[i] == hits[i], "its closest hit in a stream");
        expect(interleaved[i] == hits[i], "its closest hit among interleaved rays");
        expect(blocked_stream[i] == blocked[i], "whether anything blocks it in a stream");
    }
}

} // namespace

Finding check_traversal(const CheckContext& context) {
    Tally tally;
    for (const BvhLayout layout : layouts_for(context.facts()))
        compare(tally, context, layout, context.quick ? 2048 : 8192);
    return tally.finding("answers differ");
}

} // namespace onde::doctor
