#include "support/reference/geometry.h"

#include "support/reference/sampling.h"

#include <embree3/rtcore.h>

namespace onde::reference {
namespace {

/// Relative to the largest coordinate involved: some 60 roundings, enough for the errors of a
/// position and of the intersection, small beside any detail that single precision can hold.
constexpr float CLEARANCE = 0x1p-18f;

float largest(const glm::vec3& v) {
    return max_component(glm::abs(v));
}

template <class T>
T interpolate(const T& a, const T& b, const T& c, const glm::vec2& uv) {
    return a * (1.0f - uv.x - uv.y) + b * uv.x + c * uv.y;
}

/// How far the planes that the corners' normals n stand on lie above the triangle p, at weights w,
/// summed edge by edge where it is convex as seen from `side` (1 or -1) of `up`.
float bulge(const glm::vec3 (&p)[3], glm::vec3 (&n)[3], const glm::vec3& w, const glm::vec3& up,
            float side) {
    for (glm::vec3& normal : n)
        normal = glm::dot(normal, up) < 0.0f ? -glm::normalize(normal) : glm::normalize(normal);
    float sum = 0.0f;
    for (int i = 0, j = 1; i < 3; j = (++i + 1) % 3)
        sum += w[i] * w[j] * std::max(0.0f, side * glm::dot(p[i] - p[j], n[i] - n[j]));
    return sum;
}

RTCRay embree_ray(const glm::vec3& origin, const glm::vec3& direction, float distance) {
    RTCRay ray{};
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
    ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
    ray.tfar = distance;
    ray.mask = ~0u;
    return ray;
}

} // namespace

glm::vec2 sphere_uv(const glm::vec3& d) {
    return {0.5f + std::atan2(d.x, -d.z) / (2.0f * PI),
            std::acos(glm::clamp(d.y, -1.0f, 1.0f)) / PI};
}

std::optional<Hit> Geometry::intersect(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query;
    query.ray = embree_ray(ray.origin, ray.direction, std::numeric_limits<float>::infinity());
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const bool instanced = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    return Hit{instanced ? query.hit.instID[0] : query.hit.geomID,
               query.hit.primID,
               {query.hit.u, query.hit.v},
               ray.origin + query.ray.tfar * ray.direction};
}

bool Geometry::occluded(const glm::vec3& origin, const glm::vec3& direction, float distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = embree_ray(origin, direction, distance);
    rtcOccluded1(scene_.get(), &context, &ray);
    return ray.tfar < 0.0f;
}

SurfacePoint Geometry::surface_point(const Hit& hit) const {
    return hit.shape == instance_count() ? sphere_point(hit) : triangle_point(hit);
}

SurfacePoint Geometry::sphere_point(const Hit& hit) const {
    const Sphere& s = spheres_[hit.primitive];
    const glm::vec3 n = glm::normalize(hit.position - s.center);
    return {s.center + s.radius * n, n, n, s.material, CLEARANCE * (largest(s.center) + s.radius)};
}

SurfacePoint Geometry::triangle_point(const Hit& hit) const {
    const Shape& shape = shapes_[hit.shape];
    const MeshData& mesh = *shape.mesh;
    const glm::uvec3 t = mesh.triangles[hit.primitive];
    const glm::vec3 p0 = mesh.positions[t.x], p1 = mesh.positions[t.y], p2 = mesh.positions[t.z];
    SurfacePoint point{};
    point.position = interpolate(p0, p1, p2, hit.barycentric);
    point.geometric_normal = glm::cross(p1 - p0, p2 - p0);
    if (!mesh.normals.empty())
        point.shading_normal =
            interpolate(mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z], hit.barycentric);
    point.material = mesh.materials[hit.primitive];
    if (!mesh.normals.empty()) {
        const glm::vec3 corners[] = {p0, p1, p2};
        glm::vec3 normals[] = {mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]};
        const glm::vec3 w(1.0f - hit.barycentric.x - hit.barycentric.y, hit.barycentric);
        point.front_bulge = bulge(corners, normals, w, point.geometric_normal, 1.0f);
        point.back_bulge = bulge(corners, normals, w, point.geometric_normal, -1.0f);
    }
    float extent = largest(glm::max(glm::max(glm::abs(p0), glm::abs(p1)), glm::abs(p2)));
    if (!shape.baked) {
        const glm::mat3 linear(shape.to_world);
        point.position = shape.to_world * glm::vec4(point.position, 1.0f);
        point.geometric_normal = shape.normal_to_world * point.geometric_normal;
        point.shading_normal = shape.normal_to_world * point.shading_normal;
        const float scale =
            std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
        point.front_bulge *= scale, point.back_bulge *= scale;
        extent = extent * largest(glm::abs(linear[0]) + glm::abs(linear[1]) + glm::abs(linear[2])) +
                 largest(shape.to_world[3]);
    }
    point.geometric_normal = glm::normalize(point.geometric_normal);
    const float length = mesh.normals.empty() ? 0.0f : glm::length(point.shading_normal);
    point.shading_normal = length > 0.0f ? point.shading_normal / length : point.geometric_normal;
    point.clearance = CLEARANCE * extent;
    return point;
}

glm::vec2 Geometry::uv(const Hit& hit) const {
    if (hit.shape == instance_count())
        return sphere_uv(glm::normalize(hit.position - spheres_[hit.primitive].center));
    const MeshData& mesh = *shapes_[hit.shape].mesh;
    if (mesh.uvs.empty()) return glm::vec2(0.0f);
    const glm::uvec3 t = mesh.triangles[hit.primitive];
    return interpolate(mesh.uvs[t.x], mesh.uvs[t.y], mesh.uvs[t.z], hit.barycentric);
}

Tangents Geometry::tangents(const Hit& hit) const {
    if (hit.shape == instance_count()) {
        const glm::vec3 d = hit.position - spheres_[hit.primitive].center;
        const glm::vec3 dpdu(-d.z, 0.0f, d.x);
        return {dpdu, glm::cross(d, dpdu)};
    }
    const WorldTriangle t = triangle(hit.shape, hit.primitive);
    const glm::vec2 d1 = t.uv1 - t.uv0, d2 = t.uv2 - t.uv0;
    const float determinant = d1.x * d2.y - d1.y * d2.x;
    if (determinant == 0.0f) return {};
    return {(d2.y * t.e1 - d1.y * t.e2) / determinant, (d1.x * t.e2 - d2.x * t.e1) / determinant};
}

uint32_t Geometry::triangle_count(uint32_t shape) const {
    return shapes_[shape].mesh->triangle_count;
}

WorldTriangle Geometry::triangle(uint32_t shape, uint32_t primitive) const {
    const Shape& s = shapes_[shape];
    const MeshData& mesh = *s.mesh;
    glm::uvec3 t = mesh.triangles[primitive];
    if (s.mirrored) std::swap(t.y, t.z);
    const auto corner = [&](uint32_t i) {
        return s.baked ? mesh.positions[i] : s.to_world * glm::vec4(mesh.positions[i], 1.0f);
    };
    const auto uv = [&](uint32_t i) { return mesh.uvs.empty() ? glm::vec2(0.0f) : mesh.uvs[i]; };
    const glm::vec3 p0 = corner(t.x);
    return {p0,      corner(t.y) - p0, corner(t.z) - p0,         uv(t.x),
            uv(t.y), uv(t.z),          mesh.materials[primitive]};
}

} // namespace onde::reference
