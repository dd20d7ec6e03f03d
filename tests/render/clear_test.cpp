// What is clear: thin walls, solids that absorb, and light that goes straight through them.
#include "render/light_picture.h"
#include "render/variants.h"
#include "scene/mapping.h"

namespace onde::test {
namespace {

/// Looks down on a diffuse floor, below which all is black, past a square of a material that hangs
/// over it.
struct Room {
    Scene scene = doctor::floor_seen_from_above(0.5f);

    explicit Room(const Material& pane, float height = 0.8f, float thickness = 0) {
        scene.materials.push_back(pane);
        const float half = 20;
        Mesh square;
        for (const float y : {height + thickness, height}) {
            const auto first = uint32_t(square.positions.size());
            for (const glm::vec2 p : {glm::vec2(-1, -1), {-1, 1}, {1, 1}, {1, -1}})
                square.positions.emplace_back(half * p.x, y, half * p.y);
            const bool down = y == height && thickness > 0;
            for (const glm::uvec3 t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)})
                square.triangles.push_back(first + (down ? glm::uvec3(t.x, t.z, t.y) : t));
            if (thickness == 0) break;
        }
        square.materials.assign(square.triangles.size(), 1);
        scene.instances.push_back({uint32_t(scene.meshes.size()), glm::mat4(1)});
        scene.meshes.push_back(square);
    }

    void add_sun(float cosine = 1) {
        DirectionalLight sun;
        sun.to_light = {std::sqrt(1 - cosine * cosine), cosine, 0};
        sun.irradiance = glm::vec3(2, 3, 4);
        scene.directional_lights.push_back(sun);
    }
};

Material clear(MaterialKind kind, bool thin, glm::vec3 color = glm::vec3(1)) {
    Material material = doctor::furnace_material(kind, color, 0);
    material.thin_walled = thin;
    material.transmission = 1;
    return material;
}

/// Of the floor, by channel.
glm::dvec3 seen(const Scene& scene, uint32_t samples, uint32_t depth = 2) {
    RenderOptions options = small_options(16, 16, samples);
    options.depth = depth;
    const Image image = render_scene(scene, options).image;
    glm::dvec3 sum(0);
    for (size_t i = 0; i < image.pixels.size(); i++)
        sum[glm::length_t(i % image.channels)] += image.pixels[i];
    return sum / (double(image.pixels.size()) / image.channels);
}

/// The floor's colour over what the sun alone would make it.
glm::dvec3 share_of_sun(const Scene& scene, double cosine = 1) {
    return seen(scene, 1) / (glm::dvec3(2, 3, 4) * (0.5 / M_PI * cosine));
}

double fresnel(double cosine, double ior) {
    const double in = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    const double p = (ior * cosine - in) / (ior * cosine + in);
    const double s = (cosine - ior * in) / (cosine + ior * in);
    return 0.5 * (p * p + s * s);
}

void check_share(const glm::dvec3& share, const glm::dvec3& wanted) {
    INFO(share.x << " " << share.y << " " << share.z);
    CHECK(glm::length(share - wanted) < 1e-4);
}

} // namespace

TEST_CASE(
    "the sun shines straight through a thin wall, less by one reflection, or by all of a slab") {
    const glm::vec3 tint(0.9f, 0.5f, 0.3f);
    for (const double cosine : {1.0, 0.6}) {
        const double r = fresnel(cosine, 1.5);
        Room gltf(clear(MaterialKind::metallic_roughness, true, tint));
        gltf.add_sun(float(cosine));
        check_share(share_of_sun(gltf.scene, cosine), glm::dvec3(tint) * (1 - r));
        Room slab(clear(MaterialKind::dielectric, true, tint));
        slab.add_sun(float(cosine));
        check_share(share_of_sun(slab.scene, cosine), glm::dvec3(tint) * (1 - 2 * r / (1 + r)));
    }
}

TEST_CASE("varnish on a thin wall keeps its share of what goes straight through") {
    for (const double cosine : {1.0, 0.3}) {
        Material varnished = clear(MaterialKind::metallic_roughness, true);
        varnished.clearcoat = 1;
        Room room(varnished);
        room.add_sun(float(cosine));
        const double coat = 0.04 + 0.96 * std::pow(1 - cosine, 5);
        const glm::dvec3 share = share_of_sun(room.scene, cosine);
        INFO(share.x << " at " << cosine);
        CHECK(share.x == Approx((1 - coat) * (1 - fresnel(cosine, 1.5))).epsilon(0.005));
    }
}

TEST_CASE("specular dims what a pane reflects, and lets the rest through") {
    Material dim = clear(MaterialKind::metallic_roughness, true);
    dim.specular = 0.25f;
    Room room(dim);
    room.add_sun(0.3f);
    check_share(share_of_sun(room.scene, 0.3), glm::dvec3(1 - 0.25 * fresnel(0.3, 1.5)));
}

