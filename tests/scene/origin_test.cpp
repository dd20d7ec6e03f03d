// Scenes that lie far from 0 load as the same scenes near it do, only elsewhere.
#include "gltf_builder.h"
#include "scene/origin.h"

using namespace onde;
using namespace onde::test;

namespace {

constexpr glm::dvec3 FAR(-3761603.75, 9105279.125, 3870314.6875);

/// All points of a scene in its file's coordinates, in a fixed order.
std::vector<glm::dvec3> points_of(const Scene& scene) {
    std::vector<glm::dvec3> points;
    const auto add = [&](const glm::vec3& p) { points.push_back(scene.origin + glm::dvec3(p)); };
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const glm::uvec3& triangle : mesh.triangles)
            for (const uint32_t v : {triangle.x, triangle.y, triangle.z})
                add(glm::vec3(instance.object_to_world * glm::vec4(mesh.positions[v], 1.0f)));
    }
    for (const Sphere& sphere : scene.spheres) add(sphere.center);
    for (const Shape& shape : scene.shapes) add(glm::vec3(shape.object_to_world[3]));
    for (const PointLight& light : scene.point_lights) add(light.position);
    for (const SpotLight& light : scene.spot_lights) add(light.position);
    for (const AreaLight& light : scene.chapter.area_lights) add(light.position);
    for (const Camera& camera : scene.cameras)
        if (camera.name != "framed") add(glm::vec3(camera.camera_to_world[3]));
    if (scene.environment.ground) add(glm::vec3(0, *scene.environment.ground, 0));
    return points;
}

void check_moved(const Scene& near, const Scene& far, const glm::dvec3& step) {
    CHECK(near.origin == glm::dvec3(0));
    CHECK(far.origin != glm::dvec3(0));
    const std::vector<glm::dvec3> a = points_of(near), b = points_of(far);
    REQUIRE(a.size() == b.size());
    REQUIRE(a.size() > 2);
    double worst = 0;
    for (size_t i = 0; i < a.size(); i++) {
        const bool ground = i + 1 == a.size() && near.environment.ground;
        const glm::dvec3 off = b[i] - a[i] - step;
        worst = std::max(worst, ground ? std::abs(off.y) : glm::length(off));
    }
    CHECK(worst < 1e-6);
    CHECK(far.meshes.size() == near.meshes.size());
    CHECK(far.materials.size() == near.materials.size());
    CHECK(std::ranges::any_of(far.notes, [](const std::string& note) {
        return note.find("it was moved by (") != std::string::npos;
    }));
}

/// Loads the file with every POINT(x, y, z) of its text in place of a point moved by `step`, in the
/// separators of the format.
Scene loaded(const std::string& name, std::string text, const glm::dvec3& step,
             const char* between = " ", const ScratchFolder& folder = {}) {
    for (size_t at; (at = text.find("POINT(")) != std::string::npos;) {
        double x = 0, y = 0, z = 0;
        REQUIRE(std::sscanf(text.c_str() + at, "POINT(%lf, %lf, %lf)", &x, &y, &z) == 3);
        const std::string moved = fmt::format("{:.9f}{}{:.9f}{}{:.9f}", x + step.x, between,
                                              y + step.y, between, z + step.z);
        text.replace(at, text.find(')', at) + 1 - at, moved);
    }
    LoadOptions options;
    options.ground = GroundPlane::off;
    if (name.ends_with(".toml")) options.ground = GroundPlane::automatic;
    return load_scene(folder.write(name, text), options);
}

void check_text(const std::string& name, const std::string& text, const char* between = " ") {
    check_moved(loaded(name, text, glm::dvec3(0), between), loaded(name, text, FAR, between), FAR);
}

const std::string OBJ = "v POINT(0, 0, 0)\nv POINT(1, 0, 0)\nv POINT(1, 1, 0.25)\n"
                        "v POINT(0, 1, 0)\nv POINT(0.5, 2, 0)\nv 7 7 7\nvn 0 0 1\n"
                        "f 1//1 2//1 3//1 4//1\nf 3 4 5\n";

} // namespace

