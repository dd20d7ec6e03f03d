#include "scene/pbrt/parameters.h"

#include "core/error.h"
#include "core/shown.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>

namespace onde::pbrt {
namespace {

bool is_text_type(std::string_view type) {
    return type == "string" || type == "texture";
}

/// The values of a parameter as its file's bytes cost them.
class Values {
  public:
    Values(Parameter& parameter, GradualSpending& cost) : parameter_(parameter), cost_(cost) {}

    void add(const Token& token) {
        constexpr uint64_t LISTED = 2; // a growing list is copied
        cost_.add(LISTED * (token.text.size() + sizeof(double)));
        if (token.kind == Token::Kind::text) return add_text(token.text);
        if (parameter_.type == "bool") return add_flag(token.text);
        if (is_text_type(parameter_.type)) fail(token.text, "no text in quotation marks");
        const auto number = text::number(token.text);
        if (!number) fail(token.text, "no number");
        if (!std::isfinite(*number)) fail(token.text, "no finite number");
        parameter_.numbers.push_back(*number);
    }

  private:
    void add_text(std::string_view text) {
        if (parameter_.type == "bool") return add_flag(text);
        parameter_.texts.push_back(unescaped(text));
    }

    void add_flag(std::string_view word) {
        if (word != "true" && word != "false") fail(word, "neither true nor false");
        parameter_.numbers.push_back(word == "true");
    }

    [[noreturn]] void fail(std::string_view found, const char* problem) const {
        throw InputError("{}: parameter '{}' has '{}', which is {}", parameter_.where,
                         shown(parameter_.name), shown(found), problem);
    }

    Parameter& parameter_;
    GradualSpending& cost_;
};

/// "float fov" as a type and a name.
Parameter declared(const Token& token, const std::string& where) {
    const std::string_view declaration = text::trim(token.text);
    const size_t end = declaration.find_first_of(" \t");
    if (end == std::string_view::npos)
        throw InputError("{}: a parameter is declared as '{}'; give its type and its name", where,
                         shown(declaration));
    Parameter parameter;
    parameter.type = declaration.substr(0, end);
    parameter.name = unescaped(text::trim(declaration.substr(end)));
    parameter.where = where;
    if (parameter.type == "point") parameter.type = "point3";
    if (parameter.type == "vector") parameter.type = "vector3";
    if (parameter.type == "normal3") parameter.type = "normal";
    return parameter;
}

bool is_value(const Token& token) {
    return token.kind == Token::Kind::text || token.kind == Token::Kind::word;
}

void read_values(Tokens& tokens, Parameter& parameter, GradualSpending& cost) {
    Values values(parameter, cost);
    const auto first = tokens.next();
    if (first && is_value(*first)) return values.add(*first);
    const bool opens = first && first->kind == Token::Kind::open;
    for (auto token = tokens.next(); opens && token; token = tokens.next()) {
        if (token->kind == Token::Kind::close) return;
        if (!is_value(*token)) break;
        values.add(*token);
    }
    throw InputError("{}: parameter '{}' has no value, or its list does not end; write it as "
                     "\"type name\" [ values ]",
                     parameter.where, shown(parameter.name));
}

} // namespace

Parameters::Parameters(Tokens& tokens, GradualSpending& cost) : where_(tokens.where()) {
    constexpr size_t MOST = 1024;
    for (auto token = tokens.peek(); token && token->kind == Token::Kind::text;
         token = tokens.peek()) {
        tokens.next();
        if (all_.size() == MOST)
            throw InputError("{}: a directive has more than {} parameters", tokens.where(), MOST);
        all_.push_back(declared(*token, tokens.where()));
        read_values(tokens, all_.back(), cost);
    }
}

const Parameter* Parameters::of_name(std::string_view name) const {
    const auto found = std::ranges::find(all_, name, &Parameter::name);
    return found == all_.end() ? nullptr : &*found;
}

const Parameter* Parameters::find(std::string_view name) const {
    const Parameter* found = of_name(name);
    if (found) found->is_used = true;
    return found;
}

const Parameter* Parameters::find(std::string_view name,
                                  std::initializer_list<std::string_view> types) const {
    const Parameter* found = of_name(name);
    if (!found || std::ranges::find(types, found->type) == types.end()) return nullptr;
    found->is_used = true;
    return found;
}

std::optional<double> Parameters::number(std::string_view name) const {
    const Parameter* found = find(name, {"float", "integer"});
    if (!found || found->numbers.empty()) return std::nullopt;
    return found->numbers[0];
}

std::optional<bool> Parameters::flag(std::string_view name) const {
    const Parameter* found = find(name, {"bool"});
    if (!found || found->numbers.empty()) return std::nullopt;
    return found->numbers[0] != 0.0;
}

std::optional<std::string> Parameters::text(std::string_view name) const {
    const Parameter* found = find(name, {"string"});
    if (!found || found->texts.empty()) return std::nullopt;
    return found->texts[0];
}

std::optional<std::string> Parameters::texture(std::string_view name) const {
    const Parameter* found = find(name, {"texture"});
    if (!found || found->texts.empty()) return std::nullopt;
    return found->texts[0];
}

std::optional<glm::dvec3> Parameters::point(std::string_view name) const {
    const Parameter* found = find(name, {"point3", "vector3", "normal"});
    if (!found || found->numbers.size() < 3) return std::nullopt;
    return glm::dvec3(found->numbers[0], found->numbers[1], found->numbers[2]);
}

const std::vector<double>& Parameters::numbers(std::string_view name) const {
    static const std::vector<double> NONE;
    const Parameter* found = of_name(name);
    if (!found || !found->texts.empty()) return NONE;
    found->is_used = true;
    return found->numbers;
}

std::vector<std::string> Parameters::unused() const {
    std::vector<std::string> names;
    for (const Parameter& parameter : all_)
        if (!parameter.is_used) names.push_back(parameter.type + " " + parameter.name);
    return names;
}

} // namespace onde::pbrt