TEST_CASE("through a solid it shines unbent, less by both faces and by what is absorbed inside") {
    Material glass = clear(MaterialKind::dielectric, false);
    const glm::vec3 left(0.8f, 0.5f, 0.1f);
    for (const bool absorbs : {false, true}) {
        if (absorbs) {
            glass.attenuation_color = left;
            glass.attenuation_distance = 0.4f;
        }
        Room room(glass, 0.8f, 0.2f);
        room.add_sun();
        const double faces = std::pow(1 - fresnel(1, 1.5), 2);
        const glm::dvec3 inside = absorbs ? glm::sqrt(glm::dvec3(left)) : glm::dvec3(1);
        check_share(share_of_sun(room.scene), faces * inside);
    }
    glass.shadows = GlassShadows::opaque;
    Room dark(glass, 0.8f, 0.2f);
    dark.add_sun();
    check_share(share_of_sun(dark.scene), glm::dvec3(0));
}

TEST_CASE("what is partly clear lets that part through, and a partial metal less") {
    Material half = clear(MaterialKind::metallic_roughness, true);
    half.transmission = 0.5f;
    half.metallic = 0.2f;
    half.ior = 1.3f;
    Room room(half);
    room.add_sun();
    check_share(share_of_sun(room.scene), glm::dvec3(0.5 * 0.8 * (1 - fresnel(1, 1.3))));
}

TEST_CASE(
    "behind a pane sampled and found light add up to what a slightly rough pane lets through") {
    for (const bool map : {false, true}) {
        const auto lit = [&](float roughness) {
            Material pane = clear(MaterialKind::metallic_roughness, true, {0.9f, 0.6f, 0.4f});
            pane.roughness = roughness;
            Room room(pane);
            if (map) {
                room.scene.environment.radiance = glm::vec3(1);
                Image& sky = room.scene.environment.map.emplace(4, 2, 3);
                for (size_t i = 0; i < sky.pixels.size(); i++)
                    sky.pixels[i] = 0.1f + 0.3f * float(i % 7);
            } else {
                doctor::add_square_light(room.scene, 1.0f, 1.5f, 3.0f);
            }
            return seen(room.scene, 1024, 4);
        };
        const glm::dvec3 smooth = lit(0), rough = lit(0.0325f);
        INFO(smooth.x << " " << smooth.y << " " << smooth.z << " and " << rough.x << " " << rough.y
                      << " " << rough.z);
        CHECK(glm::length(smooth - rough) < 0.01 * glm::length(rough));
        CHECK(smooth.x > 0.1);
    }
}

TEST_CASE("light inside of a coloured solid is absorbed along its way") {
    // A white world seen through a slab, straight on: absorbed once, reflected to and fro inside.
    Material glass = clear(MaterialKind::metallic_roughness, false);
    glass.attenuation_color = {0.7f, 0.4f, 0.9f};
    glass.attenuation_distance = 0.1f;
    Scene scene = Room(glass, -0.3f, 0.1f).scene;
    for (glm::vec3& corner : scene.meshes[0].positions) corner.x += 90; // out of sight
    scene.environment.radiance = glm::vec3(1);
    const glm::dvec3 through = seen(scene, 256, 30);
    const double r = fresnel(1, 1.5);
    for (glm::length_t k = 0; k < 3; k++) {
        const double t = double(glass.attenuation_color[k]);
        const double wanted =
            r + (1 - r) * (1 - r) * t / (1 - r * t); // reflected at once, or let out in the end
        CHECK(through[k] == Approx(wanted).epsilon(0.01));
    }
}

TEST_CASE("all engines see the same behind panes and glass") {
    Material tinted = clear(MaterialKind::metallic_roughness, true, {0.4f, 0.9f, 0.5f});
    Room room(tinted);
    room.add_sun(0.8f);
    doctor::add_square_light(room.scene, 1.0f, 1.5f, 3.0f);
    Material glass = clear(MaterialKind::dielectric, false);
    glass.attenuation_color = {0.9f, 0.2f, 0.3f};
    glass.attenuation_distance = 0.1f;
    room.scene.spheres.push_back({{0, 0.3f, 0}, 0.1f, uint32_t(room.scene.materials.size())});
    room.scene.materials.push_back(glass);
    room.scene.cameras = {camera_at({0, 0.6f, 0.9f}, {0, 0.1f, 0}, 0.9f)};
    RenderOptions options = small_options(32, 24, 4);
    options.depth = 6;
    const DeviceScene placed = place_on_device(room.scene);
    const auto picture = [&](const Variant& variant) {
        return render_by(room.scene, placed, apply(options, variant)).image;
    };
    const Image first = picture(VARIANTS[0]);
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        CHECK(first_difference(first, picture(variant)) == "");
    }
}

TEST_CASE("that light goes through glass unbent is said") {
    Room room(clear(MaterialKind::dielectric, false), 0.8f, 0.2f);
    CHECK(mapping_notes(room.scene, IntegratorKind::path).empty());
    room.add_sun();
    const std::vector<std::string> notes = mapping_notes(room.scene, IntegratorKind::path);
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("unbent") != std::string::npos);
    room.scene.materials[1].shadows = GlassShadows::opaque;
    CHECK(mapping_notes(room.scene, IntegratorKind::path).empty());
}

} // namespace onde::test
