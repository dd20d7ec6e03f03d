#include "scene/reference.h"

#include "scene/field_text.h"
#include "scene/file_words.h"
#include "scene/gltf/extensions.h"
#include "scene/scene.h"
#include "scene/toml/keys.h"

#include <fmt/ranges.h>

namespace onde {
namespace {

/// "0 to 1", "from 0", "above 0", or nothing for any number.
std::string range_text(const Range& range) {
    if (range.low == POSITIVE.low && range.high == POSITIVE.high) return "above 0";
    const bool has_end = range.high < ANY_NUMBER.high && range.high < 4294967295.0;
    if (has_end) return fmt::format("{} to {}", range.low, range.high);
    return range.low > ANY_NUMBER.low ? fmt::format("from {}", range.low) : "";
}

std::string with_range(std::string kind, const Range& range) {
    const std::string text = range_text(range);
    return text.empty() ? kind : kind + " " + text;
}

template <WordedEnum Enum>
std::string words_text() {
    std::vector<std::string> words;
    for (const EnumWord<Enum>& line : WORDS_OF<Enum>)
        words.push_back(fmt::format("`\"{}\"`", line.word));
    return fmt::format("{}", fmt::join(words, ", "));
}

template <Fielded T>
std::string inline_table();

/// What a file may write for a value.
template <class T>
std::string kind_text(const FieldRules& rules) {
    const std::string number = rules.form == Form::degrees ? "degrees" : "number";
    if constexpr (std::is_same_v<T, bool>) return "`true` or `false`";
    if constexpr (std::is_same_v<T, std::string>) return "text";
    if constexpr (std::is_same_v<T, float>) return with_range(number, rules.range);
    if constexpr (std::is_same_v<T, uint32_t>) return with_range("whole number", rules.range);
    if constexpr (std::is_same_v<T, int32_t>)
        return rules.form == Form::srgb_texture ? "texture (sRGB)" : "texture (linear)";
    if constexpr (std::is_same_v<T, glm::vec2>) return with_range("`[x, y]`", rules.range);
    if constexpr (std::is_same_v<T, glm::uvec2>)
        return with_range("`[x, y]`, whole numbers", rules.range);
    if constexpr (std::is_same_v<T, std::vector<std::string>>) return "`[text, ...]`";
    if constexpr (std::is_same_v<T, glm::vec3>) {
        if (rules.form == Form::degrees) return "`[x, y, z]` in degrees";
        const char* kind = rules.form == Form::color ? "`[x, y, z]` or one number" : "`[x, y, z]`";
        return with_range(kind, rules.range);
    }
    if constexpr (WordedEnum<T>) return words_text<T>();
    if constexpr (Fielded<T>) return inline_table<T>();
    return "";
}

/// A colour as one number where it is grey.
std::string color_text(const glm::vec3& v) {
    return v.x == v.y && v.y == v.z ? value_text(v.x) : value_text(v);
}

/// What an absent key means.
template <class T>
std::string absent_text(const FieldRules& rules, const T& initial) {
    if constexpr (std::is_same_v<T, glm::vec3>)
        if (rules.form == Form::color && rules.absent.empty())
            return "`" + color_text(initial) + "`";
    if (rules.required) return "required";
    if (!rules.absent.empty()) return std::string(rules.absent);
    if constexpr (std::is_same_v<T, float>)
        if (rules.form == Form::degrees) return fmt::format("`{:.6g}`", glm::degrees(initial));
    if constexpr (std::is_same_v<T, glm::vec3>)
        if (rules.form == Form::travel) // the member is against what files give
            return "`" + value_text(glm::vec3(0.0f) - initial) + "`";
    if constexpr (requires { value_text(initial); }) return "`" + value_text(initial) + "`";
    return "";
}

std::string joined(std::string_view kind, std::string_view meaning) {
    if (kind.empty() || meaning.empty()) return fmt::format("{}{}", kind, meaning);
    return fmt::format("{}: {}", kind, meaning);
}

/// Calls line(keys, value, absent) for each key of a thing's table.
template <Fielded T, class Line>
void for_each_key(const Line& line) {
    const T initial{};
    const auto visit = [&]<class Value>(const Field<T, Value, true>& f) {
        std::string keys = fmt::format("`{}`", f.key);
        if (!f.rules.alias.empty()) keys += fmt::format(" (or `{}`)", f.rules.alias);
        line(keys, kind_text<typename Held<Value>::type>(f.rules), f.meaning,
             absent_text(f.rules, initial.*f.member));
    };
    for_each_entry<T>([&]<class Entry>(const Entry& entry) {
        if constexpr (std::is_same_v<Entry, LoaderKey>)
            line(fmt::format("`{}`", entry.key), std::string(entry.value), entry.meaning,
                 std::string(entry.absent));
        else if constexpr (requires { visit(entry); })
            visit(entry);
    });
}

/// "{ size = `[x, y]`, ... }" for a thing that is written in one line.
template <Fielded T>
std::string inline_table() {
    std::string text;
    for_each_key<T>([&](const std::string& keys, const std::string& kind, std::string_view meaning,
                        const std::string&) {
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", keys, joined(kind, meaning));
    });
    return "`{ ... }` of " + text;
}

/// A row for each key of the things.
template <Fielded... T>
std::string key_table() {
    std::string rows = "| key | value | default |\n|---|---|---|\n";
    const auto add = [&](const std::string& keys, const std::string& kind, std::string_view meaning,
                         const std::string& absent) {
        rows += fmt::format("| {} | {} | {} |\n", keys, joined(kind, meaning), absent);
    };
    (for_each_key<T>(add), ...);
    return rows;
}

/// "`radius` (number above 0, default `1`)" for each key of a type's own tables. What is placed or
/// glows is only said to, since their keys have tables of their own.
template <Fielded T>
void add_keys(std::string& text) {
    if constexpr (std::is_same_v<T, toml_keys::Placement>) {
        text += "*placed*, ";
        return;
    }
    if constexpr (std::is_same_v<T, toml_keys::Emission>) text += "*glowing*, ";
    if constexpr (std::is_same_v<T, toml_keys::Emission> || std::is_same_v<T, AreaLight>) return;
    for_each_key<T>([&](const std::string& keys, const std::string& kind, std::string_view meaning,
                        const std::string& absent) {
        const std::string end = absent.empty() ? "" : (absent == "required" ? ", " : ", default ");
        text += fmt::format("{} ({}{}{}), ", keys, joined(kind, meaning), end, absent);
    });
}

/// A row for each type of shape or light.
template <WordedEnum Type>
std::string type_table() {
    std::string rows = "| type | keys |\n|---|---|\n";
    for (const EnumWord<Type>& line : WORDS_OF<Type>)
        visit_keys(line.value, [&]<class... Keys>(std::string_view meaning, TypeTag<Keys>...) {
            std::string text;
            (add_keys<Keys>(text), ...);
            text.resize(text.size() - 2); // the last comma
            rows += fmt::format("| `\"{}\"` | {} |\n", line.word, joined(text, meaning));
        });
    return rows;
}

/// A row for each extension of glTF that is known by name.
std::string extension_table() {
    std::string rows = "| extension | in Onde |\n|---|---|\n";
    for (const gltf::Extension& extension : gltf::known_extensions())
        rows += fmt::format("| `{}` | {} |\n", extension.name,
                            joined(gltf::meaning_of(extension.support), extension.remark));
    return rows + fmt::format("| other `KHR_materials_*` | {} |\n| any other | {} |\n",
                              gltf::meaning_of(gltf::Support::ignored),
                              gltf::meaning_of(gltf::Support::none));
}

/// A row for each run of words that become the same, and one for `others`, where there are any.
std::string word_table(std::string_view kind, const std::vector<FileWord>& words,
                       const FileWord& others) {
    std::string rows = fmt::format("| {} | in Onde |\n|---|---|\n", kind);
    for (size_t i = 0; i < words.size();) {
        const std::string_view becomes = words[i].becomes;
        std::vector<std::string> same;
        for (; i < words.size() && words[i].becomes == becomes; ++i)
            same.push_back(fmt::format("`{}`", words[i].word));
        rows += fmt::format("| {} | {} |\n", fmt::join(same, ", "), becomes);
    }
    if (!others.word.empty()) rows += fmt::format("| {} | {} |\n", others.word, others.becomes);
    return rows;
}

} // namespace

std::vector<ReferenceTable> reference_tables() {
    using namespace toml_keys;
    return {{"film", key_table<Film>()},
            {"render", key_table<RenderSettings>()},
            {"camera", key_table<Camera>()},
            {"material", key_table<Material>()},
            {"texture", key_table<TextureFile>()},
            {"medium", key_table<Medium>()},
            {"phong", key_table<Phong>()},
            {"lesson", key_table<Lesson>()},
            {"expect", key_table<Expectation>()},
            {"placement", key_table<Placement>()},
            {"shape", key_table<toml_keys::Shape>()},
            {"shape types", type_table<ShapeType>()},
            {"light types", type_table<LightType>()},
            {"glowing", key_table<Emission, AreaLight>()},
            {"environment", key_table<Environment>()},
            {"daylight", key_table<Daylight>()},
            {"include", key_table<Include, Placement>()},
            {"whitted", key_table<WhittedSettings>()},
            {"gltf extensions", extension_table()},
            {"mtl statements", word_table("statement", mtl::statement_words(),
                                          {"any other", "skipped, with a note"})},
            {"mtl map options", word_table("option of a map", mtl::map_option_words(), {})},
            {"ply elements", word_table("element", ply::element_words(), {"any other", NOTED})},
            {"ply properties", word_table("property", ply::property_words(), {"any other", NOTED})},
            {"pbrt directives", word_table("directive", pbrt::directive_words(),
                                           {"any other", "left out, with a note"})},
            {"pbrt materials", word_table("material", pbrt::material_words(),
                                          {"any other", "diffuse grey, with a note"})},
            {"mitsuba plugins", word_table("plugin", mitsuba::plugin_words(),
                                           {"any other", "left out, with a note"})}};
}

} // namespace onde
