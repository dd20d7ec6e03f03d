// OBJ files as other programs write them: each loads as it was meant, and what is left out is said.
#include "obj_square.h"

using namespace onde;
using namespace onde::test;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (size_t i = text.find(from); i != std::string::npos; i = text.find(from, i + to.size()))
        text.replace(i, from.size(), to);
    return text;
}

/// The scene of an OBJ whose mtllib statement is `statement`, beside a library of that name.
Scene load_with_library(const std::string& statement, const std::string& library) {
    ScratchFolder folder;
    folder.write(library, RED);
    return load_scene(
        folder.write("a.obj", "mtllib " + statement + "\n" + SQUARE + "usemtl a\n" + FACE));
}

} // namespace

TEST_CASE("a material's name may hold blanks, at its end too, and a comment") {
    const std::string pairs[][2] = {{"my red paint", "my red paint"},
                                    {"my red paint  ", "\tmy red paint\t"},
                                    {"Material #25", "Material #25"},
                                    {"red # of the roof", "red"},
                                    {"red", "red # as in the library"}};
    for (const auto& [in_mtl, in_obj] : pairs) {
        INFO(in_mtl << '|' << in_obj);
        const Scene scene = load("mtllib m.mtl\n" + SQUARE + "usemtl " + in_obj + "\n" + FACE,
                                 "newmtl " + in_mtl + "\nKd 0.8 0.1 0.1\n");
        CHECK(material_of(scene).base_color == RED_COLOR);
    }
}

TEST_CASE("byte-order marks and UTF-16 are read over") {
    const std::string obj = "mtllib m.mtl\n" + SQUARE + "usemtl a\n" + FACE;
    CHECK(material_of(load("\xef\xbb\xbf" + obj)).base_color == RED_COLOR);
    CHECK(material_of(load(obj, "\xef\xbb\xbf" + RED)).base_color == RED_COLOR);
    std::string little = "\xff\xfe", big = "\xfe\xff";
    for (const char c : obj) {
        little += {c, '\0'};
        big += {'\0', c};
    }
    CHECK(material_of(load(little)).base_color == RED_COLOR);
    CHECK(material_of(load(big)).base_color == RED_COLOR);
}

TEST_CASE("Latin-1 and UTF-8 name the same material") {
    const std::string latin = "gr\xfcn", utf8 = "gr\xc3\xbcn";
    for (const auto& [in_obj, in_mtl] : {std::pair(latin, utf8), {utf8, latin}, {latin, latin}}) {
        const Scene scene = load("mtllib m.mtl\n" + SQUARE + "usemtl " + in_obj + "\n" + FACE,
                                 "newmtl " + in_mtl + "\nKd 0.8 0.1 0.1\n");
        CHECK(material_of(scene).base_color == RED_COLOR);
        CHECK(material_of(scene).name == utf8);
    }
}

TEST_CASE("usemtl may stand before mtllib, and faces before their vertices") {
    CHECK(material_of(load("usemtl a\n" + SQUARE + "mtllib m.mtl\n" + FACE)).base_color ==
          RED_COLOR);
    CHECK(material_of(load("usemtl a\n" + FACE + SQUARE + "mtllib m.mtl\n")).base_color ==
          RED_COLOR);
}

TEST_CASE("a library's name may hold blanks, backslashes, capitals, quotes, and a comment") {
    const std::string pairs[][2] = {{"my materials.mtl", "my materials.mtl"},
                                    {"my\\ materials.mtl", "my materials.mtl"},
                                    {"\"my materials.mtl\"", "my materials.mtl"},
                                    {"sub\\x.mtl", "sub/x.mtl"},
                                    {"./sub/x.mtl", "sub/x.mtl"},
                                    {"x.mtl  ", "x.mtl"},
                                    {"X.MTL", "x.mtl"},
                                    {"x.mtl # the library", "x.mtl"},
                                    {"gone.mtl x.mtl", "x.mtl"},
                                    {"C:\\work\\scene\\x.mtl", "x.mtl"},
                                    {"gone.mtl my materials.mtl", "my materials.mtl"}};
    for (const auto& [statement, library] : pairs) {
        INFO(statement);
        const Scene scene = load_with_library(statement, library);
        CHECK(material_of(scene).base_color == RED_COLOR);
        CHECK(has_note(scene, "library is missing (gone.mtl)") == statement.starts_with("gone"));
    }
}

