// What pbrt-v4's files mean, directive by directive.
#include "scratch.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

using namespace onde;
using onde::test::has_note;
using onde::test::ScratchFolder;

namespace {

const std::string TRIANGLE = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ]\n";

Scene load(const std::string& text, const LoadOptions& options = {}) {
    ScratchFolder folder;
    folder.write("part.pbrt", TRIANGLE);
    folder.write("tri.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                            "float y\nproperty float z\nelement face 1\nproperty list uchar int "
                            "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    folder.write("t.png", test::blue_png());
    return load_scene(folder.write("a.pbrt", text), options);
}

/// Where the camera sees a point: x to the right, y up, z toward the camera.
glm::vec3 seen(const Scene& scene, const glm::vec3& point) {
    return glm::vec3(glm::inverse(scene.cameras.at(0).camera_to_world) * glm::vec4(point, 1.0f));
}

glm::vec3 position(const Scene& scene, size_t instance, size_t vertex) {
    const Instance& i = scene.instances.at(instance);
    return glm::vec3(i.object_to_world *
                     glm::vec4(scene.meshes.at(i.mesh).positions.at(vertex), 1.0f));
}

/// The front's direction of an instance's first triangle in the world.
glm::vec3 front(const Scene& scene, size_t instance = 0) {
    const Mesh& mesh = scene.meshes.at(scene.instances.at(instance).mesh);
    const glm::uvec3 t = mesh.triangles.at(0);
    const glm::vec3 n = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                   mesh.positions[t.z] - mesh.positions[t.x]);
    const glm::mat3 m(scene.instances.at(instance).object_to_world);
    return glm::normalize(glm::transpose(glm::inverse(m)) * n);
}

void check_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    INFO(a.x << ' ' << a.y << ' ' << a.z);
    CHECK(glm::length(a - b) <= tolerance);
}

const Material& material(const Scene& scene) {
    return scene.materials.at(scene.meshes.at(0).materials.at(0));
}

Material material_of(const std::string& statement) {
    return material(load("WorldBegin\n" + statement + "\n" + TRIANGLE));
}

} // namespace

TEST_CASE("pbrt's left-handed camera sees +X to its right when it looks along +Z") {
    const std::string view = "LookAt 0 0 -5  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n";
    const Scene scene = load(view + "Translate 1 0 0\n" + TRIANGLE);
    check_near(seen(scene, position(scene, 0, 0)), {1, 0, -5});
    check_near(seen(scene, position(scene, 0, 2)), {1, 1, -5});
    CHECK(has_note(scene, "left-handed"));
    const Scene mirrored = load("Scale -1 1 1\n" + view + "Translate 1 0 0\n" + TRIANGLE);
    check_near(seen(mirrored, position(mirrored, 0, 0)), {-1, 0, -5});
    CHECK_FALSE(has_note(mirrored, "left-handed"));
}

TEST_CASE("transforms follow each other as pbrt's do, and attributes restore them") {
    const Scene scene = load("Scale 1 1 -1\nCamera \"perspective\"\nWorldBegin\n"
                             "Translate 1 2 3\nRotate 90 0 0 1\nScale 2 2 2\n" +
                             TRIANGLE + "AttributeBegin\nIdentity\n" + TRIANGLE +
                             "AttributeEnd\nTransformBegin\nTransform [ 1 0 0 0  0 1 0 0  0 0 1 0 "
                             " 7 8 9 1 ]\n" +
                             TRIANGLE +
                             "TransformEnd\nCoordinateSystem \"a\"\nConcatTransform [ 1 "
                             "0 0 0  0 1 0 0  0 0 1 0  1 0 0 1 ]\n" +
                             TRIANGLE + "CoordSysTransform \"a\"\n" + TRIANGLE);
    check_near(position(scene, 0, 1), {1, 4, 3});
    check_near(position(scene, 1, 1), {1, 0, 0});
    check_near(position(scene, 2, 0), {7, 8, 9});
    check_near(position(scene, 3, 0), {1, 4, 3});
    check_near(position(scene, 4, 0), {1, 2, 3});
}

