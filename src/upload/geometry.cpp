#include "upload/geometry.h"

#include "scene/texture_levels.h"
#include "upload/emissive.h"
#include "upload/mesh_writer.h"
#include "upload/textures.h"
#include "upload/words.h"

#include <map>
#include <tuple>

namespace onde {
namespace {

/// How a thing moves while the shutter is open.
std::span<const glm::mat4> keys_of(const Scene& scene,
                                   std::vector<MotionKeys> ShutterMotion::*things, size_t index) {
    if (!scene.shutter) return {};
    return ((*scene.shutter).*things)[index];
}

bool mesh_emits(const Scene& scene, const Mesh& mesh) {
    for (uint32_t material : mesh.materials)
        if (emits(scene.materials[material])) return true;
    return false;
}

void add_sphere(const Scene& scene, FlatGeometry& flat, const Sphere& sphere) {
    const auto primitive = uint32_t(flat.surfaces.size());
    SphereSurface surface{};
    surface.tag = sphere.material | SURFACE_SPHERE;
    surface.light = NO_INDEX;
    copy(surface.center, sphere.center);
    surface.radius = sphere.radius;
    if (emits(scene.materials[sphere.material]))
        flat.emissive.push_back(emissive_sphere(primitive, sphere));
    flat.surfaces.emplace_back().sphere = surface;
    flat.spheres.push_back({sphere.center, sphere.radius});
}

/// Places shapes; equal ones that do not emit share a geometry.
class ShapeWriter {
  public:
    ShapeWriter(const Scene& scene, FlatGeometry& flat) : scene_(scene), flat_(flat) {}

    void add(const Shape& shape, uint32_t object, std::span<const glm::mat4> keys) {
        const bool light = emits(scene_.materials[shape.material]);
        const auto key = std::tuple(shape.kind, shape.minor_radius, shape.material);
        const auto known = geometry_of_.find(key);
        const bool shared = !light && known != geometry_of_.end();
        const uint32_t geometry = shared ? known->second : add_geometry(shape);
        if (!shared) // hits of one that is placed once may have no instance
            flat_.objects.runs.push_back({uint32_t(flat_.surfaces.size() - 1), object});
        if (light) {
            flat_.emissive.push_back(emissive_shape(uint32_t(flat_.surfaces.size() - 1), shape));
            if (!keys.empty()) flat_.emissive.back().light.reset();
        }
        if (!light && !shared) geometry_of_.emplace(key, geometry);
        flat_.placements.push_back({geometry, shape.object_to_world, keys});
        flat_.objects.of_placement.push_back(object);
    }

  private:
    uint32_t add_geometry(const Shape& shape) {
        static_assert(uint32_t(ShapeKind::sphere) == SHAPE_ELLIPSOID);
        static_assert(uint32_t(ShapeKind::disk) == SHAPE_DISK);
        static_assert(uint32_t(ShapeKind::cylinder) == SHAPE_CYLINDER);
        static_assert(uint32_t(ShapeKind::cone) == SHAPE_CONE);
        static_assert(uint32_t(ShapeKind::torus) == SHAPE_TORUS);
        ShapeSurface surface{};
        surface.tag = shape.material | SURFACE_SHAPE;
        surface.light = NO_INDEX;
        surface.shape = uint32_t(shape.kind);
        surface.minor_radius = shape.minor_radius;
        const ShapeInput& input =
            flat_.shapes.emplace_back(ShapeInput{uint32_t(shape.kind), shape.minor_radius});
        flat_.geometries.push_back(
            {{}, {}, {}, uint32_t(flat_.surfaces.size()), std::span(&input, 1)});
        flat_.surfaces.emplace_back().shape = surface;
        return uint32_t(flat_.geometries.size() - 1);
    }

