// `onde info`.
#include "onde_process.h"

#include <nlohmann/json.hpp>

using namespace onde::test;

TEST_CASE("info counts what is in a scene and plans the device's memory") {
    const Folder folder;
    const std::string text = output_of(folder, {"info", CORNELL});
    CHECK_THAT(text, Catch::Contains("triangles     36 unique, 36 instanced, 2 of them emissive"));
    CHECK_THAT(text, Catch::Contains("film of 512 x 512 13.02 MiB"));
    const auto json = nlohmann::json::parse(output_of(folder, {"info", CORNELL, "--json"}));
    CHECK(json.at("unique_triangles") == 36);
    CHECK(json.at("spheres") == 1);
    CHECK(json.at("materials").at("dielectric") == 1);
    CHECK(json.at("notes").empty());
    CHECK_THAT(text, Catch::Contains("\nsamples       256\n"));
    CHECK(json.at("settings").at("samples") == 256);
    CHECK(json.at("settings").at("filter").is_null());
    CHECK(json.at("cameras").at(0).at("vertical_fov") == Approx(38));
    CHECK(json.at("cameras").at(0).at("screen").is_null());
    const auto& memory = json.at("device_memory");
    CHECK(memory.at("film").at("film sums") == 512 * 512 * 16);
    uint64_t sum = 0;
    for (const char* group : {"scene", "paths", "film"})
        for (const auto& bytes : memory.at(group)) sum += bytes.get<uint64_t>();
    CHECK(memory.at("bytes") == sum);
}

TEST_CASE("info counts shapes and area lights by their kinds, and the host's bytes of them") {
    const Folder folder;
    const std::string one = "[[shape]]\ntype = \"torus\"\n";
    folder.write("one.toml", one + "[environment]\n"); // and no studio
    folder.write("more.toml", one + one + "[[light]]\ntype = \"disk\"\nradiance = 1\n");
    const std::string text = output_of(folder, {"info", "more.toml"});
    CHECK_THAT(text, Catch::Contains("shapes        3, 1 disk, 2 torus"));
    CHECK_THAT(text,
               Catch::Contains("0 point, 0 spot, 0 photometric, 0 directional; area 1, 1 disk"));
    const auto few = nlohmann::json::parse(output_of(folder, {"info", "one.toml", "--json"}));
    const auto more = nlohmann::json::parse(output_of(folder, {"info", "more.toml", "--json"}));
    CHECK(more.at("shapes").at("torus") == 2);
    CHECK(more.at("area_lights").at("disk") == 1);
    CHECK(more.at("host_bytes") > few.at("host_bytes"));
}

TEST_CASE("info counts media and their grids") {
    const Folder folder;
    const std::string cloud = in_project("scenes/cloud.toml");
    CHECK_THAT(output_of(folder, {"info", cloud}), Catch::Contains("media         1, 1 grids, "));
    const auto json = nlohmann::json::parse(output_of(folder, {"info", cloud, "--json"}));
    CHECK(json.at("media") == 1);
    CHECK(json.at("grids") == 1);
    CHECK(json.at("grid_bytes") > 10000);
    CHECK(json.at("device_memory").at("scene").at("densities of media") > 10000);
}

TEST_CASE("a render takes the memory that info planned") {
    const Folder folder;
    folder.write("small.toml", "[film]\nsize = [32, 24]\n[render]\nsamples = 70\n"
                               "[[shape]]\ntype = \"sphere\"\ncenter = [0, 0, -5]\nradius = 1\n");
    const auto plan = nlohmann::json::parse(output_of(folder, {"info", "small.toml", "--json"}));
    const Outcome outcome = onde::test::onde(folder, {"render", "small.toml", "--json", "a.json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto report = nlohmann::json::parse(content(folder / "a.json"));
    const uint64_t taken = report.at("scene_bytes").get<uint64_t>() +
                           report.at("state_bytes").get<uint64_t>() +
                           report.at("film_bytes").get<uint64_t>();
    CHECK(plan.at("device_memory").at("bytes") == taken);
}

TEST_CASE("info parses as JSON whatever bytes a name is made of") {
    const Folder folder;
    folder.write("names.toml", "[camera]\nname = \"a \\\"quoted\\\" \\\\ \\u0001 \\u00e9\"\n"
                               "position = [0, 0, 0]\nlook_at = [0, 0, -1]\n"
                               "[[shape]]\ntype = \"sphere\"\ncenter = [0, 0, -5]\nradius = 1\n");
    const Outcome outcome = onde::test::onde(folder, {"info", "names.toml", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json.at("cameras").at(0).at("name") == "a \"quoted\" \\ \x01 \xc3\xa9");
}

TEST_CASE("info works without any device") {
    const Folder folder;
    const Environment none{{"OCL_ICD_VENDORS", folder.path().string()}};
    CHECK_THAT(output_of(folder, {"info", CORNELL}, none), Catch::Contains("no OpenCL device"));
}
