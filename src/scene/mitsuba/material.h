// Mitsuba's BSDFs as the nearest of our materials: the only place that knows how they are mapped.
#pragma once

#include "scene/file_words.h"
#include "scene/mesh_attribute.h"
#include "scene/mitsuba/values.h"
#include "scene/scene.h"

namespace onde::mitsuba {

class Materials {
  public:
    /// Textures are added to the scene when they are first asked for. Both must outlive it.
    Materials(const Document& document, Scene& scene) : document_(document), scene_(scene) {}

    /// The <bsdf> as the nearest material that Onde has; what is not exact is noted. Without one,
    /// Mitsuba's own default.
    struct Converted {
        Material material;
        std::optional<MeshAttribute> color; ///< of meshes, which multiplies its base colour
    };
    Converted convert(const Element* bsdf);

    /// The colour that an element has by that name, be it a texture.
    struct Textured {
        glm::vec3 factor{1.0f};
        int32_t texture = NO_TEXTURE;
    };
    Textured color(const Element& of, std::string_view name, const glm::dvec3& absent);

    /// The kinds of BSDFs and textures, and what becomes of each.
    static std::vector<FileWord> words();

  private:
    struct Kind;
    static std::span<const Kind> kinds();

    void convert_into(const Element& bsdf, Material& m, int depth);
    void inner(const Element& bsdf, Material& m, int depth);
    std::optional<MeshAttribute> attribute(const Element& bsdf, std::string_view name) const;
    void set_color(const Element& bsdf, std::string_view name, Material& m, double absent = 0.5);
    double number(const Element& of, std::string_view name, double absent);
    glm::dvec2 alphas(const Element& bsdf, Material& m);
    void blend_by(const MeshAttribute& weight, const Element& first, const Element& second,
                  Material& m, int depth);
    void set_even_roughness(const Element& bsdf, Material& m);
    double index_of(const Element& bsdf);
    void set_conductor(const Element& bsdf, Material& m);
    std::optional<Textured> texture(const Element& texture, bool is_color);
    std::optional<Textured> bitmap(const Element& texture, bool is_color);
    Textured checkerboard(const Element& texture);

    // One for each kind.
    void diffuse(const Element& bsdf, Material& m, int depth);
    void conductor(const Element& bsdf, Material& m, int depth);
    void rough_conductor(const Element& bsdf, Material& m, int depth);
    void dielectric(const Element& bsdf, Material& m, int depth);
    void rough_dielectric(const Element& bsdf, Material& m, int depth);
    void thin_dielectric(const Element& bsdf, Material& m, int depth);
    void plastic(const Element& bsdf, Material& m, int depth);
    void rough_plastic(const Element& bsdf, Material& m, int depth);
    void principled(const Element& bsdf, Material& m, int depth);
    void null(const Element& bsdf, Material& m, int depth);
    void two_sided(const Element& bsdf, Material& m, int depth);
    void mask(const Element& bsdf, Material& m, int depth);
    void normal_map(const Element& bsdf, Material& m, int depth);
    void bump_map(const Element& bsdf, Material& m, int depth);
    void blend(const Element& bsdf, Material& m, int depth);

    const Document& document_;
    Scene& scene_;
    int blends_ = 0;                     ///< around what is being converted
    std::optional<MeshAttribute> color_; ///< of that
};

} // namespace onde::mitsuba
