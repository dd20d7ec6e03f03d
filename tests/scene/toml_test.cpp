#include "scene/load.h"
#include "scratch.h"
#include "support/folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace onde;
using onde::test::ScratchFolder;

namespace {

Scene load_toml_text(const std::string& toml) {
    ScratchFolder folder;
    folder.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("blue.png", test::blue_png());
    return load_scene(folder.write("a.toml", toml));
}

const std::string SPHERE = "[[shape]]\ntype = \"sphere\"\n";

glm::vec3 front(const Mesh& mesh, size_t triangle) {
    const glm::uvec3 t = mesh.triangles[triangle];
    return glm::normalize(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                     mesh.positions[t.z] - mesh.positions[t.x]));
}

bool near(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 1e-5f;
}

} // namespace

TEST_CASE("film and render settings are what the file says") {
    const RenderSettings settings =
        load_toml_text(SPHERE + "[film]\nsize = [320, 200]\n[render]\nsamples = 16\ndepth = 5\n"
                                "seed = 7\nfilter = \"tent\"\nexposure = -1.5\n")
            .settings;
    CHECK(settings.width == 320u);
    CHECK(settings.height == 200u);
    CHECK(settings.samples == 16u);
    CHECK(settings.depth == 5u);
    CHECK(settings.seed == 7u);
    CHECK(settings.filter == Filter::tent);
    CHECK(settings.exposure == -1.5f);
}

TEST_CASE("a camera looks from its position to its target with its field of view in degrees") {
    const Scene scene = load_toml_text(
        SPHERE + "[[camera]]\nname = \"side\"\nposition = [5, 1, 0]\nlook_at = [0, 1, 0]\n"
                 "vertical_fov = 90\naperture = 0.1\n");
    REQUIRE(scene.cameras.size() == 1);
    const Camera& camera = scene.cameras[0];
    CHECK(camera.name == "side");
    CHECK(camera.vertical_fov == Approx(std::acos(0.0)));
    CHECK(near(glm::vec3(camera.camera_to_world * glm::vec4(0, 0, -1, 0)), glm::vec3(-1, 0, 0)));
    CHECK(near(glm::vec3(camera.camera_to_world * glm::vec4(0, 1, 0, 0)), glm::vec3(0, 1, 0)));
    CHECK(camera.focus_distance == Approx(5.0f));
}

TEST_CASE("materials keep their values and shapes find them by name") {
    const Scene scene = load_toml_text(
        "[[material]]\nname = \"a\"\n[[material]]\nname = \"gold\"\nkind = \"conductor\"\n"
        "color = [1, 0.7, 0.3]\nroughness = 0.2\n" +
        SPHERE + "material = \"gold\"\ncenter = [1, 2, 3]\nradius = 4\n");
    const Sphere& sphere = scene.spheres[0];
    CHECK(sphere.center == glm::vec3(1, 2, 3));
    CHECK(sphere.radius == 4.0f);
    const Material& gold = scene.materials[sphere.material];
    CHECK(gold.kind == MaterialKind::conductor);
    CHECK(gold.base_color == glm::vec3(1, 0.7f, 0.3f));
    CHECK(gold.roughness == 0.2f);
}

TEST_CASE("media are inside of materials and around all, and materials are blended by name") {
    const Scene scene = load_toml_text(R"(
[medium]
scattering = 0.25
[[material]]
name = "rust"
blend_with = "paint"
blend = 0.75
[[material]]
name = "paint"
anisotropy = 0.5
anisotropy_rotation = 90
dispersion = 0.4
[[material]]
name = "smoke"
kind = "dielectric"
ior = 1
medium = { scattering = [1, 2, 3], absorption = 0.5, anisotropy = -0.25 }
[[shape]]
type = "sphere"
material = "rust"
)");
    CHECK(scene.medium.scattering == glm::vec3(0.25f));
    CHECK(scene.medium.absorption == glm::vec3(0));
    CHECK(scene.materials[0].blend_with == std::optional(1u));
    CHECK(scene.materials[0].blend == 0.75f);
    CHECK(scene.materials[1].anisotropy == 0.5f);
    CHECK(scene.materials[1].anisotropy_rotation == Approx(std::acos(0.0)));
    CHECK(scene.materials[1].dispersion == 0.4f);
    REQUIRE(scene.materials[2].medium);
    CHECK(scene.materials[2].medium->scattering == glm::vec3(1, 2, 3));
    CHECK(scene.materials[2].medium->anisotropy == -0.25f);
}

