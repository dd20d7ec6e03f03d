// Pictures by panoramas and fisheyes: closed forms, agreement of both estimators, the same bits by
// every engine.
#include "render/light_picture.h"
#include "render/same_bits.h"
#include "session/small_session.h"

#include <glm/gtc/matrix_transform.hpp>

#include <numbers>

namespace onde::test {
namespace {

constexpr double PI = std::numbers::pi;

Camera camera_of(Projection projection, const glm::mat4& camera_to_world = glm::mat4(1)) {
    Camera camera;
    camera.projection = projection;
    camera.camera_to_world = camera_to_world;
    return camera;
}

/// A sphere before nothing, in a white environment or, without one, lit by itself.
Scene lone_sphere(const glm::vec3& center, float radius, const Camera& camera) {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].base_color = glm::vec3(0);
    scene.materials[0].emission = glm::vec3(1);
    scene.spheres = {{center, radius, 0}};
    scene.cameras = {camera};
    return scene;
}

/// A room of things around the camera, lit by a lamp and the sky.
Scene surroundings(Projection projection) {
    Scene scene = varied_scene();
    scene.materials[RED].roughness = 1;
    scene.cameras = {
        camera_of(projection, glm::rotate(moved({0.2f, 1.8f, 2.2f}), 0.4f, glm::vec3(1, 0.3f, 0)))};
    return scene;
}

} // namespace

TEST_CASE("a panorama of an environment is the environment's own map") {
    constexpr uint32_t WIDTH = 32, HEIGHT = 16, TIMES = 8;
    Image map(WIDTH, HEIGHT, 3);
    for (size_t i = 0; i < map.pixels.size(); i++) map.pixels[i] = 0.25f + float(i * 37 % 101) / 64;
    Scene scene = lone_sphere({0, 0, 100}, 1e-4f, camera_of(Projection::panorama));
    scene.environment.map = map;
    scene.environment.radiance = glm::vec3(1);
    // The middle of every eighth pixel is that of a pixel of the map, where nothing is
    // interpolated.
    RenderOptions options = small_options(WIDTH * (TIMES + 1), HEIGHT * (TIMES + 1), 64);
    const Image image = render_scene(scene, options).image;
    double worst = 0;
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++)
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t column = x * (TIMES + 1) + TIMES / 2,
                               row = y * (TIMES + 1) + TIMES / 2;
                worst = std::max(
                    worst, std::abs(double(image.pixel(column, row)[k]) - map.pixel(x, y)[k]));
            }
    CHECK(worst < 0.09); // the box of a pixel is a ninth of the map's, whose slopes are up to 1.6
    double mean = 0, expected = 0;
    for (const float value : image.pixels) mean += value / double(image.pixels.size());
    for (const float value : map.pixels) expected += value / double(map.pixels.size());
    CHECK(mean == Approx(expected).epsilon(1e-3));
}

TEST_CASE("a fisheye shows a sphere as a disk of its angle, and nothing outside of its circle") {
    constexpr uint32_t SIZE = 96;
    // At 60 degrees to the right of the axis, of a half angle of 10 degrees.
    const double off = PI / 3, half = PI / 18, distance = 4;
    const glm::vec3 center(float(distance * std::sin(off)), 0, float(-distance * std::cos(off)));
    Scene scene =
        lone_sphere(center, float(distance * std::sin(half)), camera_of(Projection::fisheye));
    const RenderOptions options = small_options(SIZE, SIZE, 256);
    const Image image = render_scene(scene, options).image;
    double lit = 0, at = 0;
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            lit += image.pixel(x, y)[0];
            at += image.pixel(x, y)[0] * (x + 0.5);
            // Along the axis of the picture its edges lie where the angles say.
            const double angle = (x + 0.5 - SIZE / 2.0) / (SIZE / 2.0) * (PI / 2);
            if (y == SIZE / 2 && std::abs(std::abs(angle - off) - half) > PI / SIZE)
                CHECK(image.pixel(x, y)[0] == (std::abs(angle - off) < half ? 1.0f : 0.0f));
        }
    // The film area of a cap is the integral of angle / sin(angle) over its solid angle.
    double area = 0;
    constexpr int STEPS = 400;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < STEPS; k++) {
            const double a = (i + 0.5) / STEPS * half, turn = (k + 0.5) / STEPS * 2 * PI;
            const double cosine =
                std::cos(off) * std::cos(a) + std::sin(off) * std::sin(a) * std::cos(turn);
            const double angle = std::acos(cosine);
            area += angle / std::sin(angle) * std::sin(a) * (half / STEPS) * (2 * PI / STEPS);
        }
    const double pixels = area * std::pow(SIZE / PI, 2);
    CHECK(lit == Approx(pixels).epsilon(3e-3));
    CHECK(at / lit > SIZE / 2.0 * (1 + off / (PI / 2) * 0.98));

    scene.environment.radiance = glm::vec3(2);
    const Image before_sky = render_scene(scene, options).image;
    CHECK(before_sky.pixel(0, 0)[0] == 0);
    CHECK(before_sky.pixel(SIZE - 1, SIZE - 1)[0] == 0);
    CHECK(before_sky.pixel(SIZE / 2, 2)[0] == 2);
    double sum = 0;
    for (size_t i = 0; i < before_sky.pixels.size(); i += 3) sum += before_sky.pixels[i];
    CHECK(sum == Approx(2 * (PI / 4 * SIZE * SIZE - pixels) + pixels).epsilon(2e-3));
}

