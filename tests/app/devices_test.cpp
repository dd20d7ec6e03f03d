// `onde devices`, and machines without any.
#include "onde_process.h"

#include <nlohmann/json.hpp>

using namespace onde::test;

TEST_CASE("devices marks the one that a render takes, and says the same as JSON") {
    const Folder folder;
    const std::string table = output_of(folder, {"devices"});
    const auto json = nlohmann::json::parse(output_of(folder, {"devices", "--json"}));
    size_t index = 0, defaults = 0;
    for (const auto& platform : json.at("platforms"))
        for (const auto& device : platform.at("devices")) {
            CHECK(device.at("index") == index++);
            CHECK(device.at("memory_bytes") > 0);
            CHECK_THAT(table, Catch::Contains(device.at("name").get<std::string>()));
            if (!device.at("default")) continue;
            ++defaults;
            CHECK_THAT(table, Catch::Contains("* " + std::to_string(index - 1) + "  "));
        }
    CHECK(defaults == 1);
}

TEST_CASE("a machine without a platform is told what to install, and as JSON an empty list") {
    const Folder folder;
    const Environment none{{"OCL_ICD_VENDORS", folder.path().string()}};
    CHECK_THAT(output_of(folder, {"devices"}, none), Catch::Contains("pocl-opencl-icd"));
    const auto json = nlohmann::json::parse(output_of(folder, {"devices", "--json"}, none));
    CHECK(json.at("platforms").empty());
}

TEST_CASE("devices --measure rates the layouts, and renders then use the fastest") {
    const Folder folder;
    const Environment own{{"ONDE_CACHE_DIR", (folder / "cache").string()}};
    const auto rates =
        nlohmann::json::parse(output_of(folder, {"devices", "--measure", "--json"}, own));
    REQUIRE(rates.at("layouts").size() == 3);
    double best = 0;
    std::string fastest;
    for (const auto& rate : rates.at("layouts")) {
        if (rate.at("mrays") > best) fastest = rate.at("layout");
        best = std::max(best, rate.at("mrays").get<double>());
    }
    CHECK(best > 0);
    CHECK(rates.at("chosen") == fastest);

    const auto stats_of_a_render = [&] {
        return onde::test::onde(
                   folder, {"render", CORNELL, "--size", "16x12", "--spp", "1", "--stats"}, own)
            .out;
    };
    CHECK_THAT(stats_of_a_render(), Catch::Contains("bvh       " + fastest + ": "));
    size_t remembered = 0;
    for (const auto& entry : fs::directory_iterator(folder / "cache"))
        if (entry.path().extension() == ".layout") {
            std::ofstream(entry.path(), std::ios::binary) << "binary";
            ++remembered;
        }
    CHECK(remembered == 1);
    CHECK_THAT(stats_of_a_render(), Catch::Contains("bvh       binary: "));

    const Outcome outcome = onde::test::onde(folder, {"devices", "--device", "0"}, own);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("add --measure"));
}
