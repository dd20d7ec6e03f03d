// STL files as programs write them, binary and ASCII, and damaged ones.
#include "scratch.h"

#include <algorithm>

using namespace onde;
using onde::test::bytes_of;
using onde::test::has_note;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

const std::string FACET = "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n"
                          "      vertex 1 0 0\n      vertex 0 1 0\n    endloop\n  endfacet\n";
const std::string SECOND = "facet normal nan nan nan\nouter loop\nvertex 1.0e0 0 -0.0\n"
                           "vertex +1 1 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string facet(std::initializer_list<float> corners, uint16_t attribute = 0) {
    return bytes_of<float>({0, 0, 1}) + bytes_of(corners) + bytes_of<uint16_t>({attribute});
}

/// A binary file of two triangles that share an edge.
std::string binary(const std::string& header = "made by a test", uint32_t count = 2,
                   uint16_t attribute = 0) {
    std::string file = header;
    file.resize(80, header.starts_with("solid") ? ' ' : '\0');
    return file + bytes_of<uint32_t>({count}) + facet({0, 0, 0, 1, 0, 0, 0, 1, 0}, attribute) +
           facet({1, 0, 0, 1, 1, 0, 0, 1, 0});
}

Scene load(const std::string& bytes, const std::string& name = "a.stl") {
    ScratchFolder folder;
    return load_scene(folder.write(name, bytes));
}

std::string error_of(const std::string& bytes) {
    ScratchFolder folder;
    const std::string error = load_error(folder.write("evil.stl", bytes));
    if (!error.empty()) CHECK_THAT(error, Catch::Contains("evil.stl"));
    CHECK(error.find('\n') == std::string::npos);
    return error;
}

} // namespace

TEST_CASE("STL of either kind is flat triangles of grey whose equal corners share a vertex") {
    const std::string text = "solid x\n" + FACET + SECOND + "endsolid x\n";
    std::string returns = text, lines = text, capitals = text, marked = "\xff\xfe";
    std::ranges::replace(returns, '\n', '\r');
    std::ranges::replace(lines, '\n', ' ');
    std::ranges::transform(capitals, capitals.begin(),
                           [](char c) { return char(std::toupper(c)); });
    for (const char c : text) marked += {c, '\0'};
    const std::string files[] = {binary(),
                                 binary("solid with a binary body"),
                                 binary("COLOR=abcd"),
                                 text,
                                 returns,
                                 lines,
                                 capitals,
                                 marked,
                                 "\xef\xbb\xbf" + text,
                                 "\n  " + text,
                                 "solid facet and vertex 1 2 3\n" + FACET + "endsolid\nsolid\n" +
                                     SECOND + "endsolid",
                                 FACET + SECOND};
    for (const std::string& file : files) {
        INFO(file.substr(0, 60));
        const Scene scene = load(file, "A.STL");
        const Mesh& mesh = scene.meshes.at(0);
        CHECK(mesh.positions.size() == 4);
        CHECK(mesh.triangles == std::vector{glm::uvec3(0, 1, 2), glm::uvec3(1, 3, 2)});
        CHECK(mesh.normals.empty());
        CHECK(scene.materials.at(mesh.materials[1]).base_color == glm::vec3(0.8f));
        CHECK(scene.notes.size() == 3); // of the added camera, studio and ground
    }
}

TEST_CASE("an ASCII facet may have four corners") {
    const Scene scene = load("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                             "vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    CHECK(scene.meshes.at(0).triangles.size() == 2);
}

TEST_CASE("what is left out of an STL file is noted") {
    CHECK(has_note(load(binary("", 2, 0x7fff)), "Colours of triangles"));
    CHECK(has_note(load(binary() + "more"), "after the triangles"));
    CHECK(has_note(load("solid\n" + FACET + "facet normal 0 0 1\nouter loop\nvertex 1 2 3\n"),
                   "without an end"));
    CHECK(has_note(load("solid\n" + FACET + "facet\nvertex 1 2 3\nvertex 1 2 4\nendfacet\n"),
                   "fewer than three corners are skipped (line 12)"));
    const Scene scene = load("solid\n" + FACET +
                             "facet\nvertex nan 2 3\nvertex 1 2 4\n"
                             "vertex 1 2\nendfacet\n");
    CHECK(has_note(scene, "no finite numbers"));
    CHECK(scene.meshes.at(0).triangles.size() == 1);
}

TEST_CASE("STL files that lie or are something else are refused") {
    CHECK_THAT(error_of(""), Catch::Contains("neither a binary nor an ASCII"));
    CHECK_THAT(error_of("hello"), Catch::Contains("neither a binary nor an ASCII"));
    CHECK_THAT(error_of("solid\nendsolid\n"), Catch::Contains("no triangles"));
    CHECK_THAT(error_of(binary("", 3)), Catch::Contains("claims 3 triangles, but it holds 2"));
    CHECK_THAT(error_of(binary("", 0xffffffff)), Catch::Contains("claims 4294967295"));
    CHECK_THAT(error_of(binary("solid", 3)), Catch::Contains("claims 3 triangles"));
    CHECK_THAT(error_of(binary("", 0)), Catch::Contains("no triangles"));
    const std::string whole = binary();
    for (size_t size = 0; size < whole.size(); ++size) CHECK(error_of(whole.substr(0, size)) != "");
    std::string nan = binary("", 1);
    nan.replace(96, 4, bytes_of<uint32_t>({0x7fc00000}));
    CHECK_THAT(error_of(nan), Catch::Contains("all facets"));
}

TEST_CASE("a TOML scene takes STL files as shapes and as includes") {
    ScratchFolder folder;
    folder.write("t.stl", binary());
    const Scene scene = load_scene(folder.write(
        "s.toml", "include = [\"t.stl\"]\n[[shape]]\ntype = \"mesh\"\nfile = \"t.stl\"\n"));
    CHECK(scene.instances.size() == 2);
}