    const Scene& scene_;
    FlatGeometry& flat_;
    std::map<std::tuple<ShapeKind, float, uint32_t>, uint32_t> geometry_of_;
};

/// By instance, whether it is one in the tree too.
std::vector<bool> instances_to_place(const Scene& scene) {
    std::vector<uint64_t> uses(scene.meshes.size());
    for (const Instance& instance : scene.instances) uses[instance.mesh]++;
    std::vector<bool> instanced(scene.meshes.size());
    for (size_t i = 0; i < uses.size(); i++) {
        const uint64_t copies = uses[i] * scene.meshes[i].triangles.size();
        instanced[i] = uses[i] > 1 && copies > BAKED_COPIES && !mesh_emits(scene, scene.meshes[i]);
    }
    std::vector<bool> placed;
    for (size_t i = 0; i < scene.instances.size(); i++)
        placed.push_back(instanced[scene.instances[i].mesh] ||
                         !keys_of(scene, &ShutterMotion::instances, i).empty());
    return placed;
}

/// Writes a mesh in its own space; returns its geometry. What of it emits, only rays find.
uint32_t add_placed_mesh(const Scene& scene, const Mesh& mesh, FlatGeometry& flat) {
    const auto first_primitive = uint32_t(flat.surfaces.size());
    const size_t first_emissive = flat.emissive.size();
    auto& positions = flat.positions.emplace_back();
    auto& triangles = flat.triangles.emplace_back();
    MeshWriter(scene, flat, positions, triangles).add(mesh, glm::mat4(1.0f));
    for (size_t i = first_emissive; i < flat.emissive.size(); i++) flat.emissive[i].light.reset();
    flat.geometries.push_back({positions, triangles, {}, first_primitive});
    return uint32_t(flat.geometries.size() - 1);
}

} // namespace

FlatGeometry flatten_geometry(const Scene& scene) {
    FlatGeometry flat;
    flat.vertices.emplace_back();
    flat.uv_sets = used_uv_sets(scene);
    VertexAttributes(scene, flat).add(nullptr, 0, 0);
    const std::vector<bool> placed = instances_to_place(scene);

    auto& positions = flat.positions.emplace_back();
    auto& triangles = flat.triangles.emplace_back();
    MeshWriter baked(scene, flat, positions, triangles);
    ObjectMap& objects = flat.objects;
    const auto begin_run = [&](size_t object) {
        objects.runs.push_back({uint32_t(flat.surfaces.size()), uint32_t(object)});
    };
    const size_t first_sphere = scene.instances.size();
    const size_t first_shape = first_sphere + scene.spheres.size();
    for (size_t i = 0; i < scene.instances.size(); i++) {
        const Instance& instance = scene.instances[i];
        if (placed[i]) continue;
        begin_run(i);
        baked.add(scene.meshes[instance.mesh], instance.object_to_world);
    }
    for (size_t i = 0; i < scene.spheres.size(); i++) {
        begin_run(first_sphere + i);
        add_sphere(scene, flat, scene.spheres[i]);
    }
    flat.geometries.push_back({positions, triangles, flat.spheres, 0});
    flat.placements.push_back({0, glm::mat4(1.0f), {}});
    objects.of_placement.push_back(NO_INDEX);

    std::map<uint32_t, uint32_t> geometry_of; // by mesh, in the scene's order
    for (size_t i = 0; i < scene.instances.size(); i++)
        if (placed[i]) geometry_of[scene.instances[i].mesh] = 0;
    for (auto& [mesh, geometry] : geometry_of)
        geometry = add_placed_mesh(scene, scene.meshes[mesh], flat);
    for (size_t i = 0; i < scene.instances.size(); i++) {
        if (!placed[i]) continue;
        const Instance& instance = scene.instances[i];
        flat.placements.push_back({geometry_of.at(instance.mesh), instance.object_to_world,
                                   keys_of(scene, &ShutterMotion::instances, i)});
        objects.of_placement.push_back(uint32_t(i));
    }
    ShapeWriter shapes(scene, flat);
    for (size_t i = 0; i < scene.shapes.size(); i++)
        shapes.add(scene.shapes[i], uint32_t(first_shape + i),
                   keys_of(scene, &ShutterMotion::shapes, i));
    if (!flat.bulges.empty()) flat.bulges.resize(flat.surfaces.size());
    if (has_mip_textures(scene)) flat.uv_scales.resize(flat.surfaces.size());
    return flat;
}

} // namespace onde
