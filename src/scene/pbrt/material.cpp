#include "scene/pbrt/material.h"

#include "scene/file_words.h"
#include "scene/measured.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace onde::pbrt {
namespace {

constexpr double COPPER_RED = 0.955, COPPER_GREEN = 0.638, COPPER_BLUE = 0.538;

class Converter {
  public:
    struct Kind {
        std::string_view kind;
        void (Converter::*read)();
        std::string_view becomes; ///< for the documentation
        std::string_view note;    ///< nothing where it is exact
    };

    static std::span<const Kind> kinds();

    Converter(const MaterialSources& all, const FindMaterial& find, Textures& textures,
              const Sources& sources)
        : all_(all), find_(find), textures_(textures), notes_(sources.notes), sources_(sources) {}

    /// The second part of a mixture that was converted.
    std::optional<Material> other() const { return other_; }

    Material convert(const MaterialSource& source, int depth = 0) {
        p_ = &source.parameters;
        m_ = Material{};
        m_.name = source.name.empty() ? source.kind : source.name;
        if (source.kind == "mix") return mix(source, depth);
        for (const auto& [kind, read, becomes, note] : kinds())
            if (kind == source.kind) {
                (this->*read)();
                if (!note.empty()) notes_.add(std::string(note), m_.name);
                return finished();
            }
        if (source.kind.empty())
            notes_.wrong("Materials that are not defined are diffuse grey", m_.name);
        else
            notes_.add("Materials of kinds that Onde does not know are diffuse grey", source.kind);
        m_.base_color = glm::vec3(0.5f);
        return finished();
    }

  private:
    void set_color(std::string_view name, const glm::vec3& absent) {
        const Textured color = textures_.color(*p_, name).value_or(Textured{absent});
        m_.base_color = glm::clamp(color.factor, 0.0f, 1.0f);
        m_.base_color_texture = color.texture;
    }

    /// GGX's alphas along u and v. pbrt's own roughness is alpha, or its square.
    glm::dvec2 alphas(const std::string& prefix) {
        const double both = textures_.number(*p_, prefix + "roughness").value_or(0.0);
        const double u = textures_.number(*p_, prefix + "uroughness").value_or(both);
        const double v = textures_.number(*p_, prefix + "vroughness").value_or(both);
        const glm::dvec2 stated = glm::clamp(glm::dvec2(u, v), 0.0, 1.0);
        return p_->flag("remaproughness").value_or(true) ? glm::sqrt(stated) : stated;
    }

    /// Of what reflects.
    void set_roughness(const std::string& prefix = "") {
        const glm::dvec2 alpha = alphas(prefix);
        set_alphas(m_, alpha.x, alpha.y);
    }

    /// Of what has no grain in Onde, such as glass.
    float even_roughness(const std::string& prefix = "") {
        const glm::dvec2 alpha = alphas(prefix);
        if (alpha.x != alpha.y)
            notes_.add("Glass and coats are as rough along all directions of a surface", m_.name);
        return float(std::pow(alpha.x * alpha.y, 0.25));
    }

    void diffuse() {
        m_.kind = MaterialKind::diffuse;
        set_color("reflectance", glm::vec3(0.5f));
    }

    void coated_diffuse() {
        set_plastic(m_, stated_index());
        set_color("reflectance", glm::vec3(0.5f));
        set_roughness();
    }

    void conductor_color_of(const std::string& prefix) {
        m_.kind = MaterialKind::conductor;
        m_.base_color = glm::vec3(COPPER_RED, COPPER_GREEN, COPPER_BLUE);
        if (p_->has("reflectance")) return set_color("reflectance", m_.base_color);
        const auto eta = spectrum_of(*p_, prefix + "eta", sources_);
        const auto k = spectrum_of(*p_, prefix + "k", sources_);
        if (!eta || !k) return;
        const ConductorColors colors = conductor_colors(*eta, *k);
        m_.base_color = colors.normal;
        m_.edge_tint = colors.edge_tint;
    }

    void conductor() {
        conductor_color_of("");
        set_roughness();
    }

    void coated_conductor() {
        conductor_color_of("conductor.");
        set_roughness("conductor.");
        m_.kind = MaterialKind::metallic_roughness;
        m_.metallic = 1.0f;
        m_.clearcoat = 1.0f;
        m_.clearcoat_roughness = even_roughness("interface.");
        p_->find("interface.eta");
    }

    double stated_index() {
        const auto eta = spectrum_of(*p_, "eta", sources_);
        return eta ? yellow_index(*eta) : 1.5;
    }

    void dielectric() {
        m_.kind = MaterialKind::dielectric;
        m_.base_color = glm::vec3(1.0f);
        m_.ior = float(std::clamp(stated_index(), 0.01, 100.0));
        m_.roughness = even_roughness();
    }

    void thin_dielectric() {
        set_pane(m_, stated_index());
        m_.base_color = glm::vec3(1.0f);
    }

