#include "scene/pbrt/material.h"

#include "scene/coat.h"
#include "scene/file_words.h"

#include <algorithm>
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

    /// Our roughness, whose square is GGX's alpha. pbrt's own is alpha, or its square.
    void set_roughness(const std::string& prefix = "") {
        const double both = textures_.number(*p_, prefix + "roughness").value_or(0.0);
        const double u = textures_.number(*p_, prefix + "uroughness").value_or(both);
        const double v = textures_.number(*p_, prefix + "vroughness").value_or(both);
        if (u != v) notes_.add("Roughness is the same along all directions of a surface", m_.name);
        const double stated = std::sqrt(std::clamp(u, 0.0, 1.0) * std::clamp(v, 0.0, 1.0));
        const bool remaps = p_->flag("remaproughness").value_or(true);
        const double alpha = remaps ? std::sqrt(stated) : stated;
        m_.roughness = float(std::sqrt(alpha));
    }

    void diffuse() {
        m_.kind = MaterialKind::diffuse;
        set_color("reflectance", glm::vec3(0.5f));
    }

    void coated_diffuse() {
        m_.kind = MaterialKind::metallic_roughness;
        set_color("reflectance", glm::vec3(0.5f));
        set_roughness();
        const auto eta = spectrum_of(*p_, "eta", sources_);
        m_.base_color = coated_albedo(m_.base_color, eta ? yellow_index(*eta) : 1.5);
    }

    void conductor_color_of(const std::string& prefix) {
        m_.kind = MaterialKind::conductor;
        m_.base_color = glm::vec3(COPPER_RED, COPPER_GREEN, COPPER_BLUE);
        if (p_->has("reflectance")) return set_color("reflectance", m_.base_color);
        const auto eta = spectrum_of(*p_, prefix + "eta", sources_);
        const auto k = spectrum_of(*p_, prefix + "k", sources_);
        if (eta && k) m_.base_color = conductor_color(*eta, *k);
    }

    void conductor() {
        conductor_color_of("");
        set_roughness();
    }

    void coated_conductor() {
        conductor_color_of("conductor.");
        set_roughness("conductor.");
        for (const char* name : {"eta", "roughness", "uroughness", "vroughness"})
            p_->find(std::string("interface.") + name);
    }

    void set_index() {
        const auto eta = spectrum_of(*p_, "eta", sources_);
        m_.ior = float(std::clamp(eta ? yellow_index(*eta) : 1.5, 0.01, 100.0));
    }

    void dielectric() {
        m_.kind = MaterialKind::dielectric;
        m_.base_color = glm::vec3(1.0f);
        set_index();
        set_roughness();
    }

    /// What two faces reflect of light that meets them head on stays; the rest goes straight on.
    void thin_dielectric() {
        set_index();
        const double face = spectrum::normal_reflectance(m_.ior, 0.0);
        m_.kind = MaterialKind::conductor;
        m_.base_color = glm::vec3(1.0f);
        m_.roughness = 0.0f;
        m_.alpha_mode = AlphaMode::blend;
        m_.alpha = float(2.0 * face / (1.0 + face));
    }

    void diffuse_transmission() {
        m_.kind = MaterialKind::diffuse;
        set_color("reflectance", glm::vec3(0.25f));
        p_->find("transmittance");
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

    /// The part that counts more, as a material itself.
    Material mix(const MaterialSource& source, int depth) {
        constexpr int DEEPEST = 16;
        const Parameter* names = p_->find("materials", {"string"});
        const double amount = textures_.number(*p_, "amount").value_or(0.5);
        const int64_t part =
            names && names->texts.size() == 2 ? find_(names->texts[amount < 0.5 ? 0 : 1]) : -1;
        if (part < 0 || depth == DEEPEST) {
            notes_.wrong("Mixtures of materials that are not defined are diffuse grey", m_.name);
            m_.base_color = glm::vec3(0.5f);
            return m_;
        }
        notes_.add("Of mixed materials the one that counts more is shown", m_.name);
        Material material = convert(all_[size_t(part)], depth + 1);
        material.name = source.name;
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
};

std::span<const Converter::Kind> Converter::kinds() {
    static const Kind KINDS[] = {
        {"diffuse", &Converter::diffuse, "`diffuse`", ""},
        {"coateddiffuse", &Converter::coated_diffuse,
         "`metallic-roughness` without metal: a coat of index 1.5, with a note",
         "Coated diffuse materials have the base and the coat of glTF's, of index 1.5"},
        {"conductor", &Converter::conductor,
         "`conductor` of the reflectance at normal incidence that its spectra or its metal's name "
         "say",
         ""},
        {"coatedconductor", &Converter::coated_conductor,
         "`conductor` without the coat, with a note", "Conductors go without their coat"},
        {"dielectric", &Converter::dielectric, "`dielectric`", ""},
        {"thindielectric", &Converter::thin_dielectric,
         "a mirror that lets rays pass as often as the pane does at normal incidence, with a note",
         "Thin dielectrics reflect the same share at every angle"},
        {"diffusetransmission", &Converter::diffuse_transmission,
         "`diffuse`, of its reflectance alone, with a note",
         "Diffuse materials that let light through only reflect"},
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

Material convert_material(const MaterialSource& source, const MaterialSources& all,
                          const FindMaterial& find, Textures& textures, const Sources& sources) {
    return Converter(all, find, textures, sources).convert(source);
}

std::vector<FileWord> material_words() {
    std::vector<FileWord> words;
    for (const Converter::Kind& kind : Converter::kinds())
        words.push_back({kind.kind, kind.becomes});
    words.push_back({"mix", "of its two materials the one that counts more, with a note"});
    return words;
}

} // namespace onde::pbrt
