// Motion blur: coverage in closed form, many still pictures as the reference, the same bits by
// every engine and layout, and what else knows of time.
#include "render/light_picture.h"
#include "render/same_bits.h"
#include "scene/mapping.h"
#include "session/small_session.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace onde::test {
namespace {

constexpr uint32_t SIZE = 16;

/// A white rectangle at z = 0, from `low` to `high`, that only shines, before a camera of parallel
/// rays whose pixels are 1 wide; the picture's middle is the world's.
Scene rectangle(glm::vec2 low, glm::vec2 high) {
    Scene scene;
    Mesh mesh;
    mesh.positions = {
        {low.x, low.y, 0}, {high.x, low.y, 0}, {high.x, high.y, 0}, {low.x, high.y, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.materials = {0, 0};
    scene.materials.resize(1);
    scene.materials[0].base_color = glm::vec3(0);
    scene.materials[0].emission = glm::vec3(1);
    scene.materials[0].two_sided = true;
    scene.meshes = {mesh};
    scene.instances = {{0, glm::mat4(1)}};
    scene.cameras = {camera_at({0, 0, 10}, {0, 0, 0}, 1)};
    scene.cameras[0].orthographic_height = float(SIZE);
    return scene;
}

ShutterMotion still(const Scene& scene) {
    return {std::vector<MotionKeys>(scene.instances.size()),
            std::vector<MotionKeys>(scene.shapes.size()),
            std::vector<MotionKeys>(scene.cameras.size())};
}

Image picture_of(const Scene& scene, uint32_t samples) {
    return render_scene(scene, small_options(SIZE, SIZE, samples)).image;
}

/// The share of [x, x + 1] that [low, high] covers in the mean, while it moves by `way`.
double coverage(double x, double low, double high, double way) {
    constexpr int STEPS = 4000;
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double by = way * (i + 0.5) / STEPS;
        sum += std::max(0.0, std::min(x + 1, high + by) - std::max(x, low + by)) / STEPS;
    }
    return sum;
}

void check_row(const Image& image, double low, double high, double way) {
    for (uint32_t x = 0; x < SIZE; x++) {
        INFO("column " << x);
        const double expected = coverage(double(x) - SIZE / 2.0, low, high, way);
        CHECK(image.pixel(x, SIZE / 2)[0] ==
              Approx(expected).margin(0.02)); // 2.5 sigma of random samples
        CHECK(image.pixel(x, SIZE / 2)[2] == image.pixel(x, SIZE / 2)[0]);
    }
}

/// Things of all kinds that move, turn and grow, before a camera that does too.
Scene moving_scene() {
    Scene scene = varied_scene();
    scene.shutter = still(scene);
    const auto path = [](const glm::mat4& from, const glm::mat4& by) {
        return motion_keys({from, by * from});
    };
    const auto turn = [](float angle) {
        return glm::rotate(glm::mat4(1), angle, glm::normalize(glm::vec3(1, 2, 0.5f)));
    };
    auto& instances = scene.shutter->instances;
    instances[FLOOR] = path(scene.instances[FLOOR].object_to_world, moved({0, 0.15f, 0}));
    instances[FIRST_TILE] = path(scene.instances[FIRST_TILE].object_to_world, turn(0.8f));
    instances[SECOND_TILE] = path(scene.instances[SECOND_TILE].object_to_world,
                                  glm::scale(moved({0.3f, 0, 0.1f}), glm::vec3(1.4f, 1, 0.8f)));
    scene.shutter->shapes[0] = path(scene.shapes[0].object_to_world, moved({0.3f, 0.2f, 0}));
    scene.shutter->cameras[0] = path(scene.cameras[0].camera_to_world, turn(0.03f));
    return scene;
}

} // namespace

TEST_CASE("a moving rectangle covers each pixel for as long as the closed form says") {
    Scene scene = rectangle({-5.3f, -4}, {-2.6f, 4});
    for (const float way : {0.4f, 6.5f}) {
        scene.shutter = still(scene);
        scene.shutter->instances[0] = motion_keys({glm::mat4(1), moved({way, 0, 0})});
        REQUIRE(scene.shutter->instances[0].size() == 2);
        check_row(picture_of(scene, 4096), -5.3, -2.6, way);
    }
}

TEST_CASE("a moving camera sees what stands still as a still one sees it move the other way") {
    Scene scene = rectangle({1.3f, -4}, {4.1f, 4});
    scene.shutter = still(scene);
    const glm::mat4& place = scene.cameras[0].camera_to_world;
    scene.shutter->cameras[0] = motion_keys({place, moved({5.5f, 0, 0}) * place});
    check_row(picture_of(scene, 4096), 1.3, 4.1, -5.5);
    scene.shutter->instances[0] = motion_keys({glm::mat4(1), moved({5.5f, 0, 0})});
    check_row(picture_of(scene, 1024), 1.3, 4.1, 0); // both go together
}

TEST_CASE("turns are the mean of many still pictures") {
    // Of a rectangle that makes three quarters of a turn about its corner, and grows.
    Scene scene = rectangle({0, 0}, {6.5f, 2.5f});
    const auto place = [](double share) {
        const glm::mat4 turned = glm::rotate(glm::mat4(1), float(share * 4.7), glm::vec3(0, 0, 1));
        return glm::scale(turned, glm::vec3(1));
    };
    std::vector<glm::mat4> places;
    for (int i = 0; i <= 8; i++) places.push_back(place(i / 8.0));
    scene.shutter = still(scene);
    scene.shutter->instances[0] = motion_keys(places);
    const Image blurred = picture_of(scene, 4096);

    constexpr int STILLS = 256;
    scene.shutter.reset();
    std::vector<double> mean(blurred.pixels.size());
    SessionOptions options{.render = small_options(SIZE, SIZE, 16), .choose_layout = false};
    Session session(programs(), scene, options);
    for (int i = 0; i < STILLS; i++) {
        session.set_instance_transform(0, place((i + 0.5) / STILLS));
        const std::vector<float> pixels = rendered(session);
        for (size_t k = 0; k < mean.size(); k++) mean[k] += pixels[k] / double(STILLS);
    }
    // Both are stratified; without, 4 sigma of 4096 samples were 0.03.
    double worst = 0, light = 0, expected = 0;
    for (size_t k = 0; k < mean.size(); k++) {
        worst = std::max(worst, std::abs(mean[k] - blurred.pixels[k]));
        light += blurred.pixels[k];
        expected += mean[k];
    }
    CHECK(worst < 0.015);
    CHECK(light == Approx(expected).epsilon(1e-3));
}

TEST_CASE("every layout, and a tree that was refitted, blurs with the same bits") {
    Scene scene = moving_scene();
    SessionOptions options = small_session();
    options.features.reset();
    options.choose_layout = false;
    const std::vector<float> wide = fresh_picture(scene, options);
    for (const BvhLayout layout : {BvhLayout::binary, BvhLayout::compressed}) {
        options.bvh.layout = layout;
        INFO(word_of(layout));
        CHECK(fresh_picture(scene, options) == wide);
    }
}

TEST_CASE("every engine, width and launch blurs with the same bits, and lets rays pass by alpha") {
    Scene scene = moving_scene();
    for (const size_t material : {WHITE, RED}) {
        scene.materials[material].alpha_mode = AlphaMode::blend;
        scene.materials[material].alpha = 0.6f;
    }
    check_same_bits(scene, small_options(32, 24, 4));
}

TEST_CASE("light tracing expects the path tracer's blur") {
    Scene scene = moving_scene();
    RenderOptions options = small_options(48, 40, 64);
    options.depth = 3;
    check_paths_agree(scene, options, 0.02);
}

TEST_CASE("every engine traces light in time with the same bits") {
    const Scene scene = moving_scene();
    RenderOptions options = small_options(32, 24, 4);
    options.integrator = IntegratorKind::light;
    options.depth = 4;
    check_same_bits(scene, options);
}

TEST_CASE("motion vectors are those of the frame, however long the shutter is open") {
    Scene scene = rectangle({-6, -6}, {6, 6});
    scene.next = standing_still(scene);
    scene.next->instances[0].object_to_world = moved({2, 1, 0});
    scene.shutter = still(scene);
    scene.shutter->instances[0] = motion_keys({glm::mat4(1), moved({1, 0.5f, 0})});
    RenderOptions options = small_options(SIZE, SIZE, 64);
    options.aovs = 1u << AOV_MOTION;
    Session session(programs(), scene, {.render = options, .choose_layout = false});
    session.render();
    const Image motion = session.film().develop(*find_channel("motion"));
    CHECK(motion.pixel(8, 8)[0] == Approx(2).margin(1e-4));
    CHECK(motion.pixel(8, 8)[1] == Approx(1).margin(1e-4));
    CHECK(motion.pixel(0, 0)[0] == 0);
}

TEST_CASE("depth is along the axis of a camera that turns") {
    Scene scene = rectangle({-40, -40}, {40, 40});
    scene.cameras = {camera_at({0, 0, 5}, {0, 0, 0}, 0.5f)};
    scene.shutter = still(scene);
    const glm::mat4& place = scene.cameras[0].camera_to_world;
    scene.shutter->cameras[0] = motion_keys({place, glm::rotate(place, 0.4f, glm::vec3(0, 1, 0))});
    RenderOptions options = small_options(SIZE, SIZE, 1024);
    options.aovs = 1u << AOV_DEPTH;
    Session session(programs(), scene, {.render = options, .choose_layout = false});
    session.render();
    // In the middle: 5 over the cosine of the turn, in the mean over it.
    const double expected = 5 * std::log(std::tan(0.4) + 1 / std::cos(0.4)) / 0.4;
    const Image depth = session.film().develop(*find_channel("depth"));
    const double middle = 0.25 * (depth.pixel(7, 7)[0] + depth.pixel(8, 7)[0] +
                                  depth.pixel(7, 8)[0] + depth.pixel(8, 8)[0]);
    CHECK(middle == Approx(expected).epsilon(3e-3));
}

TEST_CASE("integrators that know no time show what moves as the shutter opens, and say so") {
    const Scene scene = moving_scene();
    Scene before = scene;
    before.shutter.reset();
    SessionOptions options = small_session(IntegratorKind::whitted, 1);
    // What does not move is baked, so that the last bits differ.
    const std::vector<float> a = fresh_picture(scene, options), b = fresh_picture(before, options);
    double off = 0;
    for (size_t i = 0; i < a.size(); i++) off += std::abs(a[i] - b[i]) / double(a.size());
    CHECK(off < 1e-3);
    const auto notes = mapping_notes(scene, IntegratorKind::whitted);
    CHECK(std::ranges::count(notes,
                             "What moves is as the shutter opens: --integrator whitted blurs "
                             "nothing.") == 1);
}

TEST_CASE("what is edited stands still, and a session may change to paths and back") {
    Scene scene = moving_scene();
    SessionOptions options = small_session();
    Session session(programs(), scene, options);
    session.render();
    session.set_instance_transform(FIRST_TILE, moved({-1, 0.5f, 0}));
    session.set_shape_transform(0, moved({0, 1.2f, 0}));
    session.set_camera(scene.cameras[0]);
    scene.instances[FIRST_TILE].object_to_world = moved({-1, 0.5f, 0});
    scene.shapes[0].object_to_world = moved({0, 1.2f, 0});
    scene.shutter->instances[FIRST_TILE].clear();
    scene.shutter->shapes[0].clear();
    scene.shutter->cameras[0].clear();
    CHECK(rendered(session) == fresh_picture(scene, options));
    RenderOptions whitted = session.options();
    const RenderOptions paths = whitted;
    whitted.integrator = IntegratorKind::whitted;
    session.set_options(whitted);
    session.render();
    session.set_options(paths);
    CHECK(rendered(session) == fresh_picture(scene, options));
}

TEST_CASE("a film goes on with its blur, but not with another") {
    Scene scene = moving_scene();
    SessionOptions options = small_session(IntegratorKind::path, 80);
    const std::vector<float> whole = fresh_picture(scene, options);
    SessionOptions shorter = options;
    shorter.render.samples = 16;
    Session begun(programs(), scene, shorter);
    begun.render();
    Session continued(programs(), scene, options);
    continued.restore_film(begun.keep_film());
    CHECK(rendered(continued) == whole);
    scene.shutter->shapes[0].clear();
    Session other(programs(), scene, options);
    CHECK_THROWS_WITH(other.restore_film(begun.keep_film()), Catch::Contains("another scene"));
}

} // namespace onde::test
