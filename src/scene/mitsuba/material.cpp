#include "scene/mitsuba/material.h"

#include "scene/mean_color.h"
#include "scene/measured.h"
#include "scene/opacity.h"
#include "scene/references.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace onde::mitsuba {

struct Materials::Kind {
    std::string_view type;
    void (Materials::*read)(const Element&, Material&, int);
    std::string_view becomes; ///< for the documentation
    std::string_view note;    ///< nothing where it is exact
};

std::span<const Materials::Kind> Materials::kinds() {
    static constexpr std::string_view PLASTIC =
        "`metallic-roughness` without metal, whose coat has the index, and sends light back to its "
        "body if it is `nonlinear`";
    static constexpr std::string_view CONDUCTOR =
        "`conductor` of the reflectances head on and at the edge";
    static constexpr std::string_view PRINCIPLED =
        "`metallic-roughness` with its colour, roughness, metal, grain, clear share, coat and "
        "sheen, with a note";
    static constexpr std::string_view PRINCIPLED_NOTE =
        "Principled materials have glTF's lobes in place of their own";
    static constexpr std::string_view INNER = "what is in it";
    static const Kind KINDS[] = {
        {"diffuse", &Materials::diffuse, "`diffuse`", ""},
        {"conductor", &Materials::conductor, CONDUCTOR, ""},
        {"roughconductor", &Materials::rough_conductor, CONDUCTOR, ""},
        {"dielectric", &Materials::dielectric, "`dielectric`", ""},
        {"roughdielectric", &Materials::rough_dielectric, "`dielectric`", ""},
        {"thindielectric", &Materials::thin_dielectric, "`dielectric` with `thin_walled`", ""},
        {"plastic", &Materials::plastic, PLASTIC, ""},
        {"roughplastic", &Materials::rough_plastic, PLASTIC, ""},
        {"principled", &Materials::principled, PRINCIPLED, PRINCIPLED_NOTE},
        {"principledthin", &Materials::principled, PRINCIPLED, PRINCIPLED_NOTE},
        {"null", &Materials::null, "nothing: rays pass", ""},
        {"twosided", &Materials::two_sided, INNER, ""},
        {"mask", &Materials::mask, "what is in it, with its opacity as alpha", ""},
        {"normalmap", &Materials::normal_map, "what is in it, with a normal texture", ""},
        {"bumpmap", &Materials::bump_map, "what is in it, with a note", "Bump maps are left out"},
        {"blendbsdf", &Materials::blend, "its first material, with `blend_with` the second", ""}};
    return KINDS;
}

std::vector<FileWord> Materials::words() {
    std::vector<FileWord> words;
    for (const Kind& kind : kinds()) words.push_back({kind.type, kind.becomes});
    return words;
}

Materials::Converted Materials::convert(const Element* bsdf) {
    Material m;
    m.name = "default";
    m.base_color = glm::vec3(0.5f);
    color_.reset();
    if (bsdf) convert_into(*bsdf, m, 0);
    return {std::move(m), color_};
}

void Materials::convert_into(const Element& bsdf, Material& m, int depth) {
    constexpr int DEEPEST = 16;
    if (depth == DEEPEST)
        return document_.notes().wrong("Materials within materials end after 16", bsdf.where);
    if (const std::string& id = bsdf["id"]; !id.empty() && m.name == "default") m.name = id;
    const std::string& type = bsdf["type"];
    const auto known = std::ranges::find(kinds(), type, &Kind::type);
    if (known == kinds().end())
        return document_.notes().add("Materials of kinds that Onde does not know are diffuse grey",
                                     type);
    (this->*known->read)(bsdf, m, depth);
    if (m.name == "default") m.name = type;
    if (!known->note.empty()) document_.notes().add(std::string(known->note), bsdf.where);
}

void Materials::inner(const Element& bsdf, Material& m, int depth) {
    if (const Element* child = document_.child(bsdf, "bsdf")) convert_into(*child, m, depth + 1);
}

/// The attribute of meshes that something is by that name, if it is.
std::optional<MeshAttribute> Materials::attribute(const Element& bsdf,
                                                  std::string_view name) const {
    const Element* found = document_.property(bsdf, name);
    if (!found || !found->is("texture", "mesh_attribute")) return std::nullopt;
    const Values values(document_, *found);
    return MeshAttribute{.name = values.text("name"),
                         .at_zero = glm::vec3(0.0f),
                         .at_one = glm::vec3(float(values.number("scale", 1.0)))};
}

void Materials::set_color(const Element& bsdf, std::string_view name, Material& m, double absent) {
    if (const auto found = attribute(bsdf, name)) {
        m.base_color = glm::vec3(1.0f);
        color_ = found;
        return;
    }
    const Textured textured = color(bsdf, name, glm::dvec3(absent));
    m.base_color = glm::clamp(textured.factor, 0.0f, 1.0f);
    m.base_color_texture = textured.texture;
}

