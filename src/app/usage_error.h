// What CLI11 has to say about a command line, as one sentence.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace onde::app {

/// The complaint, naming the option or word at fault, and the --help that lists what there is.
/// `app` is the one whose parse() threw.
std::string usage_sentence(const CLI::App& app, const CLI::ParseError& error);

} // namespace onde::app
