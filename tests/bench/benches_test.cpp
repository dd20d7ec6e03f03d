// What the benches promise beside speed: figures under the keys that scripts read, and one sentence
// with exit code 2 for wrong input.
#include "app/onde_process.h"
#include "support/folders.h"

#include <nlohmann/json.hpp>

#include <set>

using namespace onde::test;
using Json = nlohmann::json;

namespace {

/// The exit code of a bench, whose outputs become the files "out" and "err" of the folder.
int bench(const Folder& folder, const std::string& arguments) {
    const std::string command = "cd '" + folder.path().string() +
                                "' && '" ONDE_BENCH_FOLDER "'/onde_bench_" + arguments +
                                " >out 2>err </dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The list that a bench writes.
Json figures_of(const std::string& arguments) {
    const Folder folder;
    REQUIRE(bench(folder, arguments + " --json figures.json") == 0);
    INFO(content(folder / "err"));
    return Json::parse(content(folder / "figures.json"));
}

std::set<std::string> values_of(const Json& list, const char* key) {
    std::set<std::string> values;
    for (const Json& object : list) values.insert(object.at(key).get<std::string>());
    return values;
}

} // namespace

TEST_CASE("the traversal bench compares five ray sets with the same answers as Embree") {
    const Json list = figures_of("traversal '" + CORNELL + "' --side 64 --repetitions 1");
    CHECK(values_of(list, "scene") == std::set<std::string>{"scenes/cornell"});
    CHECK(values_of(list, "set") ==
          std::set<std::string>{"primary", "shadow", "ao", "bounce", "bounce3"});
    for (const Json& set : list) {
        INFO(set.dump());
        const double onde = set.at("onde_mrays"), embree = set.at("embree_best_mrays");
        CHECK(set.at("ratio").get<double>() == Approx(onde / embree));
        const Json& modes = set.at("modes");
        CHECK(modes.at(set.at("onde_best_variant").get<std::string>()) == onde);
        CHECK(modes.at(set.at("embree_best_mode").get<std::string>()) == embree);
        for (const auto& [mode, mrays] : modes.items())
            if (mode.starts_with("embree")) CHECK(mrays.get<double>() <= embree);
        CHECK(set.at("rays").get<size_t>() >= 64 * 64 * 4 / 2);
        CHECK(set.at("mismatches").get<size_t>() <= 2); // rays along edges
    }
}

TEST_CASE("the traversal bench races other kernels over the sets and walks that are asked for") {
    const Folder folder;
    const std::string mine = (folder / "kernels").string();
    std::filesystem::copy(in_project("kernels"), mine, std::filesystem::copy_options::recursive);
    folder.write("kernels/trace/bvh_stream_occluded.h",
                 content(in_project("kernels/trace/bvh_stream_occluded.h")) + "// mine\n");
    const Json list = figures_of("traversal '" + CORNELL + "' --side 64 --repetitions 1 --sets ao" +
                                 " --traversals stream --against '" + mine + "'");
    REQUIRE(values_of(list, "set") == std::set<std::string>{"ao"});
    const Json& modes = list.front().at("modes");
    CHECK(modes.at("against stream").get<double>() > 0);
    CHECK(modes.at("against single").get<double>() > 0);
    CHECK(modes.contains("embree stream64 coherent"));
    CHECK_FALSE(modes.contains("embree packet8 coherent"));
}

TEST_CASE("the build bench measures every builder's rate, cost and memory") {
    const Json list = figures_of("build '" + CORNELL + "' --repetitions 1");
    CHECK(values_of(list, "builder") == std::set<std::string>{"onde sah", "onde high", "onde refit",
                                                              "onde median", "onde median-spatial",
                                                              "embree low", "embree medium",
                                                              "embree high"});
    for (const Json& built : list) {
        INFO(built.dump());
        CHECK(built.at("scene") == "scenes/cornell");
        CHECK(built.at("mtriangles_per_second").get<double>() > 0);
        CHECK(built.at("bytes_per_triangle").get<double>() > 0);
        const bool ours = built.at("builder").get<std::string>().starts_with("onde");
        CHECK(built.at("sah_cost").is_number() == ours);
        const double bytes =
            built.at("bytes_per_triangle").get<double>() * built.at("triangles").get<double>();
        CHECK(built.at("peak_bytes").get<double>() >= bytes * 0.999);
    }
}

TEST_CASE("leaves with masks have the picture of cut ones") {
    const Json list = figures_of("leaves --leaves 2000 --size 64 --spp 64 --repetitions 1");
    REQUIRE(list.size() == 3);
    const double masked = list[0].at("mean"), cut = list[1].at("mean"), whole = list[2].at("mean");
    CHECK(masked == Approx(cut).epsilon(2e-3));
    CHECK(std::abs(whole - cut) > 5e-3 * cut);
}

TEST_CASE("benches refuse wrong input with one sentence and exit code 2") {
    const Folder folder;
    folder.write("point.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                              "property float y\nproperty float z\nend_header\n0 0 0\n");
    folder.write("ball.toml", "[[shape]]\ntype = \"sphere\"\n");
    const std::pair<std::string, std::string> cases[] = {
        {"gone.ply", "gone.ply: no such file"},
        {"point.ply", "no vertices or no faces"},
        {"ball.toml", "ball.toml: has no triangles"},
        {"'" + CORNELL + "' --json gone/figures.json", "gone"},
        {"'" + CORNELL + "' --json .", "folder"},
        {"--repetitions none", "--repetitions"}};
    const auto refuses = [&](const std::string& line, const std::string& culprit) {
        INFO(line);
        CHECK(bench(folder, line) == 2);
        const std::string error = content(folder / "err");
        const size_t last = error.rfind('\n', error.size() - 2) + 1; // after lines of progress
        CHECK_THAT(error.substr(last), Catch::Contains(culprit));
        CHECK(content(folder / "out").empty());
    };
    for (const auto& [arguments, culprit] : cases)
        for (const char* name : {"traversal ", "build "}) refuses(name + arguments, culprit);
    refuses("traversal --sets shadows", "--sets");
    refuses("traversal --traversals fast", "--traversals");
    refuses("traversal --against gone", "gone: no such folder");
}
