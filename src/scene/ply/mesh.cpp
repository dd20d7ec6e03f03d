#include "scene/ply/mesh.h"

#include "core/error.h"
#include "scene/mesh_parts.h"
#include "scene/origin.h"
#include "scene/ply/body.h"
#include "scene/ply/words.h"
#include "scene/triangulate.h"
#include "scene/vertex_color.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <unordered_map>

namespace onde::ply {

namespace {

bool is_finite(std::initializer_list<double> numbers) {
    return std::ranges::all_of(numbers, [](double x) { return std::isfinite(float(x)); });
}

/// What stands for 1: colours may be bytes or 16-bit numbers.
double one(const Property& property, Slot slot) {
    if (slot < R || slot > A) return 1.0;
    return property.type <= Type::uint8 ? 255.0 : property.type < Type::float32 ? 65535.0 : 1.0;
}

constexpr const char* OTHERS = "Other properties than positions, normals, colours, texture "
                               "coordinates and polygons are ignored";

/// A vertex as one corner of a face has it.
struct VertexUv {
    uint32_t vertex = 0;
    glm::vec2 uv{0.0f};

    bool operator==(const VertexUv&) const = default;
};

struct VertexUvHash {
    size_t operator()(const VertexUv& key) const {
        const auto bits = [](float x) { return uint64_t(std::bit_cast<uint32_t>(x + 0.0f)); };
        const uint64_t hash = (bits(key.uv.x) << 32 | bits(key.uv.y)) * 0x9e3779b97f4a7c15u ^
                              key.vertex * 0xc2b2ae3d27d4eb4fu;
        return size_t(hash ^ (hash >> 29));
    }
};

constexpr const char* BAD_UVS = "Texture coordinates that are no finite numbers become 0";

/// Reads the file's elements in their order.
class Reader {
  public:
    Reader(const std::string& name, std::string_view file, const Header& header, Notes& notes,
           LoadContext& context)
        : name_(name), header_(header), body_(name_, file.substr(header.size), header.encoding),
          notes_(notes), context_(context), cost_(context, name) {}

    JoinedMesh read(const std::string& mesh_name) {
        check_elements();
        for (const Element& element : header_.elements)
            if (element.name == VERTEX)
                read_vertices(element);
            else if (element.name == FACE)
                read_faces(element);
            else if (element.name == STRIPS)
                read_strips(element);
            else
                skip(element);
        if (part_.triangles.empty() && dropped_)
            throw InputError("{}: all faces have positions that are no finite numbers; export it "
                             "again",
                             name_);
        part_.materials.assign(part_.triangles.size(), 0);
        part_.origin = origin_of(scene_extent_of(positions_, part_.triangles));
        part_.positions = counted_from(part_.origin, positions_);
        hide_bad_positions();
        std::vector<MeshPart> parts;
        parts.push_back(std::move(part_));
        return join_parts(mesh_name, std::move(parts), notes_);
    }

  private:
    void check_elements() const;
    void read_vertices(const Element& element);
    void read_faces(const Element& element);
    void read_corners(const Property& list);
    void read_corner_uvs(const Property& list);
    void split_corners();
    void add_polygon();
    void read_strips(const Element& element);
    void read_strip(const Property& list);
    void add_vertex(const std::array<double, UNUSED>& vertex, const std::array<bool, UNUSED>& has);
    bool usable(std::span<const uint32_t> corners);
    void hide_bad_positions();
    void skip(const Element& element);

