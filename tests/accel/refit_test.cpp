// A refitted tree keeps every promise of a built one, for primitives that are elsewhere.
#include "accel/soups.h"

#include "core/error.h"

#include <catch2/catch.hpp>

#include <cstring>

using namespace onde;
using namespace onde::test;

namespace {

/// A geometry hung directly, two that are instanced, one of them with a shape.
struct Scenery {
    std::vector<Soup> soups;
    std::vector<Geometry> geometries;
    std::vector<Placement> placements;

    Scenery() {
        soups = {random_triangles(3000, 0.1f, 1), random_triangles(5, 0.2f, 2),
                 random_spheres(30, 0.2f, 3)};
        soups[0].spheres = random_spheres(40, 0.1f, 4).spheres;
        soups[2].shapes = {{SHAPE_TORUS, 0.3f}};
        uint32_t first = 0;
        for (Soup& soup : soups) {
            soup.first_primitive = first;
            first += soup.size();
        }
        placements = {{0, glm::mat4(1.0f)}};
        for (int i = 0; i < 12; ++i) {
            const glm::vec3 by(0.3f * float(i) - 2.0f, 0.1f * float(i % 3), 0.5f);
            placements.push_back({1 + uint32_t(i) % 2, glm::translate(glm::mat4(1.0f), by)});
        }
        point();
    }

    /// Moves everything, by nothing that keeps shapes.
    void stir() {
        for (Soup& soup : soups) {
            for (glm::vec3& p : soup.positions)
                p += 0.3f * glm::vec3(std::sin(5 * p.y), std::cos(4 * p.z), std::sin(3 * p.x));
            for (SphereInput& sphere : soup.spheres) {
                sphere.center += glm::vec3(0.1f, -0.2f, 0.3f) * sphere.center;
                sphere.radius *= 1.5f;
            }
        }
        for (Placement& placement : placements)
            if (placement.geometry > 0)
                placement.object_to_world =
                    glm::rotate(placement.object_to_world, 0.5f, glm::vec3(0.6f, 0.0f, 0.8f));
        point();
    }

    void point() {
        geometries.clear();
        for (const Soup& soup : soups) geometries.push_back(soup.geometry());
    }
};

template <class T>
bool same_bytes(const AlignedVector<T>& a, const AlignedVector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

} // namespace

TEST_CASE("a refitted tree is valid for primitives that have moved") {
    for (const BvhBuilder builder : {BvhBuilder::sah, BvhBuilder::high, BvhBuilder::median})
        for (const bool watertight : {false, true}) {
            INFO("builder " << int(builder) << ", watertight " << watertight);
            Scenery scenery;
            const BvhOptions options{.builder = builder, .watertight = watertight};
            Bvh bvh = build_bvh(scenery.geometries, scenery.placements, options);
            const double cost = bvh.statistics.sah_cost;
            scenery.stir();
            CHECK(validate_bvh(bvh, scenery.geometries, scenery.placements) != "");
            refit_bvh(bvh, scenery.geometries, scenery.placements, options);
            CHECK(validate_bvh(bvh, scenery.geometries, scenery.placements) == "");
            CHECK(bvh.statistics.sah_cost != cost);
            CHECK(bvh.statistics.triangles == 3005);
            CHECK(bvh.statistics.instances == 12);
        }
}

TEST_CASE("refitting to where everything is changes no bit, with any number of threads") {
    const Scenery scenery;
    const Bvh built = build_bvh(scenery.geometries, scenery.placements);
    for (const bool parallel : {true, false}) {
        Bvh bvh = build_bvh(scenery.geometries, scenery.placements);
        refit_bvh(bvh, scenery.geometries, scenery.placements, {.parallel = parallel});
        CHECK(same_bytes(bvh.nodes, built.nodes));
        CHECK(same_bytes(bvh.blocks, built.blocks));
        CHECK(same_bytes(bvh.spheres, built.spheres));
        CHECK(same_bytes(bvh.instances, built.instances));
        CHECK(bvh.statistics.sah_cost == built.statistics.sah_cost);
    }
}

TEST_CASE("a refitted tree can be moved into a narrow layout, but not the other way round") {
    Scenery scenery;
    const BvhOptions options{.layout = BvhLayout::binary};
    Bvh bvh = build_bvh(scenery.geometries, scenery.placements, options);
    scenery.stir();
    refit_bvh(bvh, scenery.geometries, scenery.placements, options);
    compact_bvh(bvh, BvhLayout::binary);
    CHECK(!bvh.pairs.empty());
    CHECK_THROWS_AS(refit_bvh(bvh, scenery.geometries, scenery.placements, options), InputError);
}

TEST_CASE("a tree is not refitted to other primitives") {
    Scenery scenery;
    Bvh bvh = build_bvh(scenery.geometries, scenery.placements);
    const auto fewer = std::span(scenery.placements).first(3);
    CHECK_THROWS_AS(refit_bvh(bvh, scenery.geometries, fewer), InputError);
    scenery.soups[2].spheres.pop_back();
    scenery.soups[0].triangles.resize(100);
    scenery.point();
    CHECK_THROWS_AS(refit_bvh(bvh, scenery.geometries, scenery.placements), InputError);
}
