#include "scene/load.h"
#include "scene/phong.h"
#include "scratch.h"

using namespace onde;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

const std::string TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Scene load_obj_text(const std::string& obj, const std::string& mtl = "") {
    ScratchFolder folder;
    if (!mtl.empty()) folder.write("m.mtl", mtl);
    folder.write("blue.png", test::blue_png());
    return load_scene(folder.write("a.obj", obj));
}

/// The material of the first triangle of a file that uses material "a".
Material material_of(const std::string& mtl) {
    const Scene scene = load_obj_text("mtllib m.mtl\n" + TRIANGLE + "usemtl a\nf 1 2 3\n", mtl);
    return scene.materials[scene.meshes[0].materials[0]];
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles)
        sum += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                            mesh.positions[t.z] - mesh.positions[t.x]));
    return sum;
}

} // namespace

TEST_CASE("an OBJ quad is two triangles on four vertices with v turned downward") {
    const Scene scene = load_obj_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles == std::vector{glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)});
    CHECK(mesh.uvs[0] == glm::vec2(0, 1));
    CHECK(mesh.uvs[2] == glm::vec2(1, 0));
}

TEST_CASE("corners that share position, uv and normal share a vertex, others don't") {
    const Scene scene = load_obj_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 2\n"
                                      "f 1//1 2//1 3//1\nf 1//1 3//2 4//1\n");
    CHECK(scene.meshes[0].positions.size() == 5);
    CHECK(scene.meshes[0].normals[0] == glm::vec3(0, 0, 1));
}

TEST_CASE("negative indices count from the end") {
    const Scene scene = load_obj_text(TRIANGLE + "f -3 -2 -1\n");
    CHECK(scene.meshes[0].positions[1] == glm::vec3(1, 0, 0));
}

TEST_CASE("a concave polygon keeps its area and winding") {
    // An L of area 3.
    const Scene scene =
        load_obj_text("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 3 4 5 6 1 2\n");
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.triangles.size() == 4);
    CHECK(area(mesh) == Approx(3.0));
    for (const glm::uvec3& t : mesh.triangles)
        CHECK(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                         mesh.positions[t.z] - mesh.positions[t.x])
                  .z > 0.0f);
}

TEST_CASE("faces with and without normals become smooth and flat") {
    const Scene scene = load_obj_text(TRIANGLE + "v 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1 2 4\n");
    const Mesh& mesh = scene.meshes[0];
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    CHECK(mesh.normals[mesh.triangles[0].x] == glm::vec3(1, 0, 0));
    CHECK(mesh.normals[mesh.triangles[1].x] == glm::vec3(0, -1, 0));
}

TEST_CASE("MTL materials map to ours") {
    CHECK(material_of("newmtl a\nKd 0.1 0.2 0.3\n").kind == MaterialKind::diffuse);
    CHECK(material_of("newmtl a\nKd 0.1 0.2 0.3\n").base_color == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(material_of("newmtl a\nKd 0 0 0\nKe 3 2 1\n").emission == glm::vec3(3, 2, 1));
    const Material glass = material_of("newmtl a\nillum 7\nNi 1.4\nTf 1 0.5 0.5\n");
    CHECK(glass.kind == MaterialKind::dielectric);
    CHECK(glass.ior == Approx(1.4f));
    CHECK(glass.base_color == glm::vec3(1, 0.5f, 0.5f));
    CHECK(phong_of(glass).transmission == 1);
    const Material metal = material_of("newmtl a\nKd 1 1 1\nPr 0.25\nPm 1\n");
    CHECK(metal.kind == MaterialKind::metallic_roughness);
    CHECK(metal.roughness == 0.25f);
    CHECK(metal.metallic == 1.0f);
    CHECK(material_of("newmtl a\nKd 0 0 0\nKs 0.9 0.9 0.9\nillum 3\nNs 2000\n").kind ==
          MaterialKind::conductor);
}

TEST_CASE("map_Kd is loaded from the folder, with either kind of slash") {
    CHECK(material_of("newmtl a\nmap_Kd ./blue.png\n").base_color_texture == 0);
    CHECK(material_of("newmtl a\nmap_Kd .\\blue.png\n").base_color_texture == 0);
}

TEST_CASE("a missing MTL file is a note and its materials are grey") {
    const Scene scene = load_obj_text("mtllib gone.mtl\n" + TRIANGLE + "usemtl a\nf 1 2 3\n");
    CHECK(scene.materials[scene.meshes[0].materials[0]].base_color == glm::vec3(0.8f));
    REQUIRE_FALSE(scene.notes.empty());
    CHECK_THAT(scene.notes[0], Catch::Contains("gone.mtl"));
}

TEST_CASE("a material that no MTL file has is a note, once, and grey") {
    const Scene scene = load_obj_text("mtllib m.mtl\n" + TRIANGLE +
                                          "f 1 2 3\nusemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\n"
                                          "usemtl b\nf 1 2 3\n",
                                      "newmtl a\nKd 1 0 0\n");
    REQUIRE(scene.notes.size() >= 1);
    CHECK(scene.notes[0] == "Materials that no MTL file has are diffuse grey (b).");
    CHECK(scene.materials[scene.meshes[0].materials[1]].base_color == glm::vec3(0.8f));
    CHECK(scene.materials[scene.meshes[0].materials[2]].base_color == glm::vec3(1, 0, 0));
}

TEST_CASE("hostile OBJ files are refused with the file and the culprit") {
    struct Case {
        std::string obj, culprit;
    };
    const Case cases[] = {
        {"", "empty"},
        {TRIANGLE, "empty"},
        {TRIANGLE + "f 1 2 4\n", "vertex 4, but there are 3"},
        {TRIANGLE + "f 1 2 -9\n", "evil.obj"},
        {TRIANGLE + "f 1 2 0\n", "evil.obj"},
        {TRIANGLE + "f 1 2 2147483647\n", "vertex 2147483647"},
        {TRIANGLE + "f 1 2 2147483648\n", "evil.obj:4: '2147483648' is not a corner"},
        {TRIANGLE + "f 1 2 99999999999999999999\n", "is not a corner"},
        {TRIANGLE + "f 1 2 4294967297\n", "is not a corner"},
        {TRIANGLE + "f 1 2 -2147483648\n", "counts back"},
        {TRIANGLE + "f 1 2 3.5\n", "'3.5' is not a corner"},
        {TRIANGLE + "f 1 2 3/1/1/1\n", "is not a corner"},
        {TRIANGLE + "f 1 2 /3\n", "is not a corner"},
        {TRIANGLE + "f 1//1 2//1 3//1\n", "normal 1, but there are 0"},
        {TRIANGLE + "f 1/7 2/7 3/7\n", "texture vertex 7, but there are 0"},
        {"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "all faces have positions that are no finite"},
        {"v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n", "no finite"},
        {std::string("v 0 0 0\0f 1 1 1\n", 16), "not a text file"},
    };
    for (const Case& c : cases) {
        ScratchFolder folder;
        INFO(c.obj.substr(0, 100));
        const std::string error = load_error(folder.write("evil.obj", c.obj));
        CHECK_THAT(error, Catch::Contains("evil.obj"));
        CHECK_THAT(error, Catch::Contains(c.culprit));
    }
}

TEST_CASE("triangles without area in an OBJ load with a note") {
    const Scene scene = load_obj_text(TRIANGLE + "f 1 2 3\nf 1 1 2\n");
    REQUIRE_FALSE(scene.notes.empty());
    CHECK_THAT(scene.notes[0], Catch::Contains("without area"));
}