TEST_CASE("libraries that may not be read are notes") {
    for (const std::string name : {"../x.mtl", "/etc/passwd", "gone.mtl"}) {
        const Scene scene = load("mtllib " + name + "\n" + SQUARE + "usemtl a\n" + FACE);
        CHECK(has_note(scene, name));
        CHECK(has_note(scene, name == "gone.mtl" ? "missing" : "not allowed"));
        CHECK(material_of(scene).base_color == glm::vec3(0.8f));
    }
    CHECK(has_note(load("mtllib m.mtl\n" + SQUARE + FACE, std::string("\0\1\2", 3)), "can't be"));
}

TEST_CASE("lines end in LF, CR LF or CR, are continued by a backslash, and the last may not end") {
    const std::string obj =
        "# C:\\scenes\\\nmtllib m.mtl\n" + SQUARE + "usemtl a\nf 1/1 2/2 \\\n3/3 4/4";
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const Scene scene = load(replaced(obj, "\n", end), replaced(RED, "\n", end));
        CHECK(material_of(scene).base_color == RED_COLOR);
        CHECK(scene.meshes[0].triangles.size() == 2);
    }
    CHECK(load("v -1 -1 0\rv 1 -1 0\rv 1 1 0\rf 1 2 3\r").meshes[0].triangles.size() == 1);
}

TEST_CASE("corners may leave out what follows their slashes") {
    for (const std::string face :
         {"f 1// 2// 3//", "f 1/ 2/ 3/", "f 1//1 2//1 3//1", "f 1/2 2/2 3/2", "f 1/2/ 2/2/ 3/2/",
          "f 1/1/1 2//1 3/3/1", "fo -4 -3 -2", "f\t1\t2   3\t", "f 1/0/0 2/0/0 3/0/0",
          "f 1 2 3 # a comment"}) {
        INFO(face);
        const Scene scene = load(SQUARE + "vn 0 0 1\n" + face + "\n");
        CHECK(scene.meshes[0].triangles == std::vector{glm::uvec3(0, 1, 2)});
        CHECK(scene.meshes[0].positions[1] == glm::vec3(1, -1, 0));
    }
}

TEST_CASE("vertices may have a weight, texture coordinates one or three numbers") {
    const Scene scene = load("v 0 0 0 1\nv 1 0 0 1.0\nv 0 1 0 2\nvt 0.25\nvt 0.5 0.25 7\nvt 1 1\n"
                             "f 1/1 2/2 3/3\n");
    CHECK(scene.meshes[0].positions[2] == glm::vec3(0, 1, 0));
    CHECK(scene.meshes[0].uvs[0] == glm::vec2(0.25f, 1));
    CHECK(scene.meshes[0].uvs[1] == glm::vec2(0.5f, 0.75f));
}

