// What the chapter's formulas say about a picture, measured in the picture.
#include "render/picture.h"
#include "scene/shapes.h"

#include <fmt/format.h>

namespace onde::test {
namespace {

uint32_t add_material(Scene& scene, Phong phong, glm::vec3 color = glm::vec3(1.0f),
                      float ior = 1.5f) {
    Material material;
    material.kind = MaterialKind::phong;
    material.base_color = color;
    material.ior = ior;
    scene.chapter.phong[uint32_t(scene.materials.size())] = phong;
    scene.materials.push_back(material);
    return uint32_t(scene.materials.size() - 1);
}

void add_mesh(Scene& scene, Mesh mesh) {
    scene.instances.push_back({uint32_t(scene.meshes.size()), glm::mat4(1.0f)});
    scene.meshes.push_back(std::move(mesh));
}

void add_rectangle(Scene& scene, glm::vec3 corner, glm::vec3 edge1, glm::vec3 edge2,
                   uint32_t material) {
    add_mesh(scene, rectangle_mesh(corner, edge1, edge2, material));
}

/// Nothing but its own colour; what is seen of it is that.
Phong glowing() {
    return {.ambient = 1, .diffuse = 0, .specular = 0};
}
Phong black() {
    return {.ambient = 0, .diffuse = 0, .specular = 0};
}

/// A scene with ambient light 1, so that the colour of a glowing() surface is seen as it is.
Scene lit_by_ambience() {
    Scene scene;
    scene.chapter.whitted.ambient = glm::vec3(1.0f);
    scene.chapter.whitted.background = glm::vec3(0.0f);
    return scene;
}

/// Parallel rays along -Z from z = distance; `width` is that of the view.
Camera parallel_rays(float width, float distance) {
    Camera camera = camera_at({0, 0, distance}, {0, 0, 0}, 1.0f);
    camera.orthographic_height = width;
    return camera;
}

RenderOptions options_of(uint32_t width, uint32_t height, uint32_t samples = 1) {
    RenderOptions options = small_options(width, height, samples);
    options.integrator = IntegratorKind::whitted;
    return options;
}

Image whitted(Scene scene, const RenderOptions& options) {
    complete_scene(scene);
    check_scene(scene);
    return render_scene(scene, options).image;
}

/// Where along x the edge between dark and bright lies in a row of the picture, in pixels.
double edge_position(const Image& image, uint32_t row) {
    double bright = 0;
    for (uint32_t x = 0; x < image.width; x++) bright += image.pixel(x, row)[0] > 0.5f;
    return image.width - bright;
}

} // namespace

TEST_CASE("the parts of Phong's formula have their closed forms") {
    // A floor seen straight from above by parallel rays, lit by a point at height 1.
    Scene scene;
    scene.chapter.whitted.background = glm::vec3(0.0f);
    scene.chapter.whitted.ambient = glm::vec3(0.125f);
    const Phong phong{.ambient = 1, .diffuse = 0.5f, .specular = 0.25f, .exponent = 5};
    add_rectangle(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0},
                  add_material(scene, phong, {0.5f, 1, 0.25f}));
    scene.point_lights.push_back({{0, 0, 1}, {}});
    scene.chapter.intensities.point_lights[0] = glm::vec3(0.5f);
    scene.cameras.push_back(parallel_rays(3.0f, 5.0f));
    const Image image = whitted(scene, options_of(65, 65));
    for (uint32_t y = 0; y < 65; y++)
        for (uint32_t x = 0; x < 65; x++) {
            const double px = (x + 0.5) / 65 * 3 - 1.5, py = 1.5 - (y + 0.5) / 65 * 3;
            const double cosine = 1 / std::sqrt(1 + px * px + py * py); // of l, and of r with v
            const double light = 0.125 + 0.5 * (0.5 * cosine + 0.25 * std::pow(cosine, 5));
            INFO(x << "," << y);
            REQUIRE(image.pixel(x, y)[0] == Approx(0.5 * light).epsilon(1e-5));
            REQUIRE(image.pixel(x, y)[1] == Approx(light).epsilon(1e-5));
            REQUIRE(image.pixel(x, y)[2] == Approx(0.25 * light).epsilon(1e-5));
        }
}