TEST_CASE("glass and mirrors are smooth unless the file says otherwise") {
    const Scene scene = load_toml_text("[[material]]\nname = \"g\"\nkind = \"dielectric\"\n"
                                       "[[material]]\nname = \"d\"\n" +
                                       SPHERE);
    CHECK(scene.materials[0].roughness == 0.0f);
    CHECK(scene.materials[1].roughness == 1.0f);
}

TEST_CASE("a rectangle faces where edge1 x edge2 points, and a placed one toward +Z") {
    const Scene scene =
        load_toml_text("[[shape]]\ntype = \"rectangle\"\ncorner = [0, 0, 0]\nedge1 = [0, 0, "
                       "2]\nedge2 = [1, 0, 0]\n"
                       "[[shape]]\ntype = \"rectangle\"\nsize = [2, 4]\nposition = [0, 0, 7]\n");
    CHECK(near(front(scene.meshes[0], 0), glm::vec3(0, 1, 0)));
    CHECK(near(front(scene.meshes[1], 1), glm::vec3(0, 0, 1)));
    CHECK(scene.meshes[1].positions[0] == glm::vec3(-1, -2, 7));
}

TEST_CASE("a plane lies in XZ and faces up") {
    const Scene scene = load_toml_text("[[shape]]\ntype = \"plane\"\nsize = 10\n");
    CHECK(near(front(scene.meshes[0], 0), glm::vec3(0, 1, 0)));
    CHECK(scene_bounds(scene).high == glm::vec3(5, 0, 5));
}

TEST_CASE("every face of a box faces outward, also when it is mirrored") {
    for (const std::string scale : {"1", "[-1, 1, 1]"}) {
        const Scene scene = load_toml_text(
            "[[shape]]\ntype = \"box\"\nsize = [2, 4, 6]\nrotation = [0, 30, 0]\nscale = " + scale);
        const Mesh& mesh = scene.meshes[0];
        REQUIRE(mesh.triangles.size() == 12);
        for (size_t i = 0; i < 12; ++i)
            CHECK(glm::dot(front(mesh, i), mesh.positions[mesh.triangles[i].x]) > 0.0f);
    }
}

TEST_CASE("rotation turns about X first and Z last") {
    const Scene scene =
        load_toml_text("[[shape]]\ntype = \"mesh\"\npositions = [[0, 0, 0], "
                       "[0, 1, 0], [0, 0, 1]]\ntriangles = [[0, 1, 2]]\n"
                       "rotation = [90, 0, 90]\nscale = 2\nposition = [10, 0, 0]\n");
    const Mesh& mesh = scene.meshes[0];
    // +Y goes to +Z by X and stays; +Z goes to -Y by X, then to +X by Z.
    CHECK(near(mesh.positions[1], glm::vec3(10, 0, 2)));
    CHECK(near(mesh.positions[2], glm::vec3(12, 0, 0)));
}

TEST_CASE("lights are what the file says") {
    const Scene scene = load_toml_text(
        SPHERE +
        "[[light]]\ntype = \"point\"\nposition = [1, 2, 3]\nintensity = 5\n"
        "[[light]]\ntype = \"directional\"\ndirection = [0, -2, 0]\nirradiance = [1, 2, 3]\n"
        "[[light]]\ntype = \"sphere\"\ncenter = [0, 9, 0]\nradius = 0.5\nradiance = 7\n"
        "[[light]]\ntype = \"rectangle\"\nradiance = 8\n");
    CHECK(scene.point_lights.at(0).intensity == glm::vec3(5));
    CHECK(scene.directional_lights.at(0).to_light == glm::vec3(0, 1, 0));
    CHECK(scene.directional_lights.at(0).irradiance == glm::vec3(1, 2, 3));
    CHECK(scene.materials[scene.spheres.at(1).material].emission == glm::vec3(7));
    const Material& panel = scene.materials[scene.meshes.at(0).materials.at(0)];
    CHECK(panel.emission == glm::vec3(8));
    CHECK_FALSE(panel.two_sided);
}

TEST_CASE("an environment has a radiance, a rotation in degrees and a map") {
    const Scene scene = load_toml_text(
        SPHERE + "[environment]\nradiance = [1, 2, 3]\nrotation = 180\nmap = \"blue.png\"\n");
    CHECK(scene.environment.radiance == glm::vec3(1, 2, 3));
    CHECK(scene.environment.rotation == Approx(3.14159265));
    REQUIRE(scene.environment.map);
    CHECK(scene.environment.map->channels == 3);
    CHECK(scene.environment.map->pixels.at(2) == Approx(1.0f));
    CHECK(scene.environment.map->pixels.at(0) == Approx(0.0513f).margin(1e-3)); // sRGB 64
}

