// JSON for scripts: one way to turn values into text, for every subcommand.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace onde::app {

/// An object keeps its keys in the order in which they were added. NaN and infinity become null.
using Json = nlohmann::ordered_json;

/// The value as text with a line feed at its end, indented by two, or in one line. Bytes that are
/// not UTF-8 (names from drivers and files) are replaced, so that the text always parses.
std::string json_text(const Json& value);
std::string json_line(const Json& value);

} // namespace onde::app
