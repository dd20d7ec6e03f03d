// What surfaces look like.
#pragma once

#include "core/enum_words.h"
#include "image/image.h"
#include "scene/fields.h"
#include "scene/medium.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace onde {

enum class Wrap : uint32_t { repeat, clamp, mirror };

constexpr auto enum_words(Wrap) {
    return std::array{EnumWord{Wrap::repeat, "repeat"}, EnumWord{Wrap::clamp, "clamp"},
                      EnumWord{Wrap::mirror, "mirror"}};
}

/// mip: linear, in a coarser level of the picture where the camera sees many texels in a pixel.
enum class TextureFilter : uint32_t { linear, nearest, mip };

constexpr auto enum_words(TextureFilter) {
    return std::array{EnumWord{TextureFilter::linear, "linear"},
                      EnumWord{TextureFilter::nearest, "nearest"},
                      EnumWord{TextureFilter::mip, "mip"}};
}

inline constexpr int32_t NO_TEXTURE = -1;

/// From a mesh's texture coordinates to a texture's: scaled, then turned, then moved, as by glTF's
/// KHR_texture_transform.
struct UvTransform {
    glm::vec2 offset{0.0f};
    float rotation = 0.0f; ///< radians; by it the picture turns clockwise on the surface
    glm::vec2 scale{1.0f};

    bool operator==(const UvTransform&) const = default;
    glm::vec2 operator()(glm::vec2 uv) const;
};

/// One way of using an RGBA picture; `srgb` says that its colour channels need linearising
/// (alpha never does).
struct Texture {
    std::string name;
    TexelImage image; ///< no pixels where it is another texture's; see image_of()
    bool srgb = true;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    TextureFilter filter = TextureFilter::linear;
    uint32_t uv_set = 0; ///< of the mesh's sets of texture coordinates
    UvTransform transform{};
    int32_t same_image_as = NO_TEXTURE; ///< an earlier texture with an image of its own
};

/// The picture of a texture, its own or another's.
const TexelImage& image_of(const std::vector<Texture>& textures, const Texture& texture);

enum class MaterialKind : uint32_t {
    diffuse,    ///< Lambert: base_color is the albedo
    conductor,  ///< GGX with Schlick Fresnel: base_color is the reflectance at normal incidence
    dielectric, ///< GGX glass: exact Fresnel from ior, base_color tints what goes through
    metallic_roughness, ///< the glTF 2.0 mix (appendix B of its specification)
    unlit,              ///< shows base_color, whatever the light (KHR_materials_unlit)
    phong,              ///< the chapter's, by its Phong numbers; see path_material() for others
};

constexpr auto enum_words(MaterialKind) {
    return std::array{EnumWord{MaterialKind::diffuse, "diffuse"},
                      EnumWord{MaterialKind::conductor, "conductor"},
                      EnumWord{MaterialKind::dielectric, "dielectric"},
                      EnumWord{MaterialKind::metallic_roughness, "metallic-roughness"},
                      EnumWord{MaterialKind::unlit, "unlit"},
                      EnumWord{MaterialKind::phong, "phong"}};
}

enum class AlphaMode : uint32_t { opaque, mask, blend };

constexpr auto enum_words(AlphaMode) {
    return std::array{EnumWord{AlphaMode::opaque, "opaque"}, EnumWord{AlphaMode::mask, "mask"},
                      EnumWord{AlphaMode::blend, "blend"}};
}

/// Of the normals of microfacets.
enum class Distribution : uint32_t {
    ggx,
    beckmann, ///< few are steep: highlights without tails
};

constexpr auto enum_words(Distribution) {
    return std::array{EnumWord{Distribution::ggx, "ggx"},
                      EnumWord{Distribution::beckmann, "beckmann"}};
}

/// What smooth glass does to light that no sampling finds behind it: that of points, spots and
/// directions.
enum class GlassShadows : uint32_t {
    straight, ///< it goes on unbent, as far as it is not reflected
    opaque,   ///< it is blocked
};

constexpr auto enum_words(GlassShadows) {
    return std::array{EnumWord{GlassShadows::straight, "straight"},
                      EnumWord{GlassShadows::opaque, "opaque"}};
}

