// What motion leads to: the pose of a glTF file at another moment, thing by thing.
#include "gltf_builder.h"

#include <cmath>

using namespace onde;
using onde::test::Builder;
using onde::test::has_note;
using onde::test::ScratchFolder;
using onde::test::triangle;

namespace {

/// At second 0, with the next frame at second 1.
Scene load_both(const Builder& builder, const std::string& body) {
    ScratchFolder folder;
    const auto path = builder.write(folder, body);
    const LoadOptions options{.at = 0.0};
    Scene scene = load_scene(path, options);
    load_next_frame(scene, path, options, 1.0);
    REQUIRE(scene.next);
    REQUIRE(scene.next->instances.size() == scene.instances.size());
    REQUIRE(scene.next->cameras.size() == scene.cameras.size());
    return scene;
}

glm::dvec3 placed(const Scene& scene, size_t instance, size_t vertex) {
    const Instance& i = scene.instances.at(instance);
    return glm::dvec3(i.object_to_world *
                      glm::vec4(scene.meshes.at(i.mesh).positions.at(vertex), 1.0f));
}

glm::dvec3 next_place(const Scene& scene, size_t instance, size_t vertex) {
    const NextInstance& next = scene.next->instances.at(instance);
    glm::vec3 p = scene.meshes.at(scene.instances.at(instance).mesh).positions.at(vertex);
    if (next.steps) p += scene.next->steps.at(*next.steps).at(vertex);
    return glm::dvec3(next.object_to_world * glm::vec4(p, 1.0f));
}

bool close(const glm::dvec3& a, const glm::dvec3& b, double most = 1e-5) {
    return glm::length(a - b) < most;
}

/// One animation, with a channel for each sampler: of keys at seconds 0 and 1.
std::string animation(const std::string& samplers, const std::string& channels) {
    return R"("animations": [{"samplers": [)" + samplers + R"(], "channels": [)" + channels + "]}]";
}

const std::string MESH = R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])";

} // namespace

TEST_CASE(
    "the next frame has nodes and cameras where the animation puts them, and all else still") {
    Builder builder = triangle();
    builder.floats(1, {0, 1});
    builder.floats(3, {0, 0, 0, 4, 0, 0});
    builder.floats(4, {0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f});
    const Scene scene = load_both(
        builder,
        MESH + R"(, "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
            "nodes": [{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b"},
                      {"camera": 0, "translation": [0, 0, 5]}], )" +
            animation(R"({"input": 1, "output": 2}, {"input": 1, "output": 3})",
                      R"({"sampler": 0, "target": {"node": 0, "path": "translation"}},
                         {"sampler": 1, "target": {"node": 2, "path": "rotation"}})"));
    CHECK(close(next_place(scene, 0, 1), {5, 0, 0}));
    CHECK(scene.next->instances[1].object_to_world == scene.instances[1].object_to_world);
    CHECK_FALSE(scene.next->instances[0].steps);
    CHECK(scene.next->steps.empty());
    const glm::mat4& camera = scene.next->cameras.at(0).camera_to_world;
    CHECK(close(glm::dvec3(camera[3]), {0, 0, 5}));
    CHECK(close(glm::dvec3(camera[2]), {1, 0, 0})); // it looks to -X
    CHECK_FALSE(has_note(scene, "The motion of"));
}

TEST_CASE("vertices of morphs and skins take steps to the next frame") {
    Builder builder = triangle();
    builder.floats(1, {0, 1});
    builder.floats(3, {0, 0, 2, 0, 0, 0, 0, 0, 0}); // the morph's
    builder.floats(1, {0, 0.5f});
    builder.add<uint8_t>(5121, "VEC4", 4, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
    builder.floats(4, {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0});
    builder.floats(3, {0, 0, 0, 0, 3, 0});
    const Scene scene = load_both(
        builder, R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "targets":
                        [{"POSITION": 2}]}]},
                    {"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 4, "WEIGHTS_0": 5}}]}],
            "skins": [{"joints": [2, 3]}],
            "nodes": [{"mesh": 0, "name": "morph", "translation": [7, 0, 0]},
                      {"mesh": 1, "name": "skin", "skin": 0}, {}, {}], )" +
                     animation(R"({"input": 1, "output": 3}, {"input": 1, "output": 6})",
                               R"({"sampler": 0, "target": {"node": 0, "path": "weights"}},
                                  {"sampler": 1, "target": {"node": 3, "path": "translation"}})"));
    REQUIRE(scene.instances.size() == 2);
    CHECK(close(next_place(scene, 0, 0), {7, 0, 1}));
    CHECK(close(next_place(scene, 0, 1), {8, 0, 0}));
    CHECK(close(next_place(scene, 1, 0), {0, 0, 0}));
    CHECK(close(next_place(scene, 1, 1), {1, 3, 0}));
    CHECK(close(next_place(scene, 1, 2), {0, 1 + 1.5, 0}));
}

TEST_CASE("a thing that vanishes until the next frame stands still, with a note; others move") {
    Builder builder = triangle();
    builder.floats(1, {0, 1});
    builder.floats(3, {1, 1, 1, 0, 0, 0});
    builder.floats(3, {0, 0, 0, 0, 5, 0});
    const auto nodes = [](const char* first, const char* second) {
        return MESH +
               fmt::format(R"(, "nodes": [{{"mesh": 0, "name": "{}"}}, {{"mesh": 0, "name":
                                     "{}", "translation": [3, 0, 0]}}], )",
                           first, second) +
               animation(R"({"input": 1, "output": 2}, {"input": 1, "output": 3})",
                         R"({"sampler": 0, "target": {"node": 0, "path": "scale"}},
                            {"sampler": 1, "target": {"node": 1, "path": "translation"}})");
    };
    const Scene scene = load_both(builder, nodes("a", "b"));
    CHECK(next_place(scene, 0, 1) == placed(scene, 0, 1));
    CHECK(close(next_place(scene, 1, 1), {1, 5, 0}));
    CHECK(has_note(scene, "The motion of 1 of 2 things is 0"));
    for (const char* shared : {"a", ""}) { // their nodes tell them apart
        const Scene same = load_both(builder, nodes(shared, shared));
        CHECK(next_place(same, 0, 1) == placed(same, 0, 1));
        CHECK(close(next_place(same, 1, 1), {1, 5, 0}));
        CHECK(has_note(same, "The motion of 1 of 2 things is 0"));
    }
}

TEST_CASE("a skin far from 0 that goes on keeps the digits of its steps") {
    Builder builder = triangle();
    builder.floats(1, {0, 1});
    builder.add<uint8_t>(5121, "VEC4", 4, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    builder.floats(4, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    builder.floats(3, {4000000, 0, 0, 4000100, 0, 0});
    const Scene scene = load_both(
        builder, R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 2,
            "WEIGHTS_0": 3}}]}, {"primitives": [{"attributes": {"POSITION": 0}}]}],
            "skins": [{"joints": [1]}], "nodes": [{"mesh": 0, "skin": 0}, {}], )" +
                     animation(R"({"input": 1, "output": 4})",
                               R"({"sampler": 0, "target": {"node": 1, "path": "translation"}})"));
    CHECK(scene.origin.x > 3e6);
    for (size_t k = 0; k < 3; ++k)
        CHECK(close(next_place(scene, 0, k) - placed(scene, 0, k), {100, 0, 0}, 1e-4));
}