TEST_CASE("a polygon may have any number of corners") {
    std::string obj, face = "f";
    for (int i = 0; i < 512; ++i) {
        const double angle = 6.283185307179586 * i / 512;
        obj +=
            "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    CHECK(load(obj + face).meshes[0].triangles.size() == 510);
}

TEST_CASE("normals that are no numbers become face normals, with a note") {
    const Scene scene = load(SQUARE + "vn 0 0 1\nvn nan nan nan\nvn -nan(ind) 1.#QNAN 0\n"
                                      "vn 0 0 0\nf 1//1 2//1 3//2\nf 1//1 3//3 4//4\n");
    CHECK(has_note(scene, "Normals that are zero or no finite numbers"));
    for (const glm::vec3& normal : scene.meshes[0].normals) CHECK(normal == glm::vec3(0, 0, 1));
}

TEST_CASE("positions that are no numbers cost their faces only, and nothing where unused") {
    const Scene unused = load(SQUARE + "v nan nan nan\nv 1e60 0 0\nv 1,5 0 0\nv 1\n" + FACE);
    CHECK(unused.meshes[0].triangles.size() == 2);
    CHECK_FALSE(has_note(unused, "finite"));
    const Scene used = load(SQUARE + "v nan 0 0\nf 1 2 5\n" + FACE + "f 1 5 3 4\n");
    CHECK(used.meshes[0].triangles.size() == 2);
    CHECK(has_note(used, "Faces with positions that are no finite numbers are left out (line 10"));
    const Scene uv = load(SQUARE + "vt inf 0\nf 1/1 2/2 3/5\n");
    CHECK(uv.meshes[0].uvs[2] == glm::vec2(0, 0));
    CHECK(has_note(uv, "Texture coordinates that are no finite numbers"));
}

TEST_CASE("a smoothing group has smooth normals, weighted by area, up to its border") {
    // Two squares at a right angle, one twice as large, and a third in no group.
    const std::string roof = "v 0 0 0\nv 0 0 1\nv 2 0 1\nv 2 0 0\nv 0 -1 0\nv 0 -1 1\nv -1 0 0\n"
                             "v -1 0 1\n";
    const Scene scene = load(roof + "s 1\nf 1 2 3 4\nf 2 1 5 6\ns off\nf 1 7 8 2\n", "");
    const Mesh& mesh = scene.meshes[0];
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    const glm::vec3 shared = mesh.normals[mesh.triangles[0].x];
    CHECK(shared.x == Approx(-1 / std::sqrt(5.0f)));
    CHECK(shared.y == Approx(2 / std::sqrt(5.0f)));
    CHECK(mesh.normals[mesh.triangles[2].x] == shared);
    CHECK(mesh.normals[mesh.triangles[0].z] == glm::vec3(0, 1, 0));
    CHECK(mesh.normals[mesh.triangles[4].x] == glm::vec3(0, 1, 0));
    const Scene apart = load(roof + "s 1\nf 1 2 3 4\ns 2\nf 2 1 5 6\n", "");
    CHECK(apart.meshes[0].normals[0] == glm::vec3(0, 1, 0));
    CHECK(load(roof + "f 1 2 3 4\nf 2 1 5 6\n", "").meshes[0].normals.empty());
}

TEST_CASE("vertices may have colours, from 0 to 1 or to 255") {
    for (const std::string one : {"1", "255"}) {
        const std::string half = one == "1" ? "0.5" : "127.5";
        const Scene scene = load("v 0 0 0 " + one + " 0 " + half + "\nv 1 0 0 1.0 " + one +
                                 " 0 0\nv 0 1 0\nf 1 2 3\n");
        const Mesh& mesh = scene.meshes[0];
        REQUIRE(mesh.colors.size() == 3);
        CHECK(mesh.colors[0].x == 1.0f);
        CHECK(mesh.colors[0].z == Approx(0.2140f).margin(1e-3)); // sRGB
        CHECK(mesh.colors[1] == glm::vec4(1, 0, 0, 1));
        CHECK(mesh.colors[2] == glm::vec4(1));
        CHECK(material_of(scene).base_color == glm::vec3(1));
    }
    CHECK(load(SQUARE + FACE).meshes[0].colors.empty());
}

TEST_CASE("mesh files of more than a load may take are refused before they take it") {
    std::string obj, stl = "solid\n",
                     ply = "ply\nformat ascii 1.0\nelement vertex 100000\n"
                           "property float x\nproperty float y\n"
                           "property float z\nelement face 1\n"
                           "property list int int vertex_indices\nend_header\n";
    for (int i = 0; i < 100000; ++i) {
        const std::string number = std::to_string(i);
        obj += "v " + number + " 0 0\n";
        ply += number + " 0 0\n";
        stl +=
            "facet\nvertex " + number + " 0 0\nvertex 0 " + number + " 0\nvertex 0 0 1\nendfacet\n";
    }
    const std::pair<std::string, std::string> files[] = {
        {"a.obj", obj + "f 1 2 3\n"}, {"a.stl", stl}, {"a.ply", ply + "3 0 1 2\n"}};
    for (const auto& [name, content] : files) {
        ScratchFolder folder;
        const auto path = folder.write(name, content);
        const uint64_t enough = 64 << 20, little = content.size() + (2 << 20);
        CHECK_NOTHROW(load_scene(path, {.limit = enough}));
        CHECK_THROWS_WITH(load_scene(path, {.limit = little}),
                          Catch::Contains(name) && Catch::Contains("--load-limit"));
    }
}

TEST_CASE(
    "what is no polygon is skipped with a note, names of objects and groups may be anything") {
    const Scene scene = load("o my object # 1\ng a b c\n" + SQUARE + FACE +
                             "l 1 2 3\np 1\nf\nf 1 2\ncurv 0 1 1 2\nhello world\n");
    CHECK(scene.meshes[0].triangles.size() == 2);
    CHECK(has_note(scene, "Points and lines are skipped (line 12 and 1 more)"));
    CHECK(has_note(scene, "fewer than three corners are skipped (line 14 and 1 more)"));
    CHECK(has_note(scene, "not of polygons are skipped (curv and 1 more)"));
}
