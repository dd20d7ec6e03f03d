// What the main() of a bench does beside its work.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace onde::bench {

/// Parses the options of `app` and runs the bench. The exit code: 0 done, 2 wrong input, 3 no
/// usable device, 1 anything else, each with one sentence on standard error.
int run_main(CLI::App& app, int argc, char** argv, const std::function<void()>& run);

/// Options that are the same everywhere.
void add_repetitions(CLI::App& app, uint32_t& repetitions);
void add_json(CLI::App& app, std::string& path);

} // namespace onde::bench