TEST_CASE("only what lies far out for its size has an origin of its own") {
    const auto box = [](glm::dvec3 middle, double half) {
        return Extent{middle - glm::dvec3(half), middle + glm::dvec3(half)};
    };
    CHECK(origin_of(Extent{}) == glm::dvec3(0));
    CHECK(origin_of(box({0, 0, 0}, 1)) == glm::dvec3(0));
    CHECK(origin_of(box({0, 50, 0}, 1)) == glm::dvec3(0));
    CHECK(origin_of(box({0, 60, 0.7}, 1)) == glm::dvec3(0, 60, 0)); // multiples of two
    CHECK(origin_of(box({1e7, 0, 0}, 1e6)) == glm::dvec3(0));
    CHECK(origin_of(box({3, 0, 0}, 0)) == glm::dvec3(3, 0, 0));
    SceneExtent scene;
    scene.add(box({0, 500, 0}, 50));
    CHECK(origin_of(scene) == glm::dvec3(0));
    scene.add(box({0, 500, 0}, 0.1)); // a small thing on a large ground
    CHECK(origin_of(scene) == glm::dvec3(0, 512, 0));
    CHECK(origin_of(box({1e308, 1e308, 0}, 1)) == glm::dvec3(0));
}

TEST_CASE("OBJ, PLY and STL files in map coordinates keep their digits") {
    SECTION("obj") {
        check_text("a.obj", OBJ);
    }
    SECTION("ply") {
        check_text("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty "
                            "double y\nproperty double z\nelement face 1\nproperty list uchar int "
                            "vertex_indices\nend_header\nPOINT(0, 0, 0)\nPOINT(1, 0, 0)\n"
                            "POINT(1, 1, 0)\n9 9 9\n3 0 1 2\n");
    }
    SECTION("stl") {
        check_text("a.stl",
                   "solid a\nfacet normal 0 0 1\nouter loop\nvertex POINT(0, 0, 0)\nvertex "
                   "POINT(1, 0, 0)\nvertex POINT(1, 1, 0)\nendloop\nendfacet\nendsolid a\n");
    }
}

TEST_CASE("stray triangles without area do not keep a scene where it is") {
    const Scene obj = loaded("a.obj", OBJ + "f 6 6 6\n", FAR);
    CHECK(glm::distance(obj.origin, FAR) < 10.0);

    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {9, 9, 9}, {10, 9, 9}, {9, 10, 9}};
    mesh.triangles = {{1, 2, 3}, {0, 0, 1}, {0, 0, 0}};
    CHECK(extent_of(mesh).low == glm::dvec3(9));
}

TEST_CASE("nodes of a glTF file that stand far out keep their digits") {
    Builder builder = triangle();
    builder.add<uint8_t>(5121, "VEC4", 4, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
    builder.floats(4, {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0});
    builder.floats(3, {0, 0, 0, 0, 2, 0.125f});
    builder.floats(1, {0, 1});
    builder.floats(3, {0, 0, 0, 1, 0, 0});
    builder.floats(3, {0, 0, 0, 0.1f, 0, 0, 0, 0, 0});
    const std::string assets = R"("extensionsUsed": ["KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}, {"type": "spot"}]}},
      "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]},
                 {"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]},
                 {"weights": [1], "primitives": [{"attributes": {"POSITION": 0},
                  "targets": [{"POSITION": 6}]}]}],
      "skins": [{"joints": [2, 3]}], "scenes": [{"nodes": [0]}], "scene": 0,
      "animations": [{"samplers": [{"input": 4, "output": 5}],
                      "channels": [{"sampler": 0, "target": {"node": 4, "path": "translation"}}]}],
      )";
    const auto load = [&](const glm::dvec3& step) {
        LoadOptions options;
        options.at = 0.3;
        return builder.load(assets + fmt::format(R"("nodes": [
                {{"children": [1, 2, 4, 5, 6, 7, 8], "translation": [{:.9f}, {:.9f}, {:.9f}]}},
                {{"mesh": 0, "rotation": [0, 0.6, 0, 0.8], "translation": [0.1, 0, 0]}},
                {{"translation": [1.7, 0, 0], "children": [3]}}, {{"translation": [0, 0.3, 0]}},
                {{"mesh": 2, "scale": [2, 0.3, 1]}}, {{"mesh": 1, "skin": 0}},
                {{"mesh": 0, "extensions": {{"EXT_mesh_gpu_instancing": {{"attributes":
                  {{"TRANSLATION": 3}}}}}}}},
                {{"camera": 0, "translation": [0, 0.1, 5]}},
                {{"translation": [0.1, 3, 0], "extensions": {{"KHR_lights_punctual":
                  {{"light": 0}}}}, "children": [9]}},
                {{"extensions": {{"KHR_lights_punctual": {{"light": 1}}}}}}])",
                                                 step.x, step.y, step.z),
                            options);
    };
    check_moved(load(glm::dvec3(0)), load(FAR), FAR);
}

