#include "upload/tangents.h"

#include "core/hash.h"

#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace onde {
namespace {

constexpr uint32_t NONE = UINT32_MAX;

bool not_zero(float x) {
    return std::abs(x) > FLT_MIN;
}
glm::vec3 unit_or_same(glm::vec3 v) {
    const float length = glm::length(v);
    return not_zero(length) ? v / length : v;
}
/// The part of v across a unit normal, unit where there is any.
glm::vec3 across(glm::vec3 v, glm::vec3 normal) {
    return unit_or_same(v - normal * glm::dot(normal, v));
}

/// Numbers equal corners alike.
std::vector<uint32_t> weld(std::span<const TangentCorner> corners) {
    const auto key_of = [](const TangentCorner& c) {
        const float zero = 0.0f; // makes -0 a 0
        return std::array{c.position.x + zero, c.position.y + zero, c.position.z + zero,
                          c.normal.x + zero,   c.normal.y + zero,   c.normal.z + zero,
                          c.uv.x + zero,       c.uv.y + zero};
    };
    const auto hash = [](const std::array<float, 8>& key) {
        return size_t(Hasher().value(key).digest());
    };
    std::unordered_map<std::array<float, 8>, uint32_t, decltype(hash)> known(corners.size(), hash);
    std::vector<uint32_t> ids;
    ids.reserve(corners.size());
    for (const TangentCorner& corner : corners)
        ids.push_back(known.try_emplace(key_of(corner), uint32_t(known.size())).first->second);
    return ids;
}

struct Face {
    glm::vec3 tangent{0.0f};                ///< unit, along which u grows
    bool preserves = false;                 ///< the map keeps its orientation on the surface
    bool joins_any = true;                  ///< it has no tangent, and takes part in any group
    bool degenerate = false;                ///< two corners are one point
    uint32_t neighbor[3]{NONE, NONE, NONE}; ///< across the edge from corner k to the next
    uint32_t group[3]{NONE, NONE, NONE};    ///< of its corners
};

struct Group {
    uint32_t corner = 0; ///< the welded one that it is about
    bool preserves = false;
    glm::vec3 sum{0.0f}; ///< of tangents, weighted by angles
};

class TangentBuilder {
  public:
    explicit TangentBuilder(std::span<const TangentCorner> corners)
        : corners_(corners), welded_(weld(corners)), faces_(corners.size() / 3) {}

    std::vector<glm::vec4> build() {
        for (uint32_t f = 0; f < faces_.size(); f++) measure(f);
        find_neighbors();
        for (uint32_t f = 0; f < faces_.size(); f++)
            for (uint32_t k = 0; k < 3; k++)
                if (!faces_[f].joins_any && faces_[f].group[k] == NONE) start_group(f, k);
        for (uint32_t f = 0; f < faces_.size(); f++) add_to_groups(f);
        return collect();
    }

  private:
    const TangentCorner& corner(uint32_t face, uint32_t k) const { return corners_[3 * face + k]; }

    void measure(uint32_t f) {
        Face& face = faces_[f];
        const TangentCorner &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
        face.degenerate =
            a.position == b.position || b.position == c.position || c.position == a.position;
        const glm::vec3 e1 = b.position - a.position, e2 = c.position - a.position;
        const glm::vec2 d1 = b.uv - a.uv, d2 = c.uv - a.uv;
        const float area = d1.x * d2.y - d1.y * d2.x;
        face.preserves = area > 0.0f;
        const glm::vec3 along_u = e1 * d2.y - e2 * d1.y, along_v = e2 * d1.x - e1 * d2.x;
        const float length = glm::length(along_u);
        if (face.degenerate || !not_zero(area) || !not_zero(length)) return;
        face.tangent = along_u * ((face.preserves ? 1.0f : -1.0f) / length);
        face.joins_any = !not_zero(glm::length(along_v) / std::abs(area));
    }

