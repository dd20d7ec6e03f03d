// Films in files: parts that join, renders that go on, and what is said of files that can't be
// used.
#include "image/image_io.h"
#include "onde_process.h"

#include <nlohmann/json.hpp>

#include <random>

using namespace onde::test;

namespace {

/// That must end well.
void run(const Folder& folder, const Arguments& arguments) {
    const Outcome outcome = onde::test::onde(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
}

void check_refused(const Folder& folder, const Arguments& arguments, const std::string& words) {
    const Outcome outcome = onde::test::onde(folder, arguments);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains(words));
}

/// The options of a picture of which parts are made.
Arguments part(const Arguments& more) {
    Arguments all{"--spp", "136", "--aov", "sample-count,albedo"};
    all.insert(all.end(), more.begin(), more.end());
    return render(CORNELL, all);
}

bool same_bytes(const Folder& folder, const std::string& a, const std::string& b) {
    return content(folder / a) == content(folder / b);
}

} // namespace

TEST_CASE("parts of a picture join to the film and the picture of one render") {
    const Folder folder;
    run(folder, part({"--film", "whole.exr", "-o", "whole.png"}));
    fs::create_directory(folder / "parts");
    run(folder, part({"--samples", "0:64", "--film", "parts/a.exr"}));
    run(folder, part({"--samples", "64:136", "--rectangle", "0,0,9,12", "--film", "parts/b.exr",
                      "--wave-size", "512"}));
    run(folder, part({"--samples", "64:128", "--rectangle", "9,0,7,12", "--film", "parts/c.exr",
                      "--engine", "megakernel"}));
    CHECK_FALSE(fs::exists(folder / "cornell.png")); // only what is asked for
    const Outcome some = onde::test::onde(folder, {"merge", "parts", "-o", "some.exr"});
    CHECK(some.code == 0);
    CHECK_THAT(some.err, Catch::Contains("samples 128 to 135 of 7x12 pixels from 9,0 are missing"));
    run(folder, part({"--samples", "128:136", "--rectangle", "9,0,7,12", "--film", "d.exr"}));
    const Outcome all = onde::test::onde(
        folder, {"merge", "d.exr", "some.exr", "-o", "all.exr", "--picture", "all.png"});
    CHECK(all.code == 0);
    CHECK_THAT(all.err, Catch::Contains("all.exr") && Catch::Contains("all.png") &&
                            !Catch::Contains("missing"));
    CHECK(same_bytes(folder, "all.exr", "whole.exr"));
    CHECK(same_bytes(folder, "all.png", "whole.png"));
    run(folder, {"merge", "d.exr", "parts", "--picture", "all_at_once.exr"});
    const onde::Image albedo =
        onde::read_exr(folder / "all_at_once.exr", {"albedo.R", "albedo.G", "albedo.B"});
    CHECK(*std::ranges::max_element(albedo.pixels) > 0.5f);
    run(folder, {"merge", "d.exr", "parts", "-o", "all_at_once.png"});
    CHECK(same_bytes(folder, "all_at_once.png", "whole.png"));
    check_refused(folder, {"merge", "parts", "-o", "none.exr", "--complete"},
                  "not the whole picture");
    CHECK_FALSE(fs::exists(folder / "none.exr"));
    run(folder, {"merge", "d.exr", "parts", "-o", "complete.exr", "--complete"});
    CHECK(same_bytes(folder, "complete.exr", "whole.exr"));
}

TEST_CASE("a merge that is told to end leaves nothing, and what was there as it was") {
    const Folder folder;
    run(folder, render(CORNELL, {"--size", "1200x900", "--spp", "1", "--film", "a.exr", "--aov",
                                 "albedo,normal,position,direct,indirect"}));
    folder.write("out.exr", "not a film");
    for (const int signal : {SIGINT, SIGTERM}) {
        Process process(folder, {"merge", "a.exr", "-o", "out.exr"});
        REQUIRE(process.wait_until_interrupt_is_caught(true));
        process.send(signal);
        const Outcome outcome = process.wait();
        INFO(outcome.err);
        CHECK(outcome.code == 128 + signal);
        CHECK_THAT(outcome.err, Catch::Contains("interrupted before all was written"));
        CHECK(content(folder / "out.exr") == "not a film");
        CHECK(folder.files().size() == 2);
    }
}

