// Motion vectors against closed forms: what moves, what deforms, cameras of all kinds.
#include "render/picture.h"
#include "render/variants.h"
#include "session/small_session.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace onde::test {
namespace {

constexpr uint32_t SIZE = 16;

/// A square of 2 x 2 at z = 0 that faces a camera at z = 3, which sees 4 x 4 of that plane.
Scene square() {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.materials = {0, 0};
    scene.materials.resize(1);
    scene.meshes = {mesh};
    scene.instances = {{0, glm::mat4(1)}};
    scene.environment.radiance = glm::vec3(0.5f);
    scene.cameras = {camera_at({0, 0, 3}, {0, 0, 0}, 2 * std::atan(2.0f / 3.0f))};
    return scene;
}

RenderOptions with_motion(uint32_t samples = 64) {
    RenderOptions options = small_options(SIZE, SIZE, samples);
    options.aovs = 1u << AOV_MOTION;
    return options;
}

Session session_of(const Scene& scene, const RenderOptions& options = with_motion()) {
    return Session(programs(), scene, {.render = options, .choose_layout = false});
}

Image motion_in(Session& session) {
    session.render();
    return session.film().develop(*find_channel("motion"));
}

Image motion_of(const Scene& scene, const RenderOptions& options = with_motion()) {
    Session session = session_of(scene, options);
    return motion_in(session);
}

/// Where a camera sees a point, or a direction (w = 0): in pixels to the right and up from the
/// axis.
glm::dvec2 seen(const Camera& camera, const glm::dvec4& place) {
    const glm::dvec3 p(glm::inverse(glm::dmat4(camera.camera_to_world)) * place);
    if (camera.orthographic_height)
        return glm::dvec2(p.x, p.y) * (SIZE / double(*camera.orthographic_height));
    return glm::dvec2(p.x, p.y) / -p.z * (0.5 * SIZE / std::tan(0.5 * double(camera.vertical_fov)));
}

/// The direction through the middle of a pixel of the camera of square().
glm::dvec3 direction(uint32_t x, uint32_t y) {
    return {(x + 0.5 - 0.5 * SIZE) / 12.0, (0.5 * SIZE - y - 0.5) / 12.0, -1.0};
}

/// On the square or, for all pixels that do not show it, at infinity.
glm::dvec4 place_of(uint32_t x, uint32_t y) {
    const bool on_square = x >= 4 && x < 12 && y >= 4 && y < 12;
    const glm::dvec3 d = direction(x, y);
    return on_square ? glm::dvec4(3.0 * d + glm::dvec3(0, 0, 3), 1.0) : glm::dvec4(d, 0.0);
}

/// Compares every pixel's motion with that of the place in its middle, which `move` moves.
template <class Move>
void check_motion(const Scene& scene, const Image& motion, const Move& move, double margin = 0.02) {
    const Camera& now = scene.cameras[0];
    const Camera& next = scene.next->cameras[0];
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            const glm::dvec4 place = place_of(x, y);
            const glm::dvec2 expected = seen(next, move(place)) - seen(now, place);
            INFO("pixel " << x << "," << y);
            CHECK(motion.pixel(x, y)[0] == Approx(expected.x).margin(margin));
            CHECK(motion.pixel(x, y)[1] == Approx(expected.y).margin(margin));
        }
}

glm::dvec4 stay(const glm::dvec4& place) {
    return place;
}

} // namespace

TEST_CASE(
    "what stands still has a motion of exactly 0, and the picture is the one without motion") {
    for (const Scene& scene : {square(), varied_scene()}) {
        const Image motion = motion_of(scene);
        CHECK(std::ranges::all_of(motion.pixels, [](float number) { return number == 0.0f; }));
        RenderOptions plain = with_motion();
        plain.aovs = 0;
        Session without = session_of(scene, plain), with = session_of(scene);
        without.render();
        with.render();
        CHECK(first_difference(without.picture(), with.picture()) == "");
    }
}