TEST_CASE("what a file asks of a render is taken, bounces as surfaces") {
    const Scene scene =
        load("Film \"rgb\" \"integer xresolution\" 320 \"integer yresolution\" [ 200 ]"
             "\nSampler \"halton\" \"integer pixelsamples\" 64\nIntegrator "
             "\"path\" \"integer maxdepth\" 7\nPixelFilter \"box\"\nCamera "
             "\"perspective\" \"float fov\" 50\nWorldBegin\n" +
             TRIANGLE);
    CHECK(scene.settings.width == 320u);
    CHECK(scene.settings.height == 200u);
    CHECK(scene.settings.samples == 64u);
    CHECK(scene.settings.depth == 8u);
    CHECK(scene.settings.filter == Filter::box);
    CHECK(scene.cameras.at(0).vertical_fov == Approx(glm::radians(50.0)));
    const Scene plain = load("Camera \"perspective\"\nWorldBegin\n" + TRIANGLE);
    CHECK(plain.settings.width == 1280u);
    CHECK(plain.settings.samples == 16u);
    CHECK(plain.settings.depth == 6u);
}

TEST_CASE("the angle of view is that of the shorter side; windows and parallel rays are pbrt's") {
    const auto camera = [](const std::string& film, const std::string& stated) {
        return load("Film \"rgb\" " + film + "\nCamera " + stated + "\nWorldBegin\n" + TRIANGLE)
            .cameras.at(0);
    };
    const std::string tall = "\"integer xresolution\" 100 \"integer yresolution\" 200";
    CHECK(std::tan(camera(tall, "\"perspective\" \"float fov\" 60").vertical_fov / 2) ==
          Approx(2 * std::tan(glm::radians(30.0))));
    CHECK(std::tan(camera(tall, "\"perspective\" \"float fov\" 90 \"float screenwindow\" [ -1 1 -3 "
                                "3 ]")
                       .vertical_fov /
                   2) == Approx(3.0));
    CHECK(*camera(tall, "\"orthographic\"").orthographic_height == Approx(4.0));
    const Camera off =
        camera(tall, "\"perspective\" \"float fov\" 90 \"float screenwindow\" [ 0 1 0 2 ]");
    REQUIRE(off.screen);
    CHECK(off.screen->size == glm::vec2(1, 2));
    check_near({off.screen->first_pixel->x, off.screen->first_pixel->y, 0}, {0.005f, 0.005f, 0});
}

