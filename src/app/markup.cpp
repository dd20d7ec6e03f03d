#include "app/markup.h"

#include <cctype>

namespace onde::app {
namespace {

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c));
}
bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c));
}

/// The length of what is lowered or raised, from `at` on: {...} with its braces, or a word.
size_t script_length(std::string_view text, size_t at) {
    if (at < text.size() && text[at] == '{') {
        const size_t end = text.find('}', at);
        return (end == std::string_view::npos ? text.size() : end + 1) - at;
    }
    size_t end = at;
    while (end < text.size() && is_word(text[end])) ++end;
    return end - at;
}

std::string_view without_braces(std::string_view text) {
    if (text.starts_with('{')) text.remove_prefix(1);
    if (text.ends_with('}')) text.remove_suffix(1);
    return text;
}

} // namespace

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

std::string formula_markup(std::string_view formula) {
    std::string html;
    for (size_t i = 0; i < formula.size();) {
        const char c = formula[i];
        const size_t script = c == '_' || c == '^' ? script_length(formula, i + 1) : 0;
        if (script > 0) {
            const std::string tag = c == '_' ? "sub" : "sup";
            const std::string_view content = without_braces(formula.substr(i + 1, script));
            html += "<" + tag + ">" + formula_markup(content) + "</" + tag + ">";
            i += 1 + script;
        } else if (is_letter(c)) {
            const size_t length = script_length(formula, i);
            const std::string word = escaped(formula.substr(i, length));
            html += length == 1 ? "<var>" + word + "</var>" : word;
            i += length;
        } else {
            html += escaped(formula.substr(i, 1));
            ++i;
        }
    }
    return html;
}

} // namespace onde::app
