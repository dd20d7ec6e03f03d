// `onde inspect`.
#include "onde_process.h"
#include "support/folders.h"

using namespace onde::test;

TEST_CASE("inspect tells what happened to a pixel, in words and as a graph") {
    const Folder folder;
    const std::string scene = in_project("scenes/chapter/five-objects.toml");
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
    CHECK(lobes_of("kind = 'conductor'\nbase_color = 0.5\nroughness = 0") ==
          "f0 (0.5, 0.5, 0.5), alpha 0");
    CHECK(lobes_of("kind = 'conductor'\nbase_color = 0.5\nroughness = 0.5") ==
          "f0 (0.5, 0.5, 0.5), alpha 0.25");
    CHECK_THAT(lobes_of("kind = 'metallic-roughness'\nclearcoat = 1\ntransmission = 0.5\n"
                        "thin_walled = true"),
               Catch::StartsWith("varnish, diffuse (0.39") && // what its coat leaves of 0.4
                   Catch::Contains("a thin wall"));
    CHECK(lobes_of("kind = 'dielectric'\nior = 1.5\nroughness = 0.5") ==
          "dielectric, eta 1.5, alpha 0.25");
    CHECK(lobes_of("kind = 'unlit'\nbase_color = 0.5") == "scatters no light");
    CHECK_THAT(lobes_of("kind = 'metallic-roughness'\nbase_color = 0.5\nroughness = 0.5"),
               Catch::StartsWith("diffuse (0.48") &&
                   Catch::Contains(" f0 (0.04, 0.04, 0.04), alpha 0.25, "));
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
    const std::string scene = in_project("scenes/chapter/five-objects.toml");
    for (const char* pixel : {"64,3", "3", "-1,2", "1,2,3"}) {
        INFO(pixel);
        const Outcome outcome = onde::test::onde(
            folder, {"inspect", scene, "--size", "64x64", std::string("--pixel=") + pixel});
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains("pixel"));
    }
}
