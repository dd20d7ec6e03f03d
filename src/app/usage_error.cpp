#include "app/usage_error.h"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

namespace onde::app {
namespace {

/// "onde render", down to the last subcommand that was recognised.
std::string command_name(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return app.get_name() + (chosen.empty() ? "" : " " + command_name(*chosen.back()));
}

std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
    // CLI11 finds a missing subcommand before it finds the word that was meant to be one.
    const bool incomplete = dynamic_cast<const CLI::RequiredError*>(&error) ||
                            dynamic_cast<const CLI::ExtrasError*>(&error);
    const std::vector<std::string> unknown = app.remaining(true);
    if (incomplete && !unknown.empty())
        return fmt::format("{}: no such option or command", unknown.front());
    constexpr std::string_view CONVERSION = "Could not convert: "; // "--spp = x" follows
    const std::string text = error.what();
    if (text.starts_with(CONVERSION))
        return text.substr(CONVERSION.size()) + ": not a value that this option takes";
    return text;
}

} // namespace

std::string usage_sentence(const CLI::App& app, const CLI::ParseError& error) {
    return fmt::format("{}; see {} --help", complaint(app, error), command_name(app));
}

} // namespace onde::app
