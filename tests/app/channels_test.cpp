// Channels of pictures that need a scene of their own: groups of lights, and what scenes ask for.
#include "image/image_io.h"
#include "onde_process.h"

#include <nlohmann/json.hpp>

using namespace onde::test;

namespace {

const std::string TWO_LAMPS = R"([camera]
position = [0, 1, 4]
look_at = [0, 0, 0]
[[shape]]
type = "sphere"
[[light]]
type = "point"
position = [2, 2, 2]
intensity = [9, 1, 1]
group = "key"
[[light]]
type = "rectangle"
corner = [-2, 2, 0]
edge1 = [0, 0, 1]
edge2 = [1, 0, 0]
radiance = [1, 1, 9]
group = "fill"
[environment]
radiance = 0.1
)";

void succeed(const Folder& folder, const Arguments& arguments) {
    const Outcome outcome = onde::test::onde(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
}

onde::Image group(const Folder& folder, const char* file, const std::string& layer) {
    return onde::read_exr(folder / file, {layer + ".R", layer + ".G", layer + ".B"});
}

float sum_of_groups(const Folder& folder, const char* file, size_t i) {
    float sum = 0;
    for (const char* name : {"group.other", "group.key", "group.fill"})
        sum += group(folder, file, name).pixels[i];
    return sum;
}

} // namespace

TEST_CASE("--aov light-groups writes the light of each group, by renders and merges alike") {
    const Folder folder;
    folder.write("a.toml", TWO_LAMPS);
    const Arguments base{"--spp", "136", "--aov", "light-groups", "--float"};
    const auto make = [&](Arguments more) {
        more.insert(more.end(), base.begin(), base.end());
        succeed(folder, render("a.toml", more));
    };
    make({"-o", "a.exr", "-o", "a.png", "--film", "whole.exr"});
    for (const char* name : {"a.group.other.png", "a.group.key.png", "a.group.fill.png"})
        CHECK(fs::exists(folder / name));
    const onde::Image picture = onde::read_exr(folder / "a.exr", {"R", "G", "B"});
    for (size_t i = 0; i < picture.pixels.size(); i++)
        CHECK(sum_of_groups(folder, "a.exr", i) ==
              Approx(picture.pixels[i]).epsilon(2e-5).margin(1e-6));
    const onde::Image key = group(folder, "a.exr", "group.key");
    CHECK(std::ranges::max(key.pixels) > 0.1f);

    make({"--film", "p1.exr", "--samples", "0:64"});
    make({"--film", "p2.exr", "--samples", "64:136", "--engine", "megakernel"});
    succeed(folder,
            {"merge", "p2.exr", "p1.exr", "-o", "all.exr", "--picture", "b.exr", "--float"});
    CHECK(content(folder / "all.exr") == content(folder / "whole.exr"));
    CHECK(group(folder, "b.exr", "group.key").pixels == key.pixels);
    const auto film = nlohmann::json::parse(output_of(folder, {"film", "all.exr", "--json"}));
    CHECK(film.at("list_of_light_groups") == "other,fill,key");
}

TEST_CASE("denoised light groups add up to the denoised picture, under Blender's names too") {
    const Folder folder;
    folder.write("a.toml", TWO_LAMPS);
    const auto make = [&](const char* file, Arguments more) {
        Arguments all{"-o",           file,      "--spp",     "4",   "--aov",
                      "light-groups", "--float", "--denoise", "onde"};
        all.insert(all.end(), more.begin(), more.end());
        succeed(folder, render("a.toml", all));
    };
    make("a.exr", {});
    make("b.exr", {"--exr-names", "blender"});
    const onde::Image picture = onde::read_exr(folder / "a.exr", {"R", "G", "B"});
    for (size_t i = 0; i < picture.pixels.size(); i++)
        CHECK(sum_of_groups(folder, "a.exr", i) ==
              Approx(picture.pixels[i]).epsilon(1e-4).margin(1e-5));
    CHECK(group(folder, "b.exr", "ViewLayer.Combined_key").pixels ==
          group(folder, "a.exr", "group.key").pixels);
}

TEST_CASE("a scene states its channels, denoiser and clamp, which options override") {
    const Folder folder;
    folder.write("a.toml",
                 "[render]\naov = [\"depth\"]\ndenoise = \"onde\"\nclamp = 0.5\n" + TWO_LAMPS);
    const Outcome outcome = onde::test::onde(folder, render("a.toml", {"-o", "a.exr"}));
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("denoised by Onde") &&
                                Catch::Contains("the clamp at 0.5 has cut off"));
    CHECK(onde::read_exr(folder / "a.exr", {"depth.Z", "noisy.R"}).channels == 2);
    const Outcome other = onde::test::onde(
        folder,
        render("a.toml", {"-o", "b.exr", "--aov", "uv", "--denoise", "off", "--clamp", "2"}));
    CHECK(other.code == 0);
    CHECK_THAT(other.err, !Catch::Contains("denoised") && Catch::Contains("the clamp at 2 "));
    CHECK(onde::read_exr(folder / "b.exr", {"uv.U"}).channels == 1);
    CHECK_THROWS(onde::read_exr(folder / "b.exr", {"depth.Z"}));
    const Outcome whitted =
        onde::test::onde(folder, render("a.toml", {"-o", "c.png", "--integrator", "whitted"}));
    INFO(whitted.err);
    CHECK(whitted.code == 0); // what is for path tracing alone is left out

    folder.write("b.toml", "[render]\naov = [\"depths\"]\n" + TWO_LAMPS);
    const Outcome wrong = onde::test::onde(folder, render("b.toml", {"-o", "d.exr"}));
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("aov names depths, which is none"));
    folder.write("b.toml", "[render]\nclamp = 0\n" + TWO_LAMPS);
    CHECK_THAT(onde::test::onde(folder, render("b.toml", {"-o", "d.exr"})).err,
               Catch::Contains("clamp"));
}