TEST_CASE("a square that goes, turns and comes nearer moves as its points do") {
    Scene scene = square();
    scene.next = standing_still(scene);
    const glm::mat4 moves[] = {
        moved({0.5f, 0.25f, 0}), moved({0.1f, 0, 1}),
        glm::rotate(moved({0, 0.2f, -0.5f}), 0.6f, glm::normalize(glm::vec3(1, 2, 3)))};
    for (const glm::mat4& m : moves) {
        scene.next->instances[0].object_to_world = m;
        const Image motion = motion_of(scene);
        check_motion(scene, motion,
                     [&](const glm::dvec4& p) { return p.w == 0 ? p : glm::dmat4(m) * p; });
    }
    scene.next->instances[0].object_to_world = moves[0];
    const Image motion = motion_of(scene);
    CHECK(motion.pixel(8, 7)[0] == Approx(2).margin(1e-4)); // 4 pixels a unit
    CHECK(motion.pixel(8, 7)[1] == Approx(1).margin(1e-4));
    CHECK(motion.pixel(1, 1)[0] == 0);
}

TEST_CASE("a camera that turns and goes moves surfaces and what is behind them") {
    Scene scene = square();
    scene.next = standing_still(scene);
    Camera& next = scene.next->cameras[0];
    next.camera_to_world = glm::rotate(next.camera_to_world, 0.1f, glm::vec3(0, 1, 0));
    check_motion(scene, motion_of(scene), stay);
    next.camera_to_world = glm::rotate(moved({0.3f, 0.2f, 2.5f}), -0.05f, glm::vec3(1, 0.5f, 0.3f));
    check_motion(scene, motion_of(scene), stay);
    next = camera_at({0, 0, -3}, {0, 0, -6}, next.vertical_fov); // all is behind it
    const Image motion = motion_of(scene);
    CHECK(motion.pixel(8, 8)[0] == 0);
}

TEST_CASE("parallel rays see the motion of surfaces, and none of the environment") {
    Scene scene = square();
    scene.cameras[0].orthographic_height = 4.0f;
    scene.next = standing_still(scene);
    scene.next->instances[0].object_to_world = moved({0.5f, -0.25f, 1});
    scene.next->cameras[0].camera_to_world = moved({0.25f, 0, 7});
    const Image motion = motion_of(scene);
    CHECK(motion.pixel(8, 8)[0] == Approx(1).margin(1e-4));
    CHECK(motion.pixel(8, 8)[1] == Approx(-1).margin(1e-4));
    CHECK(motion.pixel(1, 1)[0] == 0);
}

TEST_CASE("out of a lens's focus the mean motion is that of the lens's middle") {
    Scene scene = square();
    scene.meshes[0].positions = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}; // no edge to blur
    scene.cameras[0].aperture_radius = 0.2f;
    scene.cameras[0].focus_distance = 1.5f;
    scene.next = standing_still(scene);
    scene.next->instances[0].object_to_world = moved({0.5f, 0.25f, 0});
    const Image motion = motion_of(scene);
    for (const uint32_t place : {0u, 7u, 15u}) {
        CHECK(motion.pixel(place, 15 - place)[0] == Approx(2).margin(1e-3));
        CHECK(motion.pixel(place, 15 - place)[1] == Approx(1).margin(1e-3));
    }
}

TEST_CASE("a mesh that deforms moves by the steps of its corners") {
    Scene scene = square();
    scene.next = standing_still(scene);
    const glm::mat3 stretch(1.2f, 0.1f, 0.3f, -0.2f, 0.9f, 0, 0, 0, 1);
    std::vector<glm::vec3> steps;
    for (const glm::vec3& p : scene.meshes[0].positions) steps.push_back(stretch * p - p);
    scene.next->steps = {steps};
    scene.next->instances[0].steps = 0;
    check_motion(scene, motion_of(scene), [&](const glm::dvec4& p) {
        return p.w == 0 ? p : glm::dvec4(glm::dmat3(stretch) * glm::dvec3(p), 1.0);
    });
}

TEST_CASE("copies that share a deforming mesh move as meshes of their own do") {
    Scene copies = square();
    Mesh grid = grid_mesh(33, 0); // twice as many triangles as are baked
    copies.meshes = {grid};
    const glm::mat4 upright = glm::rotate(glm::mat4(1), 1.5f, glm::vec3(1, 0, 0));
    copies.instances = {
        {0, moved({-0.7f, 0, 0}) * upright},
        {0, glm::scale(moved({0.7f, 0.2f, -0.5f}), glm::vec3(1, 0.7f, 1)) * upright}};
    copies.next = standing_still(copies);
    std::vector<glm::vec3> steps;
    for (const glm::vec3& p : grid.positions) steps.emplace_back(0, 0.2f * p.x * p.z, 0.1f * p.x);
    copies.next->steps = {steps};
    copies.next->instances = {{moved({0.3f, 0.1f, 0}) * copies.instances[0].object_to_world, 0},
                              {copies.instances[1].object_to_world, 0}};
    Scene baked = copies;
    baked.meshes.push_back(grid);
    baked.instances[1].mesh = 1;
    baked.next->steps.push_back(steps);
    baked.next->instances[1].steps = 1;
    REQUIRE(pack_scene(copies).features.instances);
    REQUIRE_FALSE(pack_scene(baked).features.instances);
    const Image shared = motion_of(copies), own = motion_of(baked);
    float largest = 0;
    for (size_t i = 0; i < shared.pixels.size(); i++) {
        CHECK(shared.pixels[i] == Approx(own.pixels[i]).margin(2e-2)); // hits at edges may differ
        largest = std::max(largest, std::abs(own.pixels[i]));
    }
    CHECK(largest > 1.0f);
}