TEST_CASE("light tracing expects the path tracer's panorama and fisheye, of all filters") {
    for (const Projection projection : {Projection::panorama, Projection::fisheye})
        for (const Filter filter : {Filter::box, Filter::blackman_harris}) {
            INFO(word_of(projection) << " " << word_of(filter));
            Scene scene = surroundings(projection);
            RenderOptions options =
                small_options(48, projection == Projection::fisheye ? 40 : 24, 64);
            options.filter = filter;
            options.depth = 3;
            check_paths_agree(scene, options, 0.02);
        }
}

TEST_CASE("depth is the distance, and motion that of the place, where a camera sees all around") {
    for (const Projection projection : {Projection::panorama, Projection::fisheye}) {
        INFO(word_of(projection));
        Scene scene;
        scene.materials.resize(1);
        Mesh mesh = grid_mesh(8, 0); // of -1 to 1, far enough to be about a point
        scene.meshes = {mesh};
        scene.instances = {{0, glm::scale(glm::translate(glm::mat4(1), glm::vec3(0, -2, 0)),
                                          glm::vec3(50, 1, 50))}};
        scene.environment.radiance = glm::vec3(1);
        scene.cameras = {
            camera_of(projection, glm::rotate(glm::mat4(1), -0.6f, glm::vec3(1, 0, 0)))};
        scene.next = standing_still(scene);
        scene.next->cameras[0].camera_to_world =
            glm::rotate(scene.cameras[0].camera_to_world, 0.3f, glm::vec3(0, 0, 1));
        constexpr uint32_t SIZE = 32;
        RenderOptions options = small_options(SIZE, SIZE, 16);
        options.aovs = 1u << AOV_DEPTH | 1u << AOV_MOTION | 1u << AOV_POSITION;
        Session session(programs(), scene, {.render = options, .choose_layout = false});
        session.render();
        const Image depth = session.film().develop(*find_channel("depth"));
        const Image position = session.film().develop(*find_channel("position"));
        const Image motion = session.film().develop(*find_channel("motion"));
        const std::span<const float> p = position.pixel(16, 17);
        const double distance = glm::length(glm::dvec3(p[0], p[1], p[2]));
        CHECK(depth.pixel(16, 17)[0] == Approx(distance).epsilon(0.02)); // of a pixel of 6 degrees
        if (projection == Projection::fisheye) {
            // A turn about the axis turns the picture about its middle.
            const glm::dvec2 from(20.5 - 16, -(16.5 - 16)),
                to(from.x * std::cos(-0.3) - from.y * std::sin(-0.3),
                   from.x * std::sin(-0.3) + from.y * std::cos(-0.3));
            CHECK(motion.pixel(20, 16)[0] == Approx(to.x - from.x).margin(0.02));
            CHECK(motion.pixel(20, 16)[1] == Approx(to.y - from.y).margin(0.02));
        }
        // The edges of a panorama are one: nothing moves farther than half of the picture.
        for (size_t i = 0; i < motion.pixels.size(); i++)
            REQUIRE(std::abs(motion.pixels[i]) <= SIZE / 2.0 + 1e-3);
    }
}

TEST_CASE("every engine, width and launch has the same bits by panoramas and fisheyes") {
    for (const Projection projection : {Projection::panorama, Projection::fisheye}) {
        INFO(word_of(projection));
        check_same_bits(surroundings(projection), small_options(40, 24, 4));
    }
}

TEST_CASE("Whitted's rays see by panoramas and fisheyes; drawing by parallel rays is refused") {
    RenderOptions options = small_options(40, 30, 1);
    options.integrator = IntegratorKind::whitted;
    Scene scene = surroundings(Projection::fisheye);
    scene.chapter.whitted.background = glm::vec3(0.5f);
    const Image image = render_scene(scene, options).image;
    CHECK(image.pixel(0, 0)[0] == 0);
    CHECK(image.pixel(20, 15)[0] > 0);
    for (const IntegratorKind kind : {IntegratorKind::depth_buffer, IntegratorKind::painter}) {
        options.integrator = kind;
        CHECK_THROWS_WITH(render_scene(scene, options),
                          Catch::Contains("parallel rays") && Catch::Contains("fisheye"));
    }
}

TEST_CASE("a session may take a panorama for its camera, and takes it back") {
    Scene scene = varied_scene();
    SessionOptions options = small_session();
    options.features.reset();
    options.choose_layout = false;
    Session session(programs(), scene, options);
    const std::vector<float> before = rendered(session);
    const Camera own = session.camera();
    Camera wide = own;
    wide.projection = Projection::panorama;
    session.set_camera(wide);
    const std::vector<float> panorama = rendered(session);
    scene.cameras[0] = wide;
    CHECK(panorama == fresh_picture(scene, options));
    session.set_camera(own);
    CHECK(rendered(session) == before);
}

} // namespace onde::test