TEST_CASE("a penumbra behind a half-plane is the visible share of the source") {
    // A floor at z = 0, a half-plane x < 0 at z = 1, a source of side 1 at z = 2: the floor's point
    // x sees the source's points above 2 * 0 - x, a share of clamp(1/2 + x, 0, 1).
    Scene scene;
    scene.chapter.whitted.background = glm::vec3(0.0f);
    scene.chapter.whitted.ambient = glm::vec3(0.0f);
    const Phong floor{.ambient = 0, .diffuse = 0, .specular = 1, .exponent = 0}; // no cosine
    add_rectangle(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, add_material(scene, floor));
    const uint32_t dark = add_material(scene, black());
    add_rectangle(scene, {-9, -9, 1}, {9, 0, 0}, {0, 18, 0}, dark);
    AreaLight light;
    light.position = {-0.5f, -0.5f, 2};
    light.edge1 = {0, 1, 0};
    light.edge2 = {1, 0, 0}; // shines toward -Z
    light.samples = 64;
    light.material = dark;
    light.intensity = glm::vec3(1.0f);
    scene.chapter.area_lights.push_back(light);
    // From below the half-plane: an oblique view of the floor by parallel rays is not needed, since
    // the camera may stand between floor and half-plane.
    scene.cameras.push_back(parallel_rays(1.5f, 0.5f));
    const Image image = whitted(scene, options_of(61, 61, 16));
    double worst = 0;
    for (uint32_t x = 0; x < 61; x++) {
        const double at = (x + 0.5) / 61 * 1.5 - 0.75;
        const double share = std::clamp(0.5 + at, 0.0, 1.0);
        worst = std::max(worst, std::abs(image.pixel(x, 30)[0] - share));
    }
    CHECK(worst < 0.01);
    CHECK(image.pixel(5, 30)[0] == 0.0f); // umbra
    CHECK(image.pixel(55, 30)[0] == Approx(1.0f).epsilon(1e-5));
}

TEST_CASE("a chain of mirrors has the product of their factors, in both conventions") {
    // The ray goes down, is turned to +X, up and back to +X by mirrors at 45 degrees, and meets a
    // glowing wall.
    for (const bool by_source : {false, true}) {
        Scene scene = lit_by_ambience();
        scene.chapter.whitted.reflectivity =
            by_source ? Reflectivity::source : Reflectivity::surface;
        const float factors[] = {0.5f, 0.75f, 0.875f};
        const auto mirror = [&](glm::vec3 center, glm::vec3 tilt, float factor) {
            Phong phong = black();
            phong.reflection = factor;
            add_rectangle(scene, center - 0.5f * tilt - glm::vec3(0, 0.5f, 0), tilt, {0, 1, 0},
                          add_material(scene, phong));
        };
        mirror({0, 0, 0}, {1, 0, 1}, factors[0]);    // -Z to -X ... and so on around a square
        mirror({-3, 0, 0}, {1, 0, 1}, factors[1]);   // -X back to -Z
        mirror({-3, 0, -3}, {-1, 0, 1}, factors[2]); // -Z to +X
        Phong wall = glowing();
        wall.reflection = 1;
        add_rectangle(scene, {3, -1, -4}, {0, 0, 2}, {0, 2, 0}, add_material(scene, wall));
        scene.cameras.push_back(parallel_rays(0.25f, 2.0f));
        RenderOptions options = options_of(5, 5);
        options.depth = 4;
        const Image image = whitted(scene, options);
        // By source, the first mirror's factor is not met: the later ones' and the wall's are.
        const float wanted =
            by_source ? factors[1] * factors[2] : factors[0] * factors[1] * factors[2];
        INFO((by_source ? "source" : "surface"));
        for (float value : image.pixels) REQUIRE(value == wanted);
    }
}

