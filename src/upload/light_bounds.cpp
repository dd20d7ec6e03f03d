#include "upload/light_bounds.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde {
namespace {

constexpr double PI = std::numbers::pi;

glm::dvec3 vector_of(const float (&v)[3]) {
    return {double(v[0]), double(v[1]), double(v[2])};
}

/// The angle between unit vectors; exact where they are almost the same.
double angle_between(glm::dvec3 a, glm::dvec3 b) {
    return 2 * std::atan2(glm::length(a - b), glm::length(a + b));
}

/// a, turned by an angle toward b, which has another direction than a and -a.
glm::dvec3 turned(glm::dvec3 a, glm::dvec3 b, double angle) {
    const glm::dvec3 across = glm::normalize(b - a * glm::dot(a, b));
    return glm::normalize(a * std::cos(angle) + across * std::sin(angle));
}

void join_cones(LightBounds& all, const LightBounds& a, const LightBounds& b) {
    const LightBounds& wide = a.spread >= b.spread ? a : b;
    const LightBounds& narrow = a.spread >= b.spread ? b : a;
    const double apart = angle_between(wide.axis, narrow.axis);
    all.axis = wide.axis;
    all.spread = wide.spread;
    if (std::min(apart + narrow.spread, PI) <= wide.spread) return;
    all.spread = (wide.spread + apart + narrow.spread) / 2;
    const bool opposite = apart > PI - 1e-9;
    if (all.spread >= PI || opposite) {
        all.spread = PI;
    } else if (apart > 1e-9) {
        all.axis = turned(wide.axis, narrow.axis, all.spread - wide.spread);
    }
}

void add_point(LightBounds& bounds, glm::dvec3 p) {
    bounds.low = glm::min(bounds.low, p);
    bounds.high = glm::max(bounds.high, p);
}

LightBounds at_point(glm::dvec3 p) {
    LightBounds bounds;
    bounds.low = bounds.high = p;
    return bounds;
}

/// One that sends light to the side of the axis, or to both.
void set_face(LightBounds& bounds, glm::dvec3 normal, bool two_sided) {
    const double length = glm::length(normal);
    const bool has_normal = length > 0 && std::isfinite(length);
    if (has_normal) bounds.axis = normal / length;
    bounds.spread = two_sided || !has_normal ? PI : 0;
    bounds.reach = PI / 2;
}

LightBounds bounds_of(const TriangleLightRecord& t, bool two_sided) {
    const glm::dvec3 corner = vector_of(t.corner), e1 = vector_of(t.edge1), e2 = vector_of(t.edge2);
    LightBounds bounds = at_point(corner);
    add_point(bounds, corner + e1);
    add_point(bounds, corner + e2);
    set_face(bounds, double(t.orientation) * glm::cross(e1, e2), two_sided);
    return bounds;
}

LightBounds bounds_of(const DiskLightRecord& d, bool two_sided) {
    const glm::dvec3 r1 = vector_of(d.radius1), r2 = vector_of(d.radius2);
    const glm::dvec3 reach = glm::sqrt(r1 * r1 + r2 * r2);
    LightBounds bounds = at_point(vector_of(d.center) - reach);
    add_point(bounds, vector_of(d.center) + reach);
    set_face(bounds, double(d.orientation) * glm::cross(r1, r2), two_sided);
    return bounds;
}

/// One that shines all around.
LightBounds round(glm::dvec3 center, double radius) {
    LightBounds bounds = at_point(center - radius);
    add_point(bounds, center + radius);
    bounds.spread = PI;
    bounds.reach = PI / 2;
    return bounds;
}

LightBounds bounds_of(const SpotLightRecord& s) {
    LightBounds bounds = at_point(vector_of(s.position));
    bounds.axis = glm::normalize(-vector_of(s.back));
    bounds.reach = std::acos(std::clamp(1 - double(s.opening), -1.0, 1.0));
    return bounds;
}

/// One that shines alike into a cone.
LightBounds bounds_of(const PhotometricLightRecord& p) {
    constexpr double RIM = 0.01; // radians, so that directions of its rim are inside
    const glm::dquat turn(double(p.turn[3]), double(p.turn[0]), double(p.turn[1]),
                          double(p.turn[2]));
    LightBounds bounds = at_point(vector_of(p.position));
    bounds.axis = glm::normalize(turn * glm::dvec3(0, 0, 1));
    bounds.spread = std::acos(std::clamp(1 - double(p.opening), -1.0, 1.0));
    bounds.reach = RIM;
    return bounds;
}

} // namespace

LightBounds joined(const LightBounds& a, const LightBounds& b) {
    LightBounds all;
    all.low = glm::min(a.low, b.low);
    all.high = glm::max(a.high, b.high);
    all.reach = std::max(a.reach, b.reach);
    all.power = a.power + b.power;
    join_cones(all, a, b);
    return all;
}

LightBounds bounds_of(const LightRecord& light, bool two_sided, double power) {
    LightBounds bounds;
    switch (light.kind) {
    case LIGHT_TRIANGLE:
        bounds = bounds_of(light.as.triangle, two_sided);
        break;
    case LIGHT_DISK:
        bounds = bounds_of(light.as.disk, two_sided);
        break;
    case LIGHT_SPHERE:
        bounds = round(vector_of(light.as.sphere.center), double(light.as.sphere.radius));
        break;
    case LIGHT_SPOT:
        bounds = bounds_of(light.as.spot);
        break;
    case LIGHT_PHOTOMETRIC:
        bounds = bounds_of(light.as.photometric);
        break;
    default:
        bounds = round(vector_of(light.as.point.position), 0);
    }
    bounds.power = power;
    return bounds;
}

} // namespace onde
