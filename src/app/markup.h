// Text for pages and drawings.
#pragma once

#include <string>
#include <string_view>

namespace onde::app {

/// The text with what HTML, XML and SVG would take for markup replaced.
std::string escaped(std::string_view text);

/// A formula as HTML: x_1, x_{12} and x^2 get lowered and raised, single letters are variables.
std::string formula_markup(std::string_view formula);

} // namespace onde::app
