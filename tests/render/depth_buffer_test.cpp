// The depth buffer (C1) against a rasteriser in double precision that shares nothing with it, in
// any order of the objects and by both kinds of atomics.
#include "render/pixel_check.h"
#include "render/raster_picture.h"

#include "chapter/raster_camera.h"
#include "chapter/raster_shapes.h"

namespace onde::test {
namespace {

/// Compares every pixel that is not doubtful; at most `most_doubtful` of all may be.
void check_against_reference(const Scene& scene, const Image& image, double most_doubtful) {
    PixelCheck judge(scene, image.width, image.height);
    size_t doubtful = 0, wrong = 0;
    std::string first;
    for (uint32_t y = 0; y < image.height; y++)
        for (uint32_t x = 0; x < image.width; x++) {
            const auto expected = judge.color(x, y);
            const glm::vec3 got = color_at(image, x, y);
            doubtful += !expected;
            if (!expected || got == *expected) continue;
            if (wrong++ == 0)
                first = fmt::format("pixel {},{}: red {} instead of {}", x, y, got.x, expected->x);
        }
    INFO(first << "; " << wrong << " wrong, " << doubtful << " doubtful");
    CHECK(wrong == 0);
    CHECK(double(doubtful) <= most_doubtful * image.width * image.height);
}

template <class T>
std::vector<T> permuted(const std::vector<T>& values, Generator& generator) {
    std::vector<T> result = values;
    std::ranges::shuffle(result, generator);
    return result;
}

constexpr DepthAtomics BOTH[] = {DepthAtomics::wide, DepthAtomics::narrow};

} // namespace

TEST_CASE("the depth buffer shows what a rasteriser in double precision finds nearest") {
    for (uint32_t seed : {1u, 2u, 3u}) {
        const Scene scene = random_raster_scene(seed);
        check_scene(scene);
        check_against_reference(scene, draw_depth(scene, best_depth_atomics(device().facts())),
                                0.06);
    }
}

TEST_CASE("64-bit and 32-bit atomics settle the same bits") {
    if (!device().facts().int64_atomics) return;
    const Scene scene = random_raster_scene(4);
    const auto options = raster_options(IntegratorKind::depth_buffer, 200, 150, 4);
    CHECK(first_pixel_difference(draw_depth(scene, DepthAtomics::narrow, options),
                                 draw_depth(scene, DepthAtomics::wide, options)) == "");
}

TEST_CASE("objects in any order make the same bits") {
    const Scene scene = random_raster_scene(5);
    const auto options = raster_options(IntegratorKind::depth_buffer, 200, 150);
    Generator generator(6);
    for (DepthAtomics atomics : BOTH) {
        if (atomics == DepthAtomics::wide && !device().facts().int64_atomics) continue;
        const Image expected = draw_depth(scene, atomics, options);
        for (int i = 0; i < 3; i++) {
            Scene shuffled = scene;
            shuffled.instances = permuted(scene.instances, generator);
            shuffled.spheres = permuted(scene.spheres, generator);
            CHECK(first_pixel_difference(draw_depth(shuffled, atomics, options), expected) == "");
        }
    }
}

TEST_CASE("of equally near triangles the first one is seen") {
    Scene scene = empty_raster_scene();
    for (int i = 0; i < 3; i++) add_card(scene, {-9, -9}, {9, 9}, 1, add_color(scene));
    for (DepthAtomics atomics : BOTH) {
        if (atomics == DepthAtomics::wide && !device().facts().int64_atomics) continue;
        const Image image = draw_depth(scene, atomics);
        CHECK(color_at(image, 40, 40) == scene.materials[0].base_color);
        CHECK(color_at(image, 95, 79) == scene.materials[0].base_color);
    }
}

TEST_CASE("triangles that share an edge leave no gap") {
    // A fan around a corner that lies on a pixel's centre. Gaps show the background.
    Scene scene = empty_raster_scene();
    Mesh mesh;
    mesh.positions = {{0.025f, 0.025f, 0}};
    for (int i = 0; i < 97; i++) {
        const float angle = 6.2831853f * float(i) / 97;
        mesh.positions.push_back({9 * std::cos(angle), 9 * std::sin(angle), 0});
        mesh.triangles.push_back({0, 1 + uint32_t(i), 1 + uint32_t(i + 1) % 97});
        mesh.materials.push_back(add_color(scene));
    }
    scene.meshes = {mesh};
    scene.instances = {{0, glm::mat4(1)}};
    const Image image = draw_depth(scene, DepthAtomics::narrow);
    size_t gaps = 0;
    for (uint32_t y = 0; y < image.height; y++)
        for (uint32_t x = 0; x < image.width; x++)
            gaps += color_at(image, x, y) == *scene.chapter.whitted.background;
    CHECK(gaps == 0);
}

TEST_CASE("a triangle far larger than the picture, slivers, points and what lies off the screen") {
    Scene scene = empty_raster_scene();
    add_triangle(scene, {-1e5f, -1e5f, 0}, {1e5f, -1e5f, 0}, {0, 2e5f, 0}, add_color(scene));
    add_triangle(scene, {0, 0, 1}, {1, 1, 1}, {2, 2, 1}, add_color(scene));               // no area
    add_triangle(scene, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, add_color(scene));               // a point
    add_triangle(scene, {50, 50, 1}, {51, 50, 1}, {50, 51, 1}, add_color(scene));         // beside
    add_triangle(scene, {-1, -1, 11}, {1, -1, 11}, {0, 1, 11}, add_color(scene));         // behind
    add_triangle(scene, {-1, -1, 0.5f}, {1, 0.9f, 0.5f}, {1, 1, 0.5f}, add_color(scene)); // thin
    scene.spheres = {{{0, 0, 12}, 1, add_color(scene)}, {{40, 0, 0}, 1, add_color(scene)}};
    check_scene(scene);
    for (DepthAtomics atomics : BOTH) {
        if (atomics == DepthAtomics::wide && !device().facts().int64_atomics) continue;
        check_against_reference(scene, draw_depth(scene, atomics), 0.05);
    }
}

TEST_CASE("inside a ball its far half is seen") {
    Scene scene = empty_raster_scene();
    scene.spheres = {{{0, 0, 10}, 5, add_color(scene)}};
    const Image image = draw_depth(scene, DepthAtomics::narrow);
    CHECK(color_at(image, 0, 0) == scene.materials[0].base_color);
    CHECK(color_at(image, 48, 40) == scene.materials[0].base_color);
}

TEST_CASE("a scene without anything shows the background") {
    Scene scene = empty_raster_scene();
    CHECK(color_at(draw_depth(scene, DepthAtomics::narrow), 3, 4) ==
          *scene.chapter.whitted.background);
}

TEST_CASE("a pixel is the mean of its samples") {
    Scene scene = empty_raster_scene();
    scene.chapter.whitted.background = glm::vec3(0);
    const uint32_t white = add_color(scene);
    scene.materials[white].base_color = glm::vec3(1);
    add_card(scene, {-9, -9}, {0.0125f, 9}, 0, white); // ends a quarter into pixel 48
    const Image image = draw_depth(scene, DepthAtomics::narrow,
                                   raster_options(IntegratorKind::depth_buffer, 96, 80, 64));
    CHECK(color_at(image, 47, 40).x == 1.0f);
    CHECK(std::abs(color_at(image, 48, 40).x - 0.25f) <= 1.0f / 32);
    CHECK(color_at(image, 49, 40).x == 0.0f);
}

TEST_CASE("textures are read where the triangle's coordinates say") {
    Scene scene = empty_raster_scene();
    const uint32_t material = add_color(scene);
    Texture texture;
    texture.image = {2, 1, {255, 0, 0, 255, 0, 255, 0, 255}};
    texture.wrap_u = texture.wrap_v = Wrap::clamp;
    scene.textures = {texture};
    scene.materials[material].base_color = glm::vec3(0.5f);
    scene.materials[material].base_color_texture = 0;
    add_card(scene, {-2.4f, -2}, {2.4f, 2}, 0, material);
    for (Mesh& mesh : scene.meshes)
        for (const glm::vec3& p : mesh.positions)
            mesh.uvs.push_back({(p.x + 2.4f) / 4.8f, (2 - p.y) / 4});
    scene.spheres = {{{0, 0, 1}, 0.5f, material}};
    const Image image = draw_depth(scene, DepthAtomics::narrow);
    CHECK(color_at(image, 2, 3) == glm::vec3(0.5f, 0, 0)); // beyond the outer texels' centres
    CHECK(color_at(image, 93, 70) == glm::vec3(0, 0.5f, 0));
    const glm::vec3 quarter = color_at(image, 36, 5); // u = 36.5 / 96
    CHECK(std::abs(quarter.y - 0.5f * (2 * 36.5f / 96 - 0.5f)) < 1e-5f);
    CHECK(color_at(image, 48, 40) == glm::vec3(0.5f)); // a ball has no coordinates
    const PackedRaster packed = pack_raster(scene, scene.cameras[0], small_options(96, 80, 1));
    REQUIRE(packed.notes.size() == 1);
    CHECK(packed.notes[0].find("textures of 1 spheres were ignored") != std::string::npos);
}

TEST_CASE("a perspective camera sees as much at the scene's centre, and says so") {
    const auto middle_card = [] {
        Scene scene = empty_raster_scene();
        add_card(scene, {-1, -1}, {1, 1}, 0, add_color(scene));
        return scene;
    };
    Scene by_angle = middle_card(), by_screen = middle_card();
    by_angle.cameras[0].orthographic_height.reset(); // at distance 10, the height is 4
    by_angle.cameras[0].vertical_fov = 2 * std::atan(0.2f);
    by_screen.cameras[0].orthographic_height.reset();
    by_screen.cameras[0].screen = ScreenWindow{{0.96f, 0.8f}, 2, std::nullopt};
    const Image expected = draw_depth(middle_card(), DepthAtomics::narrow);
    for (const Scene& scene : {by_angle, by_screen}) {
        CHECK(first_pixel_difference(draw_depth(scene, DepthAtomics::narrow), expected) == "");
        const PackedRaster packed = pack_raster(scene, scene.cameras[0], small_options(96, 80, 1));
        REQUIRE(packed.notes.size() == 1);
        CHECK(packed.notes[0].find("sees 4 units") != std::string::npos);
    }
}

TEST_CASE("without a background of its own a scene shows what its environment has ahead") {
    Scene scene = empty_raster_scene();
    scene.chapter.whitted.background.reset();
    scene.environment.radiance = glm::vec3(0.5f, 1, 2);
    CHECK(color_at(draw_depth(scene, DepthAtomics::narrow), 9, 9) == glm::vec3(0.5f, 1, 2));
    Image map(4, 2, 3);
    map.pixels.assign(map.pixels.size(), 0.0f);
    for (size_t row = 0; row < 2; row++) map.pixels[(row * 4 + 2) * 3] = 3; // just right of -Z
    scene.environment.map = map;
    scene.cameras[0] = camera_at({0, 0, 10}, {0.1f, 0.1f, 0}, 0.7f);
    scene.cameras[0].orthographic_height = 4;
    CHECK(raster_background(scene, scene.cameras[0]) == glm::vec3(1.5f, 0, 0));
}

TEST_CASE("a scene that reaches too far for exact arithmetic is refused with its reach") {
    Scene scene = empty_raster_scene();
    add_triangle(scene, {0, 0, 0}, {1e9f, 0, 0}, {0, 1e9f, 0}, add_color(scene));
    REQUIRE_THROWS_WITH(pack_raster(scene, scene.cameras[0], small_options(96, 80, 1)),
                        Catch::Matchers::Contains("2e+10 pixels"));
    scene.meshes[0].positions = {{0, 0, 0}, {1e6f, 0, 0}, {0, 1e6f, 0}}; // with fewer sub-pixels
    CHECK(pack_raster(scene, scene.cameras[0], small_options(96, 80, 1)).record.subpixels == 16);
    const Image image = draw_depth(scene, DepthAtomics::narrow);
    CHECK(color_at(image, 60, 20) == scene.materials[0].base_color);
    CHECK(color_at(image, 40, 20) == *scene.chapter.whitted.background);
}

TEST_CASE("a render that is stopped keeps whole samples only") {
    const Scene scene = random_raster_scene(8);
    const DeviceScene placed = place_on_device(scene);
    const RenderOptions options = raster_options(IntegratorKind::depth_buffer, 96, 80, 8);
    const auto integrator = make_depth_buffer(
        {programs(), &scene, placed, scene.cameras[0], options, nullptr}, DepthAtomics::narrow);
    integrator->render_pass(0, 8, [](double share) { return share < 0.25; });
    const std::vector<cl_float4> sums = integrator->film().sums().read(device());
    for (const cl_float4& sum : sums) REQUIRE(sum.s[3] == 2);
}

TEST_CASE("analytic shapes are drawn as fine meshes on their surfaces") {
    const auto distance = [](const Shape& shape, glm::dvec3 p) {
        const double ring = std::hypot(p.x, p.z);
        switch (shape.kind) {
        case ShapeKind::sphere:
            return glm::length(p) - 1;
        case ShapeKind::disk:
            return std::max(std::abs(p.y), ring - 1);
        case ShapeKind::cylinder:
            return std::max(ring - 1, std::abs(p.y) - 1);
        case ShapeKind::cone:
            return std::max(ring + p.y - 1, -p.y);
        default:
            return std::hypot(ring - 1, p.y) - double(shape.minor_radius);
        }
    };
    for (ShapeKind kind : {ShapeKind::sphere, ShapeKind::disk, ShapeKind::cylinder, ShapeKind::cone,
                           ShapeKind::torus}) {
        Shape shape;
        shape.kind = kind;
        const Mesh mesh = shape_mesh(shape);
        double worst = 0, volume = 0;
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
            for (const glm::dvec3& p : {a, b, c})
                if (kind != ShapeKind::disk) worst = std::max(worst, std::abs(distance(shape, p)));
            volume += glm::dot(a, glm::cross(b, c)) / 6; // above 0 where fronts look outward
        }
        constexpr double EXPECTED[] = {4 * M_PI / 3, 0, 2 * M_PI, M_PI / 3, 2 * M_PI * M_PI / 16};
        INFO("kind " << int(kind) << ", volume " << volume << ", off by " << worst);
        CHECK(worst < 1e-6);
        CHECK(std::abs(volume - EXPECTED[int(kind)]) <= 1e-3 * EXPECTED[int(kind)]);
    }
}

TEST_CASE("shapes lie in the picture where they are placed") {
    Scene scene = empty_raster_scene();
    Shape ball;
    ball.material = add_color(scene);
    ball.object_to_world[3] = glm::vec4(1, 0.5f, 2, 1);
    scene.shapes = {ball};
    Scene sphere = scene;
    sphere.shapes.clear();
    sphere.spheres = {{{1, 0.5f, 2}, 1, ball.material}};
    const Image a = draw_depth(scene, DepthAtomics::narrow);
    const Image b = draw_depth(sphere, DepthAtomics::narrow);
    size_t covered = 0, different = 0;
    for (uint32_t y = 0; y < a.height; y++)
        for (uint32_t x = 0; x < a.width; x++) {
            covered += color_at(b, x, y) != *scene.chapter.whitted.background;
            different += color_at(a, x, y) != color_at(b, x, y);
        }
    CHECK(covered > 1000);
    CHECK(different <= 2);
}

} // namespace onde::test
