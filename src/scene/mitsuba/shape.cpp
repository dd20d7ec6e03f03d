// Shapes of Mitsuba's files.
#include "core/error.h"
#include "scene/measured.h"
#include "scene/mesh_parts.h"
#include "scene/mitsuba/reader.h"
#include "scene/shapes.h"
#include "scene/tube.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace onde::mitsuba {

void Reader::place(const Part& part, Parts* group) {
    if (group) {
        context_.spend(2, sizeof(Part), name_);
        group->push_back(part);
    } else if (part.is_mesh) {
        scene_.place_mesh(part.of, part.place, notes_);
    } else {
        scene_.place_shape(part.kind, part.of, part.place, notes_);
    }
}

uint32_t Reader::material_of(const Element& shape) {
    const Element* emitter = document_.child(shape, "emitter");
    if (emitter && (*emitter)["type"] != "area") emitter = nullptr;
    const Element* medium = document_.child(shape, "medium");
    const Look look{document_.child(shape, "bsdf"), emitter, medium};
    std::vector<Material>& materials = scene_.assets().materials;
    if (const auto known = looks_.find(look); known != looks_.end()) return known->second;
    context_.spend(2, sizeof(Material), name_);
    auto [material, color] = materials_.convert(look.bsdf);
    if (emitter) {
        material.emission = strength(*emitter, "radiance");
        material.two_sided = false;
    }
    if (const auto inside = medium_of(medium); inside && !fill(material, *inside))
        notes_.add("Media inside of what lets no light in are left out", medium->where);
    materials.push_back(std::move(material));
    const auto number = uint32_t(materials.size() - 1);
    if (color) attributes_.emplace(number, *color);
    return looks_[look] = number;
}

void Reader::add_shape(const Element& shape, Parts* group) {
    const std::string& type = shape["type"];
    if (type == "obj" || type == "ply" || type == "stl") return add_mesh_file(shape, group);
    if (type == "rectangle") return add_rectangle(shape, group);
    if (type == "cube") return add_cube(shape, group);
    if (type == "sphere") return add_sphere(shape, group);
    if (type == "disk") return add_disk(shape, group);
    if (type == "cylinder") return add_cylinder(shape, group);
    if (type == "instance") return add_instance(shape, group);
    if (type != "shapegroup") // which stands there for instances
        notes_.add("Shapes of kinds that Onde does not have are left out", type);
}

void Reader::add_instance(const Element& shape, Parts* group) {
    if (group) return notes_.wrong("Instances in groups are left out", shape.where);
    const Element* source = document_.child(shape, "shape");
    if (!source || (*source)["type"] != "shapegroup")
        return notes_.wrong("Instances of what is no group are left out", shape.where);
    const auto [found, is_new] = groups_.try_emplace(source);
    if (is_new)
        for (const Element& child : source->children)
            if (const Element* part = document_.resolved(child); part && part->tag == "shape")
                add_shape(*part, &found->second);
    const glm::dmat4 to_world = Values(document_, shape).transform("to_world");
    for (Part part : found->second) {
        part.place = to_world * part.place;
        place(part, nullptr);
    }
}

void Reader::add_mesh(const Element& shape, Mesh mesh, const glm::dmat4& place_of, Parts* group) {
    if (Values(document_, shape).flag("flip_normals", false)) {
        for (glm::vec3& normal : mesh.normals) normal = -normal;
        for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
    }
    context_.spend(mesh.positions.size(), VERTEX_BYTES, name_);
    context_.spend(mesh.triangles.size(), TRIANGLE_BYTES, name_);
    std::ranges::fill(mesh.materials, material_of(shape));
    std::vector<Mesh>& meshes = scene_.assets().meshes;
    meshes.push_back(std::move(mesh));
    place({true, uint32_t(meshes.size() - 1), {}, place_of}, group);
}