TEST_CASE("facing mirrors stop at the predicted bounce, by depth and by epsilon") {
    // Between two mirrors of factor 1/2 that glow with 1/4: n surfaces give 1/4 (1 + 1/2 + ...).
    Scene scene = lit_by_ambience();
    scene.chapter.whitted.saturate = false;
    Phong mirror = glowing();
    mirror.reflection = 0.5f;
    const uint32_t material = add_material(scene, mirror, glm::vec3(0.25f));
    add_rectangle(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, material);
    add_rectangle(scene, {-1, 1, 4}, {2, 0, 0}, {0, -2, 0}, material);
    scene.cameras.push_back(parallel_rays(0.5f, 2.0f));
    const auto sum = [](int surfaces) { return 0.25f * (2 - std::exp2(1.0f - float(surfaces))); };
    for (const uint32_t depth : {1u, 2u, 7u, 20u}) {
        RenderOptions options = options_of(4, 4);
        options.depth = depth;
        CHECK(whitted(scene, options).pixels[0] == sum(int(depth)));
    }
    // Products 1, 1/2, 1/4, ... are followed while they are above epsilon.
    for (const int stop : {1, 3, 10}) {
        scene.chapter.whitted.epsilon = std::exp2(-float(stop));
        RenderOptions options = options_of(4, 4);
        options.depth = 100;
        CHECK(whitted(scene, options).pixels[0] == sum(stop));
        scene.chapter.whitted.epsilon = std::nextafter(scene.chapter.whitted.epsilon, 0.0f);
        CHECK(whitted(scene, options).pixels[0] == sum(stop + 1));
    }
}

TEST_CASE("indirect light may fall off with the squared distance") {
    Scene scene = lit_by_ambience();
    scene.chapter.whitted.distance_falloff = true;
    Phong mirror = black();
    mirror.reflection = 1;
    add_rectangle(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, add_material(scene, mirror));
    add_rectangle(scene, {-1, 1, 4}, {2, 0, 0}, {0, -2, 0}, add_material(scene, glowing()));
    scene.cameras.push_back(parallel_rays(0.5f, 2.0f));
    CHECK(whitted(scene, options_of(4, 4)).pixels[0] == Approx(1.0f / 16).epsilon(1e-4));
}

TEST_CASE("a translucent surface dims a shadow by its factor and does not bend it") {
    Scene scene;
    scene.chapter.whitted.background = glm::vec3(0.0f);
    scene.chapter.whitted.ambient = glm::vec3(0.0f);
    const Phong floor{.ambient = 0, .diffuse = 1, .specular = 0};
    add_rectangle(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, add_material(scene, floor));
    Phong pane = black();
    pane.transmission = 0.5f;
    const uint32_t glass = add_material(scene, pane, glm::vec3(1.0f), 2.0f);
    for (const float z : {2.0f, 3.0f})
        add_rectangle(scene, {0, -2, z}, {2, 0, 0}, {0, 4, 0}, glass);
    scene.directional_lights.push_back({{0, 0, 1}, {}});
    scene.chapter.intensities.directional_lights[0] = glm::vec3(1.0f);
    scene.cameras.push_back(parallel_rays(2.0f, 1.0f));
    const Image image = whitted(scene, options_of(8, 8));
    CHECK(image.pixel(1, 4)[0] == Approx(1.0f).epsilon(1e-6));
    CHECK(image.pixel(6, 4)[0] == Approx(0.25f).epsilon(1e-6)); // two crossings
}

TEST_CASE("beyond the critical angle everything is reflected, at the angle that Snell gives") {
    // From below the surface of water, the camera turns from the zenith down; what leaves is black
    // sky, what is reflected is the glowing bottom.
    Scene scene = lit_by_ambience();
    Phong water = black();
    water.transmission = 1;
    const float ior = 1.33f;
    add_rectangle(scene, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0},
                  add_material(scene, water, glm::vec3(1.0f), ior));
    add_rectangle(scene, {-500, -500, -2}, {1000, 0, 0}, {0, 1000, 0},
                  add_material(scene, glowing()));
    const double critical = std::asin(1 / double(ior));
    const glm::vec3 eye(0, 0, -1);
    const glm::vec3 toward(float(std::sin(critical)), 0, float(std::cos(critical)));
    Camera camera = camera_at(eye, eye + toward, 0.02f);
    scene.cameras.push_back(camera);
    RenderOptions options = options_of(201, 201);
    const Image image = whitted(scene, options);
    // The edge crosses the axis in the middle of the picture.
    const bool upright = std::abs(camera.camera_to_world[0].y) > 0.5f;
    double bright = 0;
    for (uint32_t i = 0; i < 201; i++)
        bright += (upright ? image.pixel(100, i) : image.pixel(i, 100))[0] > 0.5f;
    const double degrees = (bright - 100.5) * 0.02 / 201 * 180 / M_PI;
    INFO(degrees << " degrees from asin(1 / n)");
    CHECK(std::abs(degrees) < 0.1);
    CHECK(bright > 0);
    CHECK(bright < 201);
}

