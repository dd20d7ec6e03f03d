// PoCL in an environment that it would not survive by itself.
#include "gpu/device.h"
#include "gpu/pocl_environment.h"
#include "gpu/subprocess.h"
#include "gpu/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::gpu;
using Catch::Matchers::Contains;

namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "(unset)";
}

/// What is wrong with PoCL, as devices are listed.
std::string pocl_problem() {
    for (const PlatformReport& platform : list_platforms())
        if (platform.name.find("Portable") != std::string::npos) return platform.problem;
    return "(no PoCL)";
}

} // namespace

TEST_CASE("PoCL works in a folder of the process that is gone when it ends") {
    if (test::is_rerun()) {
        CHECK(open_device("Portable").facts().problem.empty());
        CHECK(variable("POCL_KERNEL_CACHE") == "0");
        const std::filesystem::path folder = variable("POCL_CACHE_DIR");
        CHECK(std::filesystem::is_directory(folder));
        CHECK(folder.parent_path() == variable("TMPDIR"));
        return;
    }
    const test::TemporaryFolder parent;
    CHECK(test::rerun_with("env -u POCL_CACHE_DIR -u POCL_KERNEL_CACHE TMPDIR=" +
                               parent.path().string(),
                           "PoCL works in a folder of the process that is gone when it ends"));
    CHECK(std::filesystem::is_empty(parent.path()));
}

TEST_CASE("what the user has set for PoCL stays") {
    if (test::is_rerun()) {
        CHECK(prepare_pocl() == "");
        CHECK(variable("POCL_KERNEL_CACHE") == "1");
        CHECK(variable("POCL_CACHE_DIR") == variable("TMPDIR") + "/new");
        return;
    }
    const test::TemporaryFolder parent;
    const std::string folder = parent.path().string();
    CHECK(test::rerun_with("TMPDIR=" + folder + " POCL_KERNEL_CACHE=1 POCL_CACHE_DIR=" + folder +
                               "/new",
                           "what the user has set for PoCL stays"));
}

TEST_CASE("a PATH is set where there is none") {
    if (!test::is_rerun()) {
        CHECK(test::rerun_with("env -u PATH", "a PATH is set where there is none"));
        return;
    }
    CHECK(prepare_pocl() == "");
    CHECK_THAT(variable("PATH"), Contains("/usr/bin"));
}

TEST_CASE("PoCL without a linker or a folder is listed with that problem") {
    const std::string name = "PoCL without a linker or a folder is listed with that problem";
    if (!test::is_rerun()) {
        CHECK(test::rerun_with("WITHOUT=linker PATH=/nowhere:", name));
        CHECK(test::rerun_with("WITHOUT=folder POCL_CACHE_DIR=/proc/nowhere", name));
        return;
    }
    CHECK_THAT(pocl_problem(), variable("WITHOUT") == "linker"
                                   ? Contains("ld, which is not in the PATH /nowhere:;")
                                   : Contains("POCL_CACHE_DIR, which names /proc/nowhere"));
    CHECK_THROWS_WITH(open_device("Portable"), Contains(pocl_problem()));
}