/// A number, or the mean of a texture.
double Materials::number(const Element& of, std::string_view name, double absent) {
    const Element* found = document_.property(of, name);
    if (!found || found->tag != "texture") return Values(document_, of).number(name, absent);
    const auto textured = texture(*found, false);
    if (!textured) return absent;
    if (textured->texture == NO_TEXTURE) return textured->factor.x;
    document_.notes().add("Textures of other values than colours count as their mean",
                          found->where);
    return textured->factor.x * mean_color(scene_, textured->texture).x;
}

/// The alphas along u and v, of microfacets whose distribution goes to m.
glm::dvec2 Materials::alphas(const Element& bsdf, Material& m) {
    const bool ggx = Values(document_, bsdf).text("distribution", "beckmann") == "ggx";
    m.distribution = ggx ? Distribution::ggx : Distribution::beckmann;
    const double alpha = number(bsdf, "alpha", 0.1);
    return glm::clamp(glm::dvec2(number(bsdf, "alpha_u", alpha), number(bsdf, "alpha_v", alpha)),
                      0.0, 1.0);
}

/// Of what has no grain in Onde.
void Materials::set_even_roughness(const Element& bsdf, Material& m) {
    const glm::dvec2 alpha = alphas(bsdf, m);
    if (alpha.x != alpha.y)
        document_.notes().add("Glass and coats are as rough along all directions of a surface",
                              m.name);
    m.roughness = float(std::pow(alpha.x * alpha.y, 0.25));
}

double Materials::index_of(const Element& bsdf) {
    const Values values(document_, bsdf);
    return values.index("int_ior", "bk7") / values.index("ext_ior", "air");
}

void Materials::set_conductor(const Element& bsdf, Material& m) {
    const Values values(document_, bsdf);
    m.kind = MaterialKind::conductor;
    const std::string substance = values.text("material", "none");
    auto eta = values.color("eta"), k = values.color("k");
    if (const auto known = spectrum::conductor_index(substance); known && !eta && !k) {
        eta = spectrum::color_of_light(known->eta);
        k = spectrum::color_of_light(known->k);
    } else if (substance != "none") {
        document_.notes().add("Conductors whose name Onde does not know are grey", substance);
        eta = k = std::nullopt;
    }
    const Textured tint = color(bsdf, "specular_reflectance", glm::dvec3(1.0));
    glm::vec3 reflectance(substance == "none" ? 1.0f : 0.5f);
    for (glm::length_t c = 0; eta && k && c < 3; ++c) {
        reflectance[c] = float(conductor_reflectance(1.0, (*eta)[c], (*k)[c]));
        m.edge_tint[c] = float(edge_tint((*eta)[c], (*k)[c]));
    }
    m.base_color = glm::clamp(reflectance * tint.factor, 0.0f, 1.0f);
    m.base_color_texture = tint.texture;
}

void Materials::diffuse(const Element& bsdf, Material& m, int) {
    m.kind = MaterialKind::diffuse;
    set_color(bsdf, "reflectance", m);
}

void Materials::conductor(const Element& bsdf, Material& m, int) {
    set_conductor(bsdf, m);
    m.roughness = 0.0f;
}

void Materials::rough_conductor(const Element& bsdf, Material& m, int) {
    set_conductor(bsdf, m);
    const glm::dvec2 alpha = alphas(bsdf, m);
    set_alphas(m, alpha.x, alpha.y);
}

void Materials::dielectric(const Element& bsdf, Material& m, int) {
    m.kind = MaterialKind::dielectric;
    set_color(bsdf, "specular_transmittance", m, 1.0);
    const double index = index_of(bsdf);
    m.ior = float(std::clamp(std::isfinite(index) ? index : 1.5, 0.01, 100.0));
    m.roughness = 0.0f;
}

void Materials::rough_dielectric(const Element& bsdf, Material& m, int depth) {
    dielectric(bsdf, m, depth);
    set_even_roughness(bsdf, m);
}

void Materials::thin_dielectric(const Element& bsdf, Material& m, int) {
    set_pane(m, index_of(bsdf));
    set_color(bsdf, "specular_transmittance", m, 1.0);
}

/// Without `nonlinear`, what comes back to the body is as white as what went out first.
void Materials::plastic(const Element& bsdf, Material& m, int) {
    set_plastic(m, index_of(bsdf));
    set_color(bsdf, "diffuse_reflectance", m);
    if (!Values(document_, bsdf).flag("nonlinear", false)) m.inner_reflection = 0.0f;
    m.roughness = 0.0f;
}

void Materials::rough_plastic(const Element& bsdf, Material& m, int depth) {
    plastic(bsdf, m, depth);
    set_even_roughness(bsdf, m);
}

