// MTL files as other programs write them: each loads as it was meant, and what is left out is said.
#include "obj_square.h"

using namespace onde;
using namespace onde::test;

namespace {

Material material_of_mtl(const std::string& statements) {
    return material_of(
        load("mtllib m.mtl\n" + SQUARE + "usemtl a\n" + FACE, "newmtl a\n" + statements));
}

} // namespace

TEST_CASE("a material that its library lacks is a note") {
    const Scene scene = load("mtllib m.mtl\n" + SQUARE + "usemtl nothere\n" + FACE);
    CHECK(has_note(scene, "no MTL file has are diffuse grey (nothere)"));
}

TEST_CASE("colours of MTL may be one number, absent, or no number") {
    CHECK(material_of_mtl("Kd 0.5\n").base_color == glm::vec3(0.5f));
    CHECK(material_of_mtl("Kd 0.5 # grey\n").base_color == glm::vec3(0.5f));
    CHECK(material_of_mtl("  kd\t0.5 0.25\t0\n").base_color == glm::vec3(0.5f, 0.25f, 0));
    CHECK(material_of_mtl("Ns 10\nillum 1\n").base_color == glm::vec3(0.8f));
    CHECK(material_of_mtl("Ke 4\nNi 1.45\n").emission == glm::vec3(4));
    CHECK(material_of_mtl("Kd nan 0 0\n").base_color == glm::vec3(0.8f));
    CHECK(material_of_mtl("Kd spectral a.rfl\n").base_color == glm::vec3(0.8f));
    CHECK(material_of_mtl("Kd 0 0 0\n").base_color == glm::vec3(0));
    CHECK(material_of_mtl("Tr 0.9\nNi 1.5\n").kind == MaterialKind::dielectric);
    CHECK(material_of_mtl("d 1\nTr 0.9\nNi 1.5\n").kind == MaterialKind::diffuse);
    CHECK(material_of_mtl("d -halo 0.2\nNi 1.5\n").kind == MaterialKind::dielectric);
}

TEST_CASE("what MTL says and we leave out is noted, unless it changes nothing") {
    const auto note = [](const std::string& statement, const std::string& text) {
        INFO(statement);
        const Scene scene =
            load("mtllib m.mtl\n" + SQUARE + "usemtl a\n" + FACE, "newmtl a\n" + statement + "\n");
        return has_note(scene, text);
    };
    CHECK_FALSE(note("d 1\nTr 0", "contradict"));
    CHECK(note("d 1\nTr 1", "contradict"));
    CHECK(note("bump t.png", "Bump maps"));
    CHECK(note("map_Bump -bm 2 t.png", "Bump maps"));
    CHECK(note("map_Ks t.png", "Specular maps"));
    CHECK(note("disp t.png", "Displacement maps"));
    CHECK(note("Pc 0.5", "clear coat"));
    CHECK_FALSE(note("Pc 0.00", "clear coat"));
    CHECK(note("Kd xyz 1 1 1", "XYZ"));
    CHECK(note("Ns many", "missing or not finite"));
    CHECK(note("hello 1", "do not have are skipped (line 2)"));
    CHECK(note("map_Kd -mm 0.1 2 t.png", "gain"));
    CHECK_FALSE(note("map_Kd -mm 0 1 t.png", "gain"));
    CHECK(note("map_Kd -imfchan r t.png", "channel"));
    CHECK(note("map_Kd -t 1 1 1 t.png", "turbulence"));
    CHECK(has_note(load("mtllib m.mtl\n" + SQUARE + "usemtl a\n" + FACE, "Kd 1 0 0\n" + RED + RED),
                   "same name"));
}

TEST_CASE("a map may be named with blanks, backslashes, capitals, quotes and options") {
    for (const std::string name :
         {"wood fine.png", "\"wood fine.png\"", ".\\Wood Fine.PNG", "wood fine.png   ",
          "C:\\Users\\me\\textures\\wood fine.png", "wood fine.png # oak",
          "-s 1 1 1 -clamp on wood fine.png", "-clamp on -bm 0.5 wood fine.png -s 1 1 1 -o 0 0"}) {
        INFO(name);
        ScratchFolder folder;
        folder.write("wood fine.png", blue_png());
        folder.write("m.mtl", "newmtl a\nmap_Kd " + name + "\n");
        const Scene scene =
            load_scene(folder.write("a.obj", "mtllib m.mtl\n" + SQUARE + "usemtl a\n" + FACE));
        REQUIRE(material_of(scene).base_color_texture == 0);
        CHECK(material_of(scene).base_color == glm::vec3(1));
        const bool clamp = name.find("-clamp") != std::string::npos;
        CHECK(scene.textures[0].wrap_u == (clamp ? Wrap::clamp : Wrap::repeat));
    }
}

