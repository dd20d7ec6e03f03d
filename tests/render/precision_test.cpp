// The same scene in other coordinates: far away, huge, tiny, seen from afar, turned often.
#include "render/faceted_ball.h"
#include "render/picture.h"
#include "scene/scratch.h"
#include "support/folders.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace onde::test {
namespace {

/// A case of tests/data/precision.
Scene loaded(const std::string& name) {
    return load_scene(std::filesystem::path(in_project("tests/data")) / "precision" / name);
}

Image picture_of(const Scene& scene, uint32_t samples = 16) {
    return render_scene(scene, small_options(64, 64, samples)).image;
}

double difference(const Image& a, const Image& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); i++) sum += std::pow(a.pixels[i] - b.pixels[i], 2.0);
    return std::sqrt(sum / double(a.pixels.size()));
}

double mean_of(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    return sum / double(image.pixels.size());
}

/// A room corner with a box, a ball, lamps and a model of an OBJ file, all counted from `at`.
Scene map_scene(const glm::dvec3& at) {
    const ScratchFolder folder;
    const auto point = [&](double x, double y, double z, const char* between = ", ") {
        return fmt::format("{:.7f}{}{:.7f}{}{:.7f}", at.x + x, between, at.y + y, between,
                           at.z + z);
    };
    std::string obj;
    for (const double x : {-0.9, -0.2})
        for (const double y : {0.0, 1.1})
            for (const double z : {0.3, 0.9}) obj += "v " + point(x, y, z, " ") + "\n";
    folder.write("box.obj", obj + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\n"
                                  "f 2 6 8 4\n");
    return load_scene(
        folder.write("map.toml", fmt::format(R"(
[camera]
position = [{}]
look_at = [{}]
[[shape]]
type = "plane"
position = [{}]
[[shape]]
type = "mesh"
file = "box.obj"
[[shape]]
type = "sphere"
center = [{}]
radius = 0.5
[[shape]]
type = "cylinder"
radius = 0.3
height = 0.4
position = [{}]
[[light]]
type = "point"
position = [{}]
intensity = 20
[[light]]
type = "rectangle"
corner = [{}]
edge1 = [1, 0, 0]
edge2 = [0, 0, 1]
radiance = 4
[environment]
radiance = 0.2
)",
                                             point(1, 2, 5), point(0, 0.4, 0), point(0, 0, 0),
                                             point(0.6, 0.5, 0), point(0.3, 0.2, 1), point(2, 3, 2),
                                             point(-1, 3, 0))));
}

/// Convex mirrors that reflect a half, in a white world: every pixel is 1 or a half, and a quarter
/// where a ray meets again the surface that it has just left.
Scene mirrors() {
    Scene scene;
    Material mirror;
    mirror.kind = MaterialKind::conductor;
    mirror.base_color = glm::vec3(0.5f);
    mirror.roughness = 0;
    scene.materials = {mirror};
    scene.environment.radiance = glm::vec3(1);
    return scene;
}

/// Stretched, turned and moved away from the origin.
glm::mat4 placement(glm::vec3 at, glm::vec3 scale) {
    glm::mat4 m = glm::translate(glm::mat4(1), at);
    m = glm::rotate(m, 0.7f, glm::normalize(glm::vec3(1, 2, -0.5f)));
    return glm::scale(m, scale);
}

/// Sees a ball of radius 1.5 about `at` from that far away.
Camera watching(glm::vec3 at, float distance, bool parallel) {
    const glm::vec3 from = at + distance * glm::normalize(glm::vec3(0.5f, 0.6f, 0.8f));
    Camera camera = camera_at(from, at, 2 * std::atan(1.5f / distance));
    if (parallel) camera.orthographic_height = 3.0f;
    return camera;
}

Image picture_of_mirrors(const Scene& scene, bool watertight) {
    const RenderOptions options = small_options(96, 96, 4);
    if (!watertight) return render_scene(scene, options).image;
    SessionOptions session_options{.render = options, .choose_layout = false};
    session_options.bvh.watertight = true;
    Session session(programs(), scene, session_options);
    session.render();
    return session.picture();
}

void check_no_ray_meets_its_origin(Scene scene, glm::vec3 at) {
    for (const float distance : {4.0f, 4000.0f})
        for (const bool parallel : {false, true})
            for (const bool watertight : {false, true}) {
                scene.cameras = {watching(at, distance, parallel)};
                const Image image = picture_of_mirrors(scene, watertight);
                size_t dark = 0, seen = 0;
                for (const float value : image.pixels) {
                    dark += value < 0.4999f;
                    seen += value < 0.75f;
                }
                // Where far origins are rounded, a few rays slip between two edges, but for
                // triangles that are watertight. Of central rays a few are lost even then.
                const size_t most = distance < 1000 ? 0
                                    : !watertight   ? 400
                                    : parallel      ? 10000
                                                    : 4000;
                INFO((parallel ? "parallel" : "central")
                     << " rays from " << distance << (watertight ? ", watertight" : ""));
                CHECK(dark <= (most ? image.pixels.size() / most : 0));
                CHECK(seen > 2400);
            }
}

} // namespace

TEST_CASE("a lens focused at infinity shows what one focused far away does") {
    const Image far = picture_of(loaded("foc10000.toml"));
    CHECK(far.pixels[(32 * 64 + 32) * 3] == Approx(0.4).margin(0.02));
    Scene scene = loaded("foc1e+20.toml");
    CHECK(difference(far, picture_of(scene)) < 1e-3);
    scene.cameras[0].focus_distance = 3e38f;
    CHECK(difference(far, picture_of(scene)) < 1e-3);
    scene.cameras[0].aperture_radius = 0;
    const Image pinhole = picture_of(scene);
    scene.cameras[0].focus_distance = 4;
    CHECK(difference(pinhole, picture_of(scene)) < 1e-3);
}

