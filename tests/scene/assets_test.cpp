// Real and hostile files from elsewhere: each loads and is a valid scene, or is refused with one
// sentence. Nothing else may happen.
#include "core/error.h"
#include "scene/load.h"
#include "support/assets.h"
#include "support/folders.h"

#include <catch2/catch.hpp>

#include <set>

using namespace onde;
namespace fs = std::filesystem;

namespace {

struct Tally {
    size_t loaded = 0, refused = 0;
};

Tally load_all(const fs::path& folder,
               const std::set<std::string>& formats = {".gltf", ".glb", ".obj", ".ply", ".stl"},
               const fs::path& root = {}) {
    Tally tally;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file() || !formats.contains(entry.path().extension())) continue;
        INFO(entry.path().string());
        try {
            const Scene scene = load_scene(entry.path(), {.root = root});
            CHECK_NOTHROW(check_scene(scene));
            CHECK(scene_hash(scene).size() == 16);
            ++tally.loaded;
        } catch (const InputError& error) {
            const std::string sentence = error.what();
            CHECK_THAT(sentence, Catch::Contains(entry.path().filename()));
            CHECK(sentence.find('\n') == std::string::npos);
            ++tally.refused;
        }
    }
    return tally;
}

} // namespace

TEST_CASE("glTF sample models load unless they need an extension that we lack") {
    const auto folder = test::find_asset("gltf");
    if (!folder) return;
    const Tally tally = load_all(*folder);
    CHECK(tally.loaded >= 65);
    CHECK(tally.refused <= 2);
}

TEST_CASE("OBJ models load unless they hold no faces or are damaged") {
    const auto folder = test::find_asset("obj");
    if (!folder) return;
    const Tally tally = load_all(*folder, {".obj"});
    CHECK(tally.loaded >= 33);
    CHECK(tally.refused <= 6); // points, lines or nothing, and one with vertices numbered from 0
}

TEST_CASE("PLY models load unless they hold no faces") {
    const auto folder = test::find_asset("obj"), meshes = test::find_asset("pbrt");
    if (!folder || !meshes) return;
    const Tally tally = load_all(*folder, {".ply"});
    CHECK(tally.loaded == 4);
    CHECK(tally.refused == 1); // of vertices only
    CHECK(load_all(*meshes, {".ply"}).loaded >= 84);
}

TEST_CASE("pbrt's and Mitsuba's scenes load") {
    const auto pbrt = test::find_asset("pbrt"), mitsuba = test::find_asset("mitsuba-data");
    if (!pbrt || !mitsuba) return;
    CHECK(load_all(*pbrt, {".pbrt"}).loaded == 5);
    const Tally tally = load_all(*mitsuba, {".xml"}, *mitsuba);
    CHECK(tally.loaded >= 24);
    CHECK(tally.refused <= 7); // fragments without a shape
}

TEST_CASE("invalid files are refused or load as valid scenes") {
    const auto folder = test::find_asset("invalid");
    if (!folder) return;
    CHECK(load_all(*folder).refused >= 190);
}

TEST_CASE("our own odd files, among them what fuzzing found, are refused or load as valid scenes") {
    const fs::path folder = fs::path(onde::test::in_project("tests/data"));
    const Tally tally =
        load_all(folder, {".gltf", ".glb", ".obj", ".ply", ".stl", ".toml", ".pbrt", ".xml"});
    CHECK(tally.loaded >= 9);
}

TEST_CASE("a sample model has the triangles that its documentation counts") {
    const auto helmet = test::find_asset("gltf/DamagedHelmet/glTF-Binary/DamagedHelmet.glb");
    if (!helmet) return;
    const Scene scene = load_scene(*helmet);
    CHECK(scene.meshes.at(0).triangles.size() == 15452);
    const Material& material = scene.materials.at(0);
    CHECK(scene.textures.at(size_t(material.base_color_texture)).image.width == 2048);
    CHECK(material.normal_texture != NO_TEXTURE);
}