TEST_CASE("meshes that are far out in their own coordinates, which a node takes back, are near") {
    const auto load = [](float far) {
        Builder builder;
        builder.floats(3, {far, 0, 0, far + 1, 0, 0, far, 1, 0});
        return builder.load(fmt::format(
            R"("meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}], "nodes": [
              {{"mesh": 0, "rotation": [0, 0.6, 0, 0.8], "translation": [{}, 0, {}]}}])",
            -0.28 * double(far), 0.96 * double(far)));
    };
    const Scene near = load(0), far = load(4e6f);
    CHECK(far.origin == glm::dvec3(0));
    const std::vector<glm::dvec3> a = points_of(near), b = points_of(far);
    for (size_t i = 0; i < 3; i++) CHECK(glm::length(a[i] - b[i]) < 1e-6);
    CHECK(std::abs(far.meshes[0].positions[1].x) < 10.0f);
}

TEST_CASE("a scene file has far coordinates of its own, and takes in files that do") {
    ScratchFolder near, far;
    for (const bool moved : {false, true}) {
        const ScratchFolder& folder = moved ? far : near;
        const glm::dvec3 step = moved ? FAR : glm::dvec3(0);
        loaded("a.obj", OBJ, step, " ", folder);
        loaded("inner.toml",
               "[[shape]]\ntype = \"sphere\"\ncenter = [POINT(2, 3.1, 4)]\n[[shape]]\ntype = "
               "\"mesh\"\nfile = \"a.obj\"\n[environment]\nradiance = 1\n",
               step, ", ", folder);
    }
    const std::string own = R"(
[camera]
position = [POINT(0.2, 0.1, 0.3)]
look_at = [POINT(0.21, 0.1, 0.3)]
[[light]]
type = "point"
position = [POINT(0, 3, 0)]
intensity = 1
[[light]]
type = "spot"
position = [POINT(0, 3.3, 0)]
direction = [0, -1, 0]
[[light]]
type = "sphere"
center = [POINT(0, 4.3, 0)]
radius = 0.1
radiance = 1
[[light]]
type = "rectangle"
corner = [POINT(0, 5, 0)]
edge1 = [1, 0, 0]
edge2 = [0, 0, 0.3]
radiance = 3
[[light]]
type = "disk"
position = [POINT(0, 5.1, 0)]
radiance = 3
[[shape]]
type = "box"
rotation = [0, 30, 0]
position = [POINT(3.3, 0, 1)]
[[shape]]
type = "cone"
position = [POINT(3.3, 0, 1)]
[[shape]]
type = "mesh"
positions = [[POINT(0, 0, 0)], [POINT(1, 0, 0)], [POINT(0, 0.1, 0)]]
triangles = [[0, 1, 2]]
)";
    const auto load = [&](bool moved, const std::string& text) {
        return loaded("own.toml", text, moved ? FAR : glm::dvec3(0), ", ", moved ? far : near);
    };
    SECTION("all its own") {
        const std::string text = own + "[environment]\nradiance = 1\nground = 0.5\n";
        std::string moved = text;
        moved.replace(moved.rfind("0.5"), 3, fmt::format("{:.9f}", 0.5 + FAR.y));
        check_moved(load(false, text), load(true, moved), FAR);
    }
    SECTION("a file in the same coordinates") {
        const std::string text = own + "[[shape]]\ntype = \"mesh\"\nfile = \"a.obj\"\n";
        check_moved(load(false, text), load(true, text), FAR);
    }
    SECTION("a scene in the same coordinates") {
        const std::string text = "include = [\"inner.toml\"]\n" + own;
        check_moved(load(false, text), load(true, text), FAR);
        CHECK(load(true, text).environment.radiance == glm::vec3(1));
    }
    SECTION("a scene, turned and scaled") {
        const std::string text = "[[include]]\nfile = \"inner.toml\"\nrotation = [-90, 0, 0]\n"
                                 "scale = 0.001\nposition = [0.001, 0, 0.002]\n";
        const glm::dvec3 step = 0.001 * glm::dvec3(FAR.x, FAR.z, -FAR.y);
        check_moved(load(false, text), load(true, text), step);
    }
    SECTION("a file that is taken back to 0") {
        const auto text = [](const glm::dvec3& step) {
            return fmt::format("[[shape]]\ntype = \"mesh\"\nfile = \"a.obj\"\nrotation = [0, 90, "
                               "0]\nposition = [{:.9f}, {:.9f}, {:.9f}]\n",
                               -step.z, -step.y, step.x);
        };
        const Scene a = load(false, text(glm::dvec3(0))), b = load(true, text(FAR));
        CHECK(b.origin == glm::dvec3(0));
        for (size_t i = 0; i < 4; i++)
            CHECK(glm::length(points_of(a).at(i) - points_of(b).at(i)) < 1e-6);
    }
}