TEST_CASE("a file that is included often is stored once and placed often") {
    const Scene scene = load_toml_text("[[include]]\nfile = \"tri.obj\"\n"
                                       "[[include]]\nfile = \"tri.obj\"\nposition = [5, 0, 0]\n"
                                       "[[include]]\nfile = \"tri.obj\"\nscale = [1, -2, 1]\n");
    CHECK(scene.meshes.size() == 1);
    REQUIRE(scene.instances.size() == 3);
    CHECK(scene.instances[1].object_to_world[3] == glm::vec4(5, 0, 0, 1));
    CHECK(scene_bounds(scene).low == glm::vec3(0, -2, 0));
    CHECK(scene_bounds(scene).high == glm::vec3(6, 1, 0));
}

TEST_CASE("a mesh shape may replace its file's materials") {
    const Scene scene = load_toml_text("[[material]]\nname = \"red\"\ncolor = [1, 0, 0]\n"
                                       "[[shape]]\ntype = \"mesh\"\nfile = \"tri.obj\"\n"
                                       "[[shape]]\ntype = \"mesh\"\nfile = \"tri.obj\"\n"
                                       "material = \"red\"\n");
    REQUIRE(scene.meshes.size() == 2);
    CHECK(scene.materials[scene.meshes[0].materials[0]].name == "default");
    CHECK(scene.materials[scene.meshes[1].materials[0]].name == "red");
}

TEST_CASE("an included scene brings its spheres, lights and cameras, moved and scaled") {
    ScratchFolder folder;
    folder.write("inner.toml", "[[material]]\nname = \"a\"\ncolor = 0.5\n" + SPHERE +
                                   "material = \"a\"\ncenter = [1, 0, 0]\nradius = 2\n[[light]]\n"
                                   "type = \"point\"\nposition = [0, 1, 0]\nintensity = 3\n"
                                   "[camera]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n"
                                   "[environment]\nradiance = 0.5\n[render]\nsamples = 9\n");
    const Scene scene = load_scene(folder.write(
        "outer.toml", "include = [\"inner.toml\"]\n[render]\nsamples = 4\n[[material]]\n"
                      "name = \"b\"\n"));
    CHECK(scene.materials[scene.spheres.at(0).material].base_color == glm::vec3(0.5f));
    CHECK(scene.environment.radiance == glm::vec3(0.5f));
    CHECK(scene.settings.samples == 4u);
    const Scene moved = load_scene(folder.write(
        "moved.toml", "[[include]]\nfile = \"inner.toml\"\nscale = 3\nposition = [0, 0, 1]\n"));
    CHECK(near(moved.spheres.at(0).center, glm::vec3(3, 0, 1)));
    CHECK(moved.spheres[0].radius == Approx(6.0f));
    CHECK(near(moved.point_lights.at(0).position, glm::vec3(0, 3, 1)));
    CHECK(moved.cameras.at(0).camera_to_world[3] == glm::vec4(0, 0, 13, 1));
    CHECK(moved.cameras[0].focus_distance == Approx(12.0f));
}

TEST_CASE("every word of an enum is a value of its key") {
    for (const auto& [filter, word] : WORDS_OF<Filter>)
        CHECK(load_toml_text(fmt::format("{}[render]\nfilter = \"{}\"\n", SPHERE, word))
                  .settings.filter == filter);
    for (const auto& [kind, word] : WORDS_OF<IntegratorKind>)
        CHECK(load_toml_text(fmt::format("{}[render]\nintegrator = \"{}\"\n", SPHERE, word))
                  .settings.integrator == kind);
    for (const auto& [kind, word] : WORDS_OF<MaterialKind>)
        CHECK(load_toml_text(
                  fmt::format("{}[[material]]\nname = \"a\"\nkind = \"{}\"\n", SPHERE, word))
                  .materials[0]
                  .kind == kind);
}

