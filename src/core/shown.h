// Foreign text in our sentences.
#pragma once

#include <string>
#include <string_view>

namespace onde {

/// The text as a sentence may show it: control characters escaped (\x1b), and cut with "..." where
/// it is longer than `most` characters.
std::string shown(std::string_view text, size_t most = 80);

} // namespace onde
