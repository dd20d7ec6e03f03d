#include "scene/pbrt/shape.h"

#include "core/error.h"
#include "scene/origin.h"

#include <algorithm>
#include <cmath>

namespace onde::pbrt {
namespace {

/// The parameter's numbers in groups of N, an incomplete last one left out.
template <glm::length_t N>
std::vector<glm::vec<N, double>> vectors(const Parameters& parameters, std::string_view name) {
    const std::vector<double>& numbers = parameters.numbers(name);
    std::vector<glm::vec<N, double>> result(numbers.size() / N);
    for (size_t i = 0; i < result.size(); ++i)
        for (glm::length_t c = 0; c < N; ++c) result[i][c] = numbers[i * N + size_t(c)];
    return result;
}

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The corners of polygons of `corners` each, in range.
std::vector<uint32_t> indices_of(const Parameters& parameters, size_t corners, size_t points,
                                 Notes& notes) {
    std::vector<uint32_t> indices;
    for (const double number : parameters.numbers("indices")) {
        if (!(number >= 0.0 && number < double(points)) || number != std::floor(number))
            throw InputError("{}: 'indices' has {}, but there are {} points; export it again",
                             parameters.where(), number, points);
        indices.push_back(uint32_t(number));
    }
    if (!parameters.has("indices") && points == corners)
        for (size_t i = 0; i < corners; ++i) indices.push_back(uint32_t(i));
    if (indices.size() % corners != 0)
        notes.wrong("Faces that lack corners are left out", parameters.where());
    indices.resize(indices.size() - indices.size() % corners);
    return indices;
}

/// Of patches, whose corners are 00, 10, 01, 11, two triangles each.
std::vector<glm::uvec3> triangles_of(const std::vector<uint32_t>& indices, size_t corners) {
    std::vector<glm::uvec3> triangles;
    for (size_t i = 0; i < indices.size(); i += corners) {
        triangles.emplace_back(indices[i], indices[i + 1], indices[corners == 4 ? i + 3 : i + 2]);
        if (corners == 4) triangles.emplace_back(indices[i], indices[i + 3], indices[i + 2]);
    }
    return triangles;
}

/// Normals and texture coordinates go where there are not as many as points.
template <class T>
void drop_others(std::vector<T>& values, size_t points, const char* what, Notes& notes) {
    if (values.empty() || values.size() == points) return;
    notes.wrong(std::string(what) + " that are more or fewer than points are ignored");
    values.clear();
}

void add_normals(const Parameters& parameters, MeshPart& part, Notes& notes) {
    auto normals = vectors<3>(parameters, "N");
    drop_others(normals, part.positions.size(), "Normals", notes);
    for (const glm::dvec3& normal : normals) {
        const glm::vec3 rounded(normal);
        part.normals.push_back(is_finite(rounded) ? rounded : glm::vec3(0.0f));
    }
}

void add_uvs(const Parameters& parameters, MeshPart& part, Notes& notes) {
    auto uvs = vectors<2>(parameters, parameters.has("uv") ? "uv" : "st");
    drop_others(uvs, part.positions.size(), "Texture coordinates", notes);
    for (const glm::dvec2& uv : uvs) {
        const glm::vec2 rounded(uv.x, 1.0 - uv.y); // ours runs downward
        const bool good = std::isfinite(rounded.x) && std::isfinite(rounded.y);
        part.uvs.push_back(good ? rounded : glm::vec2(0.0f));
    }
}

} // namespace

JoinedMesh mesh_of(const std::string& kind, const Parameters& parameters, Notes& notes) {
    const auto points = vectors<3>(parameters, "P");
    if (points.size() > MAX_VERTICES)
        throw InputError("{}: more than {} points; split the shape", parameters.where(),
                         MAX_VERTICES);
    const size_t corners = kind == "bilinearmesh" ? 4 : 3;
    MeshPart part;
    part.triangles = triangles_of(indices_of(parameters, corners, points.size(), notes), corners);
    part.origin = origin_of(scene_extent_of(points, part.triangles));
    part.positions = counted_from(part.origin, points);
    const auto has_numbers = [&](uint32_t corner) { return is_finite(part.positions[corner]); };
    if (std::erase_if(part.triangles, [&](const glm::uvec3& t) {
            return !has_numbers(t.x) || !has_numbers(t.y) || !has_numbers(t.z);
        }) > 0)
        notes.wrong("Faces with positions beyond the numbers of floats are left out");
    const glm::vec3 used =
        part.triangles.empty() ? glm::vec3(0.0f) : part.positions[part.triangles[0].x];
    for (glm::vec3& position : part.positions)
        if (!is_finite(position)) position = used; // no triangle has it
    add_normals(parameters, part, notes);
    add_uvs(parameters, part, notes);
    for (const char* ignored : {"S", "faceIndices", "levels", "scheme"}) parameters.find(ignored);
    part.materials.assign(part.triangles.size(), 0);
    std::vector<MeshPart> parts;
    parts.push_back(std::move(part));
    return join_parts(kind, std::move(parts), notes);
}

void turn_fronts(Mesh& mesh, bool reversed) {
    if (reversed)
        for (glm::vec3& normal : mesh.normals) normal = -normal;
    for (glm::uvec3& t : mesh.triangles) {
        bool turned = reversed;
        if (!mesh.normals.empty()) {
            const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
            const glm::dvec3 mean = glm::dvec3(mesh.normals[t.x]) + glm::dvec3(mesh.normals[t.y]) +
                                    glm::dvec3(mesh.normals[t.z]);
            turned = glm::dot(glm::cross(b - a, c - a), mean) < 0.0;
        }
        if (turned) std::swap(t.y, t.z);
    }
}

} // namespace onde::pbrt
