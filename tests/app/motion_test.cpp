// Motion vectors as the program writes them: what they lead to, names, films, and what is said.
#include "image/image_io.h"
#include "slide.h"

#include <nlohmann/json.hpp>

using namespace onde::test;

namespace {

Arguments slide(const Arguments& more) {
    return onde::test::slide("16", more);
}

/// Sums over the pixels: of alpha, of alpha times the place, of alpha times the motion.
struct Sums {
    double alpha = 0, x = 0, y = 0, right = 0, up = 0;
};
Sums sums_of(const fs::path& picture) {
    const onde::Image image = onde::read_exr(picture, {"alpha.A", "forward.u", "forward.v"});
    Sums sums;
    for (uint32_t y = 0; y < image.height; y++)
        for (uint32_t x = 0; x < image.width; x++) {
            const float* pixel = &image.pixels[3 * (size_t(y) * image.width + x)];
            sums.alpha += pixel[0];
            sums.x += float(x) * pixel[0];
            sums.y += float(y) * pixel[0];
            sums.right += pixel[1]; // of what lies before a background that stands still
            sums.up += pixel[2];
        }
    REQUIRE(sums.alpha > 0);
    return sums;
}

void check_refused(const Folder& folder, const Arguments& options, const std::string& words) {
    const Outcome outcome = onde::test::onde(folder, slide(options));
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains(words));
}

} // namespace

TEST_CASE("motion leads from each frame to the next one") {
    const Folder folder;
    succeed(folder, slide({"--frames", "2:5", "--fps", "16", "--aov", "motion,alpha", "-o", "a.exr",
                           "--quiet"}));
    for (int i = 2; i < 5; i++) {
        const auto picture = [&](int k) {
            return sums_of(folder / ("a.000" + std::to_string(k) + ".exr"));
        };
        const Sums now = picture(i), next = picture(i + 1);
        INFO(i);
        CHECK(now.right / now.alpha > 1);
        CHECK(now.right / now.alpha ==
              Approx(next.x / next.alpha - now.x / now.alpha).margin(0.08));
        CHECK(now.up / now.alpha == Approx(now.y / now.alpha - next.y / next.alpha).margin(0.08));
    }
}

TEST_CASE("one picture has the motion of its frame in a sequence, and says how long that takes") {
    const Folder folder;
    succeed(folder, slide({"--frames", "3:3", "--fps", "8", "--aov", "motion", "-o", "a.exr"}));
    const Outcome one =
        succeed(folder, slide({"--at", "0.375", "--fps", "8", "--aov", "motion", "-o", "b.exr"}));
    CHECK_THAT(one.err, Catch::Contains("leads to the next frame, 1/8 s later (--fps)"));
    CHECK(onde::read_exr(folder / "a.0003.exr", {"forward.u", "forward.v"}).pixels ==
          onde::read_exr(folder / "b.exr", {"forward.u", "forward.v"}).pixels);
    const Outcome usual =
        succeed(folder, slide({"--at", "0.375", "--aov", "motion", "-o", "c.exr"}));
    CHECK_THAT(usual.err, Catch::Contains("1/24 s later"));

    // The picture itself is that of a render without.
    succeed(folder, slide({"--at", "0.375", "-o", "d.exr"}));
    CHECK(onde::read_exr(folder / "d.exr", {"R", "G", "B"}).pixels ==
          onde::read_exr(folder / "c.exr", {"R", "G", "B"}).pixels);
}

TEST_CASE("motion has the names and directions of the compositor") {
    const Folder folder;
    const Arguments base{"--at", "0.25", "--aov", "motion"};
    const auto make = [&](Arguments more) {
        more.insert(more.end(), base.begin(), base.end());
        succeed(folder, slide(more));
    };
    make({"-o", "a.exr", "-o", "a.png"});
    make({"-o", "b.exr", "--exr-names", "blender"});
    CHECK(fs::exists(folder / "a.motion.png"));
    const onde::Image plain = onde::read_exr(folder / "a.exr", {"forward.u", "forward.v"});
    const onde::Image blender =
        onde::read_exr(folder / "b.exr", {"ViewLayer.Vector.X", "ViewLayer.Vector.Y",
                                          "ViewLayer.Vector.Z", "ViewLayer.Vector.W"});
    CHECK(std::ranges::max(plain.pixels) > 1);
    for (size_t i = 0; i < blender.pixels.size(); i++)
        CHECK(blender.pixels[i] == -plain.pixels[i / 4 * 2 + i % 2]);
}

