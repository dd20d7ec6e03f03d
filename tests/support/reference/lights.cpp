#include "support/reference/lights.h"

#include "support/reference/sampling.h"

namespace onde::reference {
namespace {

/// What a sphere looks like from a point: a cone of directions, or everything from inside.
struct SphereView {
    glm::vec3 to_center;
    float distance2;
    float sine2; ///< of the cone's half angle; 1 or more: inside, or too close to tell

    SphereView(const Sphere& sphere, const glm::vec3& from)
        : to_center(sphere.center - from), distance2(glm::dot(to_center, to_center)),
          sine2(sphere.radius * sphere.radius / distance2) {}

    bool inside() const { return sine2 > 0.99999f; }
    /// 1 - cosine of the half angle, without cancellation.
    float cone_height() const { return sine2 / (1.0f + safe_sqrt(1.0f - sine2)); }
    float cone_pdf() const { return 1.0f / (2.0f * PI * cone_height()); }
};

float area_to_solid_angle(float area_pdf, float distance2, float cosine) {
    return area_pdf * distance2 / std::max(std::abs(cosine), 1e-12f);
}

} // namespace

Lights::Lights(const Scene& scene, const Geometry& geometry, const Appearance& appearance)
    : geometry_(geometry), appearance_(appearance), environment_(scene.environment),
      point_lights_(scene.point_lights), directional_lights_(scene.directional_lights),
      light_of_(geometry.instance_count() + 1) {
    for (uint32_t shape = 0; shape < geometry.instance_count(); ++shape) add_triangles(shape);
    add_spheres();
    const float disk = PI * geometry.radius() * geometry.radius();
    for (size_t i = 0; i < point_lights_.size(); ++i)
        add_light(Kind::point, i, 4.0f * PI * luminance(point_lights_[i].intensity));
    for (size_t i = 0; i < directional_lights_.size(); ++i)
        add_light(Kind::directional, i, disk * luminance(directional_lights_[i].irradiance));
    if (!environment_.is_black()) {
        environment_index_ = uint32_t(lights_.size());
        add_light(Kind::environment, 0, disk * environment_.integral());
    }
    choice_ = AliasTable(powers_);
}

void Lights::add_light(Kind kind, size_t index, float power) {
    lights_.push_back({kind, uint32_t(index)});
    powers_.push_back(power);
}

void Lights::add_triangles(uint32_t shape) {
    const uint32_t count = geometry_.triangle_count(shape);
    std::vector<uint32_t>& light_of = light_of_[shape];
    for (uint32_t i = 0; i < count; ++i) {
        const WorldTriangle t = geometry_.triangle(shape, i);
        const MaterialRecord& material = appearance_.material(t.material);
        if (!material.emits()) continue;
        const glm::vec3 normal = glm::cross(t.e1, t.e2);
        const float area = 0.5f * glm::length(normal);
        if (!(area > 0.0f)) continue;
        if (light_of.empty()) light_of.assign(count, NO_LIGHT);
        light_of[i] = uint32_t(lights_.size());
        const float sides = material.two_sided ? 2.0f : 1.0f;
        const float power = sides * PI * area * luminance(appearance_.mean_emission(t.material));
        add_light(Kind::triangle, triangles_.size(), power);
        const glm::vec3 corner = glm::abs(t.p0) + glm::abs(t.e1) + glm::abs(t.e2);
        triangles_.push_back({t, normal / (2.0f * area), area, 0x1p-18f * max_component(corner)});
    }
}

void Lights::add_spheres() {
    const std::span<const Sphere> spheres = geometry_.spheres();
    std::vector<uint32_t>& light_of = light_of_[geometry_.instance_count()];
    for (size_t i = 0; i < spheres.size(); ++i) {
        const MaterialRecord& material = appearance_.material(spheres[i].material);
        if (!material.emits()) continue;
        if (light_of.empty()) light_of.assign(spheres.size(), NO_LIGHT);
        light_of[i] = uint32_t(lights_.size());
        const float area = 4.0f * PI * spheres[i].radius * spheres[i].radius;
        add_light(Kind::sphere, i,
                  PI * area * luminance(appearance_.mean_emission(spheres[i].material)));
    }
}

std::optional<LightSample> Lights::sample(const glm::vec3& position, Random& random) const {
    if (choice_.empty()) return std::nullopt;
    const AliasTable::Choice choice = choice_.sample(random.next());
    const Light& light = lights_[choice.index];
    std::optional<LightSample> s;
    switch (light.kind) {
    case Kind::triangle:
        s = sample_triangle_light(triangles_[light.index], position, random);
        break;
    case Kind::sphere:
        s = sample_sphere_light(geometry_.spheres()[light.index], position, random);
        break;
    case Kind::point: {
        const PointLight& point = point_lights_[light.index];
        const glm::vec3 d = point.position - position;
        const float distance2 = glm::dot(d, d);
        s = {d / std::sqrt(distance2),
             point.intensity / distance2,
             1.0f,
             true,
             point.position,
             false};
        break;
    }
    case Kind::directional: {
        const DirectionalLight& sun = directional_lights_[light.index];
        s = {sun.to_light, sun.irradiance, 1.0f, true, {}, true};
        break;
    }
    case Kind::environment:
        s = sample_environment(random);
        break;
    }
    if (s) s->pdf *= choice.pmf;
    return s;
}

std::optional<LightSample> Lights::sample_triangle_light(const TriangleLight& light,
                                                         const glm::vec3& position,
                                                         Random& random) const {
    const WorldTriangle& t = light.corners;
    const glm::vec2 b = sample_triangle(random.next2());
    const glm::vec3 on_light = t.p0 + b.x * t.e1 + b.y * t.e2;
    const glm::vec3 d = on_light - position;
    const float distance2 = glm::dot(d, d), distance = std::sqrt(distance2);
    const float cosine = -glm::dot(d, light.normal) / distance;
    const glm::vec2 uv = t.uv0 + b.x * (t.uv1 - t.uv0) + b.y * (t.uv2 - t.uv0);
    const glm::vec3 radiance =
        appearance_.emission(appearance_.material(t.material), uv, cosine > 0.0f);
    if (radiance == glm::vec3(0.0f) || !(distance2 > 0.0f)) return std::nullopt;
    return LightSample{d / distance,
                       radiance,
                       area_to_solid_angle(1.0f / light.area, distance2, cosine),
                       false,
                       on_light + std::copysign(light.clearance, cosine) * light.normal,
                       false};
}

std::optional<LightSample>
Lights::sample_sphere_light(const Sphere& sphere, const glm::vec3& position, Random& random) const {
    const SphereView view(sphere, position);
    const glm::vec2 u = random.next2();
    glm::vec3 normal; // of the sphere at the sampled point
    if (view.inside()) {
        normal = sample_sphere(u);
    } else {
        const float height = view.cone_height() * u.x, cosine = 1.0f - height;
        const float sine2 = height * (2.0f - height);
        const glm::vec3 axis = view.to_center / std::sqrt(view.distance2);
        const float phi = 2.0f * PI * u.y;
        const glm::vec2 around = std::sqrt(sine2) * glm::vec2(std::cos(phi), std::sin(phi));
        const glm::vec3 d = Frame(axis).to_world(glm::vec3(around, cosine));
        const float t = std::sqrt(view.distance2) * cosine -
                        safe_sqrt(sphere.radius * sphere.radius - view.distance2 * sine2);
        normal = glm::normalize(t * d - view.to_center);
    }
    const glm::vec3 on_light = sphere.center + sphere.radius * normal;
    const glm::vec3 d = on_light - position;
    const float distance2 = glm::dot(d, d), distance = std::sqrt(distance2);
    const float cosine = -glm::dot(d, normal) / distance;
    const MaterialRecord& material = appearance_.material(sphere.material);
    const glm::vec2 uv =
        material.emission_texture == NO_TEXTURE ? glm::vec2(0.0f) : sphere_uv(normal);
    const glm::vec3 radiance = appearance_.emission(material, uv, cosine > 0.0f);
    if (radiance == glm::vec3(0.0f) || !(distance2 > 0.0f)) return std::nullopt;
    const float area_pdf = 1.0f / (4.0f * PI * sphere.radius * sphere.radius);
    const float pdf =
        view.inside() ? area_to_solid_angle(area_pdf, distance2, cosine) : view.cone_pdf();
    const float clearance = 0x1p-18f * (max_component(glm::abs(sphere.center)) + sphere.radius);
    return LightSample{
        d / distance, radiance, pdf, false, on_light + std::copysign(clearance, cosine) * normal,
        false};
}

LightSample Lights::sample_environment(Random& random) const {
    const EnvironmentLight::Sample s = environment_.sample(random);
    return {s.direction, environment_.radiance(s.direction), s.pdf, false, {}, true};
}

uint32_t Lights::light_of(const Hit& hit) const {
    const std::vector<uint32_t>& shape = light_of_[hit.shape];
    return shape.empty() ? NO_LIGHT : shape[hit.primitive];
}

float Lights::pdf(const Hit& hit, const SurfacePoint& point, const glm::vec3& from) const {
    const uint32_t index = light_of(hit);
    if (index == NO_LIGHT) return 0.0f;
    const float pmf = choice_.pmf(index);
    const glm::vec3 d = point.position - from;
    const float distance2 = glm::dot(d, d);
    const float cosine = glm::dot(d, point.geometric_normal) / std::sqrt(distance2);
    if (lights_[index].kind == Kind::triangle)
        return pmf *
               area_to_solid_angle(1.0f / triangles_[lights_[index].index].area, distance2, cosine);
    const Sphere& sphere = geometry_.spheres()[hit.primitive];
    const SphereView view(sphere, from);
    if (!view.inside()) return pmf * view.cone_pdf();
    return pmf * area_to_solid_angle(1.0f / (4.0f * PI * sphere.radius * sphere.radius), distance2,
                                     cosine);
}

float Lights::environment_pdf(const glm::vec3& direction) const {
    return environment_index_ == NO_LIGHT
               ? 0.0f
               : choice_.pmf(environment_index_) * environment_.pdf(direction);
}

} // namespace onde::reference