/// Surface appearance. Textures multiply the factor beside them, as in glTF:
/// base_color (rgb), roughness (g) and metallic (b) of one texture, emission (rgb).
/// Alpha is roughness^2; an alpha below 1e-3 is perfectly smooth (a delta distribution).
struct Material {
    std::string name;
    MaterialKind kind = MaterialKind::diffuse;
    glm::vec3 base_color{0.8f};
    float roughness = 1.0f;
    Distribution distribution = Distribution::ggx; ///< of all but the coat of varnish
    float metallic = 0.0f;                         ///< metallic_roughness only
    glm::vec3 edge_tint{1.0f}; ///< of what metal reflects at 82 degrees, over Schlick's formula
    float ior = 1.5f; ///< interior over exterior index; of dielectric, and of the dielectric half
                      ///< of metallic_roughness
    float specular = 1.0f;                   ///< of the reflection of that half
    glm::vec3 specular_color{1.0f};          ///< the same at normal incidence
    std::optional<float> inner_reflection{}; ///< share of light from that half's body that its coat
                                             ///< sends back; without, light enters unhindered
    float transmission = 0.0f; ///< share of that half's body that is clear; metallic_roughness only
    bool thin_walled = false;  ///< what lets light through is a sheet: light is not bent
    glm::vec3 attenuation_color{1.0f}; ///< of white light after attenuation_distance inside
    std::optional<float> attenuation_distance{}; ///< in world units; nothing is absorbed without
    std::optional<Medium> medium{}; ///< inside, beside that: of what is clear and closed
    GlassShadows shadows = GlassShadows::straight;
    float diffuse_transmission = 0.0f; ///< share of that half's body that scatters to the far side
    glm::vec3 diffuse_transmission_color{1.0f};
    float clearcoat = 0.0f; ///< how much of the surface has a coat of varnish, of index 1.5
    float clearcoat_roughness = 0.0f;
    glm::vec3 sheen_color{0.0f}; ///< of fibres that stand on it
    float sheen_roughness = 0.0f;
    float iridescence = 0.0f; ///< how much of the surface has a thin film
    float iridescence_ior = 1.3f;
    float iridescence_thickness = 400.0f;         ///< nanometres, where its texture is white
    float iridescence_thickness_minimum = 100.0f; ///< where it is black
    float anisotropy = 0.0f; ///< strength: roughness along the grain goes to 1 by its square
    float anisotropy_rotation = 0.0f; ///< radians, of the grain, counter-clockwise from the tangent
    float dispersion = 0.0f;          ///< 20 over the Abbe number; 0 bends all light alike
    glm::vec3 emission{0.0f}; ///< radiance, from the front face only (both faces if two_sided)
    bool two_sided = true;    ///< whether emission leaves the back face as well
    int32_t base_color_texture = NO_TEXTURE;
    int32_t metallic_roughness_texture = NO_TEXTURE;
    int32_t emission_texture = NO_TEXTURE;
    int32_t specular_texture = NO_TEXTURE; ///< alpha
    int32_t specular_color_texture = NO_TEXTURE;
    int32_t transmission_texture = NO_TEXTURE;         ///< red
    int32_t diffuse_transmission_texture = NO_TEXTURE; ///< alpha
    int32_t diffuse_transmission_color_texture = NO_TEXTURE;
    int32_t clearcoat_texture = NO_TEXTURE;           ///< red
    int32_t clearcoat_roughness_texture = NO_TEXTURE; ///< green
    int32_t clearcoat_normal_texture = NO_TEXTURE;
    float clearcoat_normal_scale = 1.0f;
    int32_t sheen_color_texture = NO_TEXTURE;
    int32_t sheen_roughness_texture = NO_TEXTURE;       ///< alpha
    int32_t iridescence_texture = NO_TEXTURE;           ///< red
    int32_t iridescence_thickness_texture = NO_TEXTURE; ///< green
    int32_t anisotropy_texture = NO_TEXTURE;            ///< red, green: direction; blue: strength
    int32_t normal_texture = NO_TEXTURE;                ///< tangent-space normals, +Y up as in glTF
    float normal_scale = 1.0f;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha = 1.0f;        ///< times the base colour texture's alpha and that of the vertices
    float alpha_cutoff = 0.5f; ///< of AlphaMode::mask
    std::optional<uint32_t> blend_with{}; ///< another material, of which a part of the surface is;
                                          ///< emission and alpha are this one's everywhere
    float blend = 0.5f;                   ///< that part
    int32_t blend_texture = NO_TEXTURE;   ///< red
    bool double_sided = true; ///< else the camera, and what mirrors and clear glass show of the
                              ///< scene, see through the back; dielectrics always are
    std::string group{};      ///< of lights, that its emission belongs to
};