TEST_CASE("films keep motion, and parts of it join to that of one render") {
    const Folder folder;
    const auto make = [&](Arguments more) {
        more.insert(more.end(), {"--at", "0.25", "--aov", "motion"});
        Arguments all = slide(more);
        *std::ranges::find(all, "16") = "136";
        succeed(folder, all);
    };
    make({"--film", "whole.exr", "-o", "a.exr"});
    make({"--film", "p1.exr", "--samples", "0:64", "--engine", "megakernel"});
    make({"--film", "p2.exr", "--samples", "64:136"});
    succeed(folder, {"merge", "p2.exr", "p1.exr", "-o", "all.exr", "--picture", "b.exr"});
    CHECK(content(folder / "all.exr") == content(folder / "whole.exr"));
    CHECK(onde::read_exr(folder / "a.exr", {"forward.u", "forward.v"}).pixels ==
          onde::read_exr(folder / "b.exr", {"forward.u", "forward.v"}).pixels);
    const auto film = nlohmann::json::parse(output_of(folder, {"film", "all.exr", "--json"}));
    CHECK(film.at("set_of_AOVs") == "motion");
    CHECK(film.at("next_frame") != "none");
    make({"--film", "p3.exr", "--samples", "64:136", "--fps", "12"});
    const Outcome other = onde::test::onde(folder, {"merge", "p1.exr", "p3.exr", "-o", "no.exr"});
    CHECK(other.code == 2);
    CHECK_THAT(other.err, Catch::Contains("another next frame"));

    succeed(folder, {"work", "store", SLIDE, "--scene", "1", "--size", "64x48", "--spp", "136",
                     "--float", "--lanes", "8", "--at", "0.25", "--aov", "motion"});
    CHECK(content(folder / "store/film.exr") == content(folder / "whole.exr"));
}

TEST_CASE("the camera of a turntable gives what stands still a motion, and studios none") {
    const Folder folder;
    folder.write("post.obj",
                 "v 0 0 0\nv .1 0 0\nv 0 1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    succeed(folder, render("post.obj", {"--turntable", "36", "-o", "t.exr", "--aov", "motion,alpha",
                                        "--size", "32x24", "--spp", "4", "--ground", "off"}));
    const onde::Image image =
        onde::read_exr(folder / "t.0001.exr", {"alpha.A", "forward.u", "forward.v"});
    CHECK(image.pixels[0] == 0);
    CHECK(std::abs(image.pixels[1]) < 1e-3f);
    CHECK(std::abs(image.pixels[2]) < 1e-3f);
    float largest = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 3)
        if (image.pixels[i] == 1) largest = std::max(largest, std::abs(image.pixels[i + 1]));
    CHECK(largest > 0.05f); // of a post of a tenth of its height, turned by 10 degrees
    CHECK(content(folder / "t.0001.exr") != content(folder / "t.0002.exr"));
}

TEST_CASE("motion without time is 0 with a note, and --fps without either is refused") {
    const Folder folder;
    const Outcome still = succeed(folder, slide({"--aov", "motion", "-o", "a.exr"}));
    CHECK_THAT(still.err, Catch::Contains("no time passes without --at or --frames"));
    const onde::Image motion = onde::read_exr(folder / "a.exr", {"forward.u", "forward.v"});
    CHECK(std::ranges::all_of(motion.pixels, [](float number) { return number == 0; }));
    check_refused(folder, {"--fps", "24"}, "--fps is of --frames");
    check_refused(folder, {"--fps", "24", "--aov", "motion"}, "--fps is of --frames");
    check_refused(folder, {"--fps", "24", "--at", "0.5", "--aov", "alpha"}, "--fps is of --frames");
    check_refused(folder, {"--fps", "24", "--at", "0.5"}, "--fps is of --frames");
    check_refused(folder, {"--fps", "3", "--at", "0.5", "--aov", "motion", "--turntable", "2"},
                  "--fps is of --frames");
    check_refused(folder, {"--fps", "0", "--at", "0.5", "--aov", "motion"}, "--fps 0 is not");
    check_refused(folder, {"--integrator", "light", "--aov", "motion"}, "path");
    CHECK(folder.files().size() == 1);
}

TEST_CASE("a scene file asks for motion, of the animated files that it includes") {
    const Folder folder;
    folder.write("a.toml", "[render]\naov = [\"motion\"]\n[environment]\nradiance = 1\n"
                           "[camera]\nposition = [2.5, 1.5, 9]\nlook_at = [2.5, 1.5, 0]\n"
                           "[[include]]\nfile = \"slide.gltf\"\nposition = [1, 0, 0]\n");
    folder.write("slide.gltf", content(SLIDE));
    succeed(folder, render("a.toml", {"--at", "0.25", "--fps", "6", "-o", "a.exr", "--spp", "4"}));
    const onde::Image motion = onde::read_exr(folder / "a.exr", {"forward.u", "forward.v"});
    CHECK(std::ranges::max(motion.pixels) > 0.5f);
}

TEST_CASE("the motion of a moment at which nothing moves is said to be 0") {
    const Folder folder;
    const std::string still = in_project("scenes/cornell.toml");
    const Outcome outcome = succeed(folder, render(still, {"--at", "0", "--aov", "motion", "--size",
                                                           "16x16", "--spp", "1", "-o", "a.exr"}));
    CHECK_THAT(outcome.err, Catch::Contains("Nothing in the file is animated"));
    CHECK_THAT(outcome.err,
               Catch::Contains("motion is 0: nothing moves until the next frame, 1/24 s"));
    CHECK_THAT(outcome.err, !Catch::Contains("motion leads"));
}