TEST_CASE("of two renders that go on from one film the second leaves it to the first") {
    const Folder folder;
    run(folder, part({"--film", "a.exr"}));
    const std::string begun = content(folder / "a.exr");
    Process first(folder, render(CORNELL, {"--spp", "1000000", "--aov", "sample-count,albedo",
                                           "--resume", "a.exr", "--checkpoint", "0.05"}));
    while (content(folder / "a.exr") == begun) std::this_thread::yield();
    const Outcome second = onde::test::onde(
        folder,
        render(CORNELL, {"--spp", "200", "--aov", "sample-count,albedo", "--resume", "a.exr"}));
    INFO(second.err);
    CHECK(second.code == 0);
    CHECK_THAT(second.err, Catch::Contains("this film goes to a.2.exr"));
    CHECK(fs::exists(folder / "a.2.exr"));
    first.send(SIGTERM);
    CHECK(first.wait().code == 143);
    CHECK(folder.files().size() == 2);
    run(folder, part({"--resume", "a.2.exr"})); // nobody has it now
    CHECK(folder.files().size() == 2);
}

TEST_CASE("onde film says what a film holds and what it lacks") {
    const Folder folder;
    run(folder, part({"--samples", "64:128", "--rectangle", "1,2,3,4", "--film", "a.exr"}));
    const std::string words = output_of(folder, {"film", "a.exr"});
    CHECK_THAT(words, Catch::Contains("samples 64 to 127 of 3x4 pixels from 1,2"));
    CHECK_THAT(words, Catch::Contains("lacks"));
    const auto json = nlohmann::json::parse(output_of(folder, {"film", "a.exr", "--json"}));
    CHECK(json.at("samples") == "136");
    CHECK(json.at("set_of_AOVs") == "albedo");
    REQUIRE(json.at("parts").size() == 1);
    CHECK(json.at("parts")[0].at("first_sample") == 64);
    CHECK(json.at("parts")[0].at("width") == 3);
    CHECK(json.at("missing").size() > 1);
}

TEST_CASE("a picture goes on from its film to the bytes of one render, to more samples too") {
    const Folder folder;
    run(folder, part({"--film", "whole.exr", "-o", "whole.png"}));
    run(folder, render(CORNELL, {"--spp", "50", "--aov", "albedo", "--film", "a.exr"}));
    run(folder, part({"--resume", "a.exr", "-o", "a.png", "--engine", "megakernel"}));
    CHECK(same_bytes(folder, "a.exr", "whole.exr"));
    CHECK(same_bytes(folder, "a.png", "whole.png"));
    run(folder, part({"--resume", "a.exr", "-o", "b.png"})); // nothing is left to do
    CHECK(same_bytes(folder, "b.png", "whole.png"));
    CHECK(same_bytes(folder, "a.exr", "whole.exr"));
}

TEST_CASE("a render that is told to end keeps its film within a pass, and goes on from there") {
    const Folder folder;
    const Arguments large{"--size", "120x90", "--spp", "70", "--wave-size", "512"};
    const auto with = [&](const Arguments& more) {
        Arguments all = large;
        all.insert(all.end(), more.begin(), more.end());
        return render(CORNELL, all);
    };
    run(folder, with({"--film", "whole.exr"}));
    Arguments endless = with({"--film", "a.exr"});
    *std::ranges::find(endless, "70") = "100000";
    Process process(folder, endless);
    REQUIRE(process.wait_until_interrupt_is_caught(true));
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    process.send(SIGTERM);
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 128 + SIGTERM);
    if (!fs::exists(folder / "a.exr")) { // a slow machine, or a fast one
        WARN("nothing was rendered before the signal");
        return;
    }
    Arguments resumed = endless;
    const auto json = nlohmann::json::parse(output_of(folder, {"film", "a.exr", "--json"}));
    const auto& last = json.at("parts").back();
    const uint64_t samples = last.at("first_sample").get<uint64_t>() +
                             last.at("sample_count").get<uint64_t>() + last.value("pass", 0u);
    const std::string target = std::to_string((samples / 64 + 2) * 64);
    *std::ranges::find(resumed, "100000") = target;
    resumed.insert(resumed.end(), {"--resume", "a.exr", "-o", "a.png"});
    run(folder, resumed);
    Arguments at_once = with({"--film", "b.exr", "-o", "b.png"});
    *std::ranges::find(at_once, "70") = target;
    run(folder, at_once);
    CHECK(same_bytes(folder, "a.png", "b.png"));
}

