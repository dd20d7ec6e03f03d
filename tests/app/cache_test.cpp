// `onde cache`, and the kernels that it keeps.
#include "onde_process.h"
#include "support/folders.h"

using namespace onde::test;

TEST_CASE("cache prewarm compiles what a render then loads; list shows it and clear removes it") {
    const Folder folder;
    const Environment own{{"ONDE_CACHE_DIR", (folder / "cache").string()}};
    CHECK_THAT(output_of(folder, {"cache", "list"}, own), Catch::StartsWith("0 programs, 0 bytes"));
    const std::string prewarmed = output_of(folder, {"cache", "prewarm", CORNELL}, own);
    CHECK_THAT(prewarmed, Catch::Contains("cornell.toml ") && Catch::Contains(" compiled in "));
    CHECK_THAT(output_of(folder, {"cache", "list"}, own), Catch::Contains("2 programs, "));
    for (const char* samples : {"1", "65"}) { // a film of 65 has two blocks
        const Outcome outcome =
            onde::test::onde(folder, {"render", CORNELL, "--size", "16x12", "--spp", samples}, own);
        CHECK_THAT(outcome.err, Catch::Contains("kernels loaded in "));
    }
    CHECK_THAT(output_of(folder, {"cache", "list"}, own), Catch::Contains("2 programs, "));
    CHECK_THAT(output_of(folder, {"cache", "prewarm", CORNELL}, own),
               Catch::Contains(" was there, loaded in "));
    CHECK_THAT(output_of(folder, {"cache", "clear"}, own),
               Catch::StartsWith("2 programs removed from " + (folder / "cache").string()));
    CHECK_THAT(output_of(folder, {"cache", "list"}, own), Catch::StartsWith("0 programs, 0 bytes"));
}

TEST_CASE("PoCL compiles each kernel once, and a binary of it is kept") {
    const Folder folder;
    const fs::path pocl = folder / "pocl";
    fs::create_directories(pocl);
    const Environment own{{"ONDE_CACHE_DIR", (folder / "cache").string()},
                          {"POCL_CACHE_DIR", pocl.string()},
                          {"POCL_KERNEL_CACHE", "1"}}; // keeps what it compiles
    CHECK_THAT(output_of(folder, {"cache", "prewarm", CORNELL}, own),
               Catch::Contains(" compiled in "));
    std::map<std::string, int> versions; // of each kernel, as shared objects
    for (const auto& entry : fs::recursive_directory_iterator(pocl))
        if (entry.path().extension() == ".so") ++versions[entry.path().stem()];
    if (versions.empty()) WARN("the device is not PoCL's");
    for (const auto& [kernel, count] : versions) {
        INFO(kernel);
        CHECK(count == 1);
    }
}

TEST_CASE(
    "cache prewarm without a scene serves rooms, analytic shapes and trees beyond the cache") {
    const Folder folder;
    const Environment own{{"ONDE_CACHE_DIR", (folder / "cache").string()}};
    const std::string prewarmed = output_of(folder, {"cache", "prewarm"}, own);
    CHECK_THAT(prewarmed, Catch::Contains("a closed room with spheres       compiled in "));
    CHECK_THAT(prewarmed, Catch::Contains("textured glTF, beyond the cache  compiled in "));
    CHECK(std::count(prewarmed.begin(), prewarmed.end(), '\n') == 7);
    const std::string shapes = in_project("scenes/shapes.toml");
    for (const std::string& scene : {std::string(CORNELL), shapes}) {
        INFO(scene);
        const Outcome outcome =
            onde::test::onde(folder, {"render", scene, "--size", "16x12", "--spp", "1"}, own);
        CHECK_THAT(outcome.err, Catch::Contains("kernels loaded in "));
    }
}
