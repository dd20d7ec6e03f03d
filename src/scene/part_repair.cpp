#include "scene/part_repair.h"

#include <algorithm>
#include <cmath>

namespace onde {

template <class V>
static bool is_finite(const V& value) {
    for (glm::length_t i = 0; i < V::length(); ++i)
        if (!std::isfinite(value[i])) return false;
    return true;
}

/// Whether some values were not finite and are zero now.
template <class V>
static bool zero_bad(std::vector<V>& values) {
    bool found = false;
    for (V& value : values) {
        if (is_finite(value)) continue;
        value = V(0.0f);
        found = true;
    }
    return found;
}

static bool drop_bad_triangles(MeshPart& part) {
    size_t kept = 0;
    for (size_t i = 0; i < part.triangles.size(); ++i) {
        const glm::uvec3& t = part.triangles[i];
        if (!is_finite(part.positions[t.x]) || !is_finite(part.positions[t.y]) ||
            !is_finite(part.positions[t.z]))
            continue;
        part.triangles[kept] = t;
        part.materials[kept++] = part.materials[i];
    }
    const bool dropped = kept < part.triangles.size();
    part.triangles.resize(kept);
    part.materials.resize(kept);
    return dropped;
}

void repair_part(MeshPart& part, const std::string& user, Notes& notes) {
    if (!std::ranges::all_of(part.positions, is_finite<glm::vec3>)) {
        if (drop_bad_triangles(part))
            notes.wrong("Faces with positions that are no finite numbers are left out", user);
        zero_bad(part.positions);
    }
    if (zero_bad(part.normals))
        notes.wrong("Normals that are no finite numbers are replaced by face normals", user);
    bool bad_uvs = zero_bad(part.uvs);
    for (std::vector<glm::vec2>& uvs : part.more_uvs) bad_uvs |= zero_bad(uvs);
    if (bad_uvs) notes.wrong("Texture coordinates that are no finite numbers become 0", user);
}

} // namespace onde
