// Motion blur and projections as the program takes them: what files and options ask for, what is
// said, and what is refused.
#include "image/image_io.h"
#include "slide.h"

using namespace onde::test;

namespace {

Arguments slide(const Arguments& more) {
    return onde::test::slide("64", more);
}

void check_refused(const Folder& folder, const Arguments& options, const std::string& words) {
    const Outcome outcome = onde::test::onde(folder, slide(options));
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains(words));
}

std::vector<float> alpha_of(const fs::path& picture) {
    return onde::read_exr(picture, {"alpha.A"}).pixels;
}

std::vector<float> colors_of(const fs::path& picture) {
    return onde::read_exr(picture, {"R", "G", "B"}).pixels;
}

/// Pixels that are neither all nothing nor all something.
size_t blurred_pixels(const std::vector<float>& alpha) {
    return size_t(std::ranges::count_if(alpha, [](float a) { return a > 0.02f && a < 0.98f; }));
}

fs::path write(const Folder& folder, const std::string& name, const std::string& text) {
    const fs::path path = folder / name;
    std::ofstream(path) << text;
    return path;
}

/// A box that crosses the picture in a second.
const std::string CROSSING = R"([render]
shutter = 0.5
aov = ["alpha"]
[[camera]]
position = [0, 0, 6]
look_at = [0, 0, 0]
[[shape]]
type = "box"
motion = [{ time = 0, position = [-2, 0, 0] }, { time = 1, position = [2, 0, 0] }]
[[light]]
type = "point"
position = [2, 3, 4]
intensity = 50
)";

Arguments crossing(const fs::path& scene, const Arguments& more) {
    Arguments all{"--size", "48x32", "--spp", "64", "--float"};
    all.insert(all.end(), more.begin(), more.end());
    return render(scene.string(), all);
}

} // namespace

TEST_CASE(
    "--shutter blurs a glTF animation by frames, and its picture is the mean of its moments") {
    const Folder folder;
    succeed(folder, slide({"--at", "0.25", "--aov", "alpha", "-o", "still.exr"}));
    succeed(folder, slide({"--at", "0.25", "--shutter", "0.5", "--fps", "2", "--aov", "alpha", "-o",
                           "blurred.exr"}));
    std::vector<double> mean(64 * 48);
    constexpr int MOMENTS = 16;
    for (int i = 0; i < MOMENTS; i++) {
        const std::string at = std::to_string(0.25 + 0.25 * (i + 0.5) / MOMENTS);
        succeed(folder, slide({"--at", at, "--aov", "alpha", "-o", "one.exr", "--quiet"}));
        const std::vector<float> alpha = alpha_of(folder / "one.exr");
        for (size_t k = 0; k < mean.size(); k++) mean[k] += alpha[k] / MOMENTS;
    }
    const std::vector<float> blurred = alpha_of(folder / "blurred.exr");
    CHECK(blurred_pixels(blurred) > 2 * blurred_pixels(alpha_of(folder / "still.exr")));
    double off = 0;
    for (size_t k = 0; k < mean.size(); k++)
        off += std::abs(mean[k] - blurred[k]) / double(mean.size());
    CHECK(off < 0.01); // 64 samples of each, stratified
}

TEST_CASE("frames are blurred each from its own moment on") {
    const Folder folder;
    succeed(folder,
            slide({"--frames", "2:3", "--fps", "8", "--shutter", "0.5", "-o", "a.exr", "--quiet"}));
    succeed(folder, slide({"--at", "0.375", "--fps", "8", "--shutter", "0.5", "-o", "b.exr"}));
    CHECK(colors_of(folder / "a.0003.exr") == colors_of(folder / "b.exr"));
    CHECK(colors_of(folder / "a.0002.exr") != colors_of(folder / "b.exr"));
}