TEST_CASE("a slab moves a ray aside by its thickness times the sine law") {
    // Parallel rays fall at angle a on a tilted slab of thickness d before a black-and-white edge:
    // the edge is seen shifted by d sin(a - b) / cos b.
    const double a = 0.6, n = 1.5, b = std::asin(std::sin(a) / n), d = 1.0;
    const double shift = d * std::sin(a - b) / std::cos(b);
    const auto scene_with = [&](bool slab) {
        Scene scene = lit_by_ambience();
        add_rectangle(scene, {0, -5, -6}, {5, 0, 0}, {0, 10, 0}, add_material(scene, glowing()));
        Phong glass = black();
        glass.transmission = 1;
        Mesh box =
            box_mesh({8, 8, float(d)}, add_material(scene, glass, glm::vec3(1.0f), float(n)));
        for (glm::vec3& p : box.positions)
            p = {float(std::cos(a)) * p.x + float(std::sin(a)) * p.z, p.y,
                 -float(std::sin(a)) * p.x + float(std::cos(a)) * p.z};
        if (slab) add_mesh(scene, box);
        scene.cameras.push_back(parallel_rays(2.0f, 9.0f));
        return scene;
    };
    const uint32_t size = 4001;
    const double view = 0.6, pixel = view / size;
    const RenderOptions narrow = options_of(size, 3);
    const auto edge = [&](bool slab) {
        Scene scene = scene_with(slab);
        scene.cameras[0].orthographic_height = float(3 * pixel);
        return edge_position(whitted(scene, narrow), 1);
    };
    const double moved = std::abs(edge(true) - edge(false)) * pixel;
    INFO("moved by " << moved << ", expected " << shift);
    CHECK(std::abs(moved - shift) < 1e-3 * shift);
}

TEST_CASE("a prism turns a ray by the angle of least deviation where it passes symmetrically") {
    // In the XZ plane: the apex at the origin, the base toward +X, the inner ray along -Z.
    const double n = 1.5, apex = M_PI / 3;
    const double deviation = 2 * std::asin(n * std::sin(apex / 2)) - apex;
    const auto direction = [](double turned) {
        return glm::vec3(float(std::sin(turned)), 0, -float(std::cos(turned)));
    };
    const glm::vec3 in = direction(-deviation / 2), out = direction(deviation / 2);
    const float height = float(std::tan(apex / 2));
    const glm::vec3 entry(1, 0, height), exit(1, 0, -height);

    Scene scene = lit_by_ambience();
    Phong glass = black();
    glass.transmission = 1;
    Mesh prism;
    for (const float y : {-1.0f, 1.0f})
        for (const glm::vec3 p : {glm::vec3(0), 2.0f * entry, 2.0f * exit})
            prism.positions.push_back({p.x, y, p.z});
    prism.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 4, 3}, {0, 1, 4},
                       {1, 5, 4}, {1, 2, 5}, {2, 3, 5}, {2, 0, 3}};
    prism.materials.assign(8, add_material(scene, glass, glm::vec3(1.0f), float(n)));
    add_mesh(scene, prism);
    // A wall across the predicted ray that begins where the ray should meet it.
    const float away = 20;
    const glm::vec3 side(-out.z, 0, out.x);
    add_rectangle(scene, exit + away * out - glm::vec3(0, 5, 0), 10.0f * side, {0, 10, 0},
                  add_material(scene, glowing()));
    scene.cameras.push_back(camera_at(entry - 3.0f * in, entry, 1.0f));
    const uint32_t size = 2001;
    const float pixel = 0.5f / float(size);
    scene.cameras[0].orthographic_height = 3 * pixel;
    const Image image = whitted(scene, options_of(size, 3));
    const double bright = size - edge_position(image, 1);
    REQUIRE(bright > 0);
    REQUIRE(bright < size);
    const double error = (bright - 0.5 * size) * pixel / away;
    INFO("off by " << error << " radians of " << deviation);
    CHECK(std::abs(error) < 1e-3 * deviation);
}

} // namespace onde::test
