// BSDFs of every kind, smooth and rough, side by side in the lanes.
#pragma once

#include "doctor/bsdf_rig.h"
#include "doctor/mapped.h"

namespace onde::doctor {

/// A material that may have anything.
inline Material mixed_material(Generator& generator) {
    const auto some = [&] { return generator() % 3 == 0 ? unit(generator) : 0.0f; };
    Material m;
    m.kind = MaterialKind(generator() % 4);
    m.base_color = glm::vec3(unit(generator), unit(generator), unit(generator));
    m.roughness = generator() % 4 == 0 ? 0.0f : unit(generator);
    m.metallic = some();
    m.ior = generator() % 2 ? 1.5f : 1 + unit(generator);
    m.specular = generator() % 3 == 0 ? unit(generator) : 1.0f;
    m.transmission = some();
    m.thin_walled = generator() % 2;
    m.diffuse_transmission = some();
    m.diffuse_transmission_color = m.base_color;
    m.clearcoat = some();
    m.clearcoat_roughness = some();
    m.sheen_color = glm::vec3(some(), some(), some());
    m.sheen_roughness = unit(generator);
    m.iridescence = some();
    m.iridescence_thickness = 900 * unit(generator);
    m.anisotropy = some();
    m.anisotropy_rotation = 6 * unit(generator);
    m.dispersion = 9 * some();
    m.distribution = generator() % 4 == 0 ? Distribution::beckmann : Distribution::ggx;
    return m;
}

inline std::vector<bsdf::Surface> mixed_surfaces() {
    constexpr size_t COUNT = 64; // each kind of glass takes a table
    Generator generator(37);
    std::vector<bsdf::Surface> surfaces;
    for (size_t i = 0; i < COUNT; i++)
        surfaces.push_back({fmt::format("mixed {}", i), mixed_material(generator)});
    return surfaces;
}

/// Of kernels/probe/bsdf.cl, over those surfaces.
inline std::vector<Mapped> mapped_bsdfs(size_t count, size_t surfaces) {
    Generator generator(38);
    Columns in(3, Column(count));
    for (size_t i = 0; i < count; i++) {
        in[0][i] = word(uint32_t(generator() % surfaces));
        in[1][i] = float(generator() % 2);
        in[2][i] = unit(generator);
    }
    std::vector<glm::vec3> wo = unit_vectors(generator, count);
    for (glm::vec3& v : wo) v.z = std::max(std::abs(v.z), 1e-4f);
    add_vectors(in, wo);
    Columns with_wi = in;
    add_vectors(with_wi, unit_vectors(generator, count));
    for (int k = 0; k < 3; k++) in.push_back(uniform_column(generator, count));
    return {{"bsdf_eval", 4, std::move(with_wi)}, {"bsdf_sample", 9, std::move(in)}};
}

/// The first difference between BSDFs at two widths; empty when there is none.
inline std::string first_bsdf_difference(gpu::Programs& programs, uint32_t width, size_t count) {
    bsdf::Bsdfs wide(programs, mixed_surfaces(), width), scalar(programs, mixed_surfaces(), 1);
    for (const Mapped& mapped : mapped_bsdfs(count, wide.surfaces().size())) {
        const std::string difference =
            first_bit_difference(wide.probe().run(mapped.name, mapped.in, mapped.words),
                                 scalar.probe().run(mapped.name, mapped.in, mapped.words));
        if (!difference.empty()) return mapped.name + ": " + difference;
    }
    return {};
}

} // namespace onde::doctor