constexpr auto fields_of(TypeTag<Material>) {
    using M = Material;
    return std::tuple{
        field("name", &M::name, "unique in the file", {.required = true}),
        field("kind", &M::kind, "how the surface scatters light"),
        field("base_color", &M::base_color, "albedo, reflectance at normal incidence, or tint",
              {.range = UNIT, .form = Form::color, .alias = "color"}),
        field("roughness", &M::roughness, "0 is a mirror; the distribution's alpha is its square",
              {.range = UNIT, .absent = "`1`; `0` for conductor and dielectric"}),
        field("distribution", &M::distribution,
              "of the normals of microfacets; Beckmann's highlights have no tails"),
        field("metallic", &M::metallic, "of `metallic-roughness` only", {.range = UNIT}),
        field("edge_tint", &M::edge_tint,
              "of what metal reflects at 82 degrees, over Schlick's formula",
              {.range = UNIT, .form = Form::color}),
        field("ior", &M::ior, "interior over exterior index of refraction, of what is not metal",
              {.range = {.low = 0.01, .high = 100}}),
        field("specular", &M::specular, "of the reflection of what is not metal", {.range = UNIT}),
        field("specular_color", &M::specular_color, "the same at normal incidence",
              {.range = NOT_NEGATIVE, .form = Form::color}),
        field("inner_reflection", &M::inner_reflection,
              "of a plastic: light passes the coat of `metallic-roughness` on its way in too, and "
              "this "
              "share of what the body scatters is sent back to it, which makes colours deeper",
              {.range = {.low = 0, .high = 0.999}, .absent = "no plastic"}),
        field("transmission", &M::transmission,
              "share of `metallic-roughness` that is clear where it is not metal; `dielectric` is "
              "all",
              {.range = UNIT}),
        field("thin_walled", &M::thin_walled,
              "what is clear is a sheet, behind which light goes on as it came"),
        field("attenuation_color", &M::attenuation_color,
              "of white light after `attenuation_distance` inside of what is clear",
              {.range = UNIT, .form = Form::color}),
        field("attenuation_distance", &M::attenuation_distance, "in units of the world",
              {.range = POSITIVE, .absent = "nothing is absorbed"}),
        field("medium", &M::medium, "what scatters light inside of what is clear and closed"),
        field(
            "shadows", &M::shadows,
            "light of points, spots and directions, which never finds its way through smooth solid "
            "glass: it passes unbent, or not"),
        field("emission", &M::emission, "radiance", {.range = NOT_NEGATIVE, .form = Form::color}),
        field("two_sided", &M::two_sided, "whether the back face emits as well"),
        field("base_color_texture", &M::base_color_texture, "multiplies `base_color`",
              {.form = Form::srgb_texture}),
        field("metallic_roughness_texture", &M::metallic_roughness_texture,
              "green multiplies roughness, blue metallic", {.form = Form::linear_texture}),
        field("emission_texture", &M::emission_texture,
              "multiplies `emission`, so write `emission = 1` beside it",
              {.form = Form::srgb_texture}),
        field("diffuse_transmission", &M::diffuse_transmission,
              "share of `metallic-roughness` that scatters light to the far side where it is not "
              "metal",
              {.range = UNIT}),
        field("diffuse_transmission_color", &M::diffuse_transmission_color, "of that light",
              {.range = UNIT, .form = Form::color}),
        field("clearcoat", &M::clearcoat, "how much of `metallic-roughness` has varnish on it",
              {.range = UNIT}),
        field("clearcoat_roughness", &M::clearcoat_roughness, "of the varnish", {.range = UNIT}),
        field("sheen_color", &M::sheen_color, "of fibres that stand on `metallic-roughness`",
              {.range = UNIT, .form = Form::color}),
        field("sheen_roughness", &M::sheen_roughness, "how much they lie about", {.range = UNIT}),
        field("iridescence", &M::iridescence, "how much of `metallic-roughness` has a thin film",
              {.range = UNIT}),
        field("iridescence_ior", &M::iridescence_ior, "index of refraction of the film",
              {.range = {.low = 1, .high = 100}}),
        field("iridescence_thickness", &M::iridescence_thickness, "of the film, in nanometres",
              {.range = NOT_NEGATIVE}),
        field("iridescence_thickness_minimum", &M::iridescence_thickness_minimum,
              "where `iridescence_thickness_texture` is black", {.range = NOT_NEGATIVE}),
        field("anisotropy", &M::anisotropy,
              "how much rougher `conductor` and `metallic-roughness` are along their grain",
              {.range = UNIT}),
        field("anisotropy_rotation", &M::anisotropy_rotation,
              "of the grain, counter-clockwise from where the texture's u grows",
              {.form = Form::degrees}),
        field("dispersion", &M::dispersion,
              "20 over the Abbe number of what is clear, whose `ior` is that of the d line",
              {.range = {.low = 0, .high = 100}}),
        field("specular_texture", &M::specular_texture, "alpha multiplies `specular`",
              {.form = Form::linear_texture}),
        field("specular_color_texture", &M::specular_color_texture, "multiplies `specular_color`",
              {.form = Form::srgb_texture}),
        field("transmission_texture", &M::transmission_texture, "red multiplies `transmission`",
              {.form = Form::linear_texture}),
        field("diffuse_transmission_texture", &M::diffuse_transmission_texture,
              "alpha multiplies `diffuse_transmission`", {.form = Form::linear_texture}),
        field("diffuse_transmission_color_texture", &M::diffuse_transmission_color_texture,
              "multiplies `diffuse_transmission_color`", {.form = Form::srgb_texture}),
        field("clearcoat_texture", &M::clearcoat_texture, "red multiplies `clearcoat`",
              {.form = Form::linear_texture}),
        field("clearcoat_roughness_texture", &M::clearcoat_roughness_texture,
              "green multiplies `clearcoat_roughness`", {.form = Form::linear_texture}),
        field("clearcoat_normal_texture", &M::clearcoat_normal_texture,
              "normals of the varnish; without, it is smooth whatever lies below",
              {.form = Form::linear_texture}),
        field("clearcoat_normal_scale", &M::clearcoat_normal_scale, "of that texture's x and y"),
        field("sheen_color_texture", &M::sheen_color_texture, "multiplies `sheen_color`",
              {.form = Form::srgb_texture}),
        field("sheen_roughness_texture", &M::sheen_roughness_texture,
              "alpha multiplies `sheen_roughness`", {.form = Form::linear_texture}),
        field("iridescence_texture", &M::iridescence_texture, "red multiplies `iridescence`",
              {.form = Form::linear_texture}),
        field("iridescence_thickness_texture", &M::iridescence_thickness_texture,
              "green goes from the minimal thickness to `iridescence_thickness`",
              {.form = Form::linear_texture}),
        field("anisotropy_texture", &M::anisotropy_texture,
              "red and green turn the grain, blue multiplies `anisotropy`",
              {.form = Form::linear_texture}),
        field("normal_texture", &M::normal_texture, "normals in tangent space, +Y up",
              {.form = Form::linear_texture}),
        field("normal_scale", &M::normal_scale, "of the normal texture's x and y"),
        field("alpha_mode", &M::alpha_mode,
              "whether rays pass: never, where the alpha is below "
              "`alpha_cutoff`, or as often as the alpha leaves open"),
        field("alpha", &M::alpha, "times the alpha of the base colour texture and of the vertices",
              {.range = UNIT}),
        field("alpha_cutoff", &M::alpha_cutoff, "of `mask`", {.range = NOT_NEGATIVE}),
        LoaderKey{"blend_with", "name of a material",
                  "of which a part of the surface is; emission and alpha stay this one's",
                  "all is of this one"},
        field_without_key(&M::blend_with, "blended material", {.form = Form::material}),
        field("blend", &M::blend, "that part", {.range = UNIT}),
        field("blend_texture", &M::blend_texture, "red multiplies `blend`",
              {.form = Form::linear_texture}),
        field("double_sided", &M::double_sided,
              "else cameras and mirrors see through the back; "
              "`dielectric` always is"),
        field("group", &M::group, GROUP_MEANING, GROUP_RULES),
        LoaderKey{"wrap", "`\"repeat\"`, `\"clamp\"`, `\"mirror\"`",
                  "how this material's textures go on beyond their edges", "`\"repeat\"`"}};
}

/// The texture by whose coordinates tangents go: the normal map, else that of the varnish, else
/// that of the grain.
constexpr int32_t tangent_map_of(const Material& m) {
    if (m.normal_texture != NO_TEXTURE) return m.normal_texture;
    if (m.clearcoat_normal_texture != NO_TEXTURE) return m.clearcoat_normal_texture;
    return m.anisotropy > 0.0f ? m.anisotropy_texture : NO_TEXTURE;
}
/// Whether its triangles need tangents.
constexpr bool has_tangents(const Material& m) {
    return tangent_map_of(m) != NO_TEXTURE || m.anisotropy > 0.0f;
}

/// Calls visit(field, index) for each texture slot of a material.
template <class M, class Visit>
constexpr void for_each_texture(M& material, const Visit& visit) {
    for_each_field(material, [&](const auto& field, auto& value) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, int32_t>)
            if (is_texture(field.rules.form)) visit(field, value);
    });
}

} // namespace onde
