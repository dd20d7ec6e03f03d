// What Mitsuba's files mean.
#include "scene/load_context.h"
#include "scratch.h"
#include "support/assets.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <sys/resource.h>

#include <cmath>

using namespace onde;
using onde::test::has_note;
using onde::test::ScratchFolder;

namespace {

const std::string RECTANGLE = "<shape type='rectangle'/>\n";

std::string scene_of(const std::string& content) {
    return "<scene version='3.0.0'>\n" + content + "</scene>\n";
}

Scene load(const std::string& content, const LoadOptions& options = {}) {
    ScratchFolder folder;
    folder.write("part.xml", scene_of("<default name='r' value='3'/>" + RECTANGLE));
    folder.write("meshes/tri.obj",
                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 0.25\nf 1/1 2/2 3/3\n");
    folder.write("t.png", test::blue_png());
    return load_scene(folder.write("a.xml", scene_of(content)), options);
}

const Material& material(const Scene& scene) {
    return scene.materials.at(scene.meshes.at(0).materials.at(0));
}

Material material_of(const std::string& bsdf) {
    return material(load("<shape type='rectangle'>" + bsdf + "</shape>"));
}

glm::vec3 position(const Scene& scene, size_t instance, size_t vertex) {
    const Instance& i = scene.instances.at(instance);
    return glm::vec3(i.object_to_world *
                     glm::vec4(scene.meshes.at(i.mesh).positions.at(vertex), 1.0f));
}

void check_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    INFO(a.x << ' ' << a.y << ' ' << a.z);
    CHECK(glm::length(a - b) <= tolerance);
}

} // namespace

TEST_CASE("Mitsuba's camera looks where lookat says, right-handed, and mirrors where told to") {
    const std::string view = "<lookat origin='0, 0, -5' target='0 0 0' up='0, 1, 0'/>";
    const auto seen = [&](const std::string& steps) {
        const Scene scene = load("<sensor type='perspective'><transform name='to_world'>" + steps +
                                 "</transform></sensor><shape type='sphere'><point name='center' "
                                 "x='1'/></shape>");
        return glm::vec3(glm::inverse(scene.cameras.at(0).camera_to_world) *
                         glm::vec4(scene.spheres.at(0).center, 1.0f));
    };
    check_near(seen(view), {-1, 0, -5}); // +X lies to the left of who looks along +Z
    check_near(seen("<scale x='-1'/>" + view), {1, 0, -5});
}

TEST_CASE("steps of a transform follow each other in the world") {
    const Scene scene =
        load("<shape type='rectangle'><transform name='to_world'><scale value='2'/>"
             "<rotate z='1' angle='90'/><translate x='10' y='1'/></transform></shape>"
             "<shape type='rectangle'><transform name='to_world'><matrix value='1 0 0 "
             "5  0 1 0 6  0 0 1 7  0 0 0 1'/></transform></shape>");
    check_near(position(scene, 0, 0), {12, -1, 0}); // of -1, -1
    check_near(position(scene, 1, 0), {4, 5, 7});
}

TEST_CASE("angles of view go by their axis, and focal lengths by 35 mm film") {
    const auto height = [](const std::string& of) {
        const Scene scene = load("<sensor type='perspective'>" + of +
                                 "<film type='hdrfilm'><integer name='width' value='200'/><integer "
                                 "name='height' value='100'/></film></sensor>" +
                                 RECTANGLE);
        return std::tan(scene.cameras.at(0).vertical_fov / 2.0);
    };
    const std::string fov = "<float name='fov' value='90'/>";
    CHECK(height(fov) == Approx(0.5));
    CHECK(height(fov + "<string name='fov_axis' value='y'/>") == Approx(1.0));
    CHECK(height(fov + "<string name='fov_axis' value='smaller'/>") == Approx(1.0));
    CHECK(height(fov + "<string name='fov_axis' value='larger'/>") == Approx(0.5));
    CHECK(height(fov + "<string name='fov_axis' value='diagonal'/>") ==
          Approx(1.0 / std::sqrt(5.0)));
    CHECK(height("") == Approx(std::hypot(36.0, 24.0) / 100.0 / std::sqrt(5.0)));
}

