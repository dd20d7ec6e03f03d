// PLY, the Stanford triangle format: vertices with normals and texture coordinates, and polygons.
// Header and values are read by ply_header and ply_body; here they become a mesh.
#include "core/error.h"
#include "core/files.h"
#include "scene/loaders.h"
#include "scene/mesh_parts.h"
#include "scene/ply_body.h"
#include "scene/triangulate.h"

#include <algorithm>
#include <array>

namespace onde {
namespace fs = std::filesystem;

namespace {

using ply::Body, ply::Element, ply::Header, ply::Property;

constexpr size_t MAX_CORNERS = 255; ///< of a face, as in OBJ; clipping ears takes their cube

/// The numbers of a vertex that we use.
enum Slot { X, Y, Z, NX, NY, NZ, U, V, UNUSED };

Slot slot_of(const Property& property) {
    constexpr std::pair<std::string_view, Slot> SLOTS[] = {
        {"x", X},         {"y", Y},         {"z", Z},         {"nx", NX},      {"ny", NY},
        {"nz", NZ},       {"u", U},         {"v", V},         {"s", U},        {"t", V},
        {"texture_u", U}, {"texture_v", V}, {"texture_s", U}, {"texture_t", V}};
    if (property.count_type) return UNUSED;
    for (const auto& [name, slot] : SLOTS)
        if (name == property.name) return slot;
    return UNUSED;
}

bool is_corner_list(const Property& property) {
    return property.count_type &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Reads the file's elements in their order.
class PlyReader {
  public:
    PlyReader(const std::string& name, const std::string& file)
        : name_(name), header_(ply::read_header(name, file)),
          body_(name_, std::string_view(file).substr(header_.size), header_.encoding) {}

    Mesh read(const std::string& mesh_name) {
        check_elements();
        for (const Element& element : header_.elements)
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(element);
            else
                skip(element);
        part_.materials.assign(part_.triangles.size(), 0);
        std::vector<MeshPart> parts;
        parts.push_back(std::move(part_));
        return join_parts(mesh_name, std::move(parts), notes_);
    }

    std::vector<std::string> notes() const { return notes_.sentences(); }

  private:
    void check_elements() const;
    void read_vertices(const Element& element);
    void read_faces(const Element& element);
    void read_polygon(const Property& list);
    void skip(const Element& element);

    const std::string& name_;
    Header header_;
    Body body_;
    Notes notes_;
    MeshPart part_;
    std::vector<uint32_t> corners_;     ///< of the face being read
    std::vector<glm::dvec3> positions_; ///< of these corners
};

void PlyReader::check_elements() const {
    const auto named = [&](const char* name) {
        const auto& all = header_.elements;
        return std::ranges::find(all, name, &Element::name) - all.begin();
    };
    const auto vertex = size_t(named("vertex")), face = size_t(named("face"));
    if (std::max(vertex, face) >= header_.elements.size())
        throw InputError("{}: its header lists no vertices or no faces, so there is no surface; "
                         "export the mesh with polygons",
                         name_);
    if (face < vertex)
        throw InputError("{}: its faces come before its vertices; export it again", name_);
    if (header_.elements[vertex].count > MAX_VERTICES)
        throw InputError("{}: more than {} vertices; split the file", name_, MAX_VERTICES);
    const std::vector<Property>& properties = header_.elements[face].properties;
    const auto list = std::ranges::find_if(properties, is_corner_list);
    if (list == properties.end() || list->type >= ply::Type::float32)
        throw InputError("{}: its faces have no list 'vertex_indices' of integers; export it again",
                         name_);
}

void PlyReader::read_vertices(const Element& element) {
    std::array<bool, UNUSED + 1> given{};
    std::vector<Slot> slots;
    for (const Property& property : element.properties) {
        slots.push_back(slot_of(property));
        given[slots.back()] = true;
        if (slots.back() == UNUSED)
            notes_.add("Other properties than positions, normals, texture coordinates and "
                       "polygons are ignored",
                       property.name);
    }
    if (!given[X] || !given[Y] || !given[Z])
        throw InputError("{}: its vertices have no x, y and z; export it again", name_);
    body_.begin(element);
    part_.positions.reserve(element.count);
    std::array<float, UNUSED> vertex{};
    for (uint64_t row = 0; row < element.count; ++row) {
        body_.begin_row(row);
        for (size_t i = 0; i < slots.size(); ++i)
            if (slots[i] == UNUSED)
                body_.skip(element.properties[i]);
            else
                vertex[slots[i]] = body_.number(element.properties[i]);
        part_.positions.emplace_back(vertex[X], vertex[Y], vertex[Z]);
        if (given[NX] && given[NY] && given[NZ])
            part_.normals.emplace_back(vertex[NX], vertex[NY], vertex[NZ]);
        if (given[U] && given[V]) part_.uvs.emplace_back(vertex[U], 1.0f - vertex[V]);
    }
}

void PlyReader::read_faces(const Element& element) {
    body_.begin(element);
    for (uint64_t row = 0; row < element.count; ++row) {
        body_.begin_row(row);
        for (const Property& property : element.properties)
            if (is_corner_list(property))
                read_polygon(property);
            else
                body_.skip(property);
    }
}

void PlyReader::read_polygon(const Property& list) {
    const uint64_t count = body_.length(list);
    if (count > MAX_CORNERS)
        body_.fail(fmt::format("has {} corners, more than {}; triangulate it", count, MAX_CORNERS));
    corners_.clear();
    positions_.clear();
    for (uint64_t i = 0; i < count; ++i) {
        corners_.push_back(body_.index(list.type, part_.positions.size(), "vertex"));
        positions_.emplace_back(part_.positions[corners_.back()]);
    }
    if (count < 3) notes_.add("Points and lines are skipped");
    if (count == 3) // as all are in most files
        part_.triangles.emplace_back(corners_[0], corners_[1], corners_[2]);
    else
        for (const auto& [a, b, c] : triangulate(positions_))
            part_.triangles.emplace_back(corners_[a], corners_[b], corners_[c]);
}

void PlyReader::skip(const Element& element) {
    notes_.add("Other elements than vertices and faces are ignored", element.name);
    body_.skip(element);
}

} // namespace

Scene load_ply(const fs::path& path) {
    const std::string file = read_file(path), name = path.string();
    PlyReader reader(name, file);
    Scene scene;
    scene.materials.emplace_back().name = "default";
    scene.meshes.push_back(reader.read(path.stem().string()));
    scene.instances.push_back({0, glm::mat4(1.0f)});
    scene.notes = reader.notes();
    return scene;
}

} // namespace onde
