#include "scratch.h"

#include <cmath>
#include <limits>

using namespace onde;

namespace {

Scene one_sphere(glm::vec3 center = glm::vec3(0), float radius = 1) {
    Scene scene;
    scene.materials.emplace_back();
    scene.spheres.push_back({center, radius, 0});
    return scene;
}

Scene one_triangle() {
    Scene scene;
    scene.materials.emplace_back();
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.materials = {0};
    scene.instances.emplace_back();
    return scene;
}

/// The largest share of half the picture's width and height that points of a unit sphere about
/// `center`, `radius` times as large, reach.
glm::vec2 filled_share(const Camera& camera, glm::vec3 center, float radius, glm::vec2 size) {
    const glm::mat4 to_camera = glm::inverse(camera.camera_to_world);
    const float tangent = std::tan(0.5f * camera.vertical_fov);
    glm::vec2 share(0);
    for (int i = 0; i < 20000; ++i) {
        const float y = (float(i) + 0.5f) / 10000 - 1, turn = 2.39996323f * float(i);
        const float ring = std::sqrt(1 - y * y);
        const glm::vec3 point =
            center + radius * glm::vec3(ring * std::cos(turn), y, ring * std::sin(turn));
        const glm::vec3 seen(to_camera * glm::vec4(point, 1.0f));
        const glm::vec2 tangents(tangent * size.x / size.y, tangent);
        share = glm::max(share, glm::abs(glm::vec2(seen) / -seen.z) / tangents);
    }
    return share;
}

} // namespace

TEST_CASE("the framing camera fills most of the picture's tighter side, whatever its shape") {
    for (const auto& [center, radius] :
         {std::pair(glm::vec3(0), 1.0f), std::pair(glm::vec3(300, -20, 5), 0.01f),
          std::pair(glm::vec3(0, 0, -9), 1e4f)})
        for (const glm::uvec2 size : {glm::uvec2(800, 600), glm::uvec2(64, 128)}) {
            Scene scene = one_sphere(center, radius);
            complete_scene(scene, {.size = size});
            REQUIRE(scene.cameras.size() == 1);
            const Camera& camera = scene.cameras[0];
            const glm::vec2 share = filled_share(camera, center, radius, glm::vec2(size));
            INFO(share.x << " of the width, " << share.y << " of the height");
            CHECK(std::max(share.x, share.y) > 0.87f);
            CHECK(std::max(share.x, share.y) < 0.9f);
            const glm::vec3 eye(camera.camera_to_world[3]);
            CHECK(eye.z > center.z); // from the front, above and to the side
            CHECK(eye.y > center.y);
            CHECK(eye.x > center.x);
            CHECK_NOTHROW(check_scene(scene));
        }
}

TEST_CASE("the size that is asked for frames a model, else the file's own") {
    Scene own = one_sphere(), asked = one_sphere(), wide = one_sphere();
    own.settings.width = asked.settings.width = 100;
    own.settings.height = asked.settings.height = 300;
    complete_scene(own);
    complete_scene(asked, {.size = glm::uvec2(300, 100)});
    complete_scene(wide);
    CHECK(own.cameras[0].focus_distance > 2.0f * wide.cameras[0].focus_distance);
    CHECK(asked.cameras[0].focus_distance == Approx(wide.cameras[0].focus_distance));
}

TEST_CASE("a dark scene gets a studio whose key light comes from the upper left") {
    Scene scene = one_sphere();
    complete_scene(scene);
    REQUIRE(scene.environment.map);
    CHECK(scene.notes.size() == 2);
    const Image& map = *scene.environment.map;
    uint32_t brightest_x = 0, brightest_y = 0;
    for (uint32_t y = 0; y < map.height; ++y)
        for (uint32_t x = 0; x < map.width; ++x)
            if (map.pixel(x, y)[0] > map.pixel(brightest_x, brightest_y)[0])
                brightest_x = x, brightest_y = y;
    CHECK(brightest_y < map.height / 2);
    // Column 0 and the last are +Z, behind the camera; the left half is -X.
    CHECK(brightest_x < map.width / 4);
}

TEST_CASE("a scene with any light of its own gets no studio") {
    Scene point = one_sphere(), emissive = one_triangle(), sky = one_sphere();
    point.point_lights.emplace_back();
    emissive.materials[0].emission = glm::vec3(0, 1, 0);
    sky.environment.radiance = glm::vec3(0.1f, 0, 0);
    for (Scene* scene : {&point, &emissive, &sky}) {
        complete_scene(*scene);
        CHECK_FALSE(scene->environment.map);
        CHECK(scene->notes.size() == 1); // of the camera
    }
}

