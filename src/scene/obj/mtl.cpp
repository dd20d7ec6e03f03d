#include "scene/obj/mtl.h"

#include "scene/file_words.h"
#include "scene/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace onde::mtl {

namespace {

using text::Words;

constexpr size_t MAX_MATERIALS = 65536; ///< keeps a hostile file from filling the memory

/// What becomes of a statement.
struct Statement {
    std::string_view keyword; ///< in any case
    std::string_view becomes; ///< for the documentation
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
    {"Kd", "diffuse colour; one number is grey, none at all 0.8", read_color<&Material::diffuse>},
    {"Ks", "specular colour", read_color<&Material::specular>},
    {"Ke", "emission (radiance)", read_color<&Material::emission>},
    {"Tf", "tint of a dielectric", read_color<&Material::transmission>},
    {"Kt", "tint of a dielectric", read_color<&Material::transmission>},
    {"Ns", "exponent of the highlight", read_number<&Material::exponent>},
    {"Ni", "index of refraction", read_number<&Material::ior>},
    {"d", "opacity", read_number<&Material::opacity>},
    {"Tr", "transparency", read_number<&Material::transparency>},
    {"illum", "the kind of material", read_number<&Material::illumination>},
    {"Pr", "roughness", read_number<&Material::roughness>},
    {"Pm", "metallic", read_number<&Material::metallic>},
    {"map_Kd", "texture of the diffuse colour", read_map_into<&Material::diffuse_map>},
    {"map_Ke", "texture of the emission", read_map_into<&Material::emission_map>},
    {"norm", "normal map", read_map_into<&Material::normal_map>},
    {"map_norm", "normal map", read_map_into<&Material::normal_map>},
    {"map_Kn", "normal map", read_map_into<&Material::normal_map>},
    {"map_d", "opacity by a map: its alpha where it has one, else its red",
     read_map_into<&Material::opacity_map>},
    {"map_opacity", "opacity by a map: its alpha where it has one, else its red",
     read_map_into<&Material::opacity_map>},
    {"Ka", "ignored: light from everywhere is computed instead"},
    {"sharpness", "ignored: they change no picture of ours"},
    {"map_aat", "ignored: they change no picture of ours"},
    {"map_Ka", NOTED, nullptr, "Ambient maps are ignored"},
    {"map_Ks", NOTED, nullptr, "Specular maps are ignored"},
    {"map_Ns", NOTED, nullptr, "Maps of exponents are ignored"},
    {"map_Pr", NOTED, nullptr, SEPARATE_MAPS},
    {"map_Pm", NOTED, nullptr, SEPARATE_MAPS},
    {"map_bump", NOTED, nullptr, BUMP_MAPS},
    {"bump", NOTED, nullptr, BUMP_MAPS},
    {"map_Tr", NOTED, nullptr, "Maps of transparency are ignored"},
    {"disp", NOTED, nullptr, DISPLACEMENT},
    {"map_disp", NOTED, nullptr, DISPLACEMENT},
    {"decal", NOTED, nullptr, "Decals are ignored"},
    {"refl", NOTED, nullptr, REFLECTION_MAPS},
    {"map_refl", NOTED, nullptr, REFLECTION_MAPS},
    {"map_Ps", NOTED, nullptr, LAYERS},
    {"map_Pc", NOTED, nullptr, LAYERS},
    {"Ps", NOTED, nullptr, LAYERS},
    {"Pc", NOTED, nullptr, LAYERS},
    {"Pcr", NOTED, nullptr, LAYERS},
    {"aniso", NOTED, nullptr, LAYERS},
    {"anisor", NOTED, nullptr, LAYERS},
};

bool same_but_for_case(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

class Reader {
  public:
    Reader(std::string_view text, Notes& notes) : lines_(text), notes_(notes) {}

    std::vector<Material> read() {
        while (const auto line = lines_.next()) {
            Words words(*line);
            const std::string_view keyword = words.next();
            const bool begins = same_but_for_case(keyword, "newmtl");
            if (begins && materials_.size() == MAX_MATERIALS) break;
            if (begins)
                materials_.emplace_back().name = words.rest();
            else if (!keyword.empty())
                read_statement(keyword, words);
        }
        if (lines_.next()) notes_.add("Materials beyond the first 65536 of a library are ignored");
        return std::move(materials_);
    }

  private:
    void read_statement(std::string_view keyword, Words& words) {
        const auto found = std::ranges::find_if(STATEMENTS, [&](const Statement& statement) {
            return same_but_for_case(statement.keyword, keyword);
        });
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

std::vector<FileWord> statement_words() {
    std::vector<FileWord> words;
    for (const Statement& statement : STATEMENTS)
        words.push_back({statement.keyword, statement.becomes});
    return words;
}

std::vector<Material> read(std::string_view text, Notes& notes) {
    return Reader(text, notes).read();
}

} // namespace onde::mtl
