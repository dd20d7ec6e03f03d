#include "scene/obj/mesh.h"

#include "core/error.h"
#include "scene/origin.h"
#include "scene/triangulate.h"
#include "scene/vertex_color.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace onde::obj {

namespace {

struct CornerHash {
    size_t operator()(const Corner& corner) const {
        const uint64_t x = uint64_t(uint32_t(corner.position)) * 0x9e3779b97f4a7c15u ^
                           uint64_t(uint32_t(corner.uv)) * 0xc2b2ae3d27d4eb4fu ^
                           uint64_t(uint32_t(corner.normal)) * 0x165667b19e3779f9u;
        return size_t(x ^ (x >> 29));
    }
};

/// Triangles whose corners all have normals, or none; equal corners share a vertex.
class PartBuilder {
  public:
    PartBuilder(const File& file, const glm::dvec3& origin, bool normals, GradualSpending& cost)
        : file_(file), normals_(normals), cost_(cost) {
        part_.origin = origin;
    }

    void add_face(std::span<const Corner> corners, uint32_t material) {
        cost_.add(polygon_bytes(corners.size()));
        vertices_.clear();
        positions_.clear();
        for (const Corner& corner : corners) {
            vertices_.push_back(vertex(corner));
            positions_.push_back(uint32_t(corner.position));
        }
        for (const auto& [a, b, c] : triangulate({file_.positions, positions_})) {
            part_.triangles.emplace_back(vertices_[a], vertices_[b], vertices_[c]);
            part_.materials.push_back(material);
        }
    }

    MeshPart take() { return std::move(part_); }

  private:
    uint32_t vertex(Corner corner) {
        if (!normals_) corner.normal = NONE;
        const auto [found, is_new] = known_.try_emplace(corner, uint32_t(part_.positions.size()));
        if (!is_new) return found->second;
        cost_.add(VERTEX_BYTES);
        if (part_.positions.size() >= MAX_VERTICES)
            throw InputError("more than {} vertices; split the file", MAX_VERTICES);
        part_.positions.emplace_back(file_.positions[size_t(corner.position)] - part_.origin);
        if (normals_) part_.normals.emplace_back(unit(file_.normals[size_t(corner.normal)]));
        const glm::dvec2 uv =
            corner.uv == NONE ? glm::dvec2(0.0, 1.0) : file_.uvs[size_t(corner.uv)];
        part_.uvs.emplace_back(uv.x, 1.0 - uv.y);
        if (!file_.colors.empty())
            part_.colors.push_back(
                linear_vertex_color(glm::dvec3(file_.colors[size_t(corner.position)])));
        return found->second;
    }

    /// In double precision, since the squares of tiny normals underflow in float.
    static glm::dvec3 unit(const glm::dvec3& normal) {
        const double length = glm::length(normal);
        return length > 0.0 ? normal / length : normal;
    }

    const File& file_;
    bool normals_;
    GradualSpending& cost_;
    MeshPart part_;
    std::unordered_map<Corner, uint32_t, CornerHash> known_;
    std::vector<uint32_t> vertices_;  ///< of the face being added
    std::vector<uint32_t> positions_; ///< of the file, by its corners
};

glm::dvec3 origin_of_faces(const File& file) {
    const size_t step = file.faces.size() / MOST_DETAILS + 1;
    SceneExtent extent;
    const auto position = [&](const Corner& corner) {
        return file.positions[size_t(corner.position)];
    };
    for (size_t i = 0; i < file.faces.size(); ++i) {
        const auto corners = file.corners_of(i);
        if (corners.empty()) continue;
        const glm::dvec3 first = position(corners[0]);
        const bool is_point = std::ranges::all_of(
            corners, [&](const Corner& corner) { return position(corner) == first; });
        if (is_point) continue;
        Extent box;
        for (const Corner& corner : corners) {
            extent.all.grow(position(corner));
            box.grow(position(corner));
        }
        const Detail detail{0.5 * (box.low + box.high), 0.5 * glm::length(box.high - box.low),
                            double(step)};
        if (i % step == 0 && detail.size > 0.0 && std::isfinite(detail.size))
            extent.details.push_back(detail);
    }
    return origin_of(extent);
}

} // namespace

JoinedMesh build_mesh(const File& file, const std::string& name,
                      std::span<const uint32_t> materials, Notes& notes, GradualSpending& cost) {
    const glm::dvec3 origin = origin_of_faces(file);
    PartBuilder smooth(file, origin, true, cost), flat(file, origin, false, cost);
    bool uvs = false;
    for (size_t i = 0; i < file.faces.size(); ++i) {
        const std::span<const Corner> corners = file.corners_of(i);
        const bool normals = std::ranges::none_of(
            corners, [](const Corner& corner) { return corner.normal == NONE; });
        uvs |= std::ranges::any_of(corners, [](const Corner& corner) { return corner.uv != NONE; });
        (normals ? smooth : flat).add_face(corners, materials[file.faces[i].material]);
    }
    std::vector<MeshPart> parts{smooth.take(), flat.take()};
    std::erase_if(parts, [](const MeshPart& part) { return part.triangles.empty(); });
    if (!uvs)
        for (MeshPart& part : parts) part.uvs.clear();
    return join_parts(name, std::move(parts), notes);
}

} // namespace onde::obj
