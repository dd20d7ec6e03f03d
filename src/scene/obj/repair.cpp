#include "scene/obj/repair.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace onde::obj {

namespace {

/// As floats, which positions become in the end.
template <class Vector>
bool is_finite(const Vector& v) {
    for (size_t i = 0; i < Vector::length(); ++i)
        if (!std::isfinite(float(v[i]))) return false;
    return true;
}

bool is_direction(const glm::dvec3& normal) {
    return is_finite(normal) && glm::dot(normal, normal) > 0.0;
}

std::string line_of(const Face& face) {
    return "line " + std::to_string(face.line);
}

/// Keeps the faces, with their corners, for which keep(index) holds.
template <class Keep>
void keep_faces(File& file, const Keep& keep) {
    std::vector<Face> faces;
    std::vector<Corner> corners;
    for (size_t i = 0; i < file.faces.size(); ++i) {
        if (!keep(i)) continue;
        const auto kept = file.corners_of(i);
        Face face = file.faces[i];
        face.first = corners.size();
        corners.insert(corners.end(), kept.begin(), kept.end());
        faces.push_back(face);
    }
    file.faces = std::move(faces);
    file.corners = std::move(corners);
}

void drop_bad_positions(File& file, Notes& notes) {
    if (std::ranges::all_of(file.positions, is_finite<glm::dvec3>)) return;
    keep_faces(file, [&](size_t face) {
        const bool good = std::ranges::all_of(file.corners_of(face), [&](const Corner& corner) {
            return is_finite(file.positions[size_t(corner.position)]);
        });
        if (!good)
            notes.wrong("Faces with positions that are no finite numbers are left out",
                        line_of(file.faces[face]));
        return good;
    });
}

/// The sum of the corners' triangles' normals, each as long as twice its area (Newell's).
glm::dvec3 area_normal(const File& file, std::span<const Corner> corners) {
    const auto position = [&](size_t i) { return file.positions[size_t(corners[i].position)]; };
    glm::dvec3 sum(0.0);
    for (size_t i = 2; i < corners.size(); ++i)
        sum += glm::cross(position(i - 1) - position(0), position(i) - position(0));
    return sum;
}

template <class Key, class Element>
class Shared {
  public:
    explicit Shared(std::vector<Element>& elements) : elements_(elements) {}

    /// The index of the element of that key, which is appended when it is new.
    int32_t index(Key key, const Element& initial) {
        const auto [found, is_new] = indices_.try_emplace(key, int32_t(elements_.size()));
        if (is_new) elements_.push_back(initial);
        return found->second;
    }

  private:
    std::vector<Element>& elements_;
    std::unordered_map<Key, int32_t> indices_;
};

} // namespace

void drop_bad_numbers(File& file, Notes& notes) {
    drop_bad_positions(file, notes);
    const auto bad_normal = [&](const Corner& corner) {
        return corner.normal != NONE && !is_direction(file.normals[size_t(corner.normal)]);
    };
    const auto bad_uv = [&](const Corner& corner) {
        return corner.uv != NONE && !is_finite(file.uvs[size_t(corner.uv)]);
    };
    for (size_t i = 0; i < file.faces.size(); ++i) {
        const std::span<Corner> corners = file.corners_of(i);
        if (std::ranges::any_of(corners, bad_normal)) {
            notes.wrong("Normals that are zero or no finite numbers are replaced by computed ones",
                        line_of(file.faces[i]));
            for (Corner& corner : corners) corner.normal = NONE;
        }
        for (Corner& corner : corners) {
            if (!bad_uv(corner)) continue;
            notes.wrong("Texture coordinates that are no finite numbers become 0",
                        line_of(file.faces[i]));
            corner.uv = NONE;
        }
    }
}

void smooth_groups(File& file) {
    Shared<uint64_t, glm::dvec3> normals(file.normals);
    for (size_t i = 0; i < file.faces.size(); ++i) {
        const std::span<Corner> corners = file.corners_of(i);
        const uint64_t group = file.faces[i].smoothing;
        const auto has_none = [](const Corner& corner) { return corner.normal == NONE; };
        if (group == 0 || !std::ranges::any_of(corners, has_none)) continue;
        const glm::dvec3 normal = area_normal(file, corners);
        for (Corner& corner : corners) {
            corner.normal = normals.index(group << 32 | uint32_t(corner.position), glm::dvec3(0.0));
            file.normals[size_t(corner.normal)] += normal;
        }
    }
}

void move_uvs(File& file, std::span<const UvMove> moves) {
    Shared<uint64_t, glm::dvec2> moved(file.uvs);
    for (size_t i = 0; i < file.faces.size(); ++i) {
        const uint32_t material = file.faces[i].material;
        const UvMove& move = moves[material];
        if (move == UvMove()) continue;
        for (Corner& corner : file.corners_of(i)) {
            if (corner.uv == NONE) continue;
            const glm::dvec2 uv = file.uvs[size_t(corner.uv)] * move.scale + move.offset;
            corner.uv = moved.index(uint64_t(material) << 32 | uint32_t(corner.uv), uv);
        }
    }
}

} // namespace onde::obj
