// Shapes and objects of a pbrt file, and what they look like.
#include "core/error.h"
#include "scene/mesh_file.h"
#include "scene/opacity.h"
#include "scene/pbrt/reader.h"

#include "scene/measured.h"
#include "scene/pbrt/shape.h"
#include "scene/references.h"
#include "scene/tube.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace onde::pbrt {

void Reader::place(const Part& part) {
    if (object_) {
        cost_.add(2 * sizeof(Part));
        object_->push_back(part);
    } else if (part.is_mesh) {
        scene_.place_mesh(part.of, part.place, notes_);
    } else {
        scene_.place_shape(part.kind, part.of, part.place, notes_);
    }
}

Reader::Look Reader::look(const Parameters& p) {
    Look look{.material = state_.material, .area_light = state_.area_light};
    if (object_ && look.area_light >= 0) {
        notes_.add("Lights in objects that are placed by instances do not shine, as in pbrt");
        look.area_light = -1;
    }
    if (const auto texture = p.texture("alpha")) look.alpha_texture = *texture;
    look.inside = state_.inside;
    look.alpha = std::clamp(p.number("alpha").value_or(1.0), 0.0, 1.0);
    return look;
}

uint32_t Reader::material_of(const Look& look) {
    std::vector<Material>& materials = scene_.assets().materials;
    const auto [found, is_new] = looks_.try_emplace(look, uint32_t(materials.size()));
    if (is_new) {
        context_.spend(1, 2 * sizeof(Material), name_);
        materials.emplace_back(); // until the file has defined all
    }
    return found->second;
}

void Reader::shape() {
    const std::string kind = text("a kind of shape");
    const Parameters p = parameters();
    if (kind == "trianglemesh" || kind == "bilinearmesh" || kind == "loopsubdiv") {
        if (kind == "loopsubdiv") notes_.add("Subdivision surfaces are their control meshes");
        add_mesh(mesh_of(kind, p, notes_), p);
    } else if (kind == "plymesh") {
        add_mesh_file(p);
    } else if (kind == "sphere") {
        add_sphere(p);
    } else if (kind == "disk") {
        add_disk(p);
    } else if (kind == "cylinder") {
        add_cylinder(p);
    } else {
        return notes_.add("Shapes of kinds that Onde does not have are left out", kind);
    }
    for (const std::string& unused : p.unused())
        notes_.add("Other parameters of shapes are ignored", unused);
}

void Reader::add_mesh(JoinedMesh joined, const Parameters& p) {
    Mesh& mesh = joined.mesh;
    if (mesh.triangles.empty()) return notes_.wrong("Meshes without faces are left out", p.where());
    context_.spend(mesh.positions.size(), VERTEX_BYTES, name_);
    context_.spend(mesh.triangles.size(), TRIANGLE_BYTES, name_);
    turn_fronts(mesh, state_.is_reversed);
    std::ranges::fill(mesh.materials, material_of(look(p)));
    std::vector<Mesh>& meshes = scene_.assets().meshes;
    meshes.push_back(std::move(mesh));
    place({true, uint32_t(meshes.size() - 1), {}, glm::translate(state_.transform, joined.origin)});
}

void Reader::add_mesh_file(const Parameters& p) {
    const std::string file = p.text("filename").value_or("");
    const auto path = sources_.find(file, "Meshes");
    if (!path) return;
    if (p.has("displacement")) notes_.add("Displacements are left out", file);
    p.find("edgelength");
    std::vector<Mesh>& meshes = scene_.assets().meshes;
    const uint32_t material = material_of(look(p));
    const auto key = std::tuple(path->string(), material, state_.is_reversed);
    auto known = mesh_files_.find(key);
    if (known == mesh_files_.end()) {
        MeshFile loaded = load_mesh_file(*path, context_);
        for (const std::string& note : loaded.notes)
            scene_.assets().notes.push_back(file + ": " + note);
        loaded.mesh.colors.clear(); // pbrt has none
        turn_fronts(loaded.mesh, state_.is_reversed);
        std::ranges::fill(loaded.mesh.materials, material);
        meshes.push_back(std::move(loaded.mesh));
        known = mesh_files_.try_emplace(key, KnownMesh{uint32_t(meshes.size() - 1), loaded.origin})
                    .first;
    }
    const auto& [mesh, origin] = known->second;
    place({true, mesh, {}, glm::translate(state_.transform, origin)});
}

void Reader::add_sphere(const Parameters& p) {
    const double radius = p.number("radius").value_or(1.0);
    for (const char* name : {"zmin", "zmax", "phimax"})
        if (p.has(name)) notes_.add("Round shapes are whole", name);
    const Look seen = look(p);
    if (state_.is_reversed && seen.area_light >= 0)
        notes_.add("Spheres that shine inward shine outward");
    place({false, material_of(seen), ShapeKind::sphere,
           glm::scale(state_.transform, glm::dvec3(radius))});
}

