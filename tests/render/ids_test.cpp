// What samples see, counted by thing.
#include "render/picture.h"
#include "render/variants.h"

#include "scene/id_names.h"
#include "scene/shapes.h"
#include "upload/pack.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace onde::test {
namespace {

Mesh grid(uint32_t cells, uint32_t material) {
    Mesh mesh;
    for (uint32_t y = 0; y <= cells; y++)
        for (uint32_t x = 0; x <= cells; x++)
            mesh.positions.emplace_back(float(x) / float(cells), float(y) / float(cells), 0.0f);
    for (uint32_t y = 0; y < cells; y++)
        for (uint32_t x = 0; x < cells; x++) {
            const uint32_t a = y * (cells + 1) + x, b = a + cells + 1;
            mesh.triangles.emplace_back(a, a + 1, b + 1);
            mesh.triangles.emplace_back(a, b + 1, b);
        }
    mesh.materials.assign(mesh.triangles.size(), material);
    return mesh;
}

glm::mat4 at(float x, float y, float z = 0) {
    return glm::translate(glm::mat4(1), glm::vec3(x, y, z));
}

/// Six unit squares of three by two, before a camera that sees four by four of their plane: two
/// that are baked, of a mesh of two materials, two instances of a fine grid, and of shapes and
/// spheres one each. What is left is sky.
Scene scene_of_things() {
    Scene scene;
    scene.materials.resize(4);
    for (size_t i = 0; i < 4; i++) scene.materials[i].name = "m" + std::to_string(i);
    Mesh two = grid(1, 0);
    two.materials = {0, 1};
    scene.meshes = {two, grid(40, 2)};
    scene.names = {{"first", "left"}, {"fine", "right"}, {"ring", ""}};
    scene.instances = {
        {0, at(-1.5f, 0), 0}, {0, at(-1.5f, -1)}, {1, at(-0.5f, 0), 1}, {1, at(-0.5f, -1), 1}};
    scene.spheres = {{{1, 0.5f, 0}, 0.4f, 3}};
    scene.shapes = {
        {ShapeKind::torus, 3, 0.3f, at(1, -0.5f) * glm::scale(glm::mat4(1), glm::vec3(0.3f)), 2}};
    scene.environment.radiance = glm::vec3(0.5f);
    scene.cameras = {camera_at({0, 0, 3}, {0, 0, 0}, 2 * std::atan(2.0f / 3.0f))};
    return scene;
}

RenderOptions options_with_ids(uint32_t samples = 80) {
    RenderOptions options = small_options(17, 13, samples); // edges run through pixels
    options.ids = true;
    return options;
}

Session session_of(const Scene& scene, const RenderOptions& options) {
    return Session(programs(), scene, {.render = options, .choose_layout = false});
}

IdCounts rendered_ids(const Scene& scene, const RenderOptions& options) {
    Session session = session_of(scene, options);
    session.render();
    return session.film().ids();
}

/// Samples by object, of the whole picture.
std::map<uint32_t, uint64_t> totals(const IdCounts& counts) {
    std::map<uint32_t, uint64_t> all;
    for (const PixelIds& ids : counts)
        for (const IdCount& seen : ids) all[seen.id.object] += seen.count;
    return all;
}

} // namespace

TEST_CASE("every sample of a pixel is counted once, by what it sees") {
    const IdCounts counts = rendered_ids(scene_of_things(), options_with_ids());
    REQUIRE(counts.size() == 17 * 13);
    std::set<SeenId> all;
    for (const PixelIds& ids : counts) {
        uint32_t samples = 0;
        CHECK(std::ranges::is_sorted(ids, {}, &IdCount::id));
        for (const IdCount& seen : ids) {
            samples += seen.count;
            all.insert(seen.id);
        }
        CHECK(samples == 80);
    }
    const std::set<SeenId> expected{{0, 0}, {0, 1}, {1, 0}, {1, 1},      {2, 2},
                                    {3, 2}, {4, 3}, {5, 3}, NOTHING_SEEN};
    CHECK(all == expected);
    // A unit square is a sixteenth of the view, which is 17 / 13 times as wide as high.
    const double view = 16.0 * 17 / 13;
    for (const uint32_t square : {0u, 1u, 2u, 3u})
        CHECK(double(totals(counts)[square]) == Approx(17 * 13 * 80 / view).epsilon(0.02));
}

