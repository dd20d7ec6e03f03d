// Which of some names was meant by one that is none of them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace onde {

/// The name with the fewest letters to insert, remove or replace. There is at least one name.
std::string nearest(std::string_view text, std::span<const std::string_view> names);

/// "; did you mean NAME?" of the nearest one if it is near enough to be meant, else nothing.
std::string did_you_mean(std::string_view text, std::span<const std::string_view> names);

} // namespace onde