void Reader::add_mesh_file(const Element& shape, Parts* group) {
    const Values values(document_, shape);
    const std::string file = values.text("filename");
    const auto path = document_.find(file, "Meshes");
    if (!path) return;
    const bool flat = values.flag("face_normals", false);
    const bool turned = values.flag("flip_normals", false);
    // Our readers turn v around, as Mitsuba does of OBJ files alone.
    const bool keeps_v = values.flag("flip_tex_coords", shape["type"] == "obj");
    const glm::dmat4 to_world = values.transform("to_world");
    const auto key = std::tuple(path->string(), material_of(shape), flat, turned, keeps_v);
    if (const auto known = mesh_files_.find(key); known != mesh_files_.end())
        return place({true, known->second.mesh, {}, glm::translate(to_world, known->second.origin)},
                     group);
    MeshFile loaded = load_mesh_file(*path, context_);
    Scene& assets = scene_.assets();
    for (const std::string& note : loaded.notes) assets.notes.push_back(file + ": " + note);
    loaded.mesh.colors.clear(); // which only textures of attributes show
    if (const auto wanted = attributes_.find(material_of(shape)); wanted != attributes_.end())
        if (shape["type"] != "ply" || !color_by(loaded.mesh, *path, wanted->second, context_))
            notes_.wrong("Attributes that a mesh does not have are white", wanted->second.name);
    if (flat) loaded.mesh.normals.clear();
    if (!keeps_v)
        for (glm::vec2& uv : loaded.mesh.uvs) uv.y = 1.0f - uv.y;
    mesh_files_[key] = {uint32_t(assets.meshes.size()), loaded.origin};
    add_mesh(shape, std::move(loaded.mesh), glm::translate(to_world, loaded.origin), group);
}

/// From -1 to 1 in the XY plane, toward +Z; the texture's first row is below.
void Reader::add_rectangle(const Element& shape, Parts* group) {
    Mesh mesh = rectangle_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0);
    for (glm::vec2& uv : mesh.uvs) uv.y = 1.0f - uv.y;
    add_mesh(shape, std::move(mesh), Values(document_, shape).transform("to_world"), group);
}

void Reader::add_cube(const Element& shape, Parts* group) {
    add_mesh(shape, box_mesh(glm::vec3(2.0f), 0), Values(document_, shape).transform("to_world"),
             group);
}

void Reader::add_sphere(const Element& shape, Parts* group) {
    const Values values(document_, shape);
    if (values.flag("flip_normals", false) && document_.child(shape, "emitter"))
        notes_.add("Spheres that shine inward shine outward", shape.where);
    const glm::dmat4 at =
        glm::translate(values.transform("to_world"), values.vector("center", glm::dvec3(0.0)));
    place({false, material_of(shape), ShapeKind::sphere,
           glm::scale(at, glm::dvec3(values.number("radius", 1.0)))},
          group);
}

/// Ours lies in the XZ plane and faces +Y; Mitsuba's lies in the XY plane and faces +Z.
void Reader::add_disk(const Element& shape, Parts* group) {
    const Values values(document_, shape);
    const double turn = glm::radians(values.flag("flip_normals", false) ? -90.0 : 90.0);
    place({false, material_of(shape), ShapeKind::disk,
           glm::rotate(values.transform("to_world"), turn, glm::dvec3(1, 0, 0))},
          group);
}

void Reader::add_cylinder(const Element& shape, Parts* group) {
    const Values values(document_, shape);
    const glm::dvec3 from = values.vector("p0", glm::dvec3(0.0));
    const glm::dvec3 axis = values.vector("p1", glm::dvec3(0, 0, 1)) - from;
    if (!(glm::length(axis) > 0.0))
        return notes_.wrong("Cylinders without a length are left out", shape.where);
    const double radius = values.number("radius", 1.0);
    const glm::dvec3 z = glm::normalize(axis);
    const glm::dvec3 x = glm::normalize(
        glm::cross(std::abs(z.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), z));
    const glm::dmat4 own(glm::dvec4(x * radius, 0.0), glm::dvec4(glm::cross(z, x) * radius, 0.0),
                         glm::dvec4(axis, 0.0), glm::dvec4(from, 1.0));
    add_mesh(shape, tube_mesh(), values.transform("to_world") * own, group);
}

} // namespace onde::mitsuba