TEST_CASE("what a Mitsuba file asks of a render is taken") {
    const Scene scene =
        load("<default name='spp' value='12'/><integrator type='moment'><integrator type='path'>"
             "<integer name='max_depth' value='4'/></integrator></integrator><sensor "
             "type='perspective'><sampler type='independent'><integer name='sample_count' "
             "value='$spp'/></sampler><film type='hdrfilm'><integer name='width' value='32'/>"
             "<integer name='height' value='16'/><rfilter type='box'/></film></sensor>" +
             RECTANGLE);
    CHECK(scene.settings.samples == 12u);
    CHECK(scene.settings.depth == 4u);
    CHECK(scene.settings.width == 32u);
    CHECK(scene.settings.height == 16u);
    CHECK(scene.settings.filter == Filter::box);
}

TEST_CASE("BSDFs become the nearest materials") {
    const Material diffuse =
        material_of("<bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='.1, "
                    ".2, .3'/></bsdf></bsdf>");
    CHECK(diffuse.kind == MaterialKind::diffuse);
    check_near(diffuse.base_color, {0.1f, 0.2f, 0.3f});
    CHECK(material_of("").base_color == glm::vec3(0.5f));
    const Material metal =
        material_of("<bsdf type='roughconductor'><spectrum name='eta' value='1.5'/><spectrum "
                    "name='k' value='0'/><float name='alpha' value='.25'/></bsdf>");
    CHECK(metal.kind == MaterialKind::conductor);
    check_near(metal.base_color, glm::vec3(0.04f));
    CHECK(metal.roughness == Approx(0.5));
    CHECK(metal.distribution == Distribution::beckmann); // Mitsuba's default
    CHECK(
        material_of("<bsdf type='roughdielectric'><string name='distribution' value='ggx'/></bsdf>")
            .distribution == Distribution::ggx);
    const Material gold =
        material_of("<bsdf type='conductor'><string name='material' value='Au'/></bsdf>");
    CHECK(gold.base_color.x > 1.5f * gold.base_color.z);
    const Material glass =
        material_of("<bsdf type='dielectric'><string name='int_ior' value='diamond'/><float "
                    "name='ext_ior' value='1'/></bsdf>");
    CHECK(glass.kind == MaterialKind::dielectric);
    CHECK(glass.ior == 2.419f);
    const Material plastic = material_of("<bsdf type='roughplastic'><float name='int_ior' "
                                         "value='1.4'/><float name='ext_ior' value='1'/></bsdf>");
    CHECK(plastic.kind == MaterialKind::metallic_roughness);
    CHECK(plastic.ior == 1.4f);
    CHECK(plastic.inner_reflection == 0.0f);
    CHECK(material_of("<bsdf type='plastic'><boolean name='nonlinear' value='true'/></bsdf>")
              .inner_reflection > 0.5f);
    CHECK(material_of("<bsdf type='thindielectric'/>").thin_walled);
    const Material brushed = material_of("<bsdf type='roughconductor'><float name='alpha_u' "
                                         "value='.36'/><float name='alpha_v' value='.09'/></bsdf>");
    CHECK(brushed.roughness == Approx(0.3));
    CHECK(brushed.anisotropy > 0.5f);
    CHECK(brushed.anisotropy_rotation == 0.0f);
    const Material principled =
        material_of("<bsdf type='principled'><float name='spec_trans' value='.5'/><float "
                    "name='eta' value='1.33'/><float name='sheen' value='.25'/></bsdf>");
    CHECK(principled.transmission == 0.5f);
    CHECK(principled.ior == 1.33f);
    CHECK(principled.sheen_color.x == 0.25f);
    CHECK(material_of("<bsdf type='null'/>").alpha == 0.0f);
    const Material mask = material_of("<bsdf type='mask'><float name='opacity' value='.3'/><bsdf "
                                      "type='dielectric'/></bsdf>");
    CHECK(mask.alpha == 0.3f);
    CHECK(mask.kind == MaterialKind::dielectric);
    const Scene blended = load(
        "<shape type='rectangle'><bsdf type='blendbsdf'><float name='weight' value='.9'/><bsdf "
        "type='diffuse'/><bsdf type='conductor'/></bsdf></shape>");
    const Material& first = material(blended);
    CHECK(first.kind == MaterialKind::diffuse);
    CHECK(first.blend == 0.9f);
    REQUIRE(first.blend_with);
    CHECK(blended.materials.at(*first.blend_with).kind == MaterialKind::conductor);
}

