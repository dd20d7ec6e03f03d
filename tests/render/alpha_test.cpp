// Surfaces that rays pass: by their alpha, and backs that cameras see through.
#include "render/light_picture.h"
#include "render/variants.h"

namespace onde::test {
namespace {

Material unlit(glm::vec3 color, AlphaMode mode = AlphaMode::opaque, float alpha = 1) {
    Material material;
    material.kind = MaterialKind::unlit;
    material.base_color = color;
    material.alpha_mode = mode;
    material.alpha = alpha;
    return material;
}

const glm::vec3 RED(0.8f, 0.1f, 0.2f), GREEN(0.1f, 0.6f, 0.3f), BLUE(0.2f, 0.3f, 0.9f);

/// A square about the Z axis with its front toward +Z, turned about X. Rows of triangles keep most
/// rays away from edges.
void add_square(Scene& scene, float z, float half, const Material& material, float turn = 0) {
    Mesh mesh;
    for (const glm::vec2 p : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        mesh.positions.push_back(half * glm::vec3(p.x, p.y * std::cos(turn), p.y * std::sin(turn)) +
                                 glm::vec3(0, 0, z));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto index = uint32_t(scene.materials.size());
    mesh.materials = {index, index};
    scene.materials.push_back(material);
    scene.instances.push_back({uint32_t(scene.meshes.size()), glm::mat4(1)});
    scene.meshes.push_back(mesh);
}

/// A camera on the Z axis that sees the middle of the squares.
Scene empty_scene() {
    Scene scene;
    scene.cameras = {camera_at({0.01f, 0.02f, 4}, {0, 0, 0}, 0.1f)};
    return scene;
}

glm::dvec3 mean_of(const Image& image) {
    glm::dvec3 sum(0);
    for (size_t i = 0; i < image.pixels.size(); i++)
        sum[glm::length_t(i % image.channels)] += image.pixels[i];
    return sum / (double(image.pixels.size()) / image.channels);
}

void check_mean(const Scene& scene, glm::vec3 wanted, double bound, uint32_t samples = 64) {
    const glm::dvec3 mean = mean_of(render_scene(scene, small_options(16, 16, samples)).image);
    INFO("(" << mean.x << ", " << mean.y << ", " << mean.z << ") instead of (" << wanted.x << ", "
             << wanted.y << ", " << wanted.z << ")");
    CHECK(glm::length(mean - glm::dvec3(wanted)) < bound);
}

} // namespace

TEST_CASE("an unlit surface shows its colour, and lights nothing") {
    Scene scene = empty_scene();
    add_square(scene, 0, 1, unlit(GREEN));
    check_mean(scene, GREEN, 1e-5, 1);
    CHECK(pack_scene(scene).lights.empty());
}

TEST_CASE("blended surfaces let through what their alphas leave, in their order") {
    Scene scene = empty_scene();
    add_square(scene, 0, 1, unlit(GREEN));
    add_square(scene, 1, 1, unlit(RED, AlphaMode::blend, 0.25f));
    add_square(scene, 0.5f, 1, unlit(BLUE, AlphaMode::blend, 0.5f));
    check_mean(scene, 0.25f * RED + 0.75f * (0.5f * BLUE + 0.5f * GREEN), 2e-3);
}

TEST_CASE("masks are there where the alpha reaches the cutoff, and else not at all") {
    for (const float alpha : {0.29f, 0.3f}) {
        Scene scene = empty_scene();
        Material mask = unlit(RED, AlphaMode::mask, alpha);
        mask.alpha_cutoff = 0.3f;
        add_square(scene, 1, 1, mask);
        add_square(scene, 0, 1, unlit(GREEN));
        check_mean(scene, alpha < 0.3f ? GREEN : RED, 1e-5, 1);
    }
}

TEST_CASE("of surfaces in one plane each is passed by itself, whichever comes first") {
    const Material gone = unlit(RED, AlphaMode::mask, 0);
    for (const float turn : {0.0f, 0.7f})
        for (const uint32_t before : {0u, 1u, 2u, 3u}) {
            INFO(before << " clear squares before the green one, turned by " << turn);
            Scene scene = empty_scene();
            for (uint32_t i = 0; i < 3; i++) {
                if (i == before) add_square(scene, 0, 1, unlit(GREEN), turn);
                add_square(scene, 0, 1, gone, turn);
            }
            if (before == 3) add_square(scene, 0, 1, unlit(GREEN), turn);
            add_square(scene, -1, 3, unlit(BLUE));
            check_mean(scene, GREEN, 1e-5, 1);
        }
}

TEST_CASE("the alpha of a texture and of vertices count, interpolated") {
    Scene scene = empty_scene();
    add_square(scene, 0, 1, unlit(GREEN));
    Material veil = unlit(glm::vec3(1), AlphaMode::blend, 0.8f);
    veil.base_color_texture = 0;
    add_square(scene, 1, 1, veil);
    Texture texture;
    texture.image = {1, 1, {255, 0, 0, 128}};
    scene.textures.push_back(texture);
    scene.meshes[1].uvs.assign(4, glm::vec2(0.5f));
    scene.meshes[1].colors.assign(4, glm::vec4(0.5f, 1, 1, 0.5f));
    const float alpha = 0.8f * 128 / 255 * 0.5f;
    check_mean(scene, alpha * glm::vec3(0.5f, 0, 0) + (1 - alpha) * GREEN, 2e-3);
}

TEST_CASE("light comes through blended surfaces in proportion") {
    const auto lit_floor = [](uint32_t sheets) {
        Scene scene = empty_scene();
        Material white;
        white.base_color = glm::vec3(0.8f);
        add_square(scene, 0, 1, white);
        for (uint32_t i = 0; i < sheets; i++) {
            Material dark; // reflects nothing
            dark.base_color = glm::vec3(0);
            dark.alpha_mode = AlphaMode::blend;
            dark.alpha = 0.3f;
            add_square(scene, 5.0f + float(i), 3, dark);
        }
        scene.point_lights.push_back({});
        scene.point_lights[0].position = {0, 0, 9};
        scene.point_lights[0].intensity = glm::vec3(50);
        return mean_of(render_scene(scene, small_options(16, 16, 16)).image).x;
    };
    const double open = lit_floor(0);
    CHECK(open > 0.1);
    CHECK(lit_floor(1) == Approx(0.7 * open).epsilon(1e-4));
    CHECK(lit_floor(3) == Approx(0.343 * open).epsilon(1e-4));
}

TEST_CASE("cameras see through the backs of one-sided surfaces, and light does not") {
    const auto picture = [](bool double_sided, bool from_behind, float intensity = 50) {
        Scene scene = empty_scene();
        Material white;
        white.base_color = glm::vec3(0.8f);
        add_square(scene, 0, 1, white); // the floor, which faces the camera and the light
        Material cover = unlit(RED);
        cover.double_sided = double_sided;
        add_square(scene, 2, 1, cover, from_behind ? glm::radians(180.0f) : 0.0f);
        scene.point_lights.push_back({});
        scene.point_lights[0].position = {0, 0, 9};
        scene.point_lights[0].intensity = glm::vec3(intensity);
        return mean_of(render_scene(scene, small_options(16, 16, 4)).image);
    };
    CHECK(glm::length(picture(false, false) - glm::dvec3(RED)) < 1e-5);
    CHECK(glm::length(picture(true, true) - glm::dvec3(RED)) < 1e-5);
    // The floor in the cover's shadow shows the cover's colour alone.
    CHECK(glm::length(picture(false, true) - picture(false, true, 1e-9f)) < 1e-5);
}

/// Everything of this file in one scene.
static Scene crowded() {
    Scene scene = empty_scene();
    Material white;
    white.base_color = glm::vec3(0.7f);
    add_square(scene, -0.5f, 3, white);
    Material leaf = white;
    leaf.alpha_mode = AlphaMode::mask;
    leaf.base_color_texture = 0;
    add_square(scene, 0.3f, 0.2f, leaf, 0.4f);
    Texture texture;
    texture.image = {2, 2, {255, 90, 0, 255, 0, 255, 90, 0, 90, 0, 255, 0, 255, 255, 255, 255}};
    texture.filter = TextureFilter::nearest;
    texture.uv_set = 1;
    texture.transform = {{0.1f, 0.2f}, 0.3f, {3, 2}};
    scene.textures.push_back(texture);
    scene.meshes[1].more_uvs = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    Material veil = white;
    veil.alpha_mode = AlphaMode::blend;
    veil.alpha = 0.4f;
    add_square(scene, 0.5f, 0.15f, veil, -0.3f);
    scene.meshes[2].colors.assign(4, glm::vec4(0.2f, 0.9f, 0.4f, 0.7f));
    Material back = white;
    back.double_sided = false;
    add_square(scene, 0.7f, 0.1f, back, 3.0f);
    Material lamp = white;
    lamp.emission = glm::vec3(20);
    lamp.alpha_mode = AlphaMode::blend;
    lamp.alpha = 0.6f;
    add_square(scene, 2, 0.5f, lamp, 3.1f);
    scene.instances[4].object_to_world[3] = glm::vec4(0.8f, 0.8f, 0, 1);
    return scene;
}

TEST_CASE("every engine, width and launch passes the same surfaces") {
    const Scene scene = crowded();
    const DeviceScene placed = place_on_device(scene);
    for (const IntegratorKind kind :
         {IntegratorKind::path, IntegratorKind::light, IntegratorKind::whitted}) {
        RenderOptions options = small_options(40, 28, 4);
        options.integrator = kind;
        const Image expected = render_by(scene, placed, apply(options, VARIANTS[1])).image;
        for (const Variant& variant : VARIANTS) {
            const bool quick = variant.width == 8 && !variant.interleaved;
            if (kind != IntegratorKind::path && !quick) continue;
            INFO(word_of(kind) << ", " << variant.name);
            const Picture picture = render_by(scene, placed, apply(options, variant));
            CHECK(first_difference(expected, picture.image) == "");
            CHECK(picture.invalid.count == 0);
        }
    }
}

TEST_CASE("paths from the camera and from the light pass alike") {
    Scene scene = crowded();
    RenderOptions options = small_options(24, 24, 256);
    options.depth = 4;
    const DeviceScene placed = place_on_device(scene);
    const glm::dvec3 paths = mean_of(render_by(scene, placed, options).image);
    options.integrator = IntegratorKind::light;
    const glm::dvec3 light = mean_of(render_by(scene, placed, options).image);
    INFO("from the camera " << paths.x << ", from the light " << light.x);
    CHECK(paths.x > 0.01);
    CHECK(light.x == Approx(paths.x).epsilon(0.02));
    CHECK(light.y == Approx(paths.y).epsilon(0.02));
}

} // namespace onde::test