TEST_CASE("an environment that turns with the camera stands still before it") {
    Session session = session_of(square());
    Camera turned = session.camera();
    turned.camera_to_world =
        glm::rotate(glm::mat4(1), 0.4f, glm::vec3(0, 1, 0)) * turned.camera_to_world;
    session.set_next_view(turned, 0.4f);
    const Image together = motion_in(session);
    CHECK(together.pixel(1, 3)[0] == Approx(0).margin(1e-3));
    CHECK(together.pixel(1, 3)[1] == Approx(0).margin(1e-3));
    CHECK(together.pixel(8, 8)[0] == Approx(0).margin(0.1)); // it is on the axis of the turn
    CHECK(std::abs(together.pixel(11, 8)[0]) > 0.1f);
    session.set_next_view(turned, 0.0f);
    CHECK(motion_in(session).pixel(8, 1)[0] > 1.0f);
    session.set_camera(session.camera()); // what is edited stands still
    CHECK(motion_in(session).pixel(8, 1)[0] == 0.0f);
}

namespace {

/// All kinds of motion at once.
Scene moving_scene() {
    Scene scene = varied_scene();
    scene.next = standing_still(scene);
    scene.next->instances[FIRST_TILE].object_to_world =
        moved({0.2f, 0.3f, 0}) * scene.instances[FIRST_TILE].object_to_world;
    scene.next->instances[FLOOR].steps = 0;
    scene.next->steps = {{{0, 0, 0}, {0, 0.1f, 0}, {0, 0, 0}, {0, 0, 0.2f}}};
    Camera& camera = scene.next->cameras[0];
    camera.camera_to_world = glm::rotate(camera.camera_to_world, 0.05f, glm::vec3(0, 1, 0));
    return scene;
}

} // namespace

TEST_CASE("every engine, launch and width makes the same motion") {
    const Scene scene = moving_scene();
    RenderOptions options = with_motion(80); // more than a block
    options.aovs |= 1u << AOV_ALBEDO | 1u << AOV_DIRECT;
    Session first = session_of(scene, options);
    const Image motion = motion_in(first);
    CHECK(std::ranges::max(motion.pixels) > 0.1f);
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        Session session = session_of(scene, apply(options, variant));
        CHECK(motion_in(session).pixels == motion.pixels);
        CHECK(session.film().develop(*find_channel("albedo")).pixels ==
              first.film().develop(*find_channel("albedo")).pixels);
    }
}

TEST_CASE("a film goes on with its motion, but not to another next frame") {
    Scene scene = moving_scene();
    Session whole = session_of(scene, with_motion(80));
    const Image motion = motion_in(whole);
    Session begun = session_of(scene, with_motion(16));
    begun.render();
    Session continued = session_of(scene, with_motion(80));
    continued.restore_film(begun.keep_film());
    CHECK(motion_in(continued).pixels == motion.pixels);
    scene.next->instances[LAMP].object_to_world = glm::mat4(1);
    Session other = session_of(scene, with_motion(80));
    CHECK_THROWS_WITH(other.restore_film(begun.keep_film()), Catch::Contains("next frame"));
}

TEST_CASE("a session is given motion, and instances that are edited stand still") {
    Scene scene = square();
    RenderOptions options = with_motion();
    options.aovs = 0;
    Session session = session_of(scene, options);
    session.render();
    session.set_options(with_motion());
    session.set_instance_transform(0, moved({0.1f, 0, 0}));
    const Image motion = motion_in(session);
    CHECK(std::ranges::all_of(motion.pixels, [](float number) { return number == 0.0f; }));
}

} // namespace onde::test
