// What rays hit by brute force.
#pragma once

#include "doctor/traversal_rig.h"

namespace onde::doctor::traversal {

/// Every primitive of every placement, one after the other, in double precision. `margin` widens
/// triangles (in barycentric coordinates) and spheres (relative), to tell close calls.
class BruteForce {
  public:
    BruteForce(const World& world, double margin) : world_(world), margin_(margin) {}

    Hit closest(const Ray& ray) const {
        best_ = ray.t_max;
        Hit hit = {ray.t_max, 0, 0, BVH_NONE, BVH_NONE};
        for (uint32_t i = 0; i < world_.placements.size(); ++i) {
            const Placement& placement = world_.placements[i];
            const glm::dmat4 inverse = glm::inverse(glm::dmat4(placement.object_to_world));
            const glm::dvec3 origin(inverse * glm::dvec4(ray.origin, 1.0));
            const glm::dvec3 direction(inverse * glm::dvec4(ray.direction, 0.0));
            const bool direct = world_.bvh.instances[i].root == BVH_NONE;
            visit(world_.geometries[placement.geometry], origin, direction, ray.t_min,
                  direct ? BVH_NONE : i, hit);
        }
        return hit;
    }

  private:
    void visit(const Geometry& geometry, glm::dvec3 origin, glm::dvec3 direction, double t_min,
               uint32_t instance, Hit& hit) const {
        for (uint32_t i = 0; i < geometry.triangles.size(); ++i)
            visit_triangle(geometry, i, origin, direction, t_min, instance, hit);
        for (uint32_t i = 0; i < geometry.spheres.size(); ++i)
            visit_sphere(geometry.spheres[i], origin, direction, t_min,
                         geometry.first_primitive + uint32_t(geometry.triangles.size()) + i,
                         instance, hit);
    }

    void visit_triangle(const Geometry& geometry, uint32_t index, glm::dvec3 origin,
                        glm::dvec3 direction, double t_min, uint32_t instance, Hit& hit) const {
        const glm::uvec3 corners = geometry.triangles[index];
        const glm::dvec3 v0(geometry.positions[corners.x]);
        const glm::dvec3 e1 = glm::dvec3(geometry.positions[corners.y]) - v0;
        const glm::dvec3 e2 = glm::dvec3(geometry.positions[corners.z]) - v0;
        const glm::dvec3 p = glm::cross(direction, e2);
        const double determinant = glm::dot(e1, p);
        if (determinant == 0) return;
        const glm::dvec3 s = origin - v0, q = glm::cross(s, e1);
        const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
        const double t = glm::dot(e2, q) / determinant;
        if (u < -margin_ || v < -margin_ || u + v > 1 + margin_ || t <= t_min || t >= best_) return;
        best_ = t;
        hit = {float(t), float(u), float(v), geometry.first_primitive + index, instance};
    }

    void visit_sphere(const SphereInput& sphere, glm::dvec3 origin, glm::dvec3 direction,
                      double t_min, uint32_t id, uint32_t instance, Hit& hit) const {
        const glm::dvec3 f = origin - glm::dvec3(sphere.center);
        const double radius = sphere.radius * (1 + margin_);
        const double a = glm::dot(direction, direction), b = glm::dot(f, direction);
        const double discriminant = b * b - a * (glm::dot(f, f) - radius * radius);
        if (discriminant < 0) return;
        const double root = std::sqrt(discriminant);
        for (double t : {(-b - root) / a, (-b + root) / a}) {
            if (t <= t_min || t >= best_) continue;
            best_ = t;
            hit = {float(t), 0, 0, id, instance};
            return;
        }
    }

    const World& world_;
    double margin_;
    mutable double best_ = 0;
};

} // namespace onde::doctor::traversal