TEST_CASE("a model stands in the studio, whatever else lights it and whoever looks") {
    Scene lit = one_sphere(), dark = one_sphere(), own_sky = one_sphere(),
          own_camera = one_sphere();
    for (Scene* scene : {&lit, &dark, &own_sky, &own_camera}) scene->point_lights.emplace_back();
    own_sky.environment.radiance = glm::vec3(0.1f);
    own_camera.cameras.emplace_back();
    complete_scene(lit, {}, true);
    complete_scene(dark, {.studio = Studio::off}, true);
    complete_scene(own_sky, {}, true);
    complete_scene(own_camera, {}, true);
    CHECK(lit.environment.map);
    CHECK_FALSE(dark.environment.map);
    CHECK_FALSE(own_sky.environment.map);
    CHECK(own_camera.environment.map);
    Scene toml = one_sphere();
    toml.point_lights.emplace_back();
    complete_scene(toml, {.studio = Studio::on});
    CHECK(toml.environment.map);
}

TEST_CASE("a model without a camera stands on a ground just below it") {
    Scene framed = one_sphere(), own_camera = one_sphere(), toml = one_sphere();
    const float lowest = scene_bounds(framed).low.y;
    own_camera.cameras.emplace_back();
    complete_scene(framed, {}, true);
    complete_scene(own_camera, {}, true);
    complete_scene(toml);
    REQUIRE(framed.environment.ground);
    CHECK(*framed.environment.ground < lowest);
    CHECK(*framed.environment.ground > lowest - 0.01f);
    CHECK_FALSE(own_camera.environment.ground);
    CHECK_FALSE(toml.environment.ground);
    CHECK_THAT(framed.notes.back(), Catch::Contains("A ground was added"));
    const size_t notes = own_camera.notes.size();
    complete_scene(own_camera, {.ground = GroundPlane::on}, true);
    CHECK(own_camera.environment.ground == framed.environment.ground);
    CHECK(own_camera.notes.size() == notes); // it was asked for
    framed.cameras.clear();
    complete_scene(framed, {.ground = GroundPlane::off}, true);
    CHECK_FALSE(framed.environment.ground);
    toml.environment.ground = -7.0f; // the file's own
    complete_scene(toml, {.ground = GroundPlane::on});
    CHECK(toml.environment.ground == -7.0f);
}

TEST_CASE("an environment that is given replaces the file's own before a studio is added") {
    const test::ScratchFolder folder;
    const auto path = folder.write("a.toml", "[[shape]]\ntype = \"sphere\"\n");
    CHECK(load_scene(path).notes.size() == 2); // of the camera and the studio
    const Scene lit =
        load_scene(path, {.environment = Environment{.radiance = glm::vec3(0.25f), .map = {}}});
    CHECK(lit.environment.radiance == glm::vec3(0.25f));
    CHECK(lit.notes.size() == 1);
    const Scene dark = load_scene(path, {.environment = Environment{}});
    CHECK(dark.environment.map);
}

TEST_CASE("small glowing details of a texture don't light a scene, a glowing texture does") {
    for (const bool bright : {false, true}) {
        Scene scene = one_triangle();
        Texture texture;
        texture.image = {64, 64, std::vector<uint8_t>(64 * 64 * 4, bright ? 255 : 0)};
        texture.image.rgba[0] = 255;
        scene.textures.push_back(texture);
        scene.materials[0].emission = glm::vec3(1);
        scene.materials[0].emission_texture = 0;
        complete_scene(scene);
        CHECK(scene.environment.map.has_value() == !bright);
    }
}

TEST_CASE("bounds enclose rotated instances and spheres, and nothing has none") {
    Scene scene = one_triangle();
    scene.instances[0].object_to_world[3] = glm::vec4(0, 5, 0, 1);
    scene.spheres.push_back({glm::vec3(0, 0, -3), 0.5f, 0});
    const SceneBounds bounds = scene_bounds(scene);
    CHECK(bounds.low == glm::vec3(-0.5f, -0.5f, -3.5f));
    CHECK(bounds.high == glm::vec3(1, 6, 0));
    CHECK(scene_bounds(Scene{}).low == glm::vec3(0));
    CHECK(scene_bounds(Scene{}).high == glm::vec3(0));
}

TEST_CASE("the scene hash follows what can change a pixel and nothing else") {
    const Scene scene = one_triangle();
    const std::string hash = scene_hash(scene);
    CHECK(hash.size() == 16);
    CHECK(scene_hash(one_triangle()) == hash);
    Scene same = scene;
    same.materials[0].name = "renamed";
    same.notes.push_back("A note.");
    same.settings.samples = 3;
    CHECK(scene_hash(same) == hash);
    std::vector<Scene> others(10, scene);
    others[0].meshes[0].positions[0].x = 1e-20f;
    others[1].materials[0].roughness = 0.5f;
    others[2].instances[0].object_to_world[3].x = 1;
    others[3].spheres.push_back({});
    others[4].environment.radiance.x = 1;
    others[5].cameras.emplace_back();
    others[6].point_lights.emplace_back();
    others[7].materials[0].two_sided = false;
    others[8].environment.map = Image(1, 1, 3);
    others[9].chapter.whitted.epsilon = 0.5f;
    for (size_t i = 0; i < others.size(); ++i) {
        INFO("change " << i);
        CHECK(scene_hash(others[i]) != hash);
    }
}

