// Worlds of triangles, spheres and instances on the tests' device.
#pragma once

#include "accel/soups.h"
#include "doctor/traversal_rig.h"
#include "support/programs.h"

#include <catch2/catch.hpp>

namespace onde::test::traversal {

using namespace onde::gpu;
using doctor::traversal::Abilities;
using doctor::traversal::Hit;
using doctor::traversal::is_hit;
using doctor::traversal::Ray;
using doctor::traversal::same_distance;
using doctor::traversal::same_primitive;
using doctor::traversal::World;
using doctor::traversal::operator==;

class Tracer : public doctor::traversal::Tracer {
  public:
    explicit Tracer(const World& world, std::vector<std::string> defines = {},
                    Abilities abilities = Abilities::needed)
        : doctor::traversal::Tracer(programs(), world, std::move(defines), abilities) {}
};

/// The number of hits that are not the same primitive at the same distance, give or take rounding.
inline size_t unlike(const std::vector<Hit>& hits, const std::vector<Hit>& expected) {
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i)
        count += !same_primitive(hits[i], expected[i]) ||
                 !same_distance(hits[i].t, expected[i].t, 1e-6f);
    return count;
}

/// The number of places at which two lists of results differ in any bit.
template <class T>
inline size_t differences(const std::vector<T>& a, const std::vector<T>& b) {
    REQUIRE(a.size() == b.size());
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += !(a[i] == b[i]);
    return count;
}

} // namespace onde::test::traversal
