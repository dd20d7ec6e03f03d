// Light tracing against the independent reference, which traces paths from the camera: the same
// expected picture, but for what smooth mirrors and glass show.
#include "render/light_picture.h"
#include "support/folders.h"

#include <numbers>

namespace onde::test {
namespace {

constexpr float PI = std::numbers::pi_v<float>;

struct Case {
    uint32_t depth = 8, samples = 64, reference_samples = 256;
    Filter filter = Filter::box;
    double most_deviation = 0.01; ///< of the mean: what the test can still see
    int masked = -1;              ///< a material that is left out of the comparison
};

void check_light(const Scene& scene, const Case& c) {
    RenderOptions options = small_options(48, 40, c.samples);
    options.depth = c.depth;
    options.filter = c.filter;
    ReferenceOptions reference;
    reference.width = options.width;
    reference.height = options.height;
    reference.samples = c.reference_samples;
    reference.depth = c.depth;
    reference.seed = 77;
    reference.filter = c.filter;
    std::vector<bool> masked;
    if (c.masked >= 0) masked = pixels_of(scene, uint32_t(c.masked), options);
    const LightVerdict verdict =
        compare_light(trace_seeds(scene, options), expect_reference(scene, reference), masked);
    INFO(verdict.sentence);
    CHECK(verdict.accepted);
    CHECK(verdict.deviation < c.most_deviation);
}

Scene load(const char* name) {
    return load_scene(std::filesystem::path(in_project("scenes")) / name);
}

uint32_t add_material(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return uint32_t(scene.materials.size() - 1);
}

Material material_of(MaterialKind kind, float color, float roughness) {
    Material material;
    material.kind = kind;
    material.base_color = glm::vec3(color);
    material.roughness = roughness;
    return material;
}

/// A square in the plane y = height, its front up; `bend` turns its shading normals about Z.
void add_square(Scene& scene, float half, float height, uint32_t material, float bend = 0) {
    Mesh mesh;
    mesh.positions = {
        {-half, height, half}, {half, height, half}, {half, height, -half}, {-half, height, -half}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.materials = {material, material};
    if (bend != 0) mesh.normals.assign(4, glm::vec3(std::sin(bend), std::cos(bend), 0));
    scene.meshes.push_back(mesh);
    scene.instances.push_back({uint32_t(scene.meshes.size() - 1), glm::mat4(1)});
}

/// A grey floor from -2 to 2, seen from a corner above.
Scene floor_scene() {
    Scene scene;
    add_material(scene, material_of(MaterialKind::diffuse, 0.5f, 1));
    add_square(scene, 2, 0, 0);
    scene.cameras = {camera_at({1, 3.5f, 3.5f}, {0, 0, 0}, 0.8f)};
    return scene;
}

uint32_t add_light_material(Scene& scene, glm::vec3 radiance) {
    Material light = material_of(MaterialKind::diffuse, 0, 1);
    light.emission = radiance;
    return add_material(scene, light);
}

Image sky_with_a_sun() {
    Image map(16, 8, 3);
    for (size_t i = 0; i < map.pixels.size(); i++) map.pixels[i] = 0.2f + 0.05f * float(i % 7);
    for (size_t k = 0; k < 3; k++) map.pixels[3 * (2 * 16 + 5) + k] = 20;
    return map;
}

} // namespace

TEST_CASE("light tracing expects the reference's Cornell box, but for the glass sphere") {
    const Scene scene = load("cornell.toml");
    const auto glass = std::ranges::find(scene.materials, "glass", &Material::name);
    check_light(scene, {.depth = 8,
                        .filter = Filter::blackman_harris,
                        .masked = int(glass - scene.materials.begin())});
}

TEST_CASE("the light counts as a surface of the depth, as it does for paths from the camera") {
    Scene scene = load("cornell.toml");
    for (Material& material : scene.materials)
        if (material.kind == MaterialKind::dielectric) material.kind = MaterialKind::diffuse;
    for (uint32_t depth : {1u, 2u, 3u}) {
        INFO("depth " << depth);
        check_light(scene, {.depth = depth, .samples = 16});
    }
}

TEST_CASE("light tracing expects the reference's picture of lights of all kinds") {
    check_light(load("lights.toml"), {.depth = 4, .samples = 256});
}

TEST_CASE("light tracing through a thin lens expects the reference's blur") {
    Scene scene = load("lights.toml");
    scene.cameras[0].aperture_radius = 0.4f;
    scene.cameras[0].focus_distance = 9;
    check_light(scene, {.depth = 3, .samples = 256, .filter = Filter::tent});
}

TEST_CASE("light tracing of an orthographic view expects what paths from the camera do") {
    Scene scene = load("lights.toml");
    scene.cameras[0].orthographic_height = 7;
    scene.cameras[0].camera_to_world[3].y += 3; // the sky above the floor is seen as well
    scene.environment.radiance = glm::vec3(0.1f, 0.2f, 0.3f);
    RenderOptions options = small_options(48, 40, 256);
    options.depth = 3;
    check_paths_agree(scene, options, 0.01);
}

TEST_CASE("light tracing expects the reference's picture under a map of the sky") {
    Scene scene = floor_scene();
    scene.environment.radiance = glm::vec3(1, 0.9f, 0.8f);
    scene.environment.map = sky_with_a_sun();
    scene.environment.rotation = 0.5f;
    scene.spheres = {{glm::vec3(0, 0.6f, 0), 0.6f, 0}};
    scene.cameras = {camera_at({0, 1, 4}, {0, 0.8f, 0}, 0.9f)};
    check_light(scene, {.depth = 4, .samples = 256});
}

TEST_CASE("shading normals bend light for light tracing as they do for paths from the camera") {
    Scene scene;
    add_material(scene, material_of(MaterialKind::metallic_roughness, 0.6f, 0.6f));
    add_square(scene, 2, 0, 0, 0.5f);
    scene.cameras = {camera_at({1, 3.5f, 2}, {0, 0, 0}, 0.8f)};
    scene.spheres = {{glm::vec3(1.5f, 3, -0.5f), 0.4f, add_light_material(scene, glm::vec3(6))}};
    check_light(scene, {.depth = 3, .samples = 128});
}

TEST_CASE("rough glass sends light to the camera with the reference's radiance") {
    Scene scene = floor_scene();
    Material glass = material_of(MaterialKind::dielectric, 0.9f, 0.6f);
    glass.ior = 1.6f;
    scene.spheres = {{glm::vec3(0, 0.8f, 0), 0.7f, add_material(scene, glass)},
                     {glm::vec3(1.5f, 3, -1), 0.4f, add_light_material(scene, glm::vec3(9))}};
    check_light(scene, {.depth = 6, .samples = 256});
}

TEST_CASE("light that enters water is as bright below as the reference says") {
    Scene scene = floor_scene();
    Material water = material_of(MaterialKind::dielectric, 1, 0);
    water.ior = 1.33f;
    add_square(scene, 3, 1.5f, add_material(scene, water));
    scene.spheres = {{glm::vec3(0, 4, 0), 1, add_light_material(scene, glm::vec3(3))}};
    scene.cameras = {camera_at({0.2f, 1.3f, 1.2f}, {0, 0, 0}, 1.0f)};
    check_light(scene, {.depth = 4, .samples = 128, .reference_samples = 2048, .masked = 1});
}

TEST_CASE("a glass sphere's caustic has the reference's energy") {
    Scene scene = floor_scene();
    const Material glass = material_of(MaterialKind::dielectric, 1, 0);
    scene.spheres = {{glm::vec3(0, 1.1f, 0), 0.6f, add_material(scene, glass)},
                     {glm::vec3(0.5f, 4, 0), 0.3f, add_light_material(scene, glm::vec3(20))}};
    check_light(scene, {.depth = 6, .samples = 64, .reference_samples = 4096, .masked = 1});
}

TEST_CASE("under a point light, a floor has the radiance of its closed form in every block") {
    Scene scene = floor_scene();
    const glm::vec3 light(0.5f, 1.2f, -0.4f);
    scene.point_lights = {{light, glm::vec3(10)}};
    scene.cameras = {camera_at({0, 4, 0}, {0, 0, 0}, 0.6f)}; // sees the floor alone
    RenderOptions options = small_options(48, 40, 64);
    options.depth = 2;
    Expectation expected{options.width, options.height, {}, {}};
    const Camera& camera = scene.cameras[0];
    constexpr uint32_t STEPS = 4; // per pixel and axis
    for (uint32_t y = 0; y < options.height; y++)
        for (uint32_t x = 0; x < options.width; x++) {
            double mean = 0;
            for (uint32_t k = 0; k < STEPS * STEPS; k++) {
                const glm::vec2 film(float(x) + (float(k % STEPS) + 0.5f) / STEPS,
                                     float(y) + (float(k / STEPS) + 0.5f) / STEPS);
                const float scale = 2 * std::tan(camera.vertical_fov / 2) / float(options.height);
                const glm::vec4 local((film.x - 24) * scale, (20 - film.y) * scale, -1, 0);
                const glm::vec3 d(camera.camera_to_world * local);
                const glm::vec3 floor = glm::vec3(0, 4, 0) - d * (4 / d.y);
                const glm::vec3 to = light - floor;
                const float r2 = glm::dot(to, to);
                mean += 0.5 / PI * 10 * to.y / (r2 * std::sqrt(r2)) / (STEPS * STEPS);
            }
            expected.mean.push_back(mean);
            expected.variance.push_back(1e-8 * mean * mean); // of those steps
        }
    const LightVerdict verdict = compare_light(trace_seeds(scene, options), expected);
    INFO(verdict.sentence);
    CHECK(verdict.accepted);
    CHECK(verdict.deviation < 1e-3);
}

} // namespace onde::test