TEST_CASE("a camera's screen can't be taken for the camera after it") {
    // Of zeros alone, so that only the marks of what is there tell the two scenes apart.
    Camera zeros;
    zeros.camera_to_world = glm::mat4(0.0f);
    zeros.vertical_fov = zeros.focus_distance = 0;
    Camera with_screen = zeros;
    with_screen.screen = ScreenWindow{.size = glm::vec2(0), .distance = 0, .first_pixel = {}};
    Scene one = one_triangle(), other = one_triangle();
    one.cameras = {with_screen, zeros};
    other.cameras = {zeros, with_screen};
    CHECK(scene_hash(one) != scene_hash(other));
}

TEST_CASE("the check refuses every broken rule of a scene") {
    CHECK_NOTHROW(check_scene(one_triangle()));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    struct Case {
        std::string culprit;
        void (*spoil)(Scene&, float);
    };
    const Case cases[] = {
        {"empty", [](Scene& s, float) { s.instances.clear(); }},
        {"instance 0", [](Scene& s, float) { s.instances[0].mesh = 1; }},
        {"instance 0", [](Scene& s, float) { s.instances[0].object_to_world[2][2] = 0; }},
        {"instance 0", [](Scene& s, float) { s.instances[0].object_to_world[0][3] = 1; }},
        {"instance 0", [](Scene& s, float n) { s.instances[0].object_to_world[3][0] = n; }},
        {"mesh 0", [](Scene& s, float) { s.meshes[0].triangles[0].z = 3; }},
        {"mesh 0", [](Scene& s, float) { s.meshes[0].materials[0] = 1; }},
        {"mesh 0", [](Scene& s, float) { s.meshes[0].materials.clear(); }},
        {"mesh 0", [](Scene& s, float n) { s.meshes[0].positions[2].z = n; }},
        {"mesh 0", [](Scene& s, float) { s.meshes[0].normals.resize(3, glm::vec3(0, 0, 2)); }},
        {"mesh 0", [](Scene& s, float) { s.meshes[0].uvs.resize(2); }},
        {"material 0", [](Scene& s, float n) { s.materials[0].roughness = n; }},
        {"material 0", [](Scene& s, float) { s.materials[0].metallic = 1.5f; }},
        {"material 0", [](Scene& s, float) { s.materials[0].base_color.y = -0.1f; }},
        {"material 0", [](Scene& s, float) { s.materials[0].ior = 0; }},
        {"material 0", [](Scene& s, float) { s.materials[0].emission.x = -1; }},
        {"material 0", [](Scene& s, float) { s.materials[0].normal_texture = 0; }},
        {"texture 0", [](Scene& s, float) { s.textures.emplace_back(); }},
        {"sphere 0",
         [](Scene& s, float) {
             s.spheres.push_back({glm::vec3(0), 0.0f, 0});
         }},
        {"sphere 0",
         [](Scene& s, float) {
             s.spheres.push_back({glm::vec3(0), 1.0f, 9});
         }},
        {"point light 0",
         [](Scene& s, float n) {
             s.point_lights.push_back({glm::vec3(n), {}});
         }},
        {"directional light 0",
         [](Scene& s, float) {
             s.directional_lights.push_back({glm::vec3(0, 2, 0), {}});
         }},
        {"environment", [](Scene& s, float) { s.environment.map = Image(2, 2, 4); }},
        {"environment", [](Scene& s, float n) { s.environment.radiance.z = n; }},
        {"camera 0", [](Scene& s, float) { s.cameras.emplace_back().vertical_fov = 4; }},
        {"camera 0", [](Scene& s, float) { s.cameras.emplace_back().focus_distance = 0; }},
        {"camera 0", [](Scene& s, float) { s.cameras.emplace_back().camera_to_world *= 2.0f; }},
        {"settings: their width", [](Scene& s, float) { s.settings.width = 0; }},
        {"camera 0: its screen",
         [](Scene& s, float) {
             s.cameras.emplace_back().screen =
                 ScreenWindow{.size = glm::vec2(1, 0), .first_pixel = {}};
         }},
        {"whitted: its wavelengths", [](Scene& s, float) { s.chapter.whitted.wavelengths = 2; }},
        {"material 0: its exponent", [](Scene& s, float) { s.chapter.phong[0].exponent = -1; }},
        {"material 1", [](Scene& s, float) { s.chapter.phong[1] = {}; }},
        {"area light 0: its samples",
         [](Scene& s, float) { s.chapter.area_lights.emplace_back().samples = 0; }},
    };
    for (size_t i = 0; i < std::size(cases); ++i) {
        INFO("case " << i);
        Scene scene = one_triangle();
        cases[i].spoil(scene, nan);
        CHECK_THROWS_WITH(check_scene(scene), Catch::Contains(cases[i].culprit));
    }
}
