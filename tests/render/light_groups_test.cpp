// The light of groups of lights, each by itself.
#include "render/picture.h"
#include "render/variants.h"

#include "scene/light_groups.h"

#include <algorithm>
#include <numeric>

namespace onde::test {
namespace {

/// A floor of glossy stuff under a lamp, a ball of glass, two points, a sun and a sky.
Scene scene_of_groups() {
    Scene scene;
    Material floor, glass, lamp;
    floor.kind = MaterialKind::metallic_roughness;
    floor.base_color = {0.7f, 0.5f, 0.3f};
    floor.roughness = 0.6f;
    glass.kind = MaterialKind::dielectric;
    glass.roughness = 0;
    lamp.base_color = glm::vec3(0);
    lamp.emission = {3, 2, 1};
    lamp.group = "key";
    scene.materials = {floor, glass, lamp};
    Mesh mesh;
    mesh.positions = {{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    mesh.materials = {0, 0};
    scene.meshes = {mesh};
    scene.instances = {{0, glm::mat4(1)}};
    scene.spheres = {{{-0.8f, 0.6f, 0.5f}, 0.5f, 1}, {{0.9f, 1.4f, -0.4f}, 0.4f, 2}};
    scene.point_lights = {{.position = {1, 2, 1}, .intensity = {0, 2, 2}, .group = "fill"},
                          {.position = {-1, 3, 1}, .intensity = glm::vec3(1)}};
    scene.directional_lights = {
        {.to_light = {0, 1, 0}, .irradiance = glm::vec3(0.2f), .group = "fill"}};
    scene.environment.radiance = {0.1f, 0.2f, 0.4f};
    scene.environment.group = "sky";
    scene.cameras = {camera_at({0, 2.5f, 4}, {0, 0.5f, 0}, 0.9f)};
    return scene;
}

/// The scene with only the lights of a group.
Scene only(const std::string& group) {
    Scene scene = scene_of_groups();
    const auto is_other = [&](const std::string& own) {
        return (own.empty() ? std::string(OTHER_LIGHT) : own) != group;
    };
    for (Material& material : scene.materials)
        if (is_other(material.group)) material.emission = glm::vec3(0);
    std::erase_if(scene.point_lights, [&](const auto& light) { return is_other(light.group); });
    std::erase_if(scene.directional_lights,
                  [&](const auto& light) { return is_other(light.group); });
    if (is_other(scene.environment.group)) scene.environment.radiance = glm::vec3(0);
    return scene;
}

RenderOptions options_of(const Scene& scene, uint32_t samples = 80, uint32_t aovs = 0) {
    RenderOptions options = small_options(16, 12, samples);
    options.light_groups = light_groups(scene);
    options.aovs = aovs;
    if (aovs >> AOV_CLAMPED & 1) options.clamp = 2;
    return options;
}

Session session_of(const Scene& scene, const RenderOptions& options) {
    return Session(programs(), scene, {.render = options, .choose_layout = false});
}

void check_sum(Session& session) {
    const Image picture = session.film().develop();
    const std::vector<Image> groups = session.light_groups();
    for (size_t i = 0; i < picture.pixels.size(); i++) {
        float sum = 0;
        for (const Image& group : groups) sum += group.pixels[i];
        CHECK(sum == Approx(picture.pixels[i]).epsilon(2e-5).margin(1e-6));
    }
}

double mean_of(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) /
           double(image.pixels.size());
}

} // namespace

TEST_CASE("groups of lights are found in the order of materials, lights and environment") {
    CHECK(light_groups(scene_of_groups()) ==
          std::vector<std::string>{"other", "key", "fill", "sky"});
    CHECK(light_groups(Scene{}) == std::vector<std::string>{"other"});
    Scene scene = scene_of_groups();
    const std::string before = scene_hash(scene);
    scene.point_lights[1].group = "other"; // which it has already
    CHECK(light_groups(scene).size() == 4);
    scene.point_lights[1].group = "fill";
    CHECK(scene_hash(scene) != before);
    scene.materials.resize(17);
    for (size_t i = 0; i < 17; i++) scene.materials[i].group = "g" + std::to_string(i);
    CHECK_THROWS_WITH(check_scene(scene), Catch::Contains("more than 16 groups"));
    scene.materials[3].group = "no blank";
    CHECK_THROWS_WITH(check_scene(scene), Catch::Contains("material 3") &&
                                              Catch::Contains("its group must be of letters"));
}

TEST_CASE("the light of groups adds up to the picture, with a clamp and other shares too") {
    const Scene scene = scene_of_groups();
    Session plain = session_of(scene, options_of(scene));
    plain.render();
    check_sum(plain);
    Session all = session_of(scene, options_of(scene, 80, (1u << AOV_COUNT) - 1));
    all.render();
    check_sum(all);
    CHECK(all.clamped_share() > 0);
}

TEST_CASE("the light of a group is that of a scene which has only its lights") {
    const Scene scene = scene_of_groups();
    Session session = session_of(scene, options_of(scene, 1024));
    session.render();
    const std::vector<Image> groups = session.light_groups();
    for (size_t i = 0; i < groups.size(); i++) {
        const std::string& name = session.options().light_groups[i];
        INFO(name);
        RenderOptions options = small_options(16, 12, 1024);
        options.seed = 1;
        Session alone = session_of(only(name), options);
        alone.render();
        const double expected = mean_of(alone.picture());
        CHECK(expected > 0.001);
        CHECK(mean_of(groups[i]) == Approx(expected).epsilon(0.03));
    }
}

TEST_CASE("the light of media that glow is other light") {
    Scene scene = scene_of_groups();
    scene.point_lights.resize(1); // no other light but theirs
    scene.materials[1].ior = 1;
    scene.materials[1].medium = {.absorption = glm::vec3(1), .emission = {2, 1, 0}};
    Session session = session_of(scene, options_of(scene, 256));
    session.render();
    check_sum(session);
    const std::vector<Image> groups = session.light_groups();
    for (Material& material : scene.materials) material.emission = glm::vec3(0);
    scene.point_lights.clear();
    scene.directional_lights.clear();
    scene.environment.radiance = glm::vec3(0);
    RenderOptions options = small_options(16, 12, 256);
    options.seed = 1;
    Session alone = session_of(scene, options);
    alone.render();
    CHECK(mean_of(alone.picture()) > 0.001);
    CHECK(mean_of(groups[0]) == Approx(mean_of(alone.picture())).epsilon(0.03));
}

TEST_CASE("groups leave the picture as it is, and every engine makes the same of them") {
    const Scene scene = scene_of_groups();
    RenderOptions options = small_options(16, 12, 80);
    Session plain = session_of(scene, options);
    plain.render();
    for (const uint32_t aovs : {0u, 1u << AOV_DIRECT | 1u << AOV_DEPTH | 1u << AOV_SQUARES}) {
        Session first = session_of(scene, options_of(scene, 80, aovs));
        first.render();
        CHECK(first_difference(plain.picture(), first.picture()) == "");
        const std::vector<Image> groups = first.light_groups();
        for (const Variant& variant : VARIANTS) {
            INFO(variant.name << " " << aovs);
            Session session = session_of(scene, apply(options_of(scene, 80, aovs), variant));
            session.render();
            const std::vector<Image> same = session.light_groups();
            for (size_t i = 0; i < groups.size(); i++) CHECK(same[i].pixels == groups[i].pixels);
        }
    }
}

TEST_CASE("denoised groups add up to the denoised picture") {
    const Scene scene = scene_of_groups();
    SessionOptions options{.render = options_of(scene, 16, denoiser_aovs())};
    options.denoiser.denoiser = Denoiser::own;
    Session session(programs(), scene, options);
    session.render();
    const DenoisedImage denoised = session.denoised();
    REQUIRE(denoised.groups.size() == 4);
    CHECK(denoised.groups[1].pixels != session.light_groups()[1].pixels);
    for (size_t i = 0; i < denoised.picture.pixels.size(); i++) {
        float sum = 0;
        for (const Image& group : denoised.groups) sum += group.pixels[i];
        CHECK(sum == Approx(denoised.picture.pixels[i]).epsilon(1e-4).margin(1e-5));
    }
}

TEST_CASE("a film goes on with its groups, and refuses others") {
    const Scene scene = scene_of_groups();
    Session whole = session_of(scene, options_of(scene));
    whole.render();
    Session begun = session_of(scene, options_of(scene, 16));
    begun.render();
    Session continued = session_of(scene, options_of(scene));
    continued.restore_film(begun.keep_film());
    continued.render();
    CHECK(continued.light_groups()[2].pixels == whole.light_groups()[2].pixels);

    RenderOptions none = options_of(scene);
    none.light_groups.clear();
    Session without = session_of(scene, none);
    CHECK_THROWS_WITH(without.restore_film(begun.keep_film()), Catch::Contains("light groups"));
    CHECK(without.light_groups().empty());
    RenderOptions foreign = options_of(scene);
    foreign.light_groups = {"other", "moon"};
    CHECK_THROWS_AS(session_of(scene, foreign), InputError);
}

TEST_CASE("a material that gets another group takes its light along") {
    Scene scene = scene_of_groups();
    Session session = session_of(scene, options_of(scene));
    session.render();
    Material lamp = scene.materials[2];
    lamp.group = "fill";
    CHECK_THROWS_AS(session.set_material(2, lamp), InputError); // the film has a group "key"
    scene.materials[0].group = "key";                           // so that there still is one
    Session edited = session_of(scene, options_of(scene));
    edited.set_material(2, lamp);
    edited.render();
    scene.materials[2] = lamp;
    Session fresh = session_of(scene, options_of(scene));
    fresh.render();
    for (size_t i = 0; i < 4; i++)
        CHECK(edited.light_groups()[i].pixels == fresh.light_groups()[i].pixels);
}

} // namespace onde::test