namespace {

bool says_torn(const Scene& scene) {
    return std::ranges::any_of(scene.notes, [](const std::string& note) {
        return note.find("loses its shape") != std::string::npos;
    });
}

} // namespace

TEST_CASE("what is stray or huge does not keep a far model's digits from it") {
    const auto model = [](const std::string& more) {
        return loaded("a.toml",
                      "[[camera]]\nposition = [POINT(4, 2, 4)]\nlook_at = [POINT(0, 0, 0)]\n" +
                          more + "[[shape]]\ntype = \"box\"\nposition = [POINT(0, 0, 0)]\n",
                      FAR, ", ");
    };
    for (const char* more :
         {"[[shape]]\ntype = \"sphere\"\n", "[[shape]]\ntype = \"plane\"\nsize = 1e8\n",
          "[[shape]]\ntype = \"sphere\"\nradius = 2e8\n",
          "[[shape]]\ntype = \"sphere\"\n[[shape]]\ntype = \"plane\"\nsize = 1e8\n"}) {
        INFO(more);
        const Scene scene = model(more);
        CHECK(glm::distance(scene.origin, FAR) < 10.0);
        CHECK(says_torn(scene) == (std::string(more).find("\"sphere\"\n[[") != std::string::npos ||
                                   std::string(more).ends_with("\"sphere\"\n")));
    }
    CHECK_FALSE(says_torn(loaded("a.obj", OBJ, FAR)));
    CHECK_FALSE(says_torn(loaded("a.obj", OBJ, glm::dvec3(0))));
}

TEST_CASE("a few stray triangles do not keep a mesh in map coordinates from its digits") {
    const Scene scene = loaded("a.obj", OBJ + "v 8 7 7\nv 7 8 7\nf 6 7 8\n", FAR);
    CHECK(glm::distance(scene.origin, FAR) < 10.0);
    CHECK(says_torn(scene));
}