    const std::string& name_;
    const Header& header_;
    Body body_;
    Notes& notes_;
    LoadContext& context_;
    GradualSpending cost_;
    MeshPart part_;
    std::vector<glm::dvec3> positions_;
    bool bad_positions_ = false;     ///< whether some are no finite numbers
    bool dropped_ = false;           ///< whether a face was left out because of them
    std::vector<uint32_t> corners_;  ///< of the face being read
    std::vector<double> corner_uvs_; ///< of these corners, where the face has its own
    std::unordered_map<VertexUv, uint32_t, VertexUvHash> split_; ///< to the new vertex
};

void Reader::check_elements() const {
    const auto named = [&](std::string_view name) {
        const auto& all = header_.elements;
        return std::ranges::find(all, name, &Element::name) - all.begin();
    };
    const auto vertex = size_t(named(VERTEX));
    const auto faces = std::min(size_t(named(FACE)), size_t(named(STRIPS)));
    if (std::max(vertex, faces) >= header_.elements.size())
        throw InputError("{}: its header lists no vertices or no faces, so there is no surface; "
                         "export the mesh with polygons",
                         name_);
    if (faces < vertex)
        throw InputError("{}: its faces come before its vertices; export it again", name_);
    if (header_.elements[vertex].count > MAX_VERTICES)
        throw InputError("{}: more than {} vertices; split the file", name_, MAX_VERTICES);
    for (const Element& element : header_.elements) {
        if (element.name != FACE && element.name != STRIPS) continue;
        const auto list = std::ranges::find_if(element.properties, is_corner_list);
        if (list == element.properties.end() || list->type >= Type::float32)
            throw InputError("{}: its faces have no list 'vertex_indices' of integers; export it "
                             "again",
                             name_);
    }
}

void Reader::read_vertices(const Element& element) {
    std::array<bool, UNUSED> has{};
    std::vector<Slot> slots;
    for (const Property& property : element.properties) {
        slots.push_back(slot_of(property));
        if (slots.back() != UNUSED)
            has[slots.back()] = true;
        else
            notes_.add(OTHERS, property.name);
    }
    if (!has[X] || !has[Y] || !has[Z])
        throw InputError("{}: its vertices have no x, y and z; export it again", name_);
    body_.begin(element);
    if (!(has[R] && has[G] && has[B]))
        for (const Property& property : element.properties)
            if (slot_of(property) >= R && slot_of(property) <= A) notes_.add(OTHERS, property.name);
    context_.spend(element.count, VERTEX_BYTES, name_);
    positions_.reserve(element.count);
    std::array<double, UNUSED> vertex{};
    vertex[A] = 1.0;
    for (uint64_t row = 0; row < element.count; ++row) {
        body_.begin_row(row);
        for (size_t i = 0; i < slots.size(); ++i)
            if (slots[i] == UNUSED)
                body_.skip(element.properties[i]);
            else
                vertex[slots[i]] =
                    body_.number(element.properties[i]) / one(element.properties[i], slots[i]);
        add_vertex(vertex, has);
    }
}

void Reader::add_vertex(const std::array<double, UNUSED>& vertex,
                        const std::array<bool, UNUSED>& has) {
    positions_.emplace_back(vertex[X], vertex[Y], vertex[Z]);
    bad_positions_ |= !is_finite({vertex[X], vertex[Y], vertex[Z]});
    if (has[NX] && has[NY] && has[NZ]) {
        const bool good = is_finite({vertex[NX], vertex[NY], vertex[NZ]});
        if (!good) notes_.wrong("Normals that are no finite numbers are replaced by face normals");
        part_.normals.emplace_back(good ? glm::vec3(vertex[NX], vertex[NY], vertex[NZ])
                                        : glm::vec3(0.0f));
    }
    if (has[R] && has[G] && has[B])
        part_.colors.push_back(linear_vertex_color({vertex[R], vertex[G], vertex[B]}, vertex[A]));
    if (has[U] && has[V]) {
        const bool good = is_finite({vertex[U], vertex[V]});
        if (!good) notes_.wrong(BAD_UVS);
        part_.uvs.emplace_back(good ? glm::vec2(vertex[U], 1.0 - vertex[V]) : glm::vec2(0.0f));
    }
}

void Reader::read_faces(const Element& element) {
    body_.begin(element);
    for (uint64_t row = 0; row < element.count; ++row) {
        body_.begin_row(row);
        corners_.clear();
        corner_uvs_.clear();
        for (const Property& property : element.properties)
            if (is_corner_list(property))
                read_corners(property);
            else if (is_corner_uvs(property))
                read_corner_uvs(property);
            else
                body_.skip(property);
        add_polygon();
    }
}

/// Whether all positions of the corners are finite; adds a note where they are not.
bool Reader::usable(std::span<const uint32_t> corners) {
    if (!bad_positions_) return true;
    const bool good = std::ranges::all_of(corners, [&](uint32_t corner) {
        const glm::dvec3& p = positions_[corner];
        return is_finite({p.x, p.y, p.z});
    });
    dropped_ |= !good;
    if (!good) notes_.wrong("Faces with positions that are no finite numbers are left out");
    return good;
}

/// Bad positions, which no triangle uses now, become one that is used.
void Reader::hide_bad_positions() {
    if (!bad_positions_ || part_.triangles.empty()) return;
    const glm::vec3 used = part_.positions[part_.triangles[0].x];
    for (glm::vec3& p : part_.positions)
        if (!is_finite({p.x, p.y, p.z})) p = used;
}

void Reader::read_corners(const Property& list) {
    const uint64_t count = body_.length(list);
    if (count > MAX_VERTICES) body_.fail(fmt::format("has {} corners; split it", count));
    cost_.add(polygon_bytes(count));
    corners_.clear();
    for (uint64_t i = 0; i < count; ++i)
        corners_.push_back(body_.index(list.type, positions_.size(), "vertex"));
}

void Reader::read_corner_uvs(const Property& list) {
    const uint64_t count = body_.length(list);
    corner_uvs_.clear();
    for (uint64_t i = 0; i < count; ++i) corner_uvs_.push_back(body_.number(list));
}

/// Gives each corner of the face a vertex of its own texture coordinates; equal ones share it.
void Reader::split_corners() {
    if (part_.uvs.empty()) part_.uvs.resize(positions_.size(), glm::vec2(0.0f));
    for (size_t i = 0; i < corners_.size(); ++i) {
        const double u = corner_uvs_[2 * i], v = corner_uvs_[2 * i + 1];
        const bool good = is_finite({u, v});
        if (!good) notes_.wrong(BAD_UVS);
        const glm::vec2 uv = good ? glm::vec2(u, 1.0 - v) : glm::vec2(0.0f);
        const uint32_t corner = corners_[i];
        const auto [found, is_new] = split_.try_emplace({corner, uv}, uint32_t(positions_.size()));
        corners_[i] = found->second;
        if (!is_new) continue;
        cost_.add(VERTEX_BYTES);
        positions_.push_back(glm::dvec3(positions_[corner]));
        if (!part_.normals.empty()) part_.normals.push_back(glm::vec3(part_.normals[corner]));
        if (!part_.colors.empty()) part_.colors.push_back(glm::vec4(part_.colors[corner]));
        part_.uvs.push_back(uv);
    }
}

void Reader::add_polygon() {
    if (corners_.size() < 3) return notes_.add("Points and lines are skipped");
    if (!usable(corners_)) return;
    if (!corner_uvs_.empty() && corner_uvs_.size() == 2 * corners_.size()) split_corners();
    if (corners_.size() == 3) // as all are in most files
        return void(part_.triangles.emplace_back(corners_[0], corners_[1], corners_[2]));
    for (const auto& [a, b, c] : triangulate({positions_, corners_}))
        part_.triangles.emplace_back(corners_[a], corners_[b], corners_[c]);
}

void Reader::read_strips(const Element& element) {
    body_.begin(element);
    for (uint64_t row = 0; row < element.count; ++row) {
        body_.begin_row(row);
        for (const Property& property : element.properties)
            if (is_corner_list(property))
                read_strip(property);
            else
                body_.skip(property);
    }
}

/// A list of strips, each of which -1 ends. Every second triangle of a strip is turned over; those
/// that name a vertex twice only turn the strip.
void Reader::read_strip(const Property& list) {
    std::array<uint32_t, 3> corners{};
    size_t known = 0; // corners of this strip so far
    for (uint64_t left = body_.length(list); left > 0; --left) {
        cost_.add(TRIANGLE_BYTES);
        const auto corner = body_.index_or_none(list.type, positions_.size(), "vertex");
        if (!corner) {
            known = 0;
            continue;
        }
        corners = {corners[1], corners[2], *corner};
        if (++known < 3) continue;
        const auto [a, b, c] = corners;
        if (a == b || b == c || c == a || !usable(corners)) continue;
        part_.triangles.push_back(known % 2 ? glm::uvec3(a, b, c) : glm::uvec3(b, a, c));
    }
}

void Reader::skip(const Element& element) {
    notes_.add("Other elements than vertices and faces are ignored", element.name);
    body_.skip(element);
}

} // namespace

JoinedMesh read_mesh(const std::string& name, const std::string& mesh_name, std::string_view file,
                     const Header& header, Notes& notes, LoadContext& context) {
    return Reader(name, file, header, notes, context).read(mesh_name);
}

} // namespace onde::ply
