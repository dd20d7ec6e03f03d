// `onde doctor`: its lines, its JSON, its exit code.
#include "onde_process.h"
#include "support/folders.h"

#include <nlohmann/json.hpp>

using namespace onde::test;
using nlohmann::json;

namespace {

/// A folder of kernels whose sine has the wrong sign.
void plant_fault(const Folder& folder) {
    fs::copy(fs::path(in_project("kernels")), folder / "kernels", fs::copy_options::recursive);
    const std::string file = "kernels/math/elementary.h", right = "-sine, sine",
                      wrong = "sine, -sine";
    std::string text = content(folder / file);
    REQUIRE(text.find(right) != std::string::npos);
    folder.write(file, text.replace(text.find(right), right.size(), wrong));
}

} // namespace

TEST_CASE("doctor prints a line for each check, from the ground up, and says so as JSON") {
    const Folder folder;
    const std::string text =
        output_of(folder, {"doctor", "--quick", "--check", "math,layout,random"});
    CHECK_THAT(text, Catch::Contains("ok    layout     0 of"));
    CHECK(text.find("layout") < text.find("math"));
    CHECK_THAT(text, Catch::Contains("all 3 checks passed"));

    const json report =
        json::parse(output_of(folder, {"doctor", "--quick", "--check", "layout,rate", "--json"}));
    CHECK(report.at("passed") == true);
    CHECK_THAT(text, Catch::Contains("\n--denoise: "));
    CHECK(text.find(report.at("denoiser").get<std::string>()) != std::string::npos);
    const Outcome none = onde::test::onde(folder, {"doctor", "--quick", "--check", "layout"},
                                          {{"ONDE_DENOISER_LIBRARY", "/none"}});
    CHECK(none.code == 0);
    CHECK_THAT(none.out, Catch::Contains("--denoise: our own, as ") && Catch::Contains("/none"));
    CHECK(report.at("device").at("units") > 0);
    REQUIRE(report.at("checks").size() == 2);
    CHECK(report.at("checks")[0].at("name") == "layout");
    CHECK(report.at("checks")[0].at("value") == 0);
    CHECK(report.at("checks")[1].at("unit") == "Mrays/s");
    CHECK(report.at("checks")[1].at("value") > 0);
}

TEST_CASE("doctor's exit code says that a check failed, and its words which and why") {
    const Folder folder;
    plant_fault(folder);
    const Arguments faulty{"doctor", "--quick", "--check", "layout,math", "--kernels", "kernels"};
    const Outcome outcome = onde::test::onde(folder, faulty);
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.out, Catch::Contains("FAIL  math") && Catch::Contains("a sine is") &&
                                Catch::Contains("1 of 2 checks failed"));
    Arguments as_json = faulty;
    as_json.emplace_back("--json");
    const Outcome told = onde::test::onde(folder, as_json);
    CHECK(told.code == 1);
    CHECK(json::parse(told.out).at("checks")[1].at("passed") == false);
}

TEST_CASE("doctor refuses checks that there are not, folders without kernels, and no device") {
    const Folder folder;
    const Outcome unknown = onde::test::onde(folder, {"doctor", "--check", "blood"});
    CHECK(unknown.code == 2);
    CHECK_THAT(unknown.err, Catch::Contains("--check") && Catch::Contains("blood"));
    const Environment none{{"OCL_ICD_VENDORS", folder.path().string()}};
    CHECK(onde::test::onde(folder, {"doctor"}, none).code == 3);
    CHECK(onde::test::onde(folder, {"doctor", "--kernels", "nowhere"}).code != 0);
}
