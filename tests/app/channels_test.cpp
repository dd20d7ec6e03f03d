// Channels of pictures that need a scene of their own: groups of lights, and what scenes ask for.
#include "image/image_io.h"
#include "onde_process.h"
#include "support/folders.h"

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

namespace {

const std::string NAMED_THINGS = R"([camera]
position = [0, 1, 4]
look_at = [0, 0.3, 0]
[environment]
radiance = 1
[[material]]
name = "red"
base_color = [1, 0, 0]
[[shape]]
type = "sphere"
name = "ball"
material = "red"
radius = 0.7
center = [0.4, 0.7, 1]
)";
const std::string FLOOR = R"([[shape]]
type = "rectangle"
name = "floor"
size = [6, 6]
rotation = [-90, 0, 0]
[[shape]]
type = "box"
material = "red"
position = [-1, 0.5, 0]
)";

/// Decodes a file by the script beside this test.
void check_cryptomatte(const Folder& folder, const std::string& arguments) {
    const std::string command = "cd " + folder.path().string() + " && /usr/bin/python3 " +
                                in_project("tests/app/cryptomatte.py ") + arguments +
                                " > decoded.txt 2> problem.txt";
    const int status = std::system(command.c_str());
    INFO(content(folder / "problem.txt"));
    CHECK(status == 0);
}

} // namespace

TEST_CASE("Cryptomatte layers are decoded to the mattes of things") {
    const Folder folder;
    folder.write("ball.toml", NAMED_THINGS);
    folder.write("all.toml", NAMED_THINGS + FLOOR);
    // Nothing hides the ball: its matte is the alpha of a picture that has nothing else.
    const auto make = [&](const char* scene, const char* file, Arguments more) {
        more.insert(more.begin(), {"--spp", "64", "--size", "40x30", "-o", file, "--aov"});
        succeed(folder, render(scene, more));
    };
    make("ball.toml", "ball.exr", {"alpha,crypto-object"});
    check_cryptomatte(folder, "ball.exr CryptoObject ball alpha.A");
    make("all.toml", "all.exr",
         {"crypto-object,crypto-material,crypto-asset,object-id,material-id,instance-id,alpha"});
    for (const char* layer : {"CryptoObject", "CryptoMaterial", "CryptoAsset"})
        check_cryptomatte(folder, std::string("all.exr ") + layer);
    CHECK_THAT(content(folder / "decoded.txt"), Catch::Contains(" box\n"));
    const auto crypto = [&](const char* file) {
        return onde::read_exr(folder / file, {"CryptoObject00.R", "CryptoObject00.G"});
    };
    const onde::Image alone = crypto("ball.exr"), all = crypto("all.exr");
    const onde::Image ids = onde::read_exr(folder / "all.exr", {"object_id.X", "instance_id.X"});
    size_t whole = 0;
    for (size_t i = 0; i < alone.pixels.size(); i += 2)
        if (alone.pixels[i + 1] == 1) { // the ball and nothing else
            CHECK(all.pixels[i] == alone.pixels[i]);
            CHECK(all.pixels[i + 1] == 1);
            CHECK(ids.pixels[i] == 3); // of the names floor, box, ball: meshes come first
            CHECK(ids.pixels[i + 1] == 3);
            ++whole;
        }
    CHECK(whole > 50);
    make("ball.toml", "blender.exr", {"crypto-object", "--exr-names", "blender"});
    check_cryptomatte(folder, "blender.exr ViewLayer.CryptoObject");
    make("ball.toml", "blender.exr", {"object-id", "--exr-names", "blender"});
    CHECK(onde::read_exr(folder / "blender.exr", {"ViewLayer.Object Id.X"}).channels == 1);
    make("all.toml", "a.png", {"crypto-object,instance-id"});
    CHECK(fs::exists(folder / "a.crypto-object.png"));
    CHECK(fs::exists(folder / "a.instance-id.png"));
}

TEST_CASE("ids of parts are joined to those of one render, whatever the split") {
    const Folder folder;
    folder.write("a.toml", NAMED_THINGS + FLOOR);
    const auto make = [&](Arguments more) {
        more.insert(more.end(), {"--spp", "136", "--aov", "crypto-object,material-id"});
        succeed(folder, render("a.toml", more));
    };
    make({"--film", "whole.exr", "-o", "whole_picture.exr"});
    make({"--film", "a.exr", "--samples", "0:64"});
    make({"--film", "b.exr", "--samples", "64:136", "--rectangle", "0,0,9,12", "--wave-size",
          "512"});
    make({"--film", "c.exr", "--samples", "64:136", "--rectangle", "9,0,7,12", "--engine",
          "megakernel"});
    succeed(folder, {"merge", "b.exr", "c.exr", "-o", "bc.exr"});
    succeed(folder, {"merge", "bc.exr", "a.exr", "-o", "all.exr", "--picture", "all_picture.exr"});
    CHECK(content(folder / "all.exr") == content(folder / "whole.exr"));
    const std::vector<std::string> names{"CryptoObject00.R", "CryptoObject00.G", "material_id.X"};
    CHECK(onde::read_exr(folder / "all_picture.exr", names).pixels ==
          onde::read_exr(folder / "whole_picture.exr", names).pixels);
    check_cryptomatte(folder, "all_picture.exr CryptoAsset");

    succeed(folder, render("a.toml", {"--spp", "50", "--aov", "crypto-object,material-id", "--film",
                                      "begun.exr"}));
    make({"--resume", "begun.exr"});
    CHECK(content(folder / "begun.exr") == content(folder / "whole.exr"));

    std::string renamed = NAMED_THINGS + FLOOR;
    renamed.replace(renamed.find("\"floor\""), 7, "\"ground\"");
    folder.write("b.toml", renamed);
    succeed(folder, render("b.toml", {"--spp", "136", "--samples", "64:136", "--film", "d.exr",
                                      "--aov", "crypto-object"}));
    const Outcome refused = onde::test::onde(folder, {"merge", "a.exr", "d.exr", "-o", "no.exr"});
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Catch::Contains("hash of names"));
}

TEST_CASE("things that are included belong to the asset that they came with") {
    const Folder folder;
    folder.write("part.toml", NAMED_THINGS + FLOOR);
    folder.write("whole.toml", "[[include]]\nfile = \"part.toml\"\n[[shape]]\ntype = \"sphere\"\n"
                               "name = \"own\"\ncenter = [2, 0, 0]\n");
    succeed(folder, render("whole.toml", {"-o", "a.exr", "--aov", "crypto-asset,crypto-object"}));
    check_cryptomatte(folder, "a.exr CryptoAsset");
    const std::string assets = content(folder / "decoded.txt");
    CHECK_THAT(assets, Catch::Contains(" part\n") && Catch::Contains(" own\n"));
    CHECK_THAT(assets, !Catch::Contains("ball"));
    check_cryptomatte(folder, "a.exr CryptoObject");
    CHECK_THAT(content(folder / "decoded.txt"), Catch::Contains(" ball\n"));
}
