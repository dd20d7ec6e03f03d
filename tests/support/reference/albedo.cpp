#include "support/reference/albedo.h"

#include <map>
#include <mutex>

namespace onde::reference {
namespace {

/// A microfacet's normal h, seen from a direction o.
struct Microfacet {
    float o_h; ///< dot(o, h)
    float up;  ///< h.z
};

/// The part of light from o that `part(microfacet)` lets away, integrated over normals: the sum
/// of D(h) dot(o, h) / cosine. With tan(angle of h) = alpha tan(t), D(h) h.z dh becomes
/// sin(t) cos(t) dt dphi / pi, which alpha does not narrow. Midpoint rule in phi and in x, by
/// t = x (2 - x) pi / 2: densest where h lies flat and directions of grazing light turn.
template <class Part>
glm::vec2 sum_over_normals(float cosine, float alpha, const Part& part) {
    constexpr int POLAR = 64, AROUND = 48;
    const float sine = safe_sqrt(1.0f - cosine * cosine);
    glm::vec2 sum(0.0f);
    for (int i = 0; i < POLAR; ++i) {
        const float x = (float(i) + 0.5f) / POLAR, t = 0.5f * PI * x * (2.0f - x);
        const float tangent = alpha * std::tan(t), up = 1.0f / std::sqrt(1.0f + tangent * tangent);
        const float weight = std::sin(2.0f * t) * PI * (1.0f - x) / (POLAR * AROUND);
        for (int j = 0; j < AROUND; ++j) {
            const float phi = (float(j) + 0.5f) * (PI / AROUND); // the other half is alike
            const float o_h = up * (sine * tangent * std::cos(phi) + cosine);
            if (o_h > 0.0f) sum += weight * o_h / (cosine * up) * part(Microfacet{o_h, up});
        }
    }
    return glm::min(sum, 1.0f);
}

/// Masking and shadowing, height-correlated, where a direction of z leaves to the side it should.
float unmasked(float lambda_o, float z, float alpha) {
    return z > 0.0f ? 1.0f / (1.0f + lambda_o + smith_lambda(z, alpha)) : 0.0f;
}

glm::vec2 reflected(float cosine, float alpha) {
    const float lambda_o = smith_lambda(cosine, alpha);
    return sum_over_normals(cosine, alpha, [&](const Microfacet& m) {
        const float white = unmasked(lambda_o, 2.0f * m.o_h * m.up - cosine, alpha);
        return white * glm::vec2(1.0f, schlick_weight(m.o_h));
    });
}

/// eta is the index beyond over the index here.
float scattered(const Microfacet& m, float cosine, float alpha, float lambda_o, float eta) {
    const float fresnel = fresnel_dielectric(m.o_h, eta);
    const float beyond = safe_sqrt(1.0f - (1.0f - m.o_h * m.o_h) / (eta * eta));
    const float down = cosine / eta - (m.o_h / eta - beyond) * m.up;
    return fresnel * unmasked(lambda_o, 2.0f * m.o_h * m.up - cosine, alpha) +
           (1.0f - fresnel) * unmasked(lambda_o, down, alpha);
}

glm::vec2 scattered_by_glass(float cosine, float alpha, float ior) {
    const float lambda_o = smith_lambda(cosine, alpha);
    return sum_over_normals(cosine, alpha, [&](const Microfacet& m) {
        return glm::vec2(scattered(m, cosine, alpha, lambda_o, ior),
                         scattered(m, cosine, alpha, lambda_o, 1.0f / ior));
    });
}

/// Of `count` in equal steps from 0 to 1: the one before `place`, and the fraction of a step beyond
/// it.
struct Step {
    uint32_t before;
    float fraction;
};
Step step_at(float place, uint32_t count) {
    const float scaled = glm::clamp(place, 0.0f, 1.0f) * float(count - 1);
    const uint32_t before = std::min(uint32_t(scaled), count - 2);
    return {before, scaled - float(before)};
}

} // namespace

AlbedoTable::AlbedoTable(const Pair& albedos) : rows_(ROWS) {
    for (uint32_t i = 0; i < ROWS; ++i) {
        const float roughness = std::max(float(i) / (ROWS - 1), 0.02f);
        for (uint32_t j = 0; j < Row::COLUMNS; ++j) {
            const float root = std::max(float(j) / (Row::COLUMNS - 1), 0.01f);
            rows_[i].entries[j] = albedos(root * root, roughness * roughness);
        }
        rows_[i].mean = rows_[i].integrated();
    }
}

glm::vec2 AlbedoTable::Row::at(float cosine) const {
    const Step step = step_at(std::sqrt(std::max(0.0f, cosine)), COLUMNS);
    return glm::mix(entries[step.before], entries[step.before + 1], step.fraction);
}

glm::vec2 AlbedoTable::Row::integrated() const {
    constexpr int STEPS = 1024;
    glm::vec2 sum(0.0f);
    for (int i = 0; i < STEPS; ++i) {
        const float cosine = (float(i) + 0.5f) / STEPS;
        sum += 2.0f * cosine / STEPS * at(cosine);
    }
    return sum;
}

Albedos::Albedos(const AlbedoTable& table, float roughness) {
    const Step step = step_at(roughness, AlbedoTable::ROWS);
    row_ = table.rows() + step.before;
    fraction_ = step.fraction;
}

const AlbedoTable& reflection_albedos() {
    static const AlbedoTable table(reflected);
    return table;
}

const AlbedoTable& glass_albedos(float ior) {
    static std::mutex mutex;
    static std::map<float, AlbedoTable> tables;
    const std::lock_guard lock(mutex);
    const auto known = tables.find(ior);
    if (known != tables.end()) return known->second;
    const auto albedos = [&](float cosine, float alpha) {
        return scattered_by_glass(cosine, alpha, ior);
    };
    return tables.emplace(ior, AlbedoTable(albedos)).first->second;
}

float mean_transmission_into(float ior) {
    constexpr int STEPS = 1024;
    const float denser = std::max(ior, 1.0f / ior);
    float sum = 0.0f;
    for (int i = 0; i < STEPS; ++i) {
        const float cosine = (float(i) + 0.5f) / STEPS;
        sum += 2.0f * cosine / STEPS * (1.0f - fresnel_dielectric(cosine, denser));
    }
    return ior < 1.0f ? sum * ior * ior : sum; // as much light as comes the other way
}

} // namespace onde::reference