TEST_CASE("a scene of a billion kilometres looks as one of a metre") {
    const Image small = picture_of(loaded("scale-1.toml"));
    const Scene huge = loaded("scale-1e12.toml");
    CHECK(difference(small, picture_of(huge)) < 1e-3);
    REQUIRE_FALSE(huge.notes.empty());
    CHECK(huge.notes[0].find("too large") != std::string::npos);
}

TEST_CASE("a scene that lies far from 0 looks as it does at 0") {
    const Scene near = loaded("far-none.gltf"), far = loaded("far-node-1e6.gltf");
    const Image a = picture_of(near), b = picture_of(far);
    CHECK(difference(a, b) < 2e-3);
    CHECK(mean_of(a) == Approx(mean_of(b)).epsilon(1e-3));
}

TEST_CASE("a scene file in map coordinates looks as it does at 0") {
    const Image near = picture_of(map_scene(glm::dvec3(0)));
    for (const double far : {3e3, 1.7e4, 1e5, 1e7}) {
        const Image moved = picture_of(map_scene({far, -0.3 * far, 0.7 * far}));
        INFO(far << " units away");
        CHECK(difference(near, moved) < 5e-3);
        CHECK(mean_of(moved) == Approx(mean_of(near)).epsilon(1e-3));
    }
}

TEST_CASE("parallel rays from afar show the contact shadows that near ones do") {
    const Image near = picture_of(loaded("camfar-ortho-10.toml"));
    CHECK(difference(near, picture_of(loaded("camfar-ortho-1e4.toml"))) < 0.02);
}

TEST_CASE("parallel rays from very far show what near ones do, and how far away it is") {
    const Scene scene = loaded("camfar-ortho-10.toml");
    RenderOptions options = small_options(64, 64, 16);
    options.aovs = 1u << AOV_DEPTH;
    const auto rendered = [&](double away) {
        Scene moved = scene;
        glm::mat4& m = moved.cameras[0].camera_to_world;
        m[3] += float(away) * m[2];
        Session session(programs(), moved, {.render = options, .choose_layout = false});
        session.render();
        return std::pair(session.picture(), session.film().develop(*find_channel("depth")));
    };
    const auto [near, near_depth] = rendered(0);
    for (const double away : {1e5, 1e7}) {
        const auto [far, far_depth] = rendered(away);
        INFO(away);
        // What floats round of the camera's place moves the picture by a part of 1e-7 of the way.
        if (away < 1e6) CHECK(difference(near, far) < 0.02);
        const size_t middle = 32 * 64 + 32;
        CHECK(far_depth.pixels[middle] - near_depth.pixels[middle] == Approx(away).epsilon(1e-5));
    }
}

TEST_CASE("no ray meets the surface that it has just left") {
    const glm::vec3 at(700, -90, 320);
    SECTION("triangles in the world") {
        Scene scene = mirrors();
        scene.meshes = {faceted_ball(24, 12)};
        scene.instances = {{0, placement(at, {1, 0.3f, 1.4f})}};
        check_no_ray_meets_its_origin(scene, at);
    }
    SECTION("triangles of instances") {
        Scene scene = mirrors();
        scene.meshes = {faceted_ball(48, 24)};
        scene.instances = {{0, placement(at, {1, 0.3f, 1.4f})}, {0, placement(-at, {1, 1, 1})}};
        check_no_ray_meets_its_origin(scene, at);
    }
    SECTION("spheres") {
        Scene scene = mirrors();
        scene.spheres = {{at, 1.2f, 0}};
        check_no_ray_meets_its_origin(scene, at);
    }
    for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::cone})
        SECTION(std::string(word_of(kind))) {
            Scene scene = mirrors();
            scene.shapes = {{kind, 0, 0.25f, placement(at, {1, 0.6f, 0.9f})}};
            check_no_ray_meets_its_origin(scene, at);
        }
}

TEST_CASE("an environment that is turned all the way round is where it was") {
    Scene scene = loaded("scale-1.toml");
    Image map(8, 4, 3);
    for (size_t i = 0; i < map.pixels.size(); i++) map.pixels[i] = float(i % 7) * 0.2f;
    scene.environment.map = map;
    scene.environment.radiance = glm::vec3(1);
    const Image still = picture_of(scene, 4);
    const auto turn = float(2 * std::acos(-1.0));
    for (const float turns : {1.0f, -3.0f}) {
        scene.environment.rotation = turns * turn;
        INFO(turns << " turns");
        CHECK(difference(still, picture_of(scene, 4)) < 2e-3);
    }
}

TEST_CASE("a pinhole far out sees as sharply wherever its focus lies") {
    const auto seen = [](float focus) {
        Scene scene =
            doctor::furnace(doctor::furnace_material(MaterialKind::diffuse, glm::vec3(0.5f), 1));
        constexpr float SCALE = 1e6f;
        scene.spheres[0].radius *= SCALE;
        scene.cameras = {camera_at({0, 0, 4 * SCALE}, {0, 0, 0}, 0.6f)};
        scene.cameras[0].focus_distance = focus;
        return render_scene(scene, small_options(32, 32, 16)).image;
    };
    const Image near = seen(1), far = seen(4e6f);
    double difference = 0;
    for (size_t i = 0; i < near.pixels.size(); i++)
        difference += std::abs(double(near.pixels[i] - far.pixels[i])) / double(near.pixels.size());
    CHECK(difference < 1e-3);
}

} // namespace onde::test
