// The painter's algorithm (C2) beside the depth buffer: the same where objects can be sorted, wrong
// where they interlace; and blending against its closed form.
#include "chapter/raster_painter.h"
#include "render/raster_picture.h"
#include "support/folders.h"

namespace onde::test {
namespace {

struct Painting {
    Image image;
    PaintCounts counts;
};

Painting paint(const Scene& scene,
               const RenderOptions& options = raster_options(IntegratorKind::painter),
               uint32_t most_entries = MOST_TILE_ENTRIES) {
    check_scene(scene);
    const DeviceScene placed = place_on_device(scene);
    const auto painter = make_painter(
        {programs(), &scene, placed, scene.cameras[0], options, nullptr}, most_entries);
    const Image image = take_picture(*painter, options).image;
    return {image, painter->counts()};
}

void make_translucent(Scene& scene, uint32_t material, float transmission) {
    scene.materials[material].kind = MaterialKind::phong;
    scene.chapter.phong[material].transmission = transmission;
}

Scene chapter_scene(const char* name) {
    return load_scene(std::filesystem::path(in_project("scenes/chapter")) / name);
}

/// Pixels of a rectangle that differ.
size_t count_differences(const Image& a, const Image& b, glm::uvec2 low, glm::uvec2 high) {
    size_t count = 0;
    for (uint32_t y = low.y; y < high.y; y++)
        for (uint32_t x = low.x; x < high.x; x++) count += color_at(a, x, y) != color_at(b, x, y);
    return count;
}

} // namespace

TEST_CASE("on the chapter's objects the painter is right on the left and wrong on the right") {
    const Scene scene = chapter_scene("painter.toml");
    CHECK(scene.settings.integrator == IntegratorKind::painter);
    const auto options = [](IntegratorKind kind) { return raster_options(kind, 640, 320); };
    const Image painted = paint(scene, options(IntegratorKind::painter)).image;
    const Image right = draw_depth(scene, best_depth_atomics(device().facts()),
                                   options(IntegratorKind::depth_buffer));
    // The group that can be sorted.
    CHECK(first_pixel_difference(painted, right).empty() == false);
    CHECK(count_differences(painted, right, {0, 0}, {250, 320}) == 0);
    // The sheets: two triangles with legs of 80 and 20 pixels, exact but for their 82-pixel edges.
    const size_t sheets = count_differences(painted, right, {370, 30}, {590, 130});
    INFO(sheets << " pixels of the sheets differ");
    CHECK(std::abs(double(sheets) - 1600) <= 84);
    CHECK(count_differences(painted, right, {400, 60}, {480, 100}) * 2 <= sheets + 42);
    // The bars: two of their three crossings can come out right, never all.
    CHECK(count_differences(painted, right, {370, 150}, {590, 320}) > 60);
    // The half transparent sheet: 0.75 x 0.4 units of it lie over the card, the rest on nothing.
    CHECK(count_differences(painted, right, {252, 230}, {368, 320}) == 60 * 28);
}

TEST_CASE("opaque cards and balls in layers: painter and depth buffer make the same bits") {
    Scene scene = empty_raster_scene();
    Generator generator(3);
    for (int layer = 0; layer < 40; layer++) {
        const float z = 0.2f * float((layer * 17) % 40) - 5;
        const glm::vec3 at = random_vector(generator, 2);
        if (layer % 4 == 0)
            scene.spheres.push_back(
                {{at.x, at.y, z}, 0.09f + 0.01f * unit(generator), add_color(scene)});
        else
            add_card(scene, glm::vec2(at) - 0.5f, glm::vec2(at) + 0.5f, z, add_color(scene));
    }
    const Painting painting = paint(scene, raster_options(IntegratorKind::painter, 200, 150, 2));
    const Image expected = draw_depth(scene, DepthAtomics::narrow,
                                      raster_options(IntegratorKind::depth_buffer, 200, 150, 2));
    CHECK(first_pixel_difference(painting.image, expected) == "");
}

TEST_CASE("sheets blend by over, the nearest last, and every one of them is counted") {
    Scene scene = empty_raster_scene();
    glm::dvec3 expected(*scene.chapter.whitted.background);
    constexpr int SHEETS = 9;
    for (int i = 0; i < SHEETS; i++) {
        const uint32_t material = add_color(scene);
        const float transmission = float(i + 1) / 10;
        make_translucent(scene, material, transmission);
        add_card(scene, {-9, -9}, {9, 9}, float(i) - 4, material); // far to near
        expected = double(transmission) * expected +
                   (1 - double(transmission)) * glm::dvec3(scene.materials[material].base_color);
    }
    std::ranges::reverse(scene.instances); // the order of the scene must not matter
    const Painting painting = paint(scene);
    double worst = 0;
    for (uint32_t y = 0; y < 80; y++)
        for (uint32_t x = 0; x < 96; x++)
            worst =
                std::max(worst, glm::length(glm::dvec3(color_at(painting.image, x, y)) - expected));
    CHECK(worst < 1e-6);
    CHECK(painting.counts.fragments == uint64_t(SHEETS) * 96 * 80);
    CHECK(painting.counts.covered == 96 * 80);
}

TEST_CASE("translucent triangles that share edges cover no pixel twice") {
    Scene scene = empty_raster_scene();
    const uint32_t material = add_color(scene);
    make_translucent(scene, material, 0.5f);
    Mesh mesh;
    mesh.positions = {{0.025f, 0.025f, 0}}; // a pixel's centre
    for (uint32_t i = 0; i < 64; i++) {
        const float angle = 6.2831853f * float(i) / 64; // some edges run through many centres
        mesh.positions.push_back({9 * std::cos(angle), 9 * std::sin(angle), 0});
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 64});
        mesh.materials.push_back(material);
    }
    scene.meshes = {mesh};
    scene.instances = {{0, glm::mat4(1)}};
    const Painting painting = paint(scene);
    CHECK(painting.counts.fragments == 96 * 80);
    CHECK(painting.counts.covered == 96 * 80);
}

TEST_CASE("both halves of a translucent ball are blended") {
    Scene scene = empty_raster_scene();
    const uint32_t material = add_color(scene);
    make_translucent(scene, material, 0.25f);
    scene.spheres = {{{0, 0, 0}, 1, material}};
    const Painting painting = paint(scene);
    const glm::vec3 expected = 0.9375f * scene.materials[material].base_color +
                               0.0625f * *scene.chapter.whitted.background;
    CHECK(glm::length(color_at(painting.image, 48, 40) - expected) < 1e-6f);
    CHECK(painting.counts.fragments == 2 * painting.counts.covered);
    CHECK(std::abs(double(painting.counts.covered) - M_PI * 20 * 20) < 30);
}

TEST_CASE(
    "more primitives than the lists have room for are painted in groups, with the same bits") {
    Scene scene = random_raster_scene(7);
    for (uint32_t m = 0; m < scene.materials.size(); m++) make_translucent(scene, m, 0.3f);
    const RenderOptions options = raster_options(IntegratorKind::painter, 200, 150, 2);
    const Painting at_once = paint(scene, options), in_groups = paint(scene, options, 13);
    CHECK(first_pixel_difference(in_groups.image, at_once.image) == "");
    CHECK(in_groups.counts.fragments == at_once.counts.fragments);
    CHECK(at_once.counts.fragments > at_once.counts.covered);
}

} // namespace onde::test
