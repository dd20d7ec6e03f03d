// What the main() of a bench does beside its work.
#pragma once

#include "core/command_line.h"

#include <functional>
#include <string>

namespace onde::bench {

/// Parses the options and runs the bench. The exit code: 0 done, 2 wrong input, 3 no usable
/// device, 1 anything else, each with one sentence on standard error.
int run_main(CommandLine& line, int argc, char** argv, const std::function<void()>& run);

/// Options that are the same everywhere.
void add_repetitions(Command& command, uint32_t& repetitions);
void add_device(Command& command, std::string& device);
void add_kernels(Command& command, std::string& folder);
void add_json(Command& command, std::string& path);

} // namespace onde::bench
