// Runs one test of this executable again in another environment: drivers read it once per process.
#pragma once

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace onde::test {

/// True in the process that rerun_with() started.
inline bool is_rerun() {
    return std::getenv("ONDE_TEST_RERUN") != nullptr;
}

/// Runs the test of that name with `environment` ("NAME=VALUE NAME=VALUE"); true when it passed.
inline bool rerun_with(const std::string& environment, const std::string& test) {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command =
        "ONDE_TEST_RERUN=1 " + environment + " '" + self + "' -w NoTests '" + test + "'";
    return std::system(command.c_str()) == 0;
}

} // namespace onde::test