TEST_CASE("renders that are killed at any time go on from their checkpoints to the same bytes") {
    const Folder folder;
    const auto job = [&](const std::string& film, const Arguments& more = {}) {
        Arguments all{"--size",      "64x48", "--spp",        "200",   "--film", film,
                      "--wave-size", "2048",  "--checkpoint", "0.001", "--quiet"};
        all.insert(all.end(), more.begin(), more.end());
        return render(CORNELL, all);
    };
    run(folder, job("whole.exr"));
    std::mt19937 generator(5);
    int killed = 0;
    for (int kill = 0; kill < 12; ++kill) {
        Process process(folder, job("a.exr", {"--resume", "a.exr"}));
        std::this_thread::sleep_for(std::chrono::milliseconds(60 + generator() % 300));
        process.send(SIGKILL);
        killed += process.wait().signal == SIGKILL;
        if (fs::exists(folder / "a.exr")) output_of(folder, {"film", "a.exr"}); // it is whole
    }
    CHECK(killed > 0);
    run(folder, job("a.exr", {"--resume", "a.exr"}));
    CHECK(same_bytes(folder, "a.exr", "whole.exr"));
    CHECK(folder.files().size() == 2); // what was left unfinished is gone
}

TEST_CASE("a render that its noise ends goes on from its film, and is joined with nothing") {
    const Folder folder;
    const auto noisy = [&](const Arguments& more) {
        Arguments all{"--noise", "0.1"};
        if (std::ranges::find(more, "--spp") == more.end())
            all.insert(all.end(), {"--spp", "4096"});
        all.insert(all.end(), more.begin(), more.end());
        return render(CORNELL, all);
    };
    const Outcome outcome = onde::test::onde(
        folder, noisy({"--film", "whole.exr", "-o", "whole.png", "--json", "whole.json"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err,
               Catch::Contains("no more than 5 % of the pixels are off by more than 0.1"));
    const auto json = nlohmann::json::parse(content(folder / "whole.json"));
    CHECK(json.at("noise_is_met") == true);
    CHECK(json.at("fewest_samples") == 64);
    CHECK(json.at("most_samples") > json.at("samples"));
    CHECK(json.at("samples") > 64);

    run(folder, noisy({"--film", "a.exr", "--spp", "100"}));
    run(folder, noisy({"--resume", "a.exr", "-o", "a.png"}));
    CHECK(same_bytes(folder, "a.png", "whole.png"));
    CHECK_THAT(output_of(folder, {"film", "whole.exr"}),
               Catch::Contains("as far as they needed them") && !Catch::Contains("lacks"));
    run(folder, {"merge", "whole.exr", "-o", "again.png"});
    CHECK(onde::read_image(folder / "again.png").pixels ==
          onde::read_image(folder / "whole.png").pixels);

    check_refused(folder, render(CORNELL, {"--noise", "0.2", "--resume", "a.exr"}),
                  "another noise");
    check_refused(folder, noisy({"--resume", "a.exr", "--exposure", "1"}), "exposure of noise");
    check_refused(folder, {"merge", "a.exr", "whole.exr", "-o", "b.exr"},
                  "such films can't be joined with others");
    check_refused(folder, noisy({"--samples", "0:64", "--film", "b.exr"}), "leave out --samples");
    check_refused(folder, noisy({"--integrator", "light"}), "--noise is for --integrator path");
    check_refused(folder, render(CORNELL, {"--noise", "2"}), "use 0.0001 to 1");
    check_refused(folder, render(CORNELL, {"--noise", "nan"}), "--noise nan is no share of white");
}

TEST_CASE("each picture of a turntable has its film, and only what is missing is rendered again") {
    const Folder folder;
    const Arguments turn{"--turntable", "3", "--film", "t-#.exr", "-o", "t-#.png", "--spp", "65"};
    run(folder, render(CORNELL, turn));
    const std::string second = content(folder / "t-2.exr");
    fs::remove(folder / "t-2.exr");
    Arguments again = turn;
    again.insert(again.end(), {"--resume", "t-#.exr"});
    const Outcome outcome = onde::test::onde(folder, render(CORNELL, again));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("going on from 65 samples per pixel of t-1.exr"));
    CHECK(content(folder / "t-2.exr") == second);
    CHECK_FALSE(same_bytes(folder, "t-1.exr", "t-2.exr"));
}

TEST_CASE("films that cannot be made, gone on from or joined are named in one sentence") {
    const Folder folder;
    run(folder, part({"--film", "a.exr"}));
    const std::string film = content(folder / "a.exr");
    check_refused(folder, part({"--film", "a.exr"}), "a.exr: is there already");
    CHECK(content(folder / "a.exr") == film);
    check_refused(folder, part({"--film", "b.png"}), "b.png: a film file is an .exr");
    check_refused(folder, part({"--film", "b.exr", "-o", "b.exr"}),
                  "a film and what else is written");
    check_refused(folder, part({"--resume", "none.exr"}), "no such film to go on from");
    check_refused(folder, part({"--resume", "a.exr", "--seed", "3"}), "another seed");
    check_refused(folder, part({"--resume", "a.exr", "--rectangle", "0,0,2,2"}),
                  "just these by --rectangle 0,0,16,12");
    check_refused(folder, part({"--resume", "a.exr", "--samples", "64:128"}),
                  "a film from sample 64 on can't go on with one from 0 on");
    check_refused(folder, part({"--checkpoint", "2"}), "--checkpoint needs a film file");
    check_refused(folder, part({"--samples", "0:100"}), "use 64 or 128");
    check_refused(folder, part({"--samples", "64"}), "is not of the form FIRST:END");
    check_refused(folder, part({"--samples", "64:200"}), "the picture has 136 samples");
    check_refused(folder, part({"--rectangle", "0,0,17,2"}), "does not lie in the picture");
    check_refused(folder, part({"--rectangle", "0,0,17"}), "is not of the form X,Y,WIDTH,HEIGHT");
    check_refused(folder, render(CORNELL, {"--integrator", "depth-buffer", "--film", "b.exr"}),
                  "--film is for --integrator path and whitted");
    check_refused(folder, {"merge", "a.exr", "a.exr", "-o", "b.exr"}, "some too");
    check_refused(folder, {"merge", "a.exr"}, "nothing is to be written");
    check_refused(folder, {"merge", "a.exr", "-o", "b.exr", "--picture", "b.exr"}, "same place");
    check_refused(folder, part({"--film", "b.exr", "--json", "b.exr"}), "same place");
    check_refused(folder, part({"--resume", "a.exr", "--clamp", "3"}), "another clamp");
    check_refused(folder, part({"--samples", "", "--film", "b.exr"}), "has an empty value");
    check_refused(folder, {"merge", "a.exr", "-o", "a.exr"}, "is read from here");
    folder.write("bad.exr", film.substr(0, film.size() - 9));
    check_refused(folder, {"merge", "bad.exr", "-o", "b.exr"}, "bad.exr: is damaged");
    check_refused(folder, {"film", "bad.exr"}, "bad.exr: is damaged");
    check_refused(folder, part({"--resume", "bad.exr"}), "bad.exr: is damaged");
    CHECK(folder.files().size() == 2);
    run(folder, part({"--samples", "0:64", "--film", "first.exr"}));
    check_refused(folder, {"merge", "first.exr", "-o", "a.exr"},
                  "samples that these parts have not");
    CHECK(content(folder / "a.exr") == film);
}
