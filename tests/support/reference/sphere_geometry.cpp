#include "support/reference/sphere_geometry.h"

#include <optional>

namespace onde::reference {
namespace {

const Sphere& sphere_of(void* spheres, unsigned int primitive) {
    return static_cast<const Sphere*>(spheres)[primitive];
}

void bounds(const RTCBoundsFunctionArguments* args) {
    const Sphere& s = sphere_of(args->geometryUserPtr, args->primID);
    const glm::vec3 low = s.center - s.radius, high = s.center + s.radius;
    *args->bounds_o = {low.x, low.y, low.z, 0.0f, high.x, high.y, high.z, 0.0f};
}

/// The nearest distance along the ray within its limits.
std::optional<float> distance(const RTCRay& ray, const Sphere& sphere) {
    const glm::dvec3 direction(ray.dir_x, ray.dir_y, ray.dir_z);
    const glm::dvec3 to_center =
        glm::dvec3(sphere.center) - glm::dvec3(ray.org_x, ray.org_y, ray.org_z);
    const double a = glm::dot(direction, direction), b = glm::dot(to_center, direction);
    const double c = glm::dot(to_center, to_center) - double(sphere.radius) * sphere.radius;
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return std::nullopt;
    const double root = std::sqrt(discriminant);
    for (const double t : {(b - root) / a, (b + root) / a})
        if (t > ray.tnear && t <= ray.tfar) return float(t);
    return std::nullopt;
}

void intersect(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    auto* query = reinterpret_cast<RTCRayHit*>(args->rayhit);
    const Sphere& sphere = sphere_of(args->geometryUserPtr, args->primID);
    const std::optional<float> t = distance(query->ray, sphere);
    if (!t) return;
    query->ray.tfar = *t;
    query->hit.geomID = args->geomID;
    query->hit.primID = args->primID;
    query->hit.instID[0] = args->context->instID[0];
}

void occluded(const RTCOccludedFunctionNArguments* args) {
    if (!args->valid[0]) return;
    auto* ray = reinterpret_cast<RTCRay*>(args->ray);
    if (distance(*ray, sphere_of(args->geometryUserPtr, args->primID)))
        ray->tfar = -std::numeric_limits<float>::infinity();
}

} // namespace

RTCGeometry new_sphere_geometry(RTCDevice device, std::span<const Sphere> spheres) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(spheres.size()));
    rtcSetGeometryUserData(geometry, const_cast<Sphere*>(spheres.data()));
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, occluded);
    return geometry;
}

} // namespace onde::reference