TEST_CASE("a scene's own shutter counts, and the command line's before it") {
    const Folder folder;
    const fs::path scene = write(folder, "crossing.toml", CROSSING);
    succeed(folder, crossing(scene, {"-o", "a.exr"}));
    succeed(folder, crossing(scene, {"--shutter", "12", "--fps", "24", "-o", "b.exr"}));
    succeed(folder, crossing(scene, {"--shutter", "0", "-o", "c.exr"}));
    CHECK(alpha_of(folder / "a.exr") == alpha_of(folder / "b.exr"));
    CHECK(blurred_pixels(alpha_of(folder / "c.exr")) <
          blurred_pixels(alpha_of(folder / "a.exr")) / 2);
    const Outcome later =
        succeed(folder, crossing(scene, {"--at", "3", "--shutter", "0.5", "-o", "d.exr"}));
    CHECK_THAT(later.err, Catch::Contains("nothing moves while the shutter is open"));
    CHECK_THAT(output_of(folder, {"info", scene.string()}), Catch::Contains("shutter"));
}

TEST_CASE("a sample of a blurred picture is replayed at its moment") {
    const Folder folder;
    const fs::path scene = write(folder, "crossing.toml", CROSSING);
    size_t hits = 0;
    for (const char* sample : {"0", "1", "2", "3", "4", "5", "6", "7"}) {
        const std::string path = output_of(folder, {"inspect", scene.string(), "--size", "48x32",
                                                    "--pixel", "19,16", "--sample", sample});
        hits += path.find("meets") != std::string::npos;
    }
    CHECK(hits > 0);
    CHECK(hits < 8);
}

TEST_CASE("what --shutter can't do is said, and what it can't be is refused") {
    const Folder folder;
    const Outcome rest = succeed(folder, slide({"--shutter", "0.5", "-o", "a.png"}));
    CHECK_THAT(rest.err, Catch::Contains("no time passes without --at or --frames"));
    const Outcome table = succeed(
        folder, slide({"--at", "0.25", "--turntable", "1", "--shutter", "0.5", "-o", "b.png"}));
    CHECK_THAT(table.err, Catch::Contains("--turntable moves the camera"));
    check_refused(folder, {"--at", "0.25", "--shutter", "-1"},
                  "--shutter -1 is no part of a frame");
    check_refused(folder, {"--at", "0.25", "--shutter", "nan"}, "is no part of a frame");
}

TEST_CASE("--projection gives any scene's camera another projection") {
    const Folder folder;
    succeed(folder, slide({"--projection", "panorama", "-o", "a.exr"}));
    succeed(folder,
            slide({"--projection", "fisheye", "--background", "transparent", "-o", "b.exr"}));
    succeed(folder, slide({"-o", "c.exr"}));
    CHECK(colors_of(folder / "a.exr") != colors_of(folder / "c.exr"));
    check_refused(folder, {"--projection", "panorama", "--integrator", "painter"},
                  "--integrator painter draws by parallel rays, which no panorama has");
    check_refused(folder, {"--projection", "mercator"}, "mercator");
}

TEST_CASE("a camera's projection is told, and what does not go with it refused") {
    const Folder folder;
    const std::string shapes = "[[shape]]\ntype = \"sphere\"\n";
    const auto camera = [&](const std::string& keys) {
        return write(folder, "scene.toml",
                     "[[camera]]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n" + keys + shapes)
            .string();
    };
    CHECK_THAT(
        output_of(folder, {"info", camera("projection = \"fisheye\"\nfisheye_angle = 220\n")}),
        Catch::Contains("fisheye of 220 degrees"));
    CHECK_THAT(output_of(folder, {"info", camera("projection = \"panorama\"\n")}),
               Catch::Contains("panorama"));
    const auto refuses = [&](const std::string& keys, const std::string& words) {
        const Outcome outcome = onde::test::onde(folder, render(camera(keys), {"--size", "8x8"}));
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains(words));
    };
    refuses("projection = \"panorama\"\nvertical_fov = 30\n", "can't go with a panorama");
    refuses("projection = \"fisheye\"\northographic_height = 3\n", "can't go with a fisheye");
    refuses("fisheye_angle = 90\n", "is of fisheyes");
    refuses("projection = \"fisheye\"\nfisheye_angle = 400\n", "between 1 and 360");
    const Outcome lens =
        succeed(folder, render(camera("projection = \"panorama\"\naperture = 0.1\n"),
                               {"--size", "16x8", "--spp", "1", "-o", "a.png"}));
    CHECK_THAT(lens.err, Catch::Contains("lens of panoramas and fisheyes is left out"));
}
