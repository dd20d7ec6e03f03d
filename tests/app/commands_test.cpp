// The subcommands around `onde render`.
#include "image/image_io.h"
#include "onde_process.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <map>

using namespace onde::test;

namespace {

/// What it prints on standard output, when it ends with code 0 and complains of nothing.
std::string output_of(const Folder& folder, const Arguments& arguments,
                      const Environment& environment = {}) {
    const Outcome outcome = onde::test::onde(folder, arguments, environment);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    return outcome.out;
}

onde::Image plain(float value) {
    onde::Image image(4, 3, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

} // namespace

TEST_CASE("--version is the version and --help lists the subcommands") {
    const Folder folder;
    CHECK(output_of(folder, {"--version"}) == ONDE_VERSION "\n");
    const std::string help = output_of(folder, {"--help"});
    for (const char* command : {"render", "info", "reference", "inspect", "gallery", "thumbnail",
                                "compare", "devices", "cache"})
        CHECK_THAT(help, Catch::Contains(std::string("\n  ") + command));
}

TEST_CASE("every subcommand has its own help") {
    const Folder folder;
    const std::pair<Arguments, std::string> commands[] = {{{"inspect"}, "--pixel"},
                                                          {{"render"}, "--wave-size"},
                                                          {{"info"}, "--json"},
                                                          {{"compare"}, "--diff"},
                                                          {{"devices"}, "--json"},
                                                          {{"cache"}, "prewarm"},
                                                          {{"cache", "list"}, "Usage"},
                                                          {{"cache", "clear"}, "Usage"},
                                                          {{"cache", "prewarm"}, "--device"}};
    for (auto [command, mentioned] : commands) {
        INFO(command.back());
        command.push_back("--help");
        CHECK_THAT(output_of(folder, command), Catch::Contains(mentioned));
    }
}

TEST_CASE("reference prints the keys of scene files as tables") {
    const Folder folder;
    const std::string text = output_of(folder, {"reference"});
    CHECK_THAT(text, Catch::Contains("<!-- table material -->\n| key | value | default |\n"));
    CHECK_THAT(text, Catch::Contains("| `\"torus\"` |"));
}

TEST_CASE("inspect tells what happened to a pixel, in words and as a graph") {
    const Folder folder;
    const std::string scene = ONDE_SOURCE_DIR "/scenes/chapter/five-objects.toml";
    const Arguments view{"inspect", scene, "--size", "64x64", "--pixel", "32,36"};
    Arguments tree = view;
    for (const char* word : {"--integrator", "whitted", "--dot", "tree.dot"}) tree.push_back(word);
    const std::string words = output_of(folder, tree);
    for (const char* part : {"camera ray: meets", "transmitted ray", "source 0", "[0] returns"})
        CHECK_THAT(words, Catch::Contains(part));
    std::ifstream dot(folder.path() / "tree.dot");
    const std::string graph((std::istreambuf_iterator<char>(dot)), {});
    CHECK_THAT(graph, Catch::StartsWith("digraph tree {") && Catch::Contains("n0 -> n"));
    CHECK_THAT(output_of(folder, view),
               Catch::Contains("throughput (1, 1, 1)") && Catch::Contains("\nradiance ("));
}

TEST_CASE("inspect tells of a surface what its lobes have, and nothing of others") {
    const Folder folder;
    const auto lobes_of = [&](const std::string& material) {
        folder.write("ball.toml", "[[material]]\nname = 'm'\n" + material +
                                      "\n[[shape]]\ntype = 'sphere'\nmaterial = 'm'\n");
        const std::string words = output_of(
            folder, {"inspect", "ball.toml", "--size", "8x8", "--pixel", "4,4", "--depth", "1"});
        const size_t found = words.find("light found"), line = words.find("\n    ", found) + 5;
        return words.substr(line, words.find('\n', line) - line);
    };
    CHECK(lobes_of("kind = 'diffuse'\nbase_color = 0.5") == "diffuse (0.5, 0.5, 0.5)");
    CHECK(lobes_of("kind = 'conductor'\nbase_color = 0.5\nroughness = 0.5") ==
          "f0 (0.5, 0.5, 0.5), alpha 0.25");
    CHECK(lobes_of("kind = 'dielectric'\nior = 1.5\nroughness = 0.5") ==
          "dielectric, eta 1.5, alpha 0.25");
    CHECK(lobes_of("kind = 'unlit'\nbase_color = 0.5") == "scatters no light");
    CHECK_THAT(lobes_of("kind = 'metallic-roughness'\nbase_color = 0.5\nroughness = 0.5"),
               Catch::StartsWith("diffuse (0.5, 0.5, 0.5), f0 (0.04, 0.04, 0.04), alpha 0.25, "));
}

TEST_CASE("inspect says where a path meets the ground under a model, and what is behind the rest") {
    const Folder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto words_at = [&](const char* pixel, const char* ground) {
        return output_of(folder, {"inspect", "a.obj", "--size", "64x48", "--ground", ground,
                                  "--dot", "a.dot", "--pixel", pixel});
    };
    CHECK_THAT(words_at("32,47", "on"),
               Catch::Contains("throughput (1, 1, 1): meets the ground at"));
    CHECK_THAT(content(folder / "a.dot"), Catch::Contains("n0 [label=\"ground\\nfound"));
    CHECK_THAT(words_at("32,47", "off"), Catch::Contains("(1, 1, 1): leaves the scene toward"));
    CHECK_THAT(content(folder / "a.dot"), Catch::Contains("n0 [label=\"background\\nfound"));
}

TEST_CASE("inspect refuses what is no pixel") {
    const Folder folder;
    const std::string scene = ONDE_SOURCE_DIR "/scenes/chapter/five-objects.toml";
    for (const char* pixel : {"64,3", "3", "-1,2", "1,2,3"}) {
        INFO(pixel);
        const Outcome outcome = onde::test::onde(
            folder, {"inspect", scene, "--size", "64x64", std::string("--pixel=") + pixel});
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains("pixel"));
    }
}

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
    CHECK_THAT(text, Catch::Contains("0 point, 0 spot, 0 directional; area 1, 1 disk"));
    const auto few = nlohmann::json::parse(output_of(folder, {"info", "one.toml", "--json"}));
    const auto more = nlohmann::json::parse(output_of(folder, {"info", "more.toml", "--json"}));
    CHECK(more.at("shapes").at("torus") == 2);
    CHECK(more.at("area_lights").at("disk") == 1);
    CHECK(more.at("host_bytes") > few.at("host_bytes"));
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

TEST_CASE("an output that nobody can read is an error and not a success") {
    const Folder folder;
    const std::string command =
        ONDE_BINARY " info " + CORNELL + " > /dev/full 2> " + (folder / "err").string();
    const int status = std::system(command.c_str());
    CHECK(WEXITSTATUS(status) == 2);
    CHECK(content(folder / "err") == "onde: standard output could not be written\n");
}

TEST_CASE("info works without any device") {
    const Folder folder;
    const Environment none{{"OCL_ICD_VENDORS", folder.path().string()}};
    CHECK_THAT(output_of(folder, {"info", CORNELL}, none), Catch::Contains("no OpenCL device"));
}

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
    const std::string shapes = std::string(ONDE_SOURCE_DIR) + "/scenes/shapes.toml";
    for (const std::string& scene : {std::string(CORNELL), shapes}) {
        INFO(scene);
        const Outcome outcome =
            onde::test::onde(folder, {"render", scene, "--size", "16x12", "--spp", "1"}, own);
        CHECK_THAT(outcome.err, Catch::Contains("kernels loaded in "));
    }
}

