// STL: its facets become a mesh, flat shaded, of diffuse grey. Equal positions share a vertex.
#include "core/error.h"
#include "scene/loaders.h"
#include "scene/mesh_parts.h"
#include "scene/origin.h"
#include "scene/stl/file.h"
#include "scene/text.h"
#include "scene/triangulate.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace onde {
namespace fs = std::filesystem;

namespace {

struct PositionHash {
    size_t operator()(const glm::dvec3& p) const {
        const auto bits = [](double x) { return std::bit_cast<uint64_t>(x == 0.0 ? 0.0 : x); };
        uint64_t hash = bits(p.x) * 0x9e3779b97f4a7c15u ^ bits(p.y) * 0xc2b2ae3d27d4eb4fu ^
                        bits(p.z) * 0x165667b19e3779f9u;
        return size_t(hash ^ (hash >> 32));
    }
};

class FacetMesh {
  public:
    explicit FacetMesh(GradualSpending& cost) : cost_(cost) {}

    void add(std::span<const glm::dvec3> corners, Notes& notes) {
        if (!std::ranges::all_of(corners, is_finite)) {
            dropped_ = true;
            return notes.wrong("Facets with positions that are no finite numbers are left out");
        }
        cost_.add(polygon_bytes(corners.size()));
        corners_.clear();
        for (const glm::dvec3& corner : corners) corners_.push_back(vertex(corner));
        numbers_.resize(corners.size());
        std::iota(numbers_.begin(), numbers_.end(), 0u);
        for (const auto& [a, b, c] : triangulate({corners, numbers_})) {
            part_.triangles.emplace_back(corners_[a], corners_[b], corners_[c]);
            part_.materials.push_back(0);
        }
    }

    JoinedMesh take(const std::string& name, const std::string& mesh_name, Notes& notes) {
        if (part_.triangles.empty() && dropped_)
            throw InputError("{}: all facets have positions that are no finite numbers; export it "
                             "again",
                             name);
        if (part_.triangles.empty())
            throw InputError("{}: it holds no triangles; export it again", name);
        part_.origin = origin_of(scene_extent_of(positions_, part_.triangles));
        part_.positions = counted_from(part_.origin, positions_);
        std::vector<MeshPart> parts;
        parts.push_back(std::move(part_));
        return join_parts(mesh_name, std::move(parts), notes);
    }

  private:
    static bool is_finite(const glm::dvec3& p) {
        return std::isfinite(float(p.x)) && std::isfinite(float(p.y)) && std::isfinite(float(p.z));
    }

    uint32_t vertex(const glm::dvec3& position) {
        const auto [found, is_new] = vertices_.try_emplace(position, uint32_t(positions_.size()));
        if (is_new && positions_.size() >= MAX_VERTICES)
            throw InputError("more than {} vertices; split the file", MAX_VERTICES);
        if (!is_new) return found->second;
        cost_.add(VERTEX_BYTES);
        positions_.push_back(position);
        return found->second;
    }

    GradualSpending& cost_;
    MeshPart part_;
    std::vector<glm::dvec3> positions_; ///< of its vertices
    std::unordered_map<glm::dvec3, uint32_t, PositionHash> vertices_;
    std::vector<uint32_t> corners_; ///< of the facet being added
    std::vector<uint32_t> numbers_; ///< of these corners, from 0
    bool dropped_ = false;          ///< whether a facet was left out
};

} // namespace

Scene load_stl(const fs::path& path, LoadContext& context) {
    const std::string name = path.string();
    std::string bytes = read_file_within(context, path);
    // Only an ASCII file begins with a byte-order mark.
    if (bytes.starts_with("\xef\xbb\xbf") || bytes.starts_with("\xff\xfe") ||
        bytes.starts_with("\xfe\xff"))
        bytes = text::decode(bytes).value_or(bytes);
    Notes notes = context.notes_of(path);
    GradualSpending cost(context, name);
    FacetMesh mesh(cost);
    stl::read(
        name, bytes, [&](std::span<const glm::dvec3> corners) { mesh.add(corners, notes); }, notes);
    Scene scene;
    scene.materials.emplace_back().name = "default";
    place_only(mesh.take(name, path.stem().string(), notes), scene);
    scene.notes = notes.sentences();
    return scene;
}

} // namespace onde