TEST_CASE("shapes that stand where they were made, alone, are told apart") {
    Scene scene = scene_of_things();
    scene.instances = {{0, at(-4, -4, -2)}};
    scene.spheres.clear();
    scene.shapes = {{ShapeKind::torus, 3, 0.2f, glm::mat4(1)}}; // hits have no instance
    const auto counts = totals(rendered_ids(scene, options_with_ids(16)));
    CHECK(counts.contains(1)); // objects are instances first, then shapes
    CHECK(counts.contains(NO_INDEX));
}

TEST_CASE("ids leave the picture as it is, and every engine and split counts the same") {
    const Scene scene = scene_of_things();
    RenderOptions plain_options = options_with_ids();
    plain_options.ids = false;
    Session plain = session_of(scene, plain_options);
    plain.render();
    CHECK(plain.film().ids().empty());
    Session first = session_of(scene, options_with_ids());
    first.render();
    CHECK(first_difference(plain.picture(), first.picture()) == "");
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        CHECK(rendered_ids(scene, apply(options_with_ids(), variant)) == first.film().ids());
    }
    RenderOptions part = options_with_ids();
    part.rectangle = Rectangle{3, 2, 9, 7};
    const IdCounts some = rendered_ids(scene, part);
    for (uint32_t y = 0; y < 13; y++)
        for (uint32_t x = 0; x < 17; x++) {
            const bool inside = x >= 3 && x < 12 && y >= 2 && y < 9;
            CHECK(some[y * 17 + x] == (inside ? first.film().ids()[y * 17 + x] : PixelIds{}));
        }
}

TEST_CASE("a film goes on with its ids, and clears them") {
    const Scene scene = scene_of_things();
    const IdCounts whole = rendered_ids(scene, options_with_ids());
    Session begun = session_of(scene, options_with_ids(16));
    begun.render();
    CHECK(begun.film().ids() != whole);
    Session continued = session_of(scene, options_with_ids());
    continued.restore_film(begun.keep_film());
    continued.render();
    CHECK(continued.film().ids() == whole);
    continued.clear();
    CHECK(totals(continued.film().ids()).empty());
    RenderOptions without = options_with_ids();
    without.ids = false;
    Session other = session_of(scene, without);
    CHECK_THROWS_AS(other.restore_film(begun.keep_film()), InputError);
}

TEST_CASE("things that are moved keep their ids") {
    const Scene scene = scene_of_things();
    Session session = session_of(scene, options_with_ids(16));
    session.set_instance_transform(2, at(0.5f, -2));
    session.render();
    Scene moved = scene;
    moved.instances[2].object_to_world = at(0.5f, -2);
    CHECK(session.film().ids() == rendered_ids(moved, options_with_ids(16)));
}

TEST_CASE("things are called by their names, else by their meshes, else by numbers") {
    Scene scene = scene_of_things();
    scene.meshes[0].name = "plate";
    scene.materials[1].name.clear();
    const IdNames names = id_names(scene);
    CHECK(names.objects ==
          std::vector<std::string>{"first", "plate", "fine", "fine", "object 4", "ring"});
    CHECK(names.assets ==
          std::vector<std::string>{"left", "plate", "right", "right", "object 4", "ring"});
    CHECK(names.materials == std::vector<std::string>{"m0", "material 1", "m2", "m3"});
}

TEST_CASE("ids of a kind add up whatever their order") {
    PixelIds a, b;
    for (const uint32_t object : {5u, 1u, 5u, 3u, 1u, 5u}) add_id(a, {object, 0}, 1);
    for (const uint32_t object : {1u, 3u, 5u})
        add_id(b, {object, 0}, object == 3 ? 1 : object == 1 ? 2 : 3);
    CHECK(a == b);
    CHECK(most_ids({{}, a}) == 3);
}

} // namespace onde::test