/// Ours lies in the XZ plane and faces +Y; pbrt's lies in the XY plane and faces +Z.
void Reader::add_disk(const Parameters& p) {
    const double radius = p.number("radius").value_or(1.0);
    const double height = p.number("height").value_or(0.0);
    for (const char* name : {"innerradius", "phimax"})
        if (p.has(name)) notes_.add("Round shapes are whole", name);
    const double turn = glm::radians(state_.is_reversed ? -90.0 : 90.0);
    const glm::dmat4 lifted = glm::translate(state_.transform, glm::dvec3(0.0, 0.0, height));
    place({false, material_of(look(p)), ShapeKind::disk,
           glm::rotate(glm::scale(lifted, glm::dvec3(radius)), turn, glm::dvec3(1, 0, 0))});
}

void Reader::add_cylinder(const Parameters& p) {
    const double radius = p.number("radius").value_or(1.0);
    const double low = p.number("zmin").value_or(-1.0), high = p.number("zmax").value_or(1.0);
    if (p.has("phimax")) notes_.add("Round shapes are whole", "phimax");
    const glm::dmat4 kept = state_.transform;
    state_.transform = glm::scale(glm::translate(kept, glm::dvec3(0.0, 0.0, low)),
                                  glm::dvec3(radius, radius, high - low));
    add_mesh({tube_mesh()}, p);
    state_.transform = kept;
}

void Reader::object_begin() {
    const std::string name = text("a name");
    if (object_) fail("objects can't be defined within another; end it first");
    save('O');
    object_ = &objects_[name];
    object_->clear();
}

void Reader::object_end() {
    if (!object_) return notes_.wrong("Ends of what has not begun are left out", tokens_->where());
    object_ = nullptr;
    while (!saved_.empty() && saved_.back().first != 'O') saved_.pop_back();
    restore('O');
}

void Reader::object_instance() {
    const std::string name = text("a name");
    if (object_) fail("objects can't be placed within another; end it first");
    const auto found = objects_.find(name);
    if (found == objects_.end())
        return notes_.wrong("Objects that are not defined are left out", name);
    for (Part part : found->second) {
        part.place = state_.transform * part.place;
        place(part);
    }
}

/// Gives the material the alpha that the shape's parameter states.
void Reader::add_opacity(const Look& look, Material& material) {
    if (look.alpha_texture.empty()) {
        if (look.alpha >= 1.0) return;
        material.alpha_mode = AlphaMode::blend;
        material.alpha *= float(look.alpha);
        return;
    }
    const auto opacity = textures_.named(look.alpha_texture);
    if (!opacity) return;
    material.alpha_mode = AlphaMode::blend;
    if (opacity->texture == NO_TEXTURE) {
        material.alpha *= opacity->factor.x;
        return;
    }
    std::vector<Texture>& textures = scene_.assets().textures;
    const Texture& mask = textures[size_t(opacity->texture)];
    const int32_t base = material.base_color_texture;
    const TexelImage color =
        base == NO_TEXTURE ? TexelImage{} : image_of(textures, textures[size_t(base)]);
    TexelImage image = with_opacity(color, image_of(textures, mask));
    context_.spend(image.bytes(), 2, name_);
    const TextureUse use = use_of(base == NO_TEXTURE ? mask : textures[size_t(base)]);
    material.base_color_texture =
        add_texture(textures, look.alpha_texture + " as opacity", std::move(image),
                    {true, use.wrap_u, use.wrap_v, use.filter, use.uv_set, use.transform});
}

void Reader::convert_looks() {
    if (const Medium* medium = find_medium(around_camera_)) scene_.assets().medium = *medium;
    const FindMaterial find = [&](const std::string& name) {
        const auto found = material_of_name_.find(name);
        return found == material_of_name_.end() ? -1 : int64_t(found->second);
    };
    std::vector<Material>& materials = scene_.assets().materials;
    for (const auto& [look, index] : looks_) {
        auto [material, other] =
            convert_material(materials_[look.material], materials_, find, textures_, sources_);
        if (other) {
            material.blend_with = uint32_t(materials.size());
            materials.push_back(std::move(*other));
        }
        if (look.area_light >= 0) {
            const AreaLight& light = area_lights_[size_t(look.area_light)];
            material.emission = light.radiance;
            material.two_sided = light.two_sided;
        }
        add_opacity(look, material);
        if (const Medium* medium = find_medium(look.inside); medium && !fill(material, *medium))
            notes_.add("Media inside of what lets no light in are left out", look.inside);
        materials[index] = std::move(material);
    }
}

} // namespace onde::pbrt