    /// Two triangles at an edge that they run along in opposite directions.
    void find_neighbors() {
        std::unordered_multimap<uint64_t, uint32_t> open; // by an edge's corners: 3 * face + k
        const auto key = [](uint32_t from, uint32_t to) { return uint64_t(from) << 32 | to; };
        for (uint32_t f = 0; f < faces_.size(); f++) {
            if (faces_[f].degenerate) continue;
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t from = welded_[3 * f + k], to = welded_[3 * f + (k + 1) % 3];
                const auto other = open.find(key(to, from));
                if (other == open.end()) {
                    open.emplace(key(from, to), 3 * f + k);
                    continue;
                }
                faces_[f].neighbor[k] = other->second / 3;
                faces_[other->second / 3].neighbor[other->second % 3] = f;
                open.erase(other);
            }
        }
    }

    /// The group of a corner: the triangles around it that share edges and orientation.
    void start_group(uint32_t first, uint32_t first_corner) {
        const auto group = uint32_t(groups_.size());
        const Group& g =
            groups_.emplace_back(Group{welded_[3 * first + first_corner], faces_[first].preserves});
        std::vector<uint32_t> pending{first};
        while (!pending.empty()) {
            const uint32_t f = pending.back();
            pending.pop_back();
            Face& face = faces_[f];
            uint32_t k = 0;
            while (k < 3 && welded_[3 * f + k] != g.corner) k++;
            if (k == 3 || face.group[k] != NONE) continue;
            const bool free =
                face.group[0] == NONE && face.group[1] == NONE && face.group[2] == NONE;
            if (face.joins_any && free) face.preserves = g.preserves;
            if (face.preserves != g.preserves) continue;
            face.group[k] = group;
            for (const uint32_t next : {face.neighbor[(k + 2) % 3], face.neighbor[k]})
                if (next != NONE) pending.push_back(next);
        }
    }

    void add_to_groups(uint32_t f) {
        const Face& face = faces_[f];
        if (face.joins_any) return;
        for (uint32_t k = 0; k < 3; k++) {
            const TangentCorner& here = corner(f, k);
            const glm::vec3 to_next =
                across(corner(f, (k + 1) % 3).position - here.position, here.normal);
            const glm::vec3 to_last =
                across(corner(f, (k + 2) % 3).position - here.position, here.normal);
            const float cosine = glm::clamp(glm::dot(to_next, to_last), -1.0f, 1.0f);
            groups_[face.group[k]].sum += std::acos(cosine) * across(face.tangent, here.normal);
        }
    }

    /// Corners without a group take that of an equal corner, else any direction along the surface.
    std::vector<glm::vec4> collect() const {
        std::vector<uint32_t> group_of(corners_.size(), NONE); // by the welded corner
        for (uint32_t c = 0; c < corners_.size(); c++)
            if (const uint32_t group = faces_[c / 3].group[c % 3]; group != NONE)
                group_of[welded_[c]] = group;
        std::vector<glm::vec4> tangents;
        tangents.reserve(corners_.size());
        for (uint32_t c = 0; c < corners_.size(); c++) {
            uint32_t group = faces_[c / 3].group[c % 3];
            if (group == NONE) group = group_of[welded_[c]];
            glm::vec3 tangent = group == NONE ? glm::vec3(0.0f) : unit_or_same(groups_[group].sum);
            if (!(glm::length(tangent) > 0.5f)) tangent = any_across(corners_[c].normal);
            // MikkTSpace's sign is that of v upward in the picture; here v runs downward.
            const bool preserves = group != NONE && groups_[group].preserves;
            tangents.emplace_back(tangent, preserves ? -1.0f : 1.0f);
        }
        return tangents;
    }

    static glm::vec3 any_across(glm::vec3 normal) {
        const glm::vec3 helper =
            std::abs(normal.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        return across(helper, normal);
    }

    std::span<const TangentCorner> corners_;
    std::vector<uint32_t> welded_;
    std::vector<Face> faces_;
    std::vector<Group> groups_;
};

} // namespace

std::vector<glm::vec4> corner_tangents(std::span<const TangentCorner> corners) {
    return TangentBuilder(corners).build();
}

} // namespace onde
