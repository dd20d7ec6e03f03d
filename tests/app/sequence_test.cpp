// Numbered pictures: a camera that goes round the scene, the frames of an animation.
#include "image/image_io.h"
#include "slide.h"

#include <nlohmann/json.hpp>

using namespace onde::test;

namespace {

size_t count(const std::string& text, const std::string& part) {
    size_t found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

/// Of the pixels that are covered: where they are on the average, and whether any is at an edge.
struct Cover {
    double x = 0, y = 0;
    bool at_edge = false;
};
/// Of the alpha channel of a picture.
Cover cover_of(const fs::path& picture) {
    const onde::Image image = onde::read_exr(picture, {"alpha.A"});
    Cover cover;
    double sum = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) {
            const double value = image.pixels[(size_t(y) * image.width + x) * image.channels];
            if (value == 0) continue;
            sum += value;
            cover.x += x * value;
            cover.y += y * value;
            cover.at_edge |= x == 0 || y == 0 || x + 1 == image.width || y + 1 == image.height;
        }
    REQUIRE(sum > 0);
    cover.x /= sum;
    cover.y /= sum;
    return cover;
}

} // namespace

TEST_CASE("--turntable writes numbered pictures that differ, with one compiled program") {
    const Folder folder;
    folder.write("wedge.obj",
                 "v 0 0 0\nv 3 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const Outcome turn = succeed(
        folder, render("wedge.obj", {"-o", "turn.png", "-o", "turn.exr", "--turntable", "3"}));
    CHECK(count(turn.err, "kernels") == 1);
    CHECK(folder.files().size() == 7);
    CHECK(content(folder / "turn.0001.exr") != content(folder / "turn.0002.exr"));
    CHECK(content(folder / "turn.0002.exr") != content(folder / "turn.0003.exr"));
}

TEST_CASE("a turntable's camera sees the whole model from every side") {
    const Folder folder;
    folder.write("bar.obj", "v -5 0 -.1\nv 5 0 -.1\nv 5 .2 .1\nv -5 .2 .1\nf 1 2 3 4\n");
    succeed(folder, render("bar.obj", {"-o", "a.exr", "--turntable", "8", "--aov", "alpha",
                                       "--ground", "off", "--size", "32x24", "--spp", "4"}));
    for (int i = 1; i <= 8; ++i) {
        INFO("picture " << i);
        CHECK_FALSE(cover_of(folder / ("a.000" + std::to_string(i) + ".exr")).at_edge);
    }
}

TEST_CASE("--frames renders the pictures of single renders, and compiles once") {
    const Folder folder;
    const Environment own{{"ONDE_CACHE_DIR", (folder / "cache").string()}};
    const Outcome outcome = succeed(folder,
                                    render(SLIDE, {"--scene", "1", "--frames", "4:6", "--fps", "8",
                                                   "-o", "shot.exr", "--json", "shots.json"}),
                                    own);
    CHECK(count(outcome.err, "kernels") == 1);
    const auto report = nlohmann::json::parse(content(folder / "shots.json"));
    REQUIRE(report.at("pictures").size() == 3);
    for (int i = 0; i < 3; ++i) {
        const std::string name = "shot.000" + std::to_string(4 + i) + ".exr";
        const std::string at = std::to_string((4 + i) / 8.0);
        INFO(name);
        const auto& picture = report.at("pictures").at(size_t(i));
        CHECK(picture.at("kernels_from_cache") == (i > 0));
        CHECK(picture.at("outputs") == nlohmann::json{name});
        CHECK(picture.at("at") == (4 + i) / 8.0);
        succeed(folder, render(SLIDE, {"--scene", "1", "--at", at, "-o", "one.exr"}), own);
        CHECK(content(folder / name) == content(folder / "one.exr"));
    }
    CHECK(content(folder / "shot.0004.exr") != content(folder / "shot.0005.exr"));
}

TEST_CASE("an added camera stays where it is, and sees all frames of an animation") {
    const Folder folder;
    succeed(folder, render(SLIDE, {"--frames", "0:24", "-o", "f-###.exr", "--aov", "alpha",
                                   "--ground", "off", "--size", "32x24", "--spp", "4", "--quiet"}));
    CHECK(folder.files().size() == 25);
    const Cover first = cover_of(folder / "f-000.exr");
    CHECK_FALSE(first.at_edge);
    Cover before = first;
    for (int i = 1; i <= 24; ++i) {
        const std::string digits = std::string(i < 10 ? "00" : "0") + std::to_string(i);
        INFO(digits);
        const Cover now = cover_of(folder / ("f-" + digits + ".exr"));
        CHECK_FALSE(now.at_edge);
        CHECK(now.x > before.x + 0.3);
        before = now;
    }
    CHECK(before.y < first.y - 3);
}

