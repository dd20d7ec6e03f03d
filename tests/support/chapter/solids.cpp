#include "support/chapter/solids.h"

namespace onde::chapter {
namespace {

using glm::dvec3;

/// Both roots of a t^2 + 2 b t + c, none where it has less than two.
Roots quadratic(double a, double b, double c) {
    Roots found;
    const double d = b * b - a * c;
    if (d <= 0 || a == 0) return found;
    const double q = -(b + std::copysign(std::sqrt(d), b));
    found.add(q / a);
    found.add(q != 0 ? c / q : 0.0);
    return found;
}

double distance_from_axis(const dvec3& p) {
    return std::hypot(p.x, p.z);
}

/// The disk of radius 1 at height y that looks along `normal`.
void cross_cap(const Ray& ray, double y, const dvec3& normal, Crossings& found) {
    if (ray.direction.y == 0) return;
    const double t = (y - ray.origin.y) / ray.direction.y;
    if (distance_from_axis(ray.at(t)) <= 1) found.add({t, normal});
}

Crossings cross_cylinder(const Ray& ray) {
    const auto& [o, d] = ray;
    Crossings found;
    for (const double t :
         quadratic(d.x * d.x + d.z * d.z, o.x * d.x + o.z * d.z, o.x * o.x + o.z * o.z - 1)) {
        const dvec3 p = ray.at(t);
        if (std::abs(p.y) < 1) found.add({t, {p.x, 0, p.z}});
    }
    cross_cap(ray, 1, {0, 1, 0}, found);
    cross_cap(ray, -1, {0, -1, 0}, found);
    return found;
}

/// x^2 + z^2 = (1 - y)^2 below the tip, and the base.
Crossings cross_cone(const Ray& ray) {
    const auto& [o, d] = ray;
    const double up = 1 - o.y;
    Crossings found;
    for (const double t :
         quadratic(d.x * d.x + d.z * d.z - d.y * d.y, o.x * d.x + o.z * d.z + up * d.y,
                   o.x * o.x + o.z * o.z - up * up)) {
        const dvec3 p = ray.at(t);
        if (p.y > 0 && p.y < 1) found.add({t, {p.x, 1 - p.y, p.z}});
    }
    cross_cap(ray, 0, {0, -1, 0}, found);
    return found;
}

/// (|p|^2 + 1 - r^2)^2 = 4 (x^2 + z^2), with t counted from the point nearest to the centre.
Crossings cross_torus(double minor_radius, const Ray& ray) {
    const double length = glm::length(ray.direction);
    const dvec3 d = ray.direction / length;
    const double nearest = -glm::dot(ray.origin, d);
    const dvec3 o = ray.origin + nearest * d;
    const double k = glm::dot(o, o) + 1 - minor_radius * minor_radius;
    const Polynomial f{k * k - 4 * (o.x * o.x + o.z * o.z), -8 * (o.x * d.x + o.z * d.z),
                       2 * k - 4 * (d.x * d.x + d.z * d.z), 0, 1};
    Crossings found;
    for (const double t : roots(f, -3, 3)) {
        const dvec3 p = o + t * d;
        const double rho = distance_from_axis(p);
        const dvec3 ring(p.x / rho, 0, p.z / rho);
        found.add({(t + nearest) / length, p - ring});
    }
    return found;
}

} // namespace

Crossings cross_sphere(const Ray& ray) {
    const auto& [o, d] = ray;
    Crossings found;
    for (const double t : quadratic(glm::dot(d, d), glm::dot(o, d), glm::dot(o, o) - 1))
        found.add({t, ray.at(t)});
    return found;
}

Crossings cross_shape(ShapeKind kind, double minor_radius, const Ray& ray) {
    Crossings found;
    switch (kind) {
    case ShapeKind::sphere:
        return cross_sphere(ray);
    case ShapeKind::disk:
        cross_cap(ray, 0, {0, 1, 0}, found);
        return found;
    case ShapeKind::cylinder:
        return cross_cylinder(ray);
    case ShapeKind::cone:
        return cross_cone(ray);
    case ShapeKind::torus:
        return cross_torus(minor_radius, ray);
    }
    return found;
}

std::optional<Crossing> cross_triangle(const dvec3 (&corners)[3], const Ray& ray) {
    const dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double slope = glm::dot(normal, ray.direction);
    if (slope == 0) return {};
    const double t = glm::dot(normal, corners[0] - ray.origin) / slope;
    const dvec3 p = ray.at(t);
    for (int i = 0; i < 3; ++i) {
        const dvec3 edge = corners[(i + 1) % 3] - corners[i];
        if (glm::dot(glm::cross(edge, p - corners[i]), normal) < 0) return {};
    }
    return Crossing{t, normal};
}

} // namespace onde::chapter
