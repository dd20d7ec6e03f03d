// What `onde` leaves where it writes: whole files, whatever happens to it or to the disk.
#include "image/image_io.h"
#include "onde_process.h"
#include "support/folders.h"

#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <cmath>
#include <random>

using namespace onde::test;

namespace {

bool is_whole_picture(const fs::path& path) {
    try {
        return onde::read_image(path).width > 0;
    } catch (const std::exception&) {
        return false;
    }
}

/// Files of ours that are not yet what they will be.
size_t unfinished(const Folder& folder) {
    size_t count = 0;
    for (const auto& [name, content] : folder.files()) count += name.find(".onde-") == 0;
    return count;
}

} // namespace

TEST_CASE("a picture written to a link changes what the link leads to") {
    const Folder folder;
    folder.write("far/real.png", "old");
    fs::create_symlink("far/real.png", folder / "link.png");
    fs::create_symlink("far/real.json", folder / "link.json");
    const Outcome outcome =
        onde::test::onde(folder, render(CORNELL, {"-o", "link.png", "--json", "link.json"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(fs::is_symlink(folder / "link.png"));
    CHECK(is_whole_picture(folder / "far/real.png"));
    CHECK(fs::is_symlink(folder / "link.json"));
    CHECK(nlohmann::json::accept(content(folder / "far/real.json")));
}

TEST_CASE("a read-only picture is refused before the render, and stays") {
    const Folder folder;
    folder.write("a.png", "old");
    fs::permissions(folder / "a.png", fs::perms::owner_read);
    const Outcome outcome = onde::test::onde(folder, render(CORNELL, {"-o", "a.png"}));
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("read-only"));
    CHECK(folder.files().at("a.png") == "old");
}

TEST_CASE("a dash sends the picture or the numbers to standard output, and words elsewhere") {
    const Folder folder;
    const Outcome picture = onde::test::onde(folder, render(CORNELL, {"-o", "-", "--stats"}));
    INFO(picture.err);
    CHECK(picture.code == 0);
    folder.write("out.png", picture.out);
    CHECK(is_whole_picture(folder / "out.png"));
    CHECK_THAT(picture.err, Catch::Contains("Mrays/s"));
    for (const char* name : {"-", "/dev/stdout"}) {
        const Outcome numbers =
            onde::test::onde(folder, render(CORNELL, {"-o", "a.png", "--json", name, "--stats"}));
        CHECK(numbers.code == 0);
        CHECK(nlohmann::json::accept(numbers.out));
    }
    CHECK(fs::is_symlink("/dev/stdout"));
}

TEST_CASE("two outputs in one place are refused") {
    const Folder folder;
    for (const Arguments& options :
         {Arguments{"-o", "-", "--json", "-"}, Arguments{"-o", "a.png", "-o", "./a.png"},
          Arguments{"-o", "-", "--aov", "sample-count"}}) {
        const Outcome outcome = onde::test::onde(folder, render(CORNELL, options));
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(folder.files().empty());
    }
}

TEST_CASE("what a command reads is not overwritten, by whatever name") {
    const Folder folder;
    folder.write("crate.obj", "mtllib crate.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                              "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    folder.write("crate.mtl", "newmtl m\nmap_Kd crate.png\n");
    const fs::path images = in_project("tests/data/fuzz/image");
    fs::copy_file(images / "rgb.png", folder / "crate.png");
    fs::create_symlink("crate.obj", folder.path() / "link.png");
    fs::copy_file(images / "plain.hdr", folder / "sky.hdr");
    const auto before = folder.files();
    const auto drawing = [](const Arguments& more) { return render("crate.obj", more); };
    for (const Arguments& line :
         {drawing({}), drawing({"-o", "link.png"}),
          drawing({"-o", "other.png", "--json", "crate.mtl"}),
          drawing({"--environment", "sky.hdr", "-o", "other.png", "--json", "./sky.hdr"}),
          Arguments{"thumbnail", "crate.obj", "-o", ".", "--size", "16", "--spp", "1"},
          Arguments{"inspect", "crate.obj", "--pixel", "1,1", "--dot", "crate.obj"},
          Arguments{"compare", "crate.png", "crate.png", "--diff", "crate.png"}}) {
        const Outcome outcome = onde::test::onde(folder, line);
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains("is read from here"));
        CHECK(folder.files() == before);
    }
}

TEST_CASE("extensions in any case say what is written") {
    const Folder folder;
    const Outcome outcome =
        onde::test::onde(folder, render(CORNELL, {"-o", "X.PNG", "-o", "x.Exr"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(content(folder / "X.PNG").starts_with("\x89PNG"));
    CHECK(content(folder / "x.Exr").starts_with("\x76\x2f\x31\x01"));
}

TEST_CASE("an output that fails is told after the others are written") {
    const Folder folder;
    for (const char* name : {"full.png", "full.exr"})
        fs::create_symlink("/dev/full", folder / name);
    const Outcome outcome = onde::test::onde(
        folder,
        render(CORNELL, {"-o", "full.png", "-o", "full.exr", "-o", "y.png", "--json", "j"}));
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("full.png: cannot be written (No space") &&
                                Catch::Contains("full.exr"));
    CHECK(is_whole_picture(folder / "y.png"));
    CHECK(nlohmann::json::accept(content(folder / "j")));
}

TEST_CASE("SIGTERM and SIGHUP save the picture so far, as Ctrl-C does") {
    for (const int signal : {SIGTERM, SIGHUP}) {
        const Folder folder;
        Process process(folder, render(CORNELL, {"--spp", "16000000", "-o", "a.png"}));
        REQUIRE(process.wait_until_interrupt_is_caught(true));
        std::this_thread::sleep_for(std::chrono::seconds(1));
        process.send(signal);
        const Outcome outcome = process.wait();
        INFO(outcome.err);
        CHECK(outcome.code == 128 + signal);
        CHECK(is_whole_picture(folder / "a.png"));
        CHECK(folder.files().size() == 1);
    }
}

TEST_CASE("a name cannot speak to the terminal") {
    const Folder folder;
    const std::string name = "a\x1b[31m\nonde: wrote b.png";
    folder.write(name + ".toml", "[[shape]]\nshade = 1\n");
    for (const std::string& scene : {name, name + ".toml"}) {
        const Outcome outcome = onde::test::onde(folder, {"info", scene});
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find('\x1b') == std::string::npos);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
}

// ONDE_KILLS=100 for the long form.
TEST_CASE("killed at any time, it leaves the old picture or the new one, and nothing half") {
    const Folder folder;
    const Arguments arguments =
        render(CORNELL, {"--size", "320x240", "-o", "a.png", "-o", "a.exr", "--float", "--quiet"});
    const auto begin = std::chrono::steady_clock::now();
    REQUIRE(onde::test::onde(folder, arguments, {{"TMPDIR", folder.path()}}).code == 0);
    const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
    const char* wanted = std::getenv("ONDE_KILLS");
    const int kills = wanted ? std::atoi(wanted) : 8;
    std::mt19937 random(1);
    for (int i = 0; i < kills; ++i) {
        const double share = std::uniform_real_distribution(0.3, 1.1)(random);
        Process process(folder, arguments, {{"TMPDIR", folder.path()}});
        std::this_thread::sleep_for(whole * share);
        process.send(i % 2 ? SIGTERM : SIGKILL);
        process.wait();
        INFO(i << " after " << (whole * share).count() << " s");
        CHECK(is_whole_picture(folder / "a.png"));
        CHECK(is_whole_picture(folder / "a.exr"));
        CHECK(unfinished(folder) <= 1);
    }
    REQUIRE(onde::test::onde(folder, arguments, {{"TMPDIR", folder.path()}}).code == 0);
    CHECK(folder.files().size() == 2); // what the killed ones left is gone, PoCL's folders too
}

TEST_CASE("no pixel of an EXR is infinite, however bright the light") {
    const Folder folder;
    folder.write("l.toml", "[camera]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n"
                           "vertical_fov = 32\n[[light]]\ntype = \"point\"\n"
                           "position = [1, 1, 1]\nintensity = 3e38\n"
                           "[[shape]]\ntype = \"sphere\"\nradius = 0.5\n");
    const Outcome outcome =
        onde::test::onde(folder, render("l.toml", {"--size", "32x32", "--spp", "16", "--float",
                                                   "-o", "f.exr", "-o", "a.png"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const onde::Image image = onde::read_image(folder / "f.exr");
    CHECK(std::all_of(image.pixels.begin(), image.pixels.end(),
                      [](float value) { return std::isfinite(value); }));
    CHECK(*std::max_element(image.pixels.begin(), image.pixels.end()) > 1e38f);
}

TEST_CASE("options that do nothing without others say so") {
    const Folder folder;
    const auto warns = [&](const Arguments& options, const std::string& words) {
        const Outcome outcome = onde::test::onde(folder, render(CORNELL, options));
        INFO(outcome.err);
        CHECK(outcome.code == 0);
        return outcome.err.find(words) != std::string::npos;
    };
    const std::string names = "--exr-names does nothing", floats = "--float does nothing",
                      quality = "do nothing without --denoise", mixed = "--mixed-devices does";
    CHECK(warns({"-o", "a.png", "--exr-names", "blender"}, names));
    CHECK(warns({"-o", "a.png", "--float"}, floats));
    CHECK(warns({"-o", "a.png", "--denoise-quality", "fast"}, quality));
    CHECK(warns({"-o", "a.png", "--mixed-devices"}, mixed));
    CHECK_FALSE(warns({"-o", "a.exr", "-o", "a.png", "--exr-names", "blender", "--float"}, "does"));
    CHECK_FALSE(warns({"-o", "a.png", "--denoise", "onde", "--denoise-quality", "fast"}, quality));
}
