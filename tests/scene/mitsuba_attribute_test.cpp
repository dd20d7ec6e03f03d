// Attributes of meshes, by which Mitsuba's files colour them.
#include "scene/load_context.h"
#include "scratch.h"
#include "support/assets.h"

#include <fmt/format.h>

using namespace onde;
using onde::test::has_note;
using onde::test::ScratchFolder;

namespace {

/// A quadrilateral of two triangles; attributes of its vertices, and of its faces.
const char* const QUAD = "ply\nformat ascii 1.0\nelement vertex 4\n"
                         "property float x\nproperty float y\nproperty float z\n"
                         "property float color_0\nproperty float color_1\nproperty float color_2\n"
                         "element face 2\nproperty list uchar int vertex_indices\n"
                         "property float color_0\nproperty float color_1\nproperty float color_2\n"
                         "property float weight_0\nproperty float odd_0\nproperty float odd_1\n"
                         "end_header\n"
                         "0 0 0 .1 .2 .3\n1 0 0 .4 .5 .6\n1 1 0 .7 .8 .9\n0 1 0 -1 7 nan\n"
                         "3 0 1 2 .1 .2 .3 .25 0 0\n3 0 2 3 .4 .5 .6 1 0 0\n";

std::string colored_by(const std::string& name, const std::string& more = "") {
    return "<bsdf type='diffuse'><texture type='mesh_attribute' name='reflectance'><string "
           "name='name' value='" +
           name + "'/>" + more + "</texture></bsdf>";
}

Scene load(const std::string& bsdf) {
    ScratchFolder folder;
    folder.write("quad.ply", QUAD);
    return load_scene(
        folder.write("a.xml", "<scene version='3.0.0'><shape type='ply'><string name='filename' "
                              "value='quad.ply'/>" +
                                  bsdf + "</shape></scene>"),
        {});
}

void check_colors(const Mesh& mesh, const std::vector<glm::vec3>& expected) {
    REQUIRE(mesh.colors.size() == expected.size());
    REQUIRE(mesh.positions.size() == expected.size());
    for (size_t i = 0; i < expected.size(); ++i) {
        INFO(i);
        CHECK(glm::length(glm::vec3(mesh.colors[i]) - expected[i]) < 1e-6f);
        CHECK(mesh.colors[i].w == 1.0f);
    }
}

} // namespace

TEST_CASE("an attribute of vertices is their linear colour, from 0 to 1") {
    const Scene scene = load(colored_by("vertex_color"));
    const glm::vec3 last(0.0f, 1.0f, 0.0f); // of what is below, above and no number
    check_colors(scene.meshes.at(0), {{.1f, .2f, .3f}, {.4f, .5f, .6f}, {.7f, .8f, .9f}, last});
    CHECK(scene.materials.at(0).base_color == glm::vec3(1.0f));
}

TEST_CASE("an attribute of faces gives each of them corners of its colour") {
    const Mesh mesh =
        load(colored_by("face_color", "<float name='scale' value='.5'/>")).meshes.at(0);
    const glm::vec3 first(.05f, .1f, .15f), second(.2f, .25f, .3f);
    check_colors(mesh, {first, first, first, second, second, second});
    const glm::uvec3 corners = mesh.triangles.at(1);
    CHECK(mesh.positions.at(corners.y) == glm::vec3(1, 1, 0));
    CHECK(mesh.positions.at(corners.z) == glm::vec3(0, 1, 0));
}

TEST_CASE("a weight of faces mixes two plain colours") {
    const auto blend = [](const std::string& second) {
        return load("<bsdf type='blendbsdf'><texture type='mesh_attribute' name='weight'><string "
                    "name='name' value='face_weight'/></texture><bsdf type='diffuse'><rgb "
                    "name='reflectance' value='0 0.4 0.8'/></bsdf>" +
                    second + "</bsdf>");
    };
    const Scene scene =
        blend("<bsdf type='diffuse'><rgb name='reflectance' value='1 0.8 0'/></bsdf>");
    const glm::vec3 first(.25f, .5f, .6f), second(1.0f, .8f, 0.0f);
    check_colors(scene.meshes.at(0), {first, first, first, second, second, second});
    CHECK(!scene.materials.at(0).blend_with);
    const Scene other = blend("<bsdf type='conductor'/>");
    CHECK(has_note(other, "but for those of two plain colours (face_weight)"));
    CHECK(other.meshes.at(0).colors.empty());
}

TEST_CASE("attributes that a mesh does not have are noted, and white") {
    for (const char* name : {"vertex_weight", "face_odd", "color", "face_"}) {
        INFO(name);
        const Scene scene = load(colored_by(name));
        CHECK(has_note(scene, "Attributes that a mesh does not have are white"));
        CHECK(scene.meshes.at(0).colors.empty());
    }
}

TEST_CASE("meshes that no attribute colours keep their vertices") {
    const Scene scene = load("<bsdf type='diffuse'/>");
    CHECK(scene.meshes.at(0).positions.size() == 4);
    CHECK(scene.meshes.at(0).colors.empty());
}