TEST_CASE("heterogeneous media have grids, in the unit cube or in their own box") {
    ScratchFolder folder;
    std::string vol = "VOL\3";
    const auto add = [&](const auto& value) {
        vol.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    for (const uint32_t word : {1u, 2u, 1u, 1u, 1u}) add(word);
    for (const float edge : {-2.0f, 0.0f, 0.0f, 2.0f, 1.0f, 1.0f, 0.25f, 0.75f}) add(edge);
    folder.write("smoke.vol", vol);
    const auto loaded = [&](const std::string& flags) {
        return load_scene(folder.write(
            "a.xml",
            scene_of("<shape type='sphere'><bsdf type='null'/><medium type='heterogeneous' "
                     "name='interior'><volume name='sigma_t' type='gridvolume'><string "
                     "name='filename' value='smoke.vol'/>" +
                     flags +
                     "</volume><volume name='albedo' type='constvolume'><float name='value' "
                     "value='.25'/></volume><float name='scale' value='8'/></medium></shape>")));
    };
    const auto check = [](const Scene& scene, const glm::vec3& low, float length) {
        REQUIRE(scene.grids.size() == 1);
        const Medium& medium = *scene.materials.at(0).medium;
        check_near(medium.scattering, glm::vec3(2));
        check_near(medium.absorption, glm::vec3(6));
        const glm::mat4 to_samples = glm::inverse(medium.placement * scene.grids[0].from_samples);
        const auto there = [&](float share) {
            const glm::vec3 p = low + glm::vec3(share * length, 0.5f, 0.5f);
            return density_at(scene.grids[0], glm::vec3(to_samples * glm::vec4(p, 1)));
        };
        CHECK(there(-0.01f) == 0);
        CHECK(there(0.1f) == Approx(0.25).margin(1e-4));
        CHECK(there(0.9f) == Approx(0.75).margin(1e-4));
        CHECK(there(1.01f) == 0);
    };
    check(loaded("<transform name='to_world'><translate x='3'/></transform>"), {3, 0, 0}, 1);
    check(loaded("<boolean name='use_grid_bbox' value='true'/>"), {-2, 0, 0}, 4);
    CHECK(has_note(loaded("<transform name='to_world'><scale x='0'/></transform>"),
                   "scaled to nothing"));
    folder.write("smoke.vol", vol.substr(0, 50));
    CHECK(has_note(loaded(""), "can't be read"));
}

TEST_CASE("media are inside of shapes and around the sensor") {
    const Scene scene =
        load("<medium type='homogeneous' id='m'><rgb name='albedo' value='.25,.5,1'/><float "
             "name='sigma_t' value='2'/><float name='scale' value='3'/><phase type='hg'><float "
             "name='g' value='.4'/></phase></medium><shape type='rectangle'><bsdf type='null'/>"
             "<ref id='m' name='interior'/></shape><sensor type='perspective'><medium "
             "type='homogeneous' name='exterior'><float name='sigma_t' value='.5'/></medium>"
             "</sensor>");
    const Material& m = material(scene);
    REQUIRE(m.medium);
    CHECK(m.kind == MaterialKind::dielectric);
    CHECK(m.ior == 1.0f);
    check_near(m.medium->scattering, {1.5f, 3.0f, 6.0f});
    check_near(m.medium->absorption, {4.5f, 3.0f, 0.0f});
    CHECK(m.medium->anisotropy == 0.4f);
    check_near(scene.medium.scattering, glm::vec3(0.375f));
    check_near(scene.medium.absorption, glm::vec3(0.125f));
}

TEST_CASE("textures show their first row where v is 0, as Mitsuba's do") {
    const Scene scene =
        load("<shape type='obj'><string name='filename' value='meshes/tri.obj'/><bsdf "
             "type='diffuse'><texture name='reflectance' type='bitmap'><string "
             "name='filename' value='t.png'/><string name='wrap_mode' value='mirror'/>"
             "<transform name='to_uv'><scale x='2' y='3'/></transform></texture>"
             "</bsdf></shape>");
    const Texture& texture = scene.textures.at(size_t(material(scene).base_color_texture));
    CHECK(texture.wrap_u == Wrap::mirror);
    CHECK(texture.transform.scale == glm::vec2(2, 3));
    CHECK(scene.meshes.at(0).uvs.at(2).y == 0.75f); // of OBJ files v is turned around
    const Scene kept = load("<shape type='obj'><string name='filename' value='meshes/tri.obj'/>"
                            "<boolean name='flip_tex_coords' value='false'/></shape>");
    CHECK(kept.meshes.at(0).uvs.at(2).y == 0.25f);
}

TEST_CASE("emitters have Mitsuba's strengths, places and directions") {
    const Scene scene = load(
        "<shape type='rectangle'><emitter type='area'><rgb name='radiance' value='1,2,3'/>"
        "</emitter></shape><emitter type='point'><point name='position' value='1,2,3'/><rgb "
        "name='intensity' value='4'/></emitter><emitter type='directional'><vector "
        "name='direction' value='0,-2,0'/><rgb name='irradiance' value='5'/></emitter><emitter "
        "type='spot'><float name='cutoff_angle' value='40'/><transform name='to_world'><lookat "
        "origin='0,3,0' target='0,0,0' up='1,0,0'/></transform></emitter><emitter "
        "type='constant'><rgb name='radiance' value='6'/></emitter>");
    CHECK(material(scene).emission == glm::vec3(1, 2, 3));
    CHECK_FALSE(material(scene).two_sided);
    check_near(scene.point_lights.at(0).position, {1, 2, 3});
    CHECK(scene.point_lights.at(0).intensity == glm::vec3(4.0f));
    check_near(scene.directional_lights.at(0).to_light, {0, 1, 0});
    CHECK(scene.directional_lights.at(0).irradiance == glm::vec3(5.0f));
    check_near(scene.spot_lights.at(0).position, {0, 3, 0});
    check_near(scene.spot_lights.at(0).back, {0, 1, 0});
    CHECK(scene.spot_lights.at(0).inner_angle == Approx(glm::radians(30.0)));
    CHECK(scene.environment.radiance == glm::vec3(6.0f));
}

TEST_CASE("a Mitsuba map begins at -Z, and is turned with its emitter") {
    const auto rotation = [](const std::string& steps) {
        const Scene scene = load(RECTANGLE +
                                 "<emitter type='envmap'><string name='filename' "
                                 "value='t.png'/><transform name='to_world'>" +
                                 steps + "</transform></emitter>");
        REQUIRE(scene.environment.map);
        return std::cos(scene.environment.rotation);
    };
    CHECK(rotation("") == Approx(-1.0));
    CHECK(rotation("<rotate y='1' angle='180'/>") == Approx(1.0));
}

TEST_CASE("groups are placed by instances; references, aliases and parameters are resolved") {
    const Scene scene = load(
        "<shape type='instance'><ref id='h'/><transform name='to_world'><translate "
        "x='5'/></transform></shape><shape type='instance'><ref id='g'/></shape><alias id='g' "
        "as='h'/><bsdf type='dielectric' id='glass'/><default name='radius' value='0.5'/>"
        "<default name='r' value='7'/><shape type='shapegroup' id='g'><shape type='sphere'><float "
        "name='radius' value='$radius'/><ref id='glass'/></shape><shape type='cube'/></shape>");
    REQUIRE(scene.spheres.size() == 2);
    check_near(scene.spheres[0].center, {5, 0, 0});
    CHECK(scene.spheres[0].radius == 0.5f);
    CHECK(scene.materials.at(scene.spheres[0].material).kind == MaterialKind::dielectric);
    CHECK(scene.instances.size() == 2);
}

TEST_CASE("rectangles, disks, cubes and cylinders are as large as Mitsuba's") {
    const Scene scene = load(
        "<shape type='rectangle'/><shape type='cube'/><shape type='disk'/><shape "
        "type='cylinder'><point name='p0' value='1,0,0'/><point name='p1' value='1,5,0'/><float "
        "name='radius' value='2'/></shape>");
    check_near(position(scene, 0, 0), {-1, -1, 0});
    const SceneBounds bounds = scene_bounds(scene);
    check_near(bounds.low, {-1, -1, -2});
    check_near(bounds.high, {3, 5, 2});
    check_near(glm::vec3(scene.shapes.at(0).object_to_world[1]), {0, 0, 1});
}

TEST_CASE("what is wrong or unknown in a Mitsuba file costs its part and a note") {
    struct Case {
        std::string text, note;
    };
    for (const Case& c : std::vector<Case>{
             {"<shape type='hair'/>", "(hair)"},
             {"<shape type='obj'><string name='filename' value='none.obj'/></shape>", "missing"},
             {"<shape type='obj'><string name='filename' value='../../x.obj'/></shape>", "outside"},
             {"<shape type='sphere'><ref id='none'/></shape>", "ids that there are not"},
             {"<shape type='sphere'><float name='radius' value='x'/></shape>",
              "Values that are none"},
             {"<shape type='sphere'><bsdf type='null'/><medium type='heterogeneous' "
              "name='interior'/></shape>",
              "not homogeneous"},
             {"<shape type='sphere'><bsdf type='diffuse'/><medium type='homogeneous' "
              "name='interior'/></shape>",
              "lets no light in"},
             {"<shape type='sphere'><string name='radius' value='2'/></shape>",
              "Values that are none"},
             {"<shape type='sphere'><string name='flip_normals' value='true'/></shape>",
              "Values that are none"},
             {"<shape type='sphere'><float name='to_world' value='2'/></shape>",
              "Values that are none"},
             {"<shape type='sphere'><bsdf type='dielectric'><rgb name='int_ior' value='2'/></bsdf>"
              "</shape>",
              "Values that are none"},
             {"<shape type='sphere'><float name='radiuss' value='2'/></shape>",
              "Parameters that nothing asks for are ignored (radiuss, "},
             {"<emitter type='projector'/>", "kinds that Onde does not have"},
             {"<shape type='sphere'><bsdf type='hair'/></shape>", "diffuse grey"},
             {"<shape type='sphere'><transform name='to_world'><rotate "
              "angle='5'/></transform></shape>",
              "Steps of transforms"},
             {"<shape type='sphere'><transform name='to_world'><scale "
              "value='0'/></transform></shape>",
              "scaled to nothing"},
             {"<bsdf type='twosided' id='a'><ref id='a'/></bsdf><shape type='sphere'><ref "
              "id='a'/></shape>",
              "within materials"},
             {"<shape type='shapegroup' id='g'><shape type='instance'><ref id='g'/></shape></shape>"
              "<shape type='instance'><ref id='g'/></shape>",
              "Instances in groups"}}) {
        INFO(c.text);
        CHECK(has_note(load(RECTANGLE + c.text), c.note));
    }
}

TEST_CASE("tables of wavelengths have the colours that the Cornell box states beside them") {
    const auto folder = test::find_asset("mitsuba-data/scenes/cbox");
    if (!folder) return;
    const Scene spectral = load_scene(*folder / "cbox.xml");
    const Scene rgb = load_scene(*folder / "cbox-rgb.xml");
    for (const char* name : {"white", "red", "green"}) {
        const auto color = [&](const Scene& scene) {
            return std::ranges::find(scene.materials, name, &Material::name)->base_color;
        };
        check_near(color(spectral), color(rgb), 3e-3f);
    }
}

TEST_CASE("hostile XML is refused in one sentence that names the file") {
    struct Case {
        std::string text;
        std::vector<std::string> culprits;
    };
    std::string deep, values = "<default name='x0' value='aaaaaaaaaaaaaaaa'/>";
    for (int i = 0; i < 100; ++i) deep += "<shape type='a'>";
    for (int i = 1; i < 40; ++i)
        values += fmt::format("<default name='x{:02}' value='$x{:02}$x{:02}'/>", i, i - 1, i - 1);
    values.replace(values.find("x0'"), 3, "x00'");
    for (const Case& c : std::vector<Case>{
             {"<scene", {"not valid XML", ":1"}},
             {"", {"not valid XML"}},
             {"<mesh/>", {"no <scene>"}},
             {scene_of("<shape type='$a'/>"), {"without a value", ":2"}},
             {scene_of("<include filename='evil.xml'/>"), {"includes itself"}},
             {scene_of("<include filename='none.xml'/>"), {"does not exist"}},
             {scene_of("<include filename='../../none.xml'/>"), {"leaves the scene's folder"}},
             {scene_of(deep), {}},
             {scene_of(values), {"load"}},
             {scene_of(""), {"empty"}},
             {scene_of("<shape type='sphere'><float name='radius' value='1'/></shape><sensor "
                       "type='perspective'><film type='hdrfilm'><integer name='width' value='1e9'/>"
                       "</film></sensor>"),
              {"width"}}}) {
        INFO(c.text.substr(0, 200));
        ScratchFolder folder;
        std::string error;
        try {
            load_scene(folder.write("evil.xml", c.text), {.limit = uint64_t(64) << 20});
        } catch (const InputError& e) {
            error = e.what();
        }
        CHECK_THAT(error, Catch::Contains("evil.xml"));
        CHECK(error.find('\n') == std::string::npos);
        for (const std::string& culprit : c.culprits) CHECK_THAT(error, Catch::Contains(culprit));
    }
}

TEST_CASE("parameters that stand for more than a load may use are refused before they take it") {
    const auto peak = [] {
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        return usage.ru_maxrss; // KiB
    };
    std::string many;
    for (int i = 0; i < 100000; ++i) many += "$v"; // 1 GB of them
    ScratchFolder folder;
    const auto file =
        folder.write("bomb.xml", scene_of("<default name='v' value='" + std::string(10000, 'a') +
                                          "'/><shape type='" + many + "'/>"));
    const long before = peak();
    CHECK_THROWS_AS(load_scene(file, {.limit = uint64_t(64) << 20}), OverBudget);
    CHECK(peak() - before < 512 << 10);
}

TEST_CASE("Mitsuba files that include each other again and again are refused") {
    ScratchFolder folder;
    for (int i = 0; i < 12; ++i) {
        std::string body;
        for (int k = 0; k < 8; ++k) body += fmt::format("<include filename='{}.xml'/>", i + 1);
        folder.write(fmt::format("{}.xml", i), scene_of(body));
    }
    folder.write("12.xml", scene_of(""));
    CHECK_THAT(test::load_error(folder.path() / "0.xml"),
               Catch::Contains(".xml: more than 16384 files are included"));
}
