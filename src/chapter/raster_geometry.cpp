#include "chapter/raster_geometry.h"

#include "chapter/raster_camera.h"
#include "chapter/raster_shapes.h"
#include "core/error.h"
#include "scene/load.h"
#include "scene/phong.h"
#include "shared/scene.h"

#include <algorithm>
#include <cmath>

namespace onde {
namespace {

/// Sub-pixel coordinates must stay below this, so that areas of triangles fit in 64 bits.
constexpr double FARTHEST_SUBPIXEL = double(1 << 29);
constexpr uint32_t MOST_SUBPIXELS = 256;

/// Adds meshes and spheres one by one and keeps the numbers of the primitives.
class RasterPacker {
  public:
    RasterPacker(const glm::dmat4& to_screen, double pixel, bool textured)
        : to_screen_(to_screen), pixel_(pixel), textured_(textured) {}

    /// Returns the first of its triangles among those of all meshes.
    uint32_t add_mesh(const Mesh& mesh) {
        const auto first_vertex = uint32_t(packed.positions.size() / 3);
        const auto first_triangle = uint32_t(packed.triangle_materials.size());
        for (const glm::vec3& p : mesh.positions)
            packed.positions.insert(packed.positions.end(), {p.x, p.y, p.z});
        for (size_t i = 0; textured_ && i < mesh.positions.size(); i++) {
            const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[i];
            packed.uvs.insert(packed.uvs.end(), {uv.x, uv.y});
        }
        for (const glm::uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; k++) packed.triangles.push_back(first_vertex + t[k]);
        packed.triangle_materials.insert(packed.triangle_materials.end(), mesh.materials.begin(),
                                         mesh.materials.end());
        return first_triangle;
    }

    void place(const Mesh& mesh, uint32_t first_triangle, const glm::mat4& object_to_world) {
        if (mesh.triangles.empty()) return;
        const glm::dmat4 matrix = to_screen_ * glm::dmat4(object_to_world);
        RasterInstance instance{};
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 4; column++)
                instance.to_screen[4 * row + column] = float(matrix[column][row]);
        instance.first_primitive = uint32_t(primitives_);
        instance.first_triangle = first_triangle;
        packed.instances.push_back(instance);
        primitives_ += mesh.triangles.size();
        for (const glm::vec3& p : mesh.positions) reach(matrix * glm::dvec4(p, 1), 0);
        check_count();
    }

    void add_sphere(const Sphere& sphere) {
        const glm::dvec4 center = to_screen_ * glm::dvec4(sphere.center, 1);
        RasterSphere record{};
        for (int k = 0; k < 3; k++) record.center[k] = float(center[k]);
        record.radius = sphere.radius;
        record.radius_pixels = float(sphere.radius / pixel_);
        record.material = sphere.material;
        packed.spheres.push_back(record);
        reach(center, sphere.radius / pixel_);
    }

    PackedRaster finish() {
        RasterRecord& record = packed.record;
        record.triangle_count = uint32_t(primitives_);
        primitives_ += 2 * packed.spheres.size();
        check_count();
        record.primitive_count = uint32_t(primitives_);
        record.instance_count = uint32_t(packed.instances.size());
        record.subpixels = subpixels();
        return std::move(packed);
    }

    PackedRaster packed;

  private:
    void reach(const glm::dvec4& place, double radius) {
        farthest_ = std::max({farthest_, std::abs(place.x) + radius, std::abs(place.y) + radius});
    }

    void check_count() const {
        if (primitives_ < RASTER_NONE) return;
        throw InputError("the scene has more than {} triangles and spheres in all its instances, "
                         "more than this integrator can number",
                         RASTER_NONE);
    }

    uint32_t subpixels() const {
        const double farthest = farthest_ + 2;
        if (!(farthest < FARTHEST_SUBPIXEL))
            throw InputError("the scene reaches {:.3g} pixels beyond the picture; show more of it, "
                             "or make it smaller",
                             farthest_);
        uint32_t count = MOST_SUBPIXELS;
        while (farthest * count >= FARTHEST_SUBPIXEL) count /= 2;
        return count;
    }

    glm::dmat4 to_screen_;
    double pixel_, farthest_ = 0;
    bool textured_;
    uint64_t primitives_ = 0;
};

RasterMaterial pack_material(const Scene& scene, uint32_t index) {
    const Material& material = scene.materials[index];
    RasterMaterial record{};
    for (int k = 0; k < 3; k++) record.color[k] = material.base_color[k];
    record.texture =
        material.base_color_texture < 0 ? NO_INDEX : uint32_t(material.base_color_texture);
    record.alpha = 1.0f - phong_of(scene, index).transmission;
    return record;
}

void add_shapes(RasterPacker& packer, const Scene& scene) {
    size_t triangles = 0;
    for (const Shape& shape : scene.shapes) {
        const Mesh mesh = shape_mesh(shape);
        packer.place(mesh, packer.add_mesh(mesh), shape.object_to_world);
        triangles += mesh.triangles.size();
    }
    if (triangles > 0)
        packer.packed.notes.push_back(
            fmt::format("{} analytic shapes were drawn as {} triangles, {} to a turn",
                        scene.shapes.size(), triangles, SHAPE_SEGMENTS));
}

void note_textured_spheres(PackedRaster& packed, const Scene& scene) {
    const auto textured = [&](const Sphere& sphere) {
        return scene.materials[sphere.material].base_color_texture != NO_TEXTURE;
    };
    const auto count = std::ranges::count_if(scene.spheres, textured);
    if (count > 0)
        packed.notes.push_back(
            fmt::format("the textures of {} spheres were ignored: a sphere has no texture "
                        "coordinates",
                        count));
}

void note_camera(PackedRaster& packed, const Camera& given, const Camera& parallel) {
    if (given.orthographic_height) return;
    packed.notes.push_back(
        fmt::format("the perspective camera was taken as one with parallel rays that sees {:.4g} "
                    "units from top to bottom, as much as it did at the scene's centre",
                    *parallel.orthographic_height));
}

} // namespace

PackedRaster pack_raster(const Scene& scene, const Camera& camera, const RenderOptions& options) {
    const SceneBounds bounds = scene_bounds(scene);
    const Camera parallel = parallel_camera(camera, 0.5f * bounds.low + 0.5f * bounds.high);
    RasterPacker packer(screen_transform(parallel, options), pixel_size(parallel, options),
                        !scene.textures.empty());
    std::vector<uint32_t> first_triangles;
    for (const Mesh& mesh : scene.meshes) first_triangles.push_back(packer.add_mesh(mesh));
    for (const Instance& instance : scene.instances)
        packer.place(scene.meshes[instance.mesh], first_triangles[instance.mesh],
                     instance.object_to_world);
    add_shapes(packer, scene);
    for (const Sphere& sphere : scene.spheres) packer.add_sphere(sphere);
    PackedRaster packed = packer.finish();
    for (uint32_t i = 0; i < scene.materials.size(); ++i)
        packed.materials.push_back(pack_material(scene, i));
    packed.record.width = options.width;
    packed.record.height = options.height;
    const glm::vec3 background = raster_background(scene, parallel);
    for (int k = 0; k < 3; k++) packed.record.background[k] = background[k];
    note_camera(packed, camera, parallel);
    note_textured_spheres(packed, scene);
    return packed;
}

} // namespace onde