    /// All of the sum is scattered, of which a part goes through.
    void diffuse_transmission() {
        const auto of = [&](std::string_view name) {
            const Textured color = textures_.color(*p_, name).value_or(Textured{glm::vec3(0.25f)});
            if (color.texture != NO_TEXTURE)
                notes_.add("Textures of what lets diffuse light through are left out", m_.name);
            const auto scale = float(textures_.number(*p_, "scale").value_or(1.0));
            return glm::clamp(color.factor * scale, 0.0f, 1.0f);
        };
        const glm::vec3 front = of("reflectance"), behind = of("transmittance");
        const glm::vec3 both = front + behind;
        const float most = std::max({both.x, both.y, both.z, 1e-6f});
        const float through = std::max({behind.x, behind.y, behind.z}) / most;
        m_.kind = MaterialKind::metallic_roughness;
        m_.specular = 0.0f;
        m_.diffuse_transmission = through;
        const auto share = [](const glm::vec3& color, float part) {
            return part > 0.0f ? glm::min(color / part, 1.0f) : glm::vec3(0.0f);
        };
        m_.base_color = share(front, 1.0f - through);
        m_.diffuse_transmission_color = share(behind, through);
    }

    void subsurface() {
        m_.kind = MaterialKind::diffuse;
        set_color("reflectance", glm::vec3(0.5f));
    }

    void hair() {
        m_.kind = MaterialKind::diffuse;
        set_color("reflectance", glm::vec3(0.3f, 0.2f, 0.1f));
    }

    /// Nothing is there.
    void interface() {
        m_.base_color = glm::vec3(0.0f);
        m_.alpha_mode = AlphaMode::mask;
        m_.alpha = 0.0f;
    }

    /// Its first part, blended with its second.
    Material mix(const MaterialSource& source, int depth) {
        constexpr int DEEPEST = 16;
        const Parameter* names = p_->find("materials", {"string"});
        const Textured amount = textures_.color(*p_, "amount").value_or(Textured{glm::vec3(0.5f)});
        std::array<int64_t, 2> parts{-1, -1};
        for (size_t i = 0; names && names->texts.size() == 2 && i < 2; ++i)
            parts[i] = find_(names->texts[i]);
        if (parts[0] < 0 || parts[1] < 0 || depth == DEEPEST) {
            notes_.wrong("Mixtures of materials that are not defined are diffuse grey", m_.name);
            m_.base_color = glm::vec3(0.5f);
            return m_;
        }
        if (depth > 0) notes_.add("Of mixtures within mixtures the first part is shown", m_.name);
        const Material second = convert(all_[size_t(parts[1])], depth + 1);
        Material material = convert(all_[size_t(parts[0])], depth + 1);
        material.name = source.name;
        if (depth > 0) return material;
        other_ = second;
        material.blend = std::clamp(amount.factor.x, 0.0f, 1.0f);
        material.blend_texture = amount.texture;
        return material;
    }

    Material finished() {
        if (const auto map = p_->text("normalmap"))
            m_.normal_texture = textures_.picture(*map, {.srgb = false});
        if (p_->has("displacement")) notes_.add("Displacements are left out", m_.name);
        for (const std::string& unused : p_->unused())
            notes_.add("Other parameters of materials are ignored", unused);
        return m_;
    }

    const MaterialSources& all_;
    const FindMaterial& find_;
    Textures& textures_;
    Notes& notes_;
    const Sources& sources_;
    const Parameters* p_ = nullptr;
    Material m_;
    std::optional<Material> other_;
};

std::span<const Converter::Kind> Converter::kinds() {
    static const Kind KINDS[] = {
        {"diffuse", &Converter::diffuse, "`diffuse`", ""},
        {"coateddiffuse", &Converter::coated_diffuse,
         "`metallic-roughness` without metal, whose coat has the index and sends light back to its "
         "body",
         ""},
        {"conductor", &Converter::conductor,
         "`conductor` of the reflectances, head on and at the edge, that its spectra or its "
         "metal's "
         "name say",
         ""},
        {"coatedconductor", &Converter::coated_conductor,
         "`metallic-roughness`, all metal, with `clearcoat`, of index 1.5", ""},
        {"dielectric", &Converter::dielectric, "`dielectric`", ""},
        {"thindielectric", &Converter::thin_dielectric, "`dielectric` with `thin_walled`", ""},
        {"diffusetransmission", &Converter::diffuse_transmission,
         "`metallic-roughness` with `diffuse_transmission`, without its coat", ""},
        {"subsurface", &Converter::subsurface, "`diffuse`, with a note",
         "Subsurface scattering is diffuse reflection"},
        {"hair", &Converter::hair, "`diffuse`, with a note",
         "Hair and measured materials are diffuse"},
        {"measured", &Converter::hair, "`diffuse`, with a note",
         "Hair and measured materials are diffuse"},
        {"interface", &Converter::interface, "nothing: rays pass", ""},
        {"none", &Converter::interface, "nothing: rays pass", ""}};
    return KINDS;
}

} // namespace

ConvertedMaterial convert_material(const MaterialSource& source, const MaterialSources& all,
                                   const FindMaterial& find, Textures& textures,
                                   const Sources& sources) {
    Converter converter(all, find, textures, sources);
    const Material material = converter.convert(source);
    return {material, converter.other()};
}

std::vector<FileWord> material_words() {
    std::vector<FileWord> words;
    for (const Converter::Kind& kind : Converter::kinds())
        words.push_back({kind.kind, kind.becomes});
    words.push_back({"mix", "its first material, with `blend_with` the second"});
    return words;
}

} // namespace onde::pbrt
