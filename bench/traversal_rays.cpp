#include "traversal_rays.h"

#include "traversal_embree.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <random>

namespace onde::bench {

namespace {

using Generator = std::mt19937;

float uniform(Generator& generator) {
    return float(generator() >> 8) * 0x1p-24f;
}

/// A point on the model and the normal on the side from which it was hit.
struct Vertex {
    glm::vec3 position, normal;
};

std::vector<Ray> primary_rays(const Camera& camera, uint32_t side, Generator& generator) {
    constexpr uint32_t TILE = 8, SAMPLES = 4;
    const float scale = 2.0f * std::tan(0.5f * camera.vertical_fov) / float(side);
    const glm::vec3 eye(camera.camera_to_world[3]);
    std::vector<Ray> rays;
    for (uint32_t tile = 0; tile < (side / TILE) * (side / TILE); ++tile)
        for (uint32_t i = 0; i < TILE * TILE * SAMPLES; ++i) {
            const uint32_t pixel = i / SAMPLES;
            const auto x = float(TILE * (tile % (side / TILE)) + pixel % TILE);
            const auto y = float(TILE * (tile / (side / TILE)) + pixel / TILE);
            const float right = (x + uniform(generator) - 0.5f * float(side)) * scale;
            const float up = (0.5f * float(side) - y - uniform(generator)) * scale;
            const glm::vec3 direction(camera.camera_to_world * glm::vec4(right, up, -1.0f, 0.0f));
            rays.push_back({eye, 0.0f, glm::normalize(direction), 1e30f});
        }
    return rays;
}

std::vector<Vertex> hit_points(const Model& model, const EmbreeScene& oracle,
                               const std::vector<Ray>& rays) {
    std::vector<Hit> hits(rays.size());
    embree_closest(oracle, EMBREE_SINGLE, rays, hits);
    std::vector<Vertex> vertices;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].primitive == BVH_NONE) continue;
        const glm::uvec3 corners = model.triangles[hits[i].primitive];
        const glm::dvec3 v0(
            model.positions[corners.x]); // squares of short edges underflow in float
        const glm::dvec3 across = glm::cross(glm::dvec3(model.positions[corners.y]) - v0,
                                             glm::dvec3(model.positions[corners.z]) - v0);
        const double side = glm::dot(across, glm::dvec3(rays[i].direction)) > 0.0 ? -1.0 : 1.0;
        const glm::vec3 normal(side * glm::normalize(across));
        const glm::vec3 position = rays[i].origin + hits[i].t * rays[i].direction;
        vertices.push_back({position + 1e-5f * model.extent() * normal, normal});
    }
    return vertices;
}

/// A uniform point of the unit sphere, added to the normal, is cosine-distributed.
glm::vec3 cosine_direction(Generator& generator, glm::vec3 normal) {
    const float z = 1.0f - 2.0f * uniform(generator);
    const float angle = 2.0f * std::numbers::pi_v<float> * uniform(generator);
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const glm::vec3 sum = normal + glm::vec3(r * std::cos(angle), r * std::sin(angle), z);
    return glm::length(sum) > 1e-3f ? glm::normalize(sum) : normal;
}

std::vector<Ray> diffuse_rays(const std::vector<Vertex>& vertices, float t_max,
                              Generator& generator) {
    std::vector<Ray> rays;
    rays.reserve(vertices.size());
    for (const Vertex& vertex : vertices)
        rays.push_back({vertex.position, 0.0f, cosine_direction(generator, vertex.normal), t_max});
    return rays;
}

std::vector<Ray> shadow_rays(const std::vector<Vertex>& vertices, const Model& model,
                             Generator& generator) {
    std::vector<Ray> rays;
    rays.reserve(vertices.size());
    for (const Vertex& vertex : vertices) {
        const float x = uniform(generator), y = uniform(generator), z = uniform(generator);
        const glm::vec3 jitter = 0.05f * model.extent() * (glm::vec3(x, y, z) - 0.5f);
        rays.push_back({vertex.position, 0.0f, model.light + jitter - vertex.position, 0.999f});
    }
    return rays;
}

/// The rays of one picture, set by set.
std::array<std::vector<Ray>, 5> picture_rays(const Model& model, const EmbreeScene& oracle,
                                             uint32_t side, Generator& generator) {
    constexpr float FAR = 1e30f;
    std::vector<Ray> primary = primary_rays(model.camera, side, generator);
    const std::vector<Vertex> seen = hit_points(model, oracle, primary);
    std::vector<Ray> bounce = diffuse_rays(seen, FAR, generator);
    const auto bounce2 = diffuse_rays(hit_points(model, oracle, bounce), FAR, generator);
    auto bounce3 = diffuse_rays(hit_points(model, oracle, bounce2), FAR, generator);
    return {std::move(primary), shadow_rays(seen, model, generator),
            diffuse_rays(seen, 0.05f * model.extent(), generator), std::move(bounce),
            std::move(bounce3)};
}

} // namespace

std::vector<RaySet> record_rays(const Model& model, const EmbreeScene& oracle, uint32_t side) {
    constexpr int MOST_PICTURES = 64;
    std::vector<RaySet> sets = {
        {"primary", false}, {"shadow", true}, {"ao", true}, {"bounce", false}, {"bounce3", false}};
    Generator generator(1);
    const auto is_short = [&](const RaySet& set) {
        return 2 * set.rays.size() < sets[0].rays.size() || set.rays.empty();
    };
    for (int i = 0; i < MOST_PICTURES && std::ranges::any_of(sets, is_short); ++i) {
        const auto more = picture_rays(model, oracle, side, generator);
        for (size_t set = 0; set < sets.size(); ++set)
            if (is_short(sets[set]))
                sets[set].rays.insert(sets[set].rays.end(), more[set].begin(), more[set].end());
    }
    return sets;
}

} // namespace onde::bench