TEST_CASE("a map lies beside its library or beside the OBJ") {
    for (const std::string place : {"lib/t.png", "t.png"}) {
        ScratchFolder folder;
        folder.write(place, blue_png());
        folder.write("lib/m.mtl", "newmtl a\nmap_Kd t.png\n");
        const Scene scene =
            load_scene(folder.write("a.obj", "mtllib lib/m.mtl\n" + SQUARE + "usemtl a\n" + FACE));
        CHECK(material_of(scene).base_color_texture == 0);
    }
}

TEST_CASE("scale and offset of map_Kd move the texture coordinates of its faces only") {
    const Scene scene = load("mtllib m.mtl\n" + SQUARE + "usemtl a\n" + FACE + "usemtl b\n" + FACE,
                             "newmtl a\nmap_Kd -s 2 3 1 -o 0.5 0 t.png\nnewmtl b\nmap_Kd t.png\n");
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.uvs[mesh.triangles[0].x] == glm::vec2(0.5f, 1));
    CHECK(mesh.uvs[mesh.triangles[0].z] == glm::vec2(2.5f, -2));
    CHECK(mesh.uvs[mesh.triangles[2].x] == glm::vec2(0, 1));
    CHECK(mesh.uvs[mesh.triangles[2].z] == glm::vec2(1, 0));
}

TEST_CASE("a map that is missing, damaged or not allowed is left out with a note") {
    const std::string cases[][2] = {{"gone.png", "missing are left out (gone.png)"},
                                    {"a.obj", "can't be read are left out (a.obj)"},
                                    {"../x.png", "not allowed and left out (../x.png)"},
                                    {"/tmp/x.png", "not allowed and left out (/tmp/x.png)"}};
    for (const auto& [name, text] : cases) {
        const Scene scene = load("mtllib m.mtl\n" + SQUARE + "usemtl a\n" + FACE,
                                 "newmtl a\nKd 1 0.5 0.5\nmap_Kd " + name + "\n");
        CHECK(material_of(scene).base_color_texture == NO_TEXTURE);
        CHECK(material_of(scene).base_color == glm::vec3(1, 0.5f, 0.5f));
        CHECK(has_note(scene, text));
    }
}

TEST_CASE("d, Tr and map_d let rays pass") {
    CHECK(material_of_mtl("d 0.7\n").alpha == 0.7f);
    CHECK(material_of_mtl("d 0.7\n").alpha_mode == AlphaMode::blend);
    CHECK(material_of_mtl("Tr 0.25\n").alpha == 0.75f);
    CHECK(material_of_mtl("d 1\nTr 0\n").alpha_mode == AlphaMode::opaque);
    CHECK(material_of_mtl("illum 7\nd 0.2\n").alpha_mode == AlphaMode::opaque); // glass
    for (const std::string map_kd : {"", "map_Kd t.png\n"}) {
        const Scene scene = load("mtllib m.mtl\n" + SQUARE + "usemtl a\n" + FACE,
                                 "newmtl a\n" + map_kd + "map_d t.png\n");
        const Material& material = material_of(scene);
        CHECK(material.alpha_mode == AlphaMode::blend);
        REQUIRE(material.base_color_texture != NO_TEXTURE);
        const TexelImage& image =
            image_of(scene.textures, scene.textures.at(size_t(material.base_color_texture)));
        CHECK(image.rgba[3] == 64); // the red of an opaque picture
        CHECK(image.rgba[2] == 255);
        CHECK(image.rgba[0] == (map_kd.empty() ? 255 : 64));
    }
}

TEST_CASE("norm is a normal map, whose -bm scales it") {
    const Material material = material_of_mtl("norm -bm 0.5 t.png\n");
    CHECK(material.normal_texture == 0);
    CHECK(material.normal_scale == 0.5f);
}