TEST_CASE("[whitted] of an included scene is taken where the scene has none, else a note says so") {
    ScratchFolder folder;
    folder.write("inner.toml", SPHERE + "[whitted]\nambient = 0.25\nwavelengths = 5\n");
    const std::string two = "include = [\"inner.toml\", \"inner.toml\"]\n";
    const auto left_out = [](const Scene& scene) {
        return std::ranges::count_if(scene.notes, [](const std::string& note) {
            return note.find("[whitted] settings of an included scene") != std::string::npos;
        });
    };
    const Scene bare = load_scene(folder.write("bare.toml", two));
    CHECK(bare.chapter.whitted.ambient == glm::vec3(0.25f));
    CHECK(bare.chapter.whitted.wavelengths == 5);
    CHECK(left_out(bare) == 0);
    const Scene own = load_scene(folder.write("own.toml", two + "[whitted]\nepsilon = 0.5\n"));
    CHECK(own.chapter.whitted.epsilon == 0.5f);
    CHECK_FALSE(own.chapter.whitted.ambient);
    CHECK(own.chapter.whitted.wavelengths == 7);
    CHECK(left_out(own) == 1);
}

TEST_CASE("shapes are placed with their radii; stretched spheres become ellipsoids") {
    ScratchFolder folder;
    folder.write("ball.toml", SPHERE + "center = [1, 0, 0]\nradius = 2\n");
    const Scene scene = load_scene(folder.write(
        "shapes.toml",
        "[[shape]]\ntype = \"torus\"\nmajor_radius = 2\nminor_radius = 0.5\nposition = [1, 2, 3]\n"
        "[[shape]]\ntype = \"cylinder\"\nradius = 3\nheight = 4\n"
        "[[shape]]\ntype = \"cone\"\nradius = 3\nheight = 4\n"
        "[[shape]]\ntype = \"ellipsoid\"\nradii = [1, 2, 3]\n"
        "[[light]]\ntype = \"disk\"\nradius = 2\nradiance = 3\nposition = [0, 9, 0]\n"
        "[[include]]\nfile = \"ball.toml\"\nscale = [1, 3, 1]\n"));
    REQUIRE(scene.shapes.size() == 6);
    const auto at = [&](size_t i, glm::vec3 p) {
        return glm::vec3(scene.shapes[i].object_to_world * glm::vec4(p, 1.0f));
    };
    CHECK(scene.shapes[0].minor_radius == 0.25f);
    CHECK(near(at(0, {1, 0, 0}), glm::vec3(3, 2, 3)));
    CHECK(near(at(1, {1, 1, 0}), glm::vec3(3, 2, 0)));
    CHECK(near(at(2, {0, 1, 0}), glm::vec3(0, 4, 0)));
    CHECK(near(at(3, {0, 1, 0}), glm::vec3(0, 2, 0)));
    CHECK(scene.shapes[5].kind == ShapeKind::sphere);
    CHECK(near(at(5, {0, 1, 0}), glm::vec3(1, 6, 0)));
    REQUIRE(scene.chapter.area_lights.size() == 1);
    const AreaLight& light = scene.chapter.area_lights[0];
    CHECK(light.kind == AreaLightKind::disk);
    CHECK(glm::cross(light.edge1, light.edge2).y == Approx(4.0f)); // as the shape's front
    CHECK(scene.materials[scene.shapes[4].material].emission == glm::vec3(3));
    const SceneBounds bounds = scene_bounds(scene);
    CHECK(bounds.high.y == Approx(9.0f));
    CHECK(bounds.low.y == Approx(-6.0f));
}

TEST_CASE("every scene of the project loads without a note") {
    const auto folder = std::filesystem::path(onde::test::in_project("scenes"));
    size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".toml") continue;
        if (entry.path().parent_path().filename() == "parts") continue; // for others to include
        INFO(entry.path().string());
        CHECK(load_scene(entry.path()).notes.empty());
        ++count;
    }
    CHECK(count >= 5);
}

TEST_CASE("specular of a phong material is the chapter's weight; of others it is 1 at most") {
    const auto material = [](const std::string& kind, const std::string& specular) {
        return SPHERE + "material = \"m\"\n[[material]]\nname = \"m\"\nkind = \"" + kind +
               "\"\nspecular = " + specular + "\n";
    };
    const Scene phong = load_toml_text(material("phong", "3"));
    REQUIRE(phong.chapter.phong.contains(0));
    CHECK(phong.chapter.phong.at(0).specular == 3.0f);
    CHECK(phong.materials.at(0).specular == 1.0f);
    const Scene glossy = load_toml_text(material("metallic-roughness", "0.5"));
    CHECK(glossy.chapter.phong.at(0).specular == 0.5f);
    CHECK(glossy.materials.at(0).specular == 0.5f);
    CHECK_THROWS_WITH(load_toml_text(material("metallic-roughness", "3")),
                      Catch::Contains("specular") && Catch::Contains("must lie between 0 and 1"));
}
