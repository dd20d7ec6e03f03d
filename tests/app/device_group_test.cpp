// `--device` with several: the picture and the film of one.
#include "onde_process.h"

#include <nlohmann/json.hpp>

using namespace onde::test;

namespace {

/// As many units as a machine of few cores needs to be cut into eight.
const Environment EIGHT_UNITS{{"HWLOC_SYNTHETIC", "node:1(memory=8000000000) pu:8"},
                              {"HWLOC_THISSYSTEM", "1"}};

/// Waves that leave each device several units.
Arguments picture(const std::string& devices, const Arguments& more = {}) {
    Arguments all{"--device", devices, "--wave-size", "512", "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return render(CORNELL, all);
}

void run(const Folder& folder, const Arguments& arguments) {
    const Outcome outcome = onde::test::onde(folder, arguments, EIGHT_UNITS);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
}

void check_refused(const Folder& folder, const Arguments& arguments, const std::string& words,
                   const Environment& environment = EIGHT_UNITS, int code = 2) {
    const Outcome outcome = onde::test::onde(folder, arguments, environment);
    INFO(outcome.err);
    CHECK(outcome.code == code);
    CHECK_THAT(outcome.err, Catch::Contains(words));
}

} // namespace

TEST_CASE("two and eight devices make the picture, the AOVs and the film of one") {
    const Folder folder;
    for (const std::string spp : {"20", "200"}) {
        const Arguments more{"--spp", spp, "--aov", "albedo,depth"};
        const auto outputs = [&](const std::string& name) {
            Arguments all = more;
            const std::string base = name + spp;
            all.insert(all.end(), {"--film", base + ".film.exr", "-o", base + ".png", "-o",
                                   base + ".exr", "--json", base + ".json"});
            return all;
        };
        run(folder, picture("0", outputs("one")));
        run(folder, picture("0/2", outputs("two")));
        run(folder, picture("0/8", outputs("eight")));
        for (const std::string name : {"two", "eight"}) {
            for (const char* file : {".film.exr", ".png", ".exr", ".albedo.png"})
                CHECK(content(folder / ("one" + spp + file)) ==
                      content(folder / (name + spp + file)));
            const auto json = nlohmann::json::parse(content(folder / (name + spp + ".json")));
            CHECK(json.at("shares").size() == (name == "two" ? 2 : 8));
        }
    }
}

TEST_CASE("devices write checkpoints, end on Ctrl-C, and go on to the film of one") {
    const Folder folder;
    const Arguments film{"--spp", "20000", "--checkpoint", "0.1"};
    const auto with = [&](const std::string& name, const Arguments& other) {
        Arguments all = film;
        all.insert(all.end(), {"--film", name, "--resume", name});
        all.insert(all.end(), other.begin(), other.end());
        return all;
    };
    Process process(folder, picture("0/2", with("film.exr", {})), EIGHT_UNITS);
    for (int i = 0; i < 6000 && !fs::exists(folder / "film.exr"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    process.send(SIGINT);
    const Outcome stopped = process.wait();
    INFO(stopped.err);
    REQUIRE((stopped.code == 130 || stopped.code == 0));
    run(folder, picture("0/4", with("film.exr", {})));
    run(folder, picture("0", with("whole.exr", {})));
    CHECK(content(folder / "film.exr") == content(folder / "whole.exr"));
}

TEST_CASE("a turntable by two devices is that of one, and denoised pictures are the same") {
    const Folder folder;
    const Arguments more{"--turntable", "3", "--spp", "8", "--denoise", "onde"};
    const auto to = [&](const std::string& name) {
        Arguments all = more;
        all.insert(all.end(), {"-o", name});
        return all;
    };
    run(folder, picture("0", to("one.png")));
    run(folder, picture("0/2", to("two.png")));
    for (const char* number : {".0001.png", ".0002.png", ".0003.png"})
        CHECK(content(folder / (std::string("one") + number)) ==
              content(folder / (std::string("two") + number)));
}

TEST_CASE("what several devices can't do is said in one sentence") {
    const Folder folder;
    check_refused(folder, picture("0/2", {"--time", "1"}), "--time is for one device");
    check_refused(folder, picture("0/2", {"--integrator", "light"}), "light has none");
    check_refused(folder, picture("0/2", {"--noise", "0.1"}), "leave it out");
    check_refused(folder, picture("0,0"), "names device 0 twice");
    check_refused(folder, picture("0/9"), "use at most 8");
    check_refused(folder, picture("0,abacus"), "no OpenCL device matches 'abacus'", EIGHT_UNITS, 3);
    check_refused(folder, {"work", "store", CORNELL, "--device", "0/2"},
                  "--device 0/2 names several devices, by which only onde render");
    Environment by_variable = EIGHT_UNITS;
    by_variable["ONDE_DEVICE"] = "0/2";
    check_refused(folder, {"work", "store", CORNELL}, "ONDE_DEVICE names several", by_variable);
}

TEST_CASE("devices of several classes are refused, or mixed where that is asked for") {
    const char* simulator = "/usr/lib/oclgrind/liboclgrind-rt-icd.so";
    if (!fs::exists(simulator)) return;
    const Folder folder;
    folder.write("drivers/other.icd", std::string(simulator) + "\n");
    for (const auto& entry : fs::directory_iterator("/etc/OpenCL/vendors"))
        if (entry.path().filename().string().find("pocl") != std::string::npos)
            fs::copy(entry.path(), folder / "drivers/pocl.icd");
    Environment both = EIGHT_UNITS;
    both["OCL_ICD_VENDORS"] = (folder / "drivers").string();
    check_refused(folder, picture("all"), "add --mixed-devices", both);
    // One that fails, as this simulator may, costs the other its work.
    const Arguments mixed{"--mixed-devices", "--layout", "wide",   "--size",  "4x3",
                          "--depth",         "1",        "--film", "film.exr"};
    const Outcome outcome = onde::test::onde(folder, picture("all", mixed), both);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(output_of(folder, {"film", "film.exr"}),
               Catch::Contains("Oclgrind") && Catch::Contains(" and Portable Computing Language"));
}
