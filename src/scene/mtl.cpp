#include "scene/mtl.h"

#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace onde::mtl {

namespace {

using text::Words;

constexpr size_t MAX_MATERIALS = 65536; ///< keeps a hostile file from filling the memory

/// What becomes of a statement, by its keyword in lower case.
struct Statement {
    std::string_view keyword;
    void (*read)(Material&, Words&, Notes&) = nullptr;
    const char* note = nullptr; ///< said where it is written and has another effect than none
};

/// The finite number that comes next, or nothing, with a note.
std::optional<float> finite(const Material& material, Words& words, Notes& notes) {
    const float number = float(words.next_number());
    if (std::isfinite(number)) return number;
    notes.wrong("Numbers of materials that are missing or not finite are ignored", material.name);
    return std::nullopt;
}

/// Three numbers, or one that stands for all.
std::optional<glm::vec3> color(const Material& material, Words& words, Notes& notes) {
    Words ahead = words;
    const std::string_view kind = ahead.next();
    if (kind == "spectral" || kind == "xyz") {
        notes.add("Colours given as spectra or in XYZ are ignored", material.name);
        return std::nullopt;
    }
    const auto red = finite(material, words, notes);
    if (!red) return std::nullopt;
    if (const std::string_view next = words.rest(); next.empty() || next.starts_with('#'))
        return glm::vec3(*red);
    const auto green = finite(material, words, notes), blue = finite(material, words, notes);
    if (!green || !blue) return std::nullopt;
    return glm::vec3(*red, *green, *blue);
}

template <auto member>
void read_color(Material& material, Words& words, Notes& notes) {
    if (const auto value = color(material, words, notes)) material.*member = *value;
}

template <auto member>
void read_number(Material& material, Words& words, Notes& notes) {
    if (Words ahead = words; ahead.next() == "-halo") words = ahead; // d -halo 0.5
    if (const auto value = finite(material, words, notes)) material.*member = *value;
}

template <auto member>
void read_map_into(Material& material, Words& words, Notes& notes) {
    material.*member = read_map(words.rest(), material.name, notes);
}

constexpr const char* SEPARATE_MAPS = "Separate roughness and metallic maps are ignored";
constexpr const char* BUMP_MAPS = "Bump maps are ignored";
constexpr const char* DISPLACEMENT = "Displacement maps are ignored";
constexpr const char* REFLECTION_MAPS = "Reflection maps are ignored";
constexpr const char* LAYERS = "Sheen, clear coat and anisotropy are ignored";

constexpr Statement STATEMENTS[] = {
    {"kd", read_color<&Material::diffuse>},
    {"ks", read_color<&Material::specular>},
    {"ke", read_color<&Material::emission>},
    {"tf", read_color<&Material::transmission>},
    {"kt", read_color<&Material::transmission>},
    {"ns", read_number<&Material::exponent>},
    {"ni", read_number<&Material::ior>},
    {"d", read_number<&Material::opacity>},
    {"tr", read_number<&Material::transparency>},
    {"illum", read_number<&Material::illumination>},
    {"pr", read_number<&Material::roughness>},
    {"pm", read_number<&Material::metallic>},
    {"map_kd", read_map_into<&Material::diffuse_map>},
    {"map_ke", read_map_into<&Material::emission_map>},
    {"norm", read_map_into<&Material::normal_map>},
    {"map_norm", read_map_into<&Material::normal_map>},
    {"map_kn", read_map_into<&Material::normal_map>},
    {"ka"}, // light from everywhere, which is computed instead
    {"sharpness"},
    {"map_aat"},
    {"map_ka", nullptr, "Ambient maps are ignored"},
    {"map_ks", nullptr, "Specular maps are ignored"},
    {"map_ns", nullptr, "Maps of exponents are ignored"},
    {"map_pr", nullptr, SEPARATE_MAPS},
    {"map_pm", nullptr, SEPARATE_MAPS},
    {"map_bump", nullptr, BUMP_MAPS},
    {"bump", nullptr, BUMP_MAPS},
    {"map_d", read_map_into<&Material::opacity_map>},
    {"map_opacity", read_map_into<&Material::opacity_map>},
    {"map_tr", nullptr, "Maps of transparency are ignored"},
    {"disp", nullptr, DISPLACEMENT},
    {"map_disp", nullptr, DISPLACEMENT},
    {"decal", nullptr, "Decals are ignored"},
    {"refl", nullptr, REFLECTION_MAPS},
    {"map_refl", nullptr, REFLECTION_MAPS},
    {"map_ps", nullptr, LAYERS},
    {"map_pc", nullptr, LAYERS},
    {"ps", nullptr, LAYERS},
    {"pc", nullptr, LAYERS},
    {"pcr", nullptr, LAYERS},
    {"aniso", nullptr, LAYERS},
    {"anisor", nullptr, LAYERS},
};

std::string lower(std::string_view word) {
    std::string result(word);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return result;
}

class Reader {
  public:
    Reader(std::string_view text, Notes& notes) : lines_(text), notes_(notes) {}

    std::vector<Material> read() {
        while (const auto line = lines_.next()) {
            Words words(*line);
            const std::string keyword = lower(words.next());
            if (keyword == "newmtl" && materials_.size() == MAX_MATERIALS) break;
            if (keyword == "newmtl")
                materials_.emplace_back().name = words.rest();
            else if (!keyword.empty())
                read_statement(keyword, words);
        }
        if (lines_.next()) notes_.add("Materials beyond the first 65536 of a library are ignored");
        return std::move(materials_);
    }

  private:
    void read_statement(const std::string& keyword, Words& words) {
        const auto found = std::ranges::find(STATEMENTS, keyword, &Statement::keyword);
        if (found == std::end(STATEMENTS))
            return notes_.add("Statements that MTL files do not have are skipped",
                              "line " + std::to_string(lines_.number()));
        if (materials_.empty())
            return notes_.add("Statements before the first material are skipped",
                              "line " + std::to_string(lines_.number()));
        if (found->read) return found->read(materials_.back(), words, notes_);
        if (!found->note || text::number(words.rest()) == 0.0) return;
        notes_.add(found->note, materials_.back().name);
    }

    text::Lines lines_;
    Notes& notes_;
    std::vector<Material> materials_;
};

} // namespace

std::vector<Material> read(std::string_view text, Notes& notes) {
    return Reader(text, notes).read();
}

} // namespace onde::mtl
