#include "scene/mitsuba/material.h"

#include "scene/coat.h"
#include "scene/mean_color.h"
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
        "`metallic-roughness` without metal: a coat of index 1.5, with a note";
    static constexpr std::string_view PLASTIC_NOTE =
        "Plastics have the base and the coat of glTF's, of index 1.5";
    static constexpr std::string_view INNER = "what is in it";
    static const Kind KINDS[] = {
        {"diffuse", &Materials::diffuse, "`diffuse`", ""},
        {"conductor", &Materials::conductor, "`conductor` of the reflectance at normal incidence",
         ""},
        {"roughconductor", &Materials::rough_conductor,
         "`conductor` of the reflectance at normal incidence", ""},
        {"dielectric", &Materials::dielectric, "`dielectric`", ""},
        {"roughdielectric", &Materials::rough_dielectric, "`dielectric`", ""},
        {"thindielectric", &Materials::thin_dielectric,
         "a mirror that lets rays pass as often as the pane does at normal incidence, with a note",
         "Thin dielectrics reflect the same share at every angle"},
        {"plastic", &Materials::plastic, PLASTIC, PLASTIC_NOTE},
        {"roughplastic", &Materials::rough_plastic, PLASTIC, PLASTIC_NOTE},
        {"principled", &Materials::principled,
         "`metallic-roughness` of its base colour, roughness and metallic, with a note",
         "Principled materials have their base colour, roughness and metal alone"},
        {"principledthin", &Materials::principled,
         "`metallic-roughness` of its base colour, roughness and metallic, with a note",
         "Principled materials have their base colour, roughness and metal alone"},
        {"null", &Materials::null, "nothing: rays pass", ""},
        {"twosided", &Materials::two_sided, INNER, ""},
        {"mask", &Materials::mask, "what is in it, with its opacity as alpha", ""},
        {"normalmap", &Materials::normal_map, "what is in it, with a normal texture", ""},
        {"bumpmap", &Materials::bump_map, "what is in it, with a note", "Bump maps are left out"},
        {"blendbsdf", &Materials::blend,
         "of its two materials the one that counts more, with a note",
         "Of blended materials the one that counts more is shown"}};
    return KINDS;
}

std::vector<FileWord> Materials::words() {
    std::vector<FileWord> words;
    for (const Kind& kind : kinds()) words.push_back({kind.type, kind.becomes});
    return words;
}

Material Materials::convert(const Element* bsdf) {
    Material m;
    m.name = "default";
    m.base_color = glm::vec3(0.5f);
    if (bsdf) convert_into(*bsdf, m, 0);
    return m;
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

void Materials::set_color(const Element& bsdf, std::string_view name, Material& m, double absent) {
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

/// Our roughness, whose square is alpha.
void Materials::set_roughness(const Element& bsdf, Material& m) {
    const double alpha = number(bsdf, "alpha", 0.1);
    const double u = number(bsdf, "alpha_u", alpha), v = number(bsdf, "alpha_v", alpha);
    if (u != v)
        document_.notes().add("Roughness is the same along all directions of a surface", m.name);
    if (Values(document_, bsdf).text("distribution", "beckmann") != "ggx")
        document_.notes().add("Beckmann's distribution is taken as GGX's", bsdf.where);
    m.roughness = float(std::pow(std::clamp(u, 0.0, 1.0) * std::clamp(v, 0.0, 1.0), 0.25));
}

void Materials::set_index(const Element& bsdf, Material& m) {
    const Values values(document_, bsdf);
    const double ratio = values.index("int_ior", "bk7") / values.index("ext_ior", "air");
    m.ior = float(std::clamp(std::isfinite(ratio) ? ratio : 1.5, 0.01, 100.0));
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
    if (eta && k)
        for (size_t c = 0; c < 3; ++c)
            reflectance[c] = float(spectrum::normal_reflectance((*eta)[c], (*k)[c]));
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
    set_roughness(bsdf, m);
}

void Materials::dielectric(const Element& bsdf, Material& m, int) {
    m.kind = MaterialKind::dielectric;
    set_color(bsdf, "specular_transmittance", m, 1.0);
    set_index(bsdf, m);
    m.roughness = 0.0f;
}

void Materials::rough_dielectric(const Element& bsdf, Material& m, int depth) {
    dielectric(bsdf, m, depth);
    set_roughness(bsdf, m);
}

/// What two faces reflect of light that meets them head on stays; the rest goes straight on.
void Materials::thin_dielectric(const Element& bsdf, Material& m, int) {
    set_index(bsdf, m);
    const double face = spectrum::normal_reflectance(m.ior, 0.0);
    m.kind = MaterialKind::conductor;
    m.base_color = glm::vec3(1.0f);
    m.roughness = 0.0f;
    m.alpha_mode = AlphaMode::blend;
    m.alpha = float(2.0 * face / (1.0 + face));
}

void Materials::plastic(const Element& bsdf, Material& m, int) {
    m.kind = MaterialKind::metallic_roughness;
    set_color(bsdf, "diffuse_reflectance", m);
    set_index(bsdf, m);
    if (Values(document_, bsdf).flag("nonlinear", false))
        m.base_color = coated_albedo(m.base_color, m.ior);
    m.ior = Material{}.ior; // of the kind, glTF's
    m.roughness = 0.0f;
}

void Materials::rough_plastic(const Element& bsdf, Material& m, int depth) {
    plastic(bsdf, m, depth);
    set_roughness(bsdf, m);
}

void Materials::principled(const Element& bsdf, Material& m, int) {
    m.kind = MaterialKind::metallic_roughness;
    set_color(bsdf, "base_color", m);
    m.roughness = float(std::clamp(number(bsdf, "roughness", 0.5), 0.0, 1.0));
    m.metallic = float(std::clamp(number(bsdf, "metallic", 0.0), 0.0, 1.0));
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

void Materials::blend(const Element& bsdf, Material& m, int depth) {
    size_t wanted = number(bsdf, "weight", 0.5) > 0.5 ? 1 : 0;
    for (const Element& child : bsdf.children) {
        if (child.tag != "bsdf" && child.tag != "ref") continue;
        const Element* part = document_.resolved(child);
        if (part && part->tag == "bsdf" && wanted-- == 0) return convert_into(*part, m, depth + 1);
    }
}

} // namespace onde::mitsuba