TEST_CASE("on a turntable the added studio keeps its place about the camera") {
    const Folder folder;
    folder.write("post.obj",
                 "v 0 0 0\nv .1 0 0\nv 0 1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const Arguments turn{"--turntable", "4",     "-o", "t.exr",    "--float", "--size",
                         "32x24",       "--spp", "16", "--ground", "off"};
    succeed(folder, render("post.obj", turn));
    // What is behind the model is the same from every side.
    const auto corner = [&](const char* name) {
        const onde::Image image = onde::read_image(folder / name);
        return std::vector<float>(image.pixels.begin(), image.pixels.begin() + 3);
    };
    const std::vector<float> first = corner("t.0001.exr");
    for (const char* name : {"t.0002.exr", "t.0003.exr", "t.0004.exr"}) {
        INFO(name);
        for (size_t i = 0; i < 3; ++i) CHECK(corner(name)[i] == Approx(first[i]).epsilon(1e-4));
    }
}

TEST_CASE("what is not animated is the same in all frames, and a note says so once") {
    const Folder folder;
    folder.write("still.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Outcome outcome =
        succeed(folder, render("still.obj", {"--frames", "0:1", "-o", "still.exr"}));
    CHECK(count(outcome.err, "Nothing in the file is animated") == 1);
    CHECK(content(folder / "still.0000.exr") == content(folder / "still.0001.exr"));
}

TEST_CASE("sequences that can't be are refused in a sentence before anything is done") {
    const Folder folder;
    const std::pair<Arguments, const char*> wrong[] = {
        {{"--turntable", "0"}, "out of range"},
        {{"--turntable", "2", "-o", "-"}, "standard output"},
        {{"--turntable", "2", "--frames", "0:1"}, "--frames and --turntable"},
        {{"--frames", "0:1", "-o", "-"}, "standard output"},
        {{"--frames", "0:1", "--at", "1"}, "--at is one moment"},
        {{"--frames", "3:1"}, "ends before it begins"},
        {{"--frames=-3:1"}, "not of the form FIRST:LAST"},
        {{"--frames", "3"}, "not of the form FIRST:LAST"},
        {{"--frames", "a:b"}, "not of the form FIRST:LAST"},
        {{"--frames", "0:4294967295"}, "more than 100000 frames"},
        {{"--frames", "0:99999999999"}, "--frames 0:99999999999 has a number that is too large"},
        {{"--frames", "0:1", "--fps", "0"}, "--fps 0 is not"},
        {{"--frames", "0:1", "--fps", "nan"}, "--fps nan is not"},
        {{"--frames", "1:2", "-o", "a1#.png", "-o", "a#1.png"}, "two outputs"},
        {{"--fps", "24"}, "--fps is of --frames"}};
    for (const auto& [options, sentence] : wrong) {
        INFO(options.front() << " " << sentence);
        const Outcome outcome = onde::test::onde(folder, render(SLIDE, options));
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains(sentence));
        CHECK(count(outcome.err, "\n") == 1);
    }
    CHECK(folder.files().empty());
}

TEST_CASE("Ctrl-C saves the frame that is rendered, and what was rendered is reported") {
    const Folder folder;
    Process process(folder, render(SLIDE, {"--frames", "0:9999", "--spp", "64", "-o", "f.png",
                                           "--json", "f.json", "--size", "64x48"}));
    REQUIRE(process.wait_until_interrupt_is_caught(true));
    while (!fs::exists(folder / "f.0001.png")) std::this_thread::yield();
    process.send(SIGINT);
    const Outcome outcome = process.wait();
    INFO(outcome.err);
    CHECK(outcome.code == 130);
    const auto report = nlohmann::json::parse(content(folder / "f.json"));
    const size_t pictures = report.at("pictures").size();
    CHECK(pictures >= 2);
    CHECK(pictures < 10000);
    CHECK(folder.files().size() == pictures + 1);
    const bool part = count(outcome.err, "saving the picture so far") == 1;
    const std::string done = std::to_string(pictures - part);
    CHECK_THAT(outcome.err, Catch::Contains("with " + done + " of 10000 pictures done"));
}

TEST_CASE("SIGTERM between two pictures says how many of how many are done") {
    const Folder folder;
    // Grids of 250,000 triangles load for far longer than one sample of 16x12 pixels takes.
    std::string grid;
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 300; ++x)
            grid += "v " + std::to_string(x) + " " + std::to_string(x * y % 7) + " " +
                    std::to_string(y) + "\n";
    for (int y = 0; y < 299; ++y)
        for (int x = 1; x < 300; ++x) {
            const int at = 300 * y + x;
            grid += "f " + std::to_string(at) + " " + std::to_string(at + 300) + " " +
                    std::to_string(at + 301) + " " + std::to_string(at + 1) + "\n";
        }
    folder.write("grid.obj", grid);
    Process process(folder, render("grid.obj", {"--frames", "0:9999", "-o", "f.png", "--quiet"}));
    REQUIRE(process.wait_until_interrupt_is_caught(true));
    while (!fs::exists(folder / "f.0000.png")) std::this_thread::yield();
    process.send(SIGTERM);
    const Outcome outcome = process.wait();
    CHECK(outcome.code == 143);
    const size_t pictures = folder.files().size() - 1;
    CHECK_THAT(outcome.err, Catch::Contains("onde: interrupted with " + std::to_string(pictures) +
                                            " of 10000 pictures done"));
}
