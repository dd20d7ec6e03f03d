#include "support/chapter/world.h"

#include "scene/phong.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <stdexcept>

namespace onde::chapter {
namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

dvec3 moved(const dmat4& m, const dvec3& point) {
    return dvec3(m * dvec4(point, 1));
}
dvec3 turned(const dmat4& m, const dvec3& vector) {
    return dvec3(m * dvec4(vector, 0));
}

/// A ray that starts on a surface has left it after this share of its coordinates.
double clearance(const dvec3& origin) {
    return 1e-7 * (1 + std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)}));
}

} // namespace

World::World(const Scene& scene) {
    for (const Instance& instance : scene.instances)
        add_instance(scene.meshes.at(instance.mesh), dmat4(instance.object_to_world));
    for (const Sphere& sphere : scene.spheres)
        add_solid(ShapeKind::sphere, 0, sphere.material,
                  glm::scale(glm::translate(dmat4(1), dvec3(sphere.center)),
                             dvec3(double(sphere.radius))));
    for (const Shape& shape : scene.shapes)
        add_solid(shape.kind, double(shape.minor_radius), shape.material,
                  dmat4(shape.object_to_world));
}

void World::add_instance(const Mesh& mesh, const dmat4& to_world) {
    if (!mesh.normals.empty()) throw std::invalid_argument("smooth normals");
    const double mirrored = glm::determinant(to_world) < 0 ? -1 : 1;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        Triangle triangle;
        for (int k = 0; k < 3; ++k)
            triangle.corners[k] = moved(to_world, dvec3(mesh.positions[mesh.triangles[i][k]]));
        triangle.front = mirrored * glm::cross(triangle.corners[1] - triangle.corners[0],
                                               triangle.corners[2] - triangle.corners[0]);
        triangle.material = mesh.materials[i];
        triangles_.push_back(triangle);
    }
}

void World::add_solid(ShapeKind kind, double minor_radius, uint32_t material,
                      const dmat4& to_world) {
    double stretch = 0;
    for (int axis = 0; axis < 3; ++axis)
        stretch += glm::dot(dvec3(to_world[axis]), dvec3(to_world[axis]));
    solids_.push_back({kind, minor_radius, material, glm::inverse(to_world), dvec3(to_world[3]),
                       2 * std::sqrt(stretch)});
}

/// visit(crossing, material, primitive) for every crossing with low < t < high.
template <class Visit>
void World::visit_crossings(const Ray& ray, double low, double high, const Visit& visit) const {
    uint32_t primitive = 0;
    for (const Triangle& triangle : triangles_) {
        ++primitive;
        const auto crossing = cross_triangle(triangle.corners, ray);
        if (crossing && crossing->t > low && crossing->t < high)
            visit(Crossing{crossing->t, triangle.front}, triangle.material, primitive);
    }
    for (const Solid& solid : solids_) {
        ++primitive;
        const dvec3 away = ray.origin - solid.centre;
        const dvec3 nearest = away - glm::dot(away, ray.direction) * ray.direction;
        if (glm::dot(nearest, nearest) > solid.radius * solid.radius) continue;
        const Ray local{moved(solid.to_object, ray.origin), turned(solid.to_object, ray.direction)};
        for (const Crossing& crossing : cross_shape(solid.kind, solid.minor_radius, local))
            if (crossing.t > low && crossing.t < high)
                visit(
                    Crossing{crossing.t, turned(glm::transpose(solid.to_object), crossing.normal)},
                    solid.material, primitive);
    }
}

std::optional<Surface> World::nearest(const Ray& ray) const {
    std::optional<Surface> best;
    visit_crossings(ray, clearance(ray.origin), INFINITY,
                    [&](const Crossing& crossing, uint32_t material, uint32_t primitive) {
                        if (best && best->t <= crossing.t) return;
                        best = {.t = crossing.t,
                                .normal = crossing.normal,
                                .material = material,
                                .primitive = primitive};
                    });
    if (!best) return {};
    best->point = ray.at(best->t);
    best->front = glm::dot(best->normal, ray.direction) < 0;
    best->normal = (best->front ? 1.0 : -1.0) * glm::normalize(best->normal);
    return best;
}

double World::transmitted(const Ray& ray, double distance, const Scene& scene,
                          uint32_t& crossings) const {
    double left = 1;
    crossings = 0;
    visit_crossings(ray, clearance(ray.origin), distance,
                    [&](const Crossing&, uint32_t material, uint32_t) {
                        left *= double(phong_of(scene, material).transmission);
                        ++crossings;
                    });
    if (left == 0) crossings = 0;
    return left;
}

} // namespace onde::chapter
