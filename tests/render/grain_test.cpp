// Where the grain of a surface lies: by its texture coordinates, by its turn, by its texture.
#include "render/same_bits.h"

namespace onde::test {
namespace {

/// A metal floor that shows the sun, seen from above at 45 degrees in both planes.
struct Floor {
    Scene scene = doctor::floor_seen_from_above(0.9f);

    explicit Floor(glm::vec2 u_along = {1, 0}) {
        Material& m = scene.materials[0];
        m.kind = MaterialKind::conductor;
        m.roughness = 0.3f;
        m.anisotropy = 0.7f;
        Mesh& floor = scene.meshes[0];
        for (const glm::vec3& p :
             floor.positions) // u grows in the plane, v downward in the picture
            floor.uvs.emplace_back(glm::dot(u_along, glm::vec2(p.x, p.z)),
                                   glm::dot(glm::vec2(-u_along.y, u_along.x), glm::vec2(p.x, p.z)));
        DirectionalLight sun;
        sun.to_light = glm::normalize(glm::vec3(0.6f, 1, 0));
        sun.irradiance = glm::vec3(1);
        scene.directional_lights.push_back(sun);
    }
    float seen() const {
        RenderOptions options = small_options(8, 8, 1);
        options.depth = 2;
        return render_scene(scene, options).image.pixels[0];
    }
};

Texture one_texel(uint8_t red, uint8_t green, uint8_t blue) {
    Texture texture;
    texture.name = "grain";
    texture.srgb = false;
    texture.image.width = texture.image.height = 1;
    texture.image.rgba = {red, green, blue, 255};
    return texture;
}

} // namespace

TEST_CASE("the grain is rough where the texture's u grows, and turns counter-clockwise") {
    const float along = Floor().seen();
    Floor turned;
    turned.scene.materials[0].anisotropy_rotation = float(M_PI / 2);
    const float across = turned.seen();
    // The half vector leans along x: far out on the rough flank, past the end of the smooth one.
    CHECK(along > 3 * across);
    CHECK(Floor({0, 1}).seen() == Approx(across).epsilon(1e-3));

    // 45 degrees either way lean to the sun alike, 30 and 60 do not.
    const auto at = [](double degrees, float light_z) {
        Floor floor;
        floor.scene.materials[0].anisotropy_rotation = float(glm::radians(degrees));
        floor.scene.directional_lights[0].to_light = glm::normalize(glm::vec3(0.6f, 1, light_z));
        return floor.seen();
    };
    CHECK(at(45, 0) == Approx(at(-45, 0)).epsilon(0.02));
    CHECK(at(30, 0) > 1.1f * at(60, 0));
    // Seen from above, v grows toward +z, so that counter-clockwise about +y is from +x to -z.
    CHECK(at(40, -0.5f) > 1.1f * at(-40, -0.5f));
}

TEST_CASE("a texture turns the grain by red and green, and weakens it by blue") {
    Floor plain, textured;
    textured.scene.textures = {one_texel(128, 255, 255)};
    textured.scene.materials[0].anisotropy_texture = 0;
    plain.scene.materials[0].anisotropy_rotation = float(M_PI / 2);
    CHECK(textured.seen() == Approx(plain.seen()).epsilon(0.02));
    Floor weak, none;
    weak.scene.textures = {one_texel(255, 128, 0)};
    weak.scene.materials[0].anisotropy_texture = 0;
    none.scene.materials[0].anisotropy = 0;
    CHECK(weak.seen() == Approx(none.seen()).epsilon(1e-4));
}

TEST_CASE("a grain has the same bits in all engines and lanes") {
    Floor floor;
    floor.scene.spheres.push_back({{0, 0.1f, 0}, 0.05f, 0});
    RenderOptions options = small_options(16, 16, 4);
    check_same_bits(floor.scene, options);
}

} // namespace onde::test
