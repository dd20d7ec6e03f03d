// Surfaces that are one material in part and another in part.
#include "render/same_bits.h"

namespace onde::test {
namespace {

/// A floor of a dim and a bright material, under the sun.
struct Floor {
    Scene scene = doctor::floor_seen_from_above(0.2f);

    explicit Floor(float share) {
        scene.materials.push_back(
            doctor::furnace_material(MaterialKind::diffuse, glm::vec3(0.8f), 1));
        scene.materials[0].blend_with = 1;
        scene.materials[0].blend = share;
        DirectionalLight sun;
        sun.to_light = {0, 1, 0};
        sun.irradiance = glm::vec3(1);
        scene.directional_lights.push_back(sun);
    }
    double mean() const {
        RenderOptions options = small_options(16, 16, 256);
        options.depth = 2;
        const Image image = render_scene(scene, options).image;
        double sum = 0;
        for (const float value : image.pixels) sum += double(value);
        return sum / double(image.pixels.size());
    }
};

} // namespace

TEST_CASE("a blend reflects what its parts do, in their shares") {
    for (const float share : {0.0f, 0.25f, 0.9f, 1.0f}) {
        INFO("share " << share);
        CHECK(Floor(share).mean() * M_PI == Approx(0.2 + 0.6 * double(share)).margin(0.005));
    }
}

TEST_CASE("a blend's texture says where it is, and it glows as its first part does") {
    Floor floor(1);
    Texture half;
    half.name = "half";
    half.srgb = false;
    half.image.width = half.image.height = 1;
    half.image.rgba = {128, 0, 0, 255};
    floor.scene.textures = {half};
    floor.scene.materials[0].blend_texture = 0;
    CHECK(floor.mean() * M_PI == Approx(0.2 + 0.6 * 128 / 255.0).margin(0.005));
    floor.scene.directional_lights.clear();
    floor.scene.materials[0].emission = glm::vec3(3);
    floor.scene.materials[1].emission = glm::vec3(7);
    CHECK(floor.mean() == Approx(3).margin(1e-4));
}

TEST_CASE("a blend has the same bits in all engines and lanes") {
    Floor floor(0.5f);
    floor.scene.materials[1] =
        doctor::furnace_material(MaterialKind::conductor, glm::vec3(0.9f), 0.4f);
    const RenderOptions options = small_options(16, 16, 8);
    check_same_bits(floor.scene, options);
}

} // namespace onde::test
