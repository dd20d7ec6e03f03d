// The parameters of a pbrt directive: a type and a name in quotes, and a value or a list of them.
#pragma once

#include "scene/load_context.h"
#include "scene/pbrt/tokens.h"

#include <glm/glm.hpp>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace onde::pbrt {

struct Parameter {
    std::string type, name, where; ///< "FILE:LINE"
    std::vector<double> numbers;   ///< of numeric types; 0 and 1 of bool; finite
    std::vector<std::string> texts;
    mutable bool is_used = false;
};

class Parameters {
  public:
    Parameters() = default;

    /// Reads what follows a directive. Throws InputError "FILE:LINE: ..." for what is no list of
    /// parameters. `cost` is what its values take.
    Parameters(Tokens& tokens, GradualSpending& cost);

    /// "FILE:LINE" of the directive.
    const std::string& where() const { return where_; }

    /// The parameter of that name and one of these types; nothing where it has another type.
    const Parameter* find(std::string_view name,
                          std::initializer_list<std::string_view> types) const;
    /// The parameter of that name, whatever its type.
    const Parameter* find(std::string_view name) const;
    bool has(std::string_view name) const { return find(name) != nullptr; }

    std::optional<double> number(std::string_view name) const; ///< float or integer
    std::optional<bool> flag(std::string_view name) const;
    std::optional<std::string> text(std::string_view name) const;
    std::optional<glm::dvec3> point(std::string_view name) const; ///< point3 or vector3
    /// The name of the texture that stands for a value.
    std::optional<std::string> texture(std::string_view name) const;
    /// All numbers of the parameter; none where it is absent.
    const std::vector<double>& numbers(std::string_view name) const;

    /// Parameters that nobody has asked for, or not with their type: "string radius".
    std::vector<std::string> unused() const;

  private:
    const Parameter* of_name(std::string_view name) const;

    std::string where_;
    std::vector<Parameter> all_;
};

} // namespace onde::pbrt