void Materials::principled(const Element& bsdf, Material& m, int) {
    const auto share = [&](std::string_view name, double absent) {
        return float(std::clamp(number(bsdf, name, absent), 0.0, 1.0));
    };
    m.kind = MaterialKind::metallic_roughness;
    set_color(bsdf, "base_color", m);
    const double alpha = std::pow(double(share("roughness", 0.5)), 2.0);
    const double aspect = std::sqrt(1.0 - 0.9 * double(share("anisotropic", 0.0)));
    set_alphas(m, alpha / aspect, alpha * aspect);
    m.metallic = share("metallic", 0.0);
    m.transmission = share("spec_trans", 0.0);
    m.thin_walled = bsdf["type"] == "principledthin";
    const double specular = number(bsdf, "specular", 0.5);
    const double index = 2.0 / (1.0 - std::sqrt(0.08 * std::clamp(specular, 0.0, 1.0))) - 1.0;
    m.ior = float(std::clamp(number(bsdf, "eta", index), 1.0, 100.0));
    m.clearcoat = 0.25f * share("clearcoat", 0.0);
    m.clearcoat_roughness =
        float(std::sqrt(std::lerp(0.1, 0.001, double(share("clearcoat_gloss", 0.0)))));
    m.sheen_color = glm::vec3(share("sheen", 0.0));
    m.sheen_roughness = 0.5f;
}

void Materials::null(const Element&, Material& m, int) {
    m.base_color = glm::vec3(0.0f);
    m.alpha_mode = AlphaMode::mask;
    m.alpha = 0.0f;
}

void Materials::two_sided(const Element& bsdf, Material& m, int depth) {
    inner(bsdf, m, depth);
}

void Materials::mask(const Element& bsdf, Material& m, int depth) {
    inner(bsdf, m, depth);
    m.alpha_mode = AlphaMode::blend;
    const Textured opacity = color(bsdf, "opacity", glm::dvec3(0.5));
    m.alpha *= std::clamp(opacity.factor.x, 0.0f, 1.0f);
    if (opacity.texture == NO_TEXTURE) return;
    const int32_t base = m.base_color_texture;
    std::vector<Texture>& textures = scene_.textures;
    const Texture& mask = textures[size_t(opacity.texture)];
    const ByteImage picture =
        base == NO_TEXTURE ? ByteImage{} : image_of(textures, textures[size_t(base)]);
    ByteImage image = with_opacity(picture, image_of(textures, mask), OpacityChannel::red);
    document_.context().spend(image.bytes(), 2, bsdf.where);
    TextureUse use = use_of(base == NO_TEXTURE ? mask : textures[size_t(base)]);
    use.srgb = true;
    m.base_color_texture = add_texture(textures, bsdf.where + ": opacity", std::move(image), use);
}

void Materials::normal_map(const Element& bsdf, Material& m, int depth) {
    inner(bsdf, m, depth);
    const Element* map = document_.property(bsdf, "normalmap");
    if (!map || map->tag != "texture" || (*map)["type"] != "bitmap") return;
    if (const auto textured = bitmap(*map, false)) m.normal_texture = textured->texture;
}

void Materials::bump_map(const Element& bsdf, Material& m, int depth) {
    inner(bsdf, m, depth);
}

/// Two plain colours, mixed, are a colour of vertices.
void Materials::blend_by(const MeshAttribute& weight, const Element& first, const Element& second,
                         Material& m, int depth) {
    Material other;
    convert_into(second, other, depth + 1);
    convert_into(first, m, depth + 1);
    const auto is_plain = [](const Material& part) {
        return part.kind == MaterialKind::diffuse && part.base_color_texture == NO_TEXTURE;
    };
    if (!is_plain(m) || !is_plain(other) || color_)
        return document_.notes().add("Blends by attributes of meshes show their first part, but "
                                     "for those of two plain colours",
                                     weight.name);
    color_ = {weight.name, m.base_color, glm::mix(m.base_color, other.base_color, weight.at_one)};
    m.base_color = glm::vec3(1.0f);
}

void Materials::blend(const Element& bsdf, Material& m, int depth) {
    std::vector<const Element*> parts;
    for (const Element& child : bsdf.children) {
        if (child.tag != "bsdf" && child.tag != "ref") continue;
        const Element* part = document_.resolved(child);
        if (part && part->tag == "bsdf") parts.push_back(part);
    }
    if (parts.size() != 2)
        return document_.notes().wrong("Blends of other than two materials are grey", bsdf.where);
    if (const auto weight = attribute(bsdf, "weight"))
        return blend_by(*weight, *parts[0], *parts[1], m, depth);
    const Textured weight = color(bsdf, "weight", glm::dvec3(0.5));
    convert_into(*parts[0], m, depth + 1);
    if (blends_ > 0)
        return document_.notes().add("Of blends within blends the first part is shown", bsdf.where);
    ++blends_;
    Material other;
    other.name = "default";
    other.base_color = glm::vec3(0.5f);
    convert_into(*parts[1], other, depth + 1);
    --blends_;
    scene_.materials.push_back(std::move(other));
    m.blend_with = uint32_t(scene_.materials.size() - 1);
    m.blend = std::clamp(weight.factor.x, 0.0f, 1.0f);
    m.blend_texture = weight.texture;
}

} // namespace onde::mitsuba