TEST_CASE("materials become the nearest that there are") {
    const Material diffuse = material_of("Material \"diffuse\" \"rgb reflectance\" [ .1 .2 .3 ]");
    CHECK(diffuse.kind == MaterialKind::diffuse);
    check_near(diffuse.base_color, {0.1f, 0.2f, 0.3f});
    const Material gold = material_of("Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" "
                                      "\"spectrum k\" \"metal-Au-k\" \"float roughness\" .25");
    CHECK(gold.kind == MaterialKind::conductor);
    CHECK(gold.base_color.x > 1.5f * gold.base_color.z);
    CHECK(gold.roughness == Approx(std::sqrt(0.5)));
    CHECK(
        material_of("Material \"conductor\" \"float roughness\" .25 \"bool remaproughness\" false")
            .roughness == Approx(0.5));
    check_near(material_of("Material \"conductor\" \"rgb eta\" [ 1.5 2 1 ] \"rgb k\" [ 0 0 2 ]")
                   .base_color,
               {0.04f, 1.0f / 9.0f, 0.5f});
    const Material glass = material_of("Material \"dielectric\" \"float eta\" 1.7");
    CHECK(glass.kind == MaterialKind::dielectric);
    CHECK(glass.ior == 1.7f);
    CHECK(glass.roughness == 0.0f);
    CHECK(material_of("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"").ior == 1.5168f);
    CHECK(gold.edge_tint.x < 1.0f);
    const Material plastic =
        material_of("Material \"coateddiffuse\" \"rgb reflectance\" [ 1 0 0 ] \"float eta\" 1.4");
    CHECK(plastic.kind == MaterialKind::metallic_roughness);
    CHECK(plastic.ior == 1.4f);
    CHECK(plastic.inner_reflection > 0.5f);
    const Material pane = material_of("Material \"thindielectric\" \"float eta\" 1.3");
    CHECK(pane.kind == MaterialKind::dielectric);
    CHECK(pane.thin_walled);
    CHECK(pane.ior == 1.3f);
    const Material leaf =
        material_of("Material \"diffusetransmission\" \"rgb reflectance\" [ .3 .3 "
                    ".3 ] \"rgb transmittance\" [ .1 .1 .1 ]");
    CHECK(leaf.diffuse_transmission == Approx(0.25));
    check_near(leaf.base_color, glm::vec3(0.4f));
    check_near(leaf.diffuse_transmission_color, glm::vec3(0.4f));
    const Material brushed = material_of("Material \"conductor\" \"float uroughness\" .09 \"float "
                                         "vroughness\" .36 \"bool remaproughness\" false");
    CHECK(brushed.roughness == Approx(0.3));
    CHECK(brushed.anisotropy > 0.5f);
    CHECK(brushed.anisotropy_rotation > 1.5f);
    const Material varnished = material_of("Material \"coatedconductor\"");
    CHECK(varnished.metallic == 1.0f);
    CHECK(varnished.clearcoat == 1.0f);
    CHECK(material_of("Material \"interface\"").alpha == 0.0f);
}

TEST_CASE("media have grids of the file itself and of NanoVDB, placed, and glow") {
    const Scene scene = load(
        "AttributeBegin\nTranslate 1 2 3\nMakeNamedMedium \"g\" \"string type\" \"uniformgrid\" "
        "\"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 1 \"float density\" [ 0.25 0.75 ] "
        "\"point3 p1\" [ 2 1 1 ] \"float scale\" 3 \"rgb Le\" [ 1 2 4 ] \"float Lescale\" 0.5\n"
        "AttributeEnd\nMediumInterface \"\" \"g\"\nCamera \"perspective\"\nWorldBegin\n" +
        TRIANGLE);
    REQUIRE(scene.grids.size() == 1);
    CHECK(scene.medium.grid == 0);
    check_near(scene.medium.absorption, glm::vec3(3));
    check_near(scene.medium.scattering, glm::vec3(3));
    check_near(scene.medium.emission, {1.5f, 3.0f, 6.0f});
    // The camera's world is mirrored in z.
    const glm::mat4 to_samples = glm::inverse(scene.medium.placement * scene.grids[0].from_samples);
    const auto there = [&](const glm::vec3& p) {
        return density_at(scene.grids[0], glm::vec3(to_samples * glm::vec4(p, 1)));
    };
    const float z = scene.medium.placement[3].z + 0.5f * scene.medium.placement[2].z;
    const float x = scene.medium.placement[3].x, along = scene.medium.placement[0].x;
    CHECK(there({x + 0.2f * along, 2.5f, z}) == Approx(0.25).margin(1e-4));
    CHECK(there({x + 1.8f * along, 2.5f, z}) == Approx(0.75).margin(1e-4));
    CHECK(there({x + 2.1f * along, 2.5f, z}) == 0);
    const std::string broken =
        "MakeNamedMedium \"g\" \"string type\" \"uniformgrid\" \"integer nx\" 3 \"float density\" "
        "[ 1 ]\nWorldBegin\n";
    CHECK(has_note(load(broken + TRIANGLE), "not as large as they say"));
    CHECK(has_note(load("MakeNamedMedium \"g\" \"string type\" \"nanovdb\" \"string filename\" "
                        "\"none.nvdb\"\nWorldBegin\n" +
                        TRIANGLE),
                   "Grids of densities that are missing"));
    CHECK(
        has_note(load("Scale 1 0 1\nMakeNamedMedium \"g\" \"string type\" \"uniformgrid\" \"float "
                      "density\" [ 1 ]\nIdentity\nWorldBegin\n" +
                      TRIANGLE),
                 "scaled to nothing"));
}

TEST_CASE("media are inside of shapes and around the camera") {
    const std::string media =
        "MakeNamedMedium \"smoke\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 1 2 3 ] \"rgb "
        "sigma_s\" [ 4 5 6 ] \"float scale\" .5 \"float g\" -.3\n"
        "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" 0 \"rgb sigma_s\" "
        "[ .1 .1 .1 ]\n";
    const Scene scene = load(media +
                             "MediumInterface \"\" \"fog\"\nCamera \"perspective\"\n"
                             "WorldBegin\nMaterial \"interface\"\n"
                             "MediumInterface \"smoke\" \"fog\"\n" +
                             TRIANGLE);
    const Material& m = material(scene);
    REQUIRE(m.medium);
    CHECK(m.kind == MaterialKind::dielectric);
    CHECK(m.ior == 1.0f);
    check_near(m.medium->absorption, {0.5f, 1.0f, 1.5f});
    check_near(m.medium->scattering, {2.0f, 2.5f, 3.0f});
    CHECK(m.medium->anisotropy == -0.3f);
    check_near(scene.medium.scattering, glm::vec3(0.1f));
    CHECK(has_note(
        load(media + "WorldBegin\nMaterial \"diffuse\"\nMediumInterface \"smoke\"\n" + TRIANGLE),
        "lets no light in"));
    CHECK(has_note(load("WorldBegin\nMediumInterface \"none\"\n" + TRIANGLE), "not defined"));
    CHECK(has_note(load("MakeNamedMedium \"c\" \"string type\" \"cloud\"\nWorldBegin\n" + TRIANGLE),
                   "not homogeneous"));
}

TEST_CASE("materials may be named before they are defined, and mixed") {
    const Scene scene =
        load("WorldBegin\nNamedMaterial \"a\"\n" + TRIANGLE +
             "MakeNamedMaterial \"b\" \"string type\" \"dielectric\"\n"
             "MakeNamedMaterial \"a\" \"string type\" \"mix\" \"string materials\" [ "
             "\"c\" \"b\" ] \"float amount\" .8\n");
    CHECK(has_note(scene, "not defined"));
    const Scene both =
        load("WorldBegin\nNamedMaterial \"a\"\n" + TRIANGLE +
             "MakeNamedMaterial \"b\" \"string type\" \"dielectric\"\n"
             "MakeNamedMaterial \"c\" \"string type\" \"diffuse\"\n"
             "MakeNamedMaterial \"a\" \"string type\" \"mix\" \"string materials\" [ "
             "\"c\" \"b\" ] \"float amount\" .8\n");
    CHECK(material(both).kind == MaterialKind::diffuse);
    CHECK(material(both).blend == 0.8f);
    REQUIRE(material(both).blend_with);
    CHECK(both.materials.at(*material(both).blend_with).kind == MaterialKind::dielectric);
    CHECK(has_note(load("WorldBegin\nNamedMaterial \"a\"\n" + TRIANGLE), "not defined"));
}

TEST_CASE("textures multiply colours, stand upright as pbrt has them, and may be alpha") {
    const Scene scene = load(
        "WorldBegin\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.png\" "
        "\"float uscale\" 2 \"float vscale\" 3 \"float vdelta\" .5 \"string wrap\" "
        "\"clamp\"\nTexture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"t\" \"float scale\" "
        ".5\nMaterial \"diffuse\" \"texture reflectance\" \"s\"\nShape \"trianglemesh\" "
        "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"point2 uv\" [ 0 0 1 0 0 1 ]\n");
    const Material& m = material(scene);
    CHECK(m.base_color == glm::vec3(0.5f));
    const Texture& texture = scene.textures.at(size_t(m.base_color_texture));
    CHECK(texture.srgb);
    CHECK(texture.wrap_u == Wrap::clamp);
    // pbrt's row from above at v = 1 is 1 - (3 v + 0.5).
    CHECK(texture.transform(scene.meshes.at(0).uvs.at(2)) == glm::vec2(0.0f, 1.0f - 3.5f));
    const Scene alpha =
        load("WorldBegin\nTexture \"a\" \"float\" \"constant\" \"float value\" .25\n"
             "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"texture "
             "alpha\" \"a\"\n");
    CHECK(material(alpha).alpha == 0.25f);
    CHECK(material(alpha).alpha_mode == AlphaMode::blend);
}

TEST_CASE("fronts are where normals point, else as corners go around; ReverseOrientation turns") {
    const std::string down = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ] \"normal "
                             "N\" [ 0 0 -1  0 0 -1  0 0 -1 ]\n";
    const std::string world = "Scale 1 1 -1\nCamera \"perspective\"\nWorldBegin\n"; // not mirrored
    check_near(front(load(world + TRIANGLE)), {0, 0, 1});
    check_near(front(load(world + down)), {0, 0, -1});
    check_near(front(load(world + "ReverseOrientation\n" + TRIANGLE)), {0, 0, -1});
    check_near(front(load(world + "ReverseOrientation\n" + down)), {0, 0, 1});
    check_near(front(load(world + "Scale 1 1 -1\n" + TRIANGLE)), {0, 0, -1});
    check_near(front(load(world + "ReverseOrientation\nShape \"plymesh\" \"string filename\" "
                                  "\"tri.ply\"\n")),
               {0, 0, -1});
}

TEST_CASE("area lights emit from their front, by luminance where they are spectra") {
    const auto emission = [](const std::string& light) {
        return material(load("WorldBegin\nAreaLightSource \"diffuse\" " + light + "\n" + TRIANGLE));
    };
    const Material lamp = emission("\"rgb L\" [ 1 2 3 ] \"float scale\" 2");
    CHECK(lamp.emission == glm::vec3(2, 4, 6));
    CHECK_FALSE(lamp.two_sided);
    CHECK(emission("\"bool twosided\" true").two_sided);
    const glm::vec3 warm = emission("\"blackbody L\" 3000 \"float scale\" 5").emission;
    CHECK(glm::dot(warm, glm::vec3(0.2127f, 0.7152f, 0.0722f)) == Approx(5.0).epsilon(1e-3));
    CHECK(warm.x > warm.z);
}

TEST_CASE("lights have pbrt's strengths, places and directions") {
    const std::string world = "Scale 1 1 -1\nCamera \"perspective\"\nWorldBegin\n" + TRIANGLE;
    const Scene scene = load(
        world + "Translate 1 0 0\nLightSource \"point\" \"rgb I\" [ 1 1 1 ] \"float power\" "
                "12.566370614 \"point3 from\" [ 0 2 0 ]\nLightSource \"distant\" \"rgb L\" [ 3 "
                "3 3 ] \"point3 from\" [ 0 4 0 ] \"point3 to\" [ 0 0 0 ] \"float scale\" "
                "2\nLightSource \"spot\" "
                "\"float coneangle\" 40 \"float conedeltaangle\" 10 \"point3 to\" [ 0 -1 0 "
                "]\nLightSource \"infinite\" \"rgb L\" [ 1 2 3 ]\nLightSource \"infinite\" "
                "\"float scale\" 2\n");
    const PointLight& point = scene.point_lights.at(0);
    check_near(point.position, {1, 2, 0});
    check_near(point.intensity, glm::vec3(1.0f));
    check_near(scene.directional_lights.at(0).to_light, {0, 1, 0});
    check_near(scene.directional_lights.at(0).irradiance, glm::vec3(6.0f));
    const SpotLight& spot = scene.spot_lights.at(0);
    check_near(spot.back, {0, 1, 0});
    CHECK(spot.half_angle == Approx(glm::radians(40.0)));
    CHECK(spot.inner_angle == Approx(glm::radians(30.0)));
    check_near(scene.environment.radiance, {3, 4, 5});
}

TEST_CASE("spheres, disks and cylinders stand where pbrt has them") {
    const Scene scene =
        load("Scale 1 1 -1\nCamera \"perspective\"\nWorldBegin\nTranslate 0 0 5\n"
             "Shape \"sphere\" \"float radius\" 2\nShape \"disk\" \"float radius\" 3 "
             "\"float height\" 1\nScale 1 2 1\nShape \"sphere\"\nShape \"cylinder\" "
             "\"float radius\" 2 \"float zmin\" 1 \"float zmax\" 4\n");
    REQUIRE(scene.spheres.size() == 1);
    check_near(scene.spheres[0].center, {0, 0, 5});
    CHECK(scene.spheres[0].radius == 2.0f);
    REQUIRE(scene.shapes.size() == 2);
    const glm::mat4& disk = scene.shapes[0].object_to_world;
    check_near(glm::vec3(disk[3]), {0, 0, 6});
    check_near(glm::vec3(disk[1]), {0, 0, 3}); // its front
    check_near(position(scene, 0, 0), {2, 0, 6});
    check_near(position(scene, 0, 1), {2, 0, 9});
    check_near(front(scene), {1, 0, 0}, 0.05f);
}

TEST_CASE("objects are placed by instances, with the material and the place of their definition") {
    const Scene scene = load("Scale 1 1 -1\nCamera \"perspective\"\nWorldBegin\nObjectBegin \"o\"\n"
                             "Translate 1 0 0\nMaterial \"dielectric\"\nAreaLightSource "
                             "\"diffuse\"\n" +
                             TRIANGLE + "Shape \"sphere\"\nObjectEnd\n" + TRIANGLE +
                             "Translate 0 5 0\nObjectInstance \"o\"\nObjectInstance \"o\"\n");
    CHECK(scene.instances.size() == 3);
    CHECK(scene.spheres.size() == 2);
    check_near(position(scene, 1, 0), {1, 5, 0});
    CHECK(scene.instances[1].mesh == scene.instances[2].mesh);
    CHECK(has_note(scene, "do not shine"));
    CHECK(scene.materials.at(scene.spheres[0].material).kind == MaterialKind::dielectric);
    CHECK(scene.materials.at(scene.meshes.at(1).materials.at(0)).kind == MaterialKind::diffuse);
}

TEST_CASE("files are included and imported, meshes read once a look") {
    const Scene scene = load("WorldBegin\nInclude \"part.pbrt\"\nImport \"part.pbrt\"\nShape "
                             "\"plymesh\" \"string filename\" \"tri.ply\"\nShape \"plymesh\" "
                             "\"string filename\" \"tri.ply\"\n");
    CHECK(scene.instances.size() == 4);
    CHECK(scene.meshes.size() == 3);
}

TEST_CASE(
    "what is wrong or unknown in a pbrt file costs its part and a note; strict loads refuse") {
    struct Case {
        std::string text, note;
    };
    for (const Case& c : std::vector<Case>{
             {"Shape \"curve\"\n", "(curve)"},
             {"Shape \"plymesh\" \"string filename\" \"none.ply\"\n", "missing"},
             {"Shape \"plymesh\" \"string filename\" \"../a.ply\"\n", "outside"},
             {"ObjectInstance \"none\"\n", "not defined"},
             {"Bogus 1 2 [ 3 ] \"float x\" 4\n", "Directives that pbrt-v4 does not have"},
             {"AttributeEnd\n", "has not begun"},
             {"AttributeBegin\n", "do not end"},
             {"Scale 0 1 1\n" + TRIANGLE, "scaled to nothing"},
             {"Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"normal N\" [ 1 0 0 ]\n",
              "more or fewer"},
             {"MakeNamedMedium \"m\"\nMediumInterface \"m\" \"\"\n", "Media"},
             {"Material \"diffuse\" \"texture reflectance\" \"none\"\n" + TRIANGLE, "not defined"},
             {"Texture \"a\" \"spectrum\" \"mix\" \"texture tex1\" \"a\"\nMaterial \"diffuse\" "
              "\"texture reflectance\" \"a\"\n" +
                  TRIANGLE,
              "made of themselves"},
             {"Material \"diffuse\" \"rgb reflectance\" [ 1 ]\n" + TRIANGLE,
              "Colours that are none"},
             {"Shape \"sphere\" \"float zmin\" 0\n", "whole"},
             {"Shape \"sphere\" \"string radius\" \"2\"\n",
              "Other parameters of shapes are ignored (string radius)"},
             {"Shape \"sphere\" \"float radiuss\" 2\n", "(float radiuss)"},
             {"LightSource \"point\" \"rgb scale\" [ 1 1 1 ]\n",
              "of lights are ignored (rgb scale)"},
             {"Film \"rgb\" \"string xresolution\" \"9\"\n",
              "Other parameters of Film are ignored (string xresolution)"},
             {"Texture \"t\" \"spectrum\" \"constant\" \"rgb valu\" [ 1 0 0 ]\nMaterial "
              "\"diffuse\" "
              "\"texture reflectance\" \"t\"\n" +
                  TRIANGLE,
              "Other parameters of textures are ignored (rgb valu)"}}) {
        INFO(c.text);
        const Scene scene = load("WorldBegin\n" + TRIANGLE + c.text);
        CHECK(has_note(scene, c.note));
    }
    CHECK_THROWS_AS(load("WorldBegin\n" + TRIANGLE + "AttributeEnd\n", {.strict = true}),
                    InputError);
}

TEST_CASE("a pbrt scene far from 0 keeps its shape") {
    const Scene scene = load("Scale 1 1 -1\nCamera \"perspective\"\nWorldBegin\nTranslate 1e7 0 0\n"
                             "Scale .001 .001 .001\n" +
                             TRIANGLE);
    CHECK(scene.origin.x == Approx(1e7));
    check_near(position(scene, 0, 1) - position(scene, 0, 0), {0.001f, 0, 0}, 1e-8f);
}

TEST_CASE("a pbrt light near the end of float's range shines, whatever else follows from it") {
    const Scene scene =
        load("WorldBegin\nLightSource \"point\" \"rgb I\" [ 1e38 1 1 ]\nShape \"sphere\"\n");
    REQUIRE(scene.point_lights.size() == 1);
    CHECK(scene.point_lights[0].intensity.x == Approx(1e38));
}