TEST_CASE("compare measures pictures, equal or not, and ends with code 0 for both") {
    const Folder folder;
    onde::write_exr(folder / "a.exr", plain(0.5f), {});
    onde::write_exr(folder / "b.exr", plain(0.75f), {});
    CHECK_THAT(output_of(folder, {"compare", "a.exr", "a.exr"}),
               Catch::Contains("RMSE         0\n"));
    CHECK_THAT(output_of(folder, {"compare", "a.exr", "b.exr"}),
               Catch::Contains("RMSE         0.25\n"));
    const auto equal =
        nlohmann::json::parse(output_of(folder, {"compare", "a.exr", "a.exr", "--json"}));
    CHECK(equal.at("rmse") == 0.0);
    CHECK(equal.at("psnr").is_null()); // infinite
    const std::string line = output_of(folder, {"compare", "a.exr", "b.exr", "--json"});
    CHECK(line.find('\n') == line.size() - 1);
    CHECK(nlohmann::json::parse(line).at("worst").at("b") == 0.75);
}

TEST_CASE("compare writes the difference, and refuses what it cannot compare or write") {
    const Folder folder;
    onde::write_exr(folder / "a.exr", plain(0.5f), {});
    onde::write_exr(folder / "b.exr", plain(0.75f), {});
    onde::write_exr(folder / "small.exr", onde::Image(2, 2, 3), {});
    output_of(folder, {"compare", "a.exr", "b.exr", "--diff", "d.exr"});
    CHECK(onde::read_image(folder / "d.exr").pixels == plain(0.25f).pixels);
    const auto before = folder.files();
    const Arguments wrong[] = {{"compare", "a.exr", "small.exr"},
                               {"compare", "a.exr", "b.exr", "--diff", "d.jpg"},
                               {"compare", "a.exr", "b.exr", "--diff", "no/such/d.png"}};
    for (const Arguments& arguments : wrong) {
        const Outcome outcome = onde::test::onde(folder, arguments);
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.starts_with("onde: "));
    }
    CHECK(folder.files() == before);
}
