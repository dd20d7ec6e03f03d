// Lights on the device: sampled, found by rays, and what their samples integrate to.
#pragma once

#include "doctor/scene_probe.h"
#include "doctor/statistics.h"

namespace onde::doctor::lights {

inline Material emitter(float radiance, bool two_sided = false) {
    Material material;
    material.emission = glm::vec3(radiance, 1, 2);
    material.two_sided = two_sided;
    return material;
}

struct Triangle {
    glm::vec3 a, b, c;
};
inline constexpr Triangle TRIANGLE{{-1, 2, 0.5f}, {1.5f, 2.5f, -1}, {0, 2, 2}}; // front downward

inline Scene triangle_scene(bool two_sided = false) {
    Scene scene;
    add_triangle(scene, TRIANGLE.a, TRIANGLE.b, TRIANGLE.c, emitter(3, two_sided));
    return scene;
}
inline Scene sphere_scene(bool two_sided) {
    Scene scene;
    scene.materials.push_back(emitter(3, two_sided));
    scene.spheres.push_back({{1, 2, 3}, 0.75f, 0});
    return scene;
}

/// Shines up to 60 degrees from straight down, most on one side.
inline PhotometricLight lopsided_lamp(glm::vec3 position, float intensity) {
    PhotometricLight lamp{.position = position, .intensity = glm::vec3(intensity)};
    lamp.profile.rows = 6;
    lamp.profile.columns = 4;
    lamp.profile.candela.clear();
    for (const float row : {900.0f, 600.0f, 200.0f, 0.0f, 0.0f, 0.0f, 0.0f})
        for (const float side : {1.0f, 0.5f, 0.25f, 0.75f})
            lamp.profile.candela.push_back(row == 900.0f ? row : row * side);
    return lamp;
}

/// A light of every type.
inline Scene every_light() {
    Scene scene = triangle_scene(true);
    scene.materials.push_back(emitter(5, true));
    scene.spheres.push_back({{-3, 1, 0}, 0.5f, 1});
    Shape disk;
    disk.kind = ShapeKind::disk;
    disk.material = 1;
    disk.object_to_world[3] = glm::vec4(2, -3, 1, 1);
    scene.shapes.push_back(disk);
    scene.point_lights.push_back({{0, -4, 3}, {10, 20, 30}});
    scene.spot_lights.push_back({{0, 0, 5}, {0, 0, 1}, glm::vec3(4)});
    scene.photometric_lights.push_back(lopsided_lamp({0.5f, 5, 0}, 10));
    scene.directional_lights.push_back({{0, 0.8f, 0.6f}, {1, 2, 3}});
    scene.directional_lights.push_back({{0.6f, 0, -0.8f}, {3, 2, 1}, 0.1f});
    scene.environment.radiance = glm::vec3(0.5f);
    return scene;
}

/// Lights of all types that have a place, in a cube of that side, and three that have none.
inline Scene many_lights(size_t count, float side = 10) {
    Generator generator(74);
    const auto place = [&] {
        return side * glm::vec3(unit(generator), unit(generator), unit(generator));
    };
    Scene scene;
    for (size_t i = 0; i < count; i++) {
        const glm::vec3 at = place(), way = unit_vector(generator);
        const Material glow = emitter(std::exp2(4 * unit(generator)), i % 10 == 5);
        if (i % 10 == 5) {
            scene.photometric_lights.push_back(lopsided_lamp(at, glow.emission.x));
            scene.photometric_lights.back().back = way;
            scene.photometric_lights.back().start = unit_vector(generator);
        } else if (i % 5 == 0) {
            scene.point_lights.push_back({at, glow.emission});
        } else if (i % 5 == 1) {
            SpotLight spot{at, way, glow.emission};
            spot.half_angle = 0.2f + unit(generator);
            scene.spot_lights.push_back(spot);
        } else if (i % 5 == 2) {
            scene.spheres.push_back({at, 0.02f * side, uint32_t(scene.materials.size())});
            scene.materials.push_back(glow);
        } else {
            const glm::vec3 across = glm::cross(way, unit_vector(generator));
            add_triangle(scene, at, at + 0.05f * side * way, at + 0.05f * side * across, glow);
        }
    }
    scene.directional_lights.push_back({{0, 0.8f, 0.6f}, {1, 2, 3}});
    scene.directional_lights.push_back({{0.6f, 0.8f, 0}, {1, 2, 3}, 0.2f});
    scene.environment.radiance = glm::vec3(0.5f);
    return scene;
}

/// What points with normals choose of the lights: the light, its probability, what is left of the
/// number, and the probability of the light that is asked for.
struct LightChoices {
    std::vector<uint32_t> light;
    Column pmf, rest, pmf_of_asked;
};

struct ChoiceInput {
    std::vector<glm::vec3> points, normals;
    Column u, asked;
};

inline LightChoices choose_lights(SceneProbe& probe, const ChoiceInput& input) {
    Columns in;
    add_vectors(in, input.points);
    add_vectors(in, input.normals);
    in.push_back(input.u);
    in.push_back(input.asked);
    in.push_back(constant_column(input.u.size(), 1));
    const Columns out = probe.run("light_choice", in, 4);
    LightChoices choices{{}, out[1], out[2], out[3]};
    for (const float word : out[0]) choices.light.push_back(from_word(word));
    return choices;
}

/// The probabilities of all lights for one point.
inline std::vector<double> choice_probabilities(SceneProbe& probe, glm::vec3 point,
                                                glm::vec3 normal) {
    const size_t count = probe.packed().lights.size();
    ChoiceInput input{
        std::vector(count, point), std::vector(count, normal), constant_column(count, 0.5f), {}};
    for (uint32_t i = 0; i < count; i++) input.asked.push_back(word(i));
    const LightChoices all = choose_lights(probe, input);
    return {all.pmf_of_asked.begin(), all.pmf_of_asked.end()};
}

/// A chi-square test of `count` choices of one point against the lights' probabilities; empty when
/// they agree.
inline std::string choice_failure(SceneProbe& probe, glm::vec3 point, glm::vec3 normal,
                                  size_t count, double significance) {
    Generator generator(75);
    std::vector<double> observed(probe.packed().lights.size());
    const LightChoices chosen =
        choose_lights(probe, {std::vector(count, point), std::vector(count, normal),
                              uniform_column(generator, count), word_column(count, 0)});
    for (const uint32_t light : chosen.light) observed[light]++;
    std::vector<double> expected = choice_probabilities(probe, point, normal);
    for (double& pmf : expected) pmf *= double(count);
    return chi_square_failure(observed, expected, significance);
}

struct LightSamples {
    std::vector<glm::vec3> direction, radiance;
    Column distance, pdf, delta, valid;
};

inline LightSamples sample(SceneProbe& probe, glm::vec3 from, size_t count) {
    Generator generator(71);
    Columns in;
    add_vectors(in, std::vector<glm::vec3>(count, from));
    for (int k = 0; k < 3; k++) in.push_back(uniform_column(generator, count));
    in.push_back(constant_column(count, 1));
    const Columns out = probe.run("light_sample", in, 10);
    LightSamples samples{{}, {}, out[3], out[7], out[8], out[9]};
    for (size_t i = 0; i < count; i++) {
        samples.direction.emplace_back(vector_at(out, 0, i));
        samples.radiance.emplace_back(vector_at(out, 4, i));
    }
    return samples;
}

/// What rays from one point find: see probe_surface.
inline Columns look(SceneProbe& probe, glm::vec3 from, const std::vector<glm::vec3>& directions) {
    Columns in;
    add_vectors(in, std::vector<glm::vec3>(directions.size(), from));
    add_vectors(in, directions);
    in.push_back(constant_column(directions.size(), 1));
    return probe.run("surface", in, 18);
}

/// Rays along the samples find the light with the same density; empty when they do. `found` becomes
/// how many hit something: rays along the light's border may miss it. What is found nearer is
/// another light.
inline std::string found_pdf_failure(SceneProbe& probe, const LightSamples& samples, glm::vec3 from,
                                     double bound, size_t& found) {
    const Columns out = look(probe, from, samples.direction);
    found = 0;
    for (float hit : out[0]) found += hit != 0;
    const auto error = [&](size_t i) {
        const bool is_area = samples.valid[i] != 0 && samples.delta[i] == 0;
        if (!is_area || out[0][i] == 0 || out[1][i] < 0.99f * samples.distance[i]) return 0.0;
        return std::abs(double(out[16][i]) / double(samples.pdf[i]) - 1);
    };
    return worst_item(samples.pdf.size(), bound, error, [&](size_t i) {
        return fmt::format("found with density {}, sampled with {}", out[16][i], samples.pdf[i]);
    });
}

/// The mean of f / pdf and the deviation of that mean.
template <class F>
std::pair<double, double> integrate(const LightSamples& samples, const F& f) {
    double sum = 0, squares = 0;
    const double count = double(samples.pdf.size());
    for (size_t i = 0; i < samples.pdf.size(); i++) {
        const double a = samples.valid[i] != 0 ? f(samples.direction[i]) / samples.pdf[i] : 0.0;
        sum += a;
        squares += a * a;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count)};
}

/// Van Oosterom and Strackee 1983, The Solid Angle of a Plane Triangle.
inline double solid_angle(const Triangle& t, glm::vec3 point) {
    const glm::dvec3 from(point);
    const glm::dvec3 a = glm::normalize(glm::dvec3(t.a) - from);
    const glm::dvec3 b = glm::normalize(glm::dvec3(t.b) - from);
    const glm::dvec3 c = glm::normalize(glm::dvec3(t.c) - from);
    const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
    return 2 * std::atan2(volume, 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

/// The integral of the cosine with +Y over a triangle that is above (Lambert).
inline double projected_solid_angle(const Triangle& t, glm::vec3 point) {
    const glm::dvec3 from(point);
    const glm::dvec3 v[3] = {glm::normalize(glm::dvec3(t.a) - from),
                             glm::normalize(glm::dvec3(t.b) - from),
                             glm::normalize(glm::dvec3(t.c) - from)};
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const glm::dvec3 p = v[k], q = v[(k + 1) % 3];
        sum += std::acos(glm::dot(p, q)) * glm::normalize(glm::cross(p, q)).y / 2;
    }
    return std::abs(sum);
}

} // namespace onde::doctor::lights
