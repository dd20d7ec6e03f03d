#include "upload/media.h"

#include "core/error.h"
#include "scene/phong.h"
#include "upload/appearance.h"
#include "upload/words.h"

#include <algorithm>

namespace onde {

static bool is_something(const Medium& medium) {
    return medium.absorption != glm::vec3(0) || medium.scattering != glm::vec3(0);
}

/// Whether light gets in.
static bool has_inside(const Material& m) {
    const uint32_t lobes = lobes_of(m);
    return lobes >> LOBE_DIELECTRIC & 1 || (m.medium && lobes >> LOBE_THIN & 1);
}

/// That of coloured glass, and what is stated beside it.
static Medium inside_of(const Material& m) {
    Medium medium = m.medium.value_or(Medium{});
    // Black would be infinite; what is left of it after the distance is nothing to be seen.
    if (!m.thin_walled && m.attenuation_distance)
        medium.absorption -=
            glm::log(glm::max(m.attenuation_color, 1e-6f)) / *m.attenuation_distance;
    return medium;
}

bool has_media(const Scene& scene) {
    const auto scatters = [&](const Material& m) {
        return has_inside(m) && m.medium && is_something(*m.medium);
    };
    return is_something(scene.medium) || std::ranges::any_of(scene.materials, scatters);
}

static MediumRecord record_of(const Medium& medium) {
    MediumRecord record{};
    copy(record.extinction, medium.absorption + medium.scattering);
    copy(record.scattering, medium.scattering);
    record.anisotropy = medium.anisotropy;
    return record;
}

std::vector<MediumRecord> pack_media(const Scene& scene, std::vector<uint32_t>& inside) {
    std::vector<MediumRecord> records{record_of(scene.medium)};
    for (uint32_t i = 0; i < scene.materials.size(); i++) {
        const Material material = path_material(scene, i);
        if (!has_inside(material)) continue;
        inside[i] = uint32_t(records.size());
        records.push_back(record_of(inside_of(material)));
    }
    if (records.size() > MOST_MEDIA)
        throw InputError("the scene has {} clear materials with something inside; at most {} can "
                         "be told apart",
                         records.size() - 1, MOST_MEDIA - 1);
    return records;
}

} // namespace onde
