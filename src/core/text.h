// Text that others wrote (names in files, paths, messages of libraries) made fit for a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace onde {

/// Bytes that a message shows of a path or another sentence, and of a name in a file. What is
/// longer is so only to disturb.
inline constexpr size_t LONGEST_IN_MESSAGE = 320, LONGEST_NAME = 80;

/// The text in one line that no terminal obeys: control characters, marks that turn the direction
/// of writing, and bytes that are not UTF-8 as \n, \xNN or \u{NNNN}. Of a text of more than
/// `longest` bytes the middle is left out. What is printable stays, backslashes too.
std::string printable(std::string_view text, size_t longest = LONGEST_IN_MESSAGE);

/// The same line by line, nothing left out: for build logs and other texts of several lines.
std::string printable_lines(std::string_view text);

} // namespace onde
