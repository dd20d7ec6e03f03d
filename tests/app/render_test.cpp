// `onde render`: the picture, what goes with it, and how it ends.
#include "core/error.h"
#include "core/files.h"
#include "image/image_io.h"
#include "onde_process.h"
#include "support/folders.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>

using namespace onde::test;

namespace {

void check_is_picture(const fs::path& path, uint32_t width = 16, uint32_t height = 12) {
    INFO(path);
    const onde::Image image = onde::read_image(path);
    CHECK(image.width == width);
    CHECK(image.height == height);
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    CHECK(sum > 0.0);
}

std::vector<float> pixels_of(const Folder& folder, const std::string& name,
                             const Arguments& options) {
    Arguments all{"-o", name, "--float"};
    all.insert(all.end(), options.begin(), options.end());
    const Outcome outcome = onde::test::onde(folder, render(CORNELL, all));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return onde::read_image(folder / name).pixels;
}

} // namespace

TEST_CASE("a render writes every picture it was asked for and nothing else") {
    const Folder folder;
    const Outcome outcome =
        onde::test::onde(folder, render(CORNELL, {"-o", "a.png", "-o", "b.exr"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::Contains("wrote " + (folder / "a.png").string()));
    CHECK(folder.files().size() == 2);
    check_is_picture(folder / "a.png");
    check_is_picture(folder / "b.exr");
}

TEST_CASE("without a name the picture is named after the scene, in the current folder") {
    const Folder folder;
    CHECK(onde::test::onde(folder, render(CORNELL)).code == 0);
    CHECK(folder.files().size() == 1);
    check_is_picture(folder / "cornell.png");
}

TEST_CASE("a picture says how it was made") {
    const Folder folder;
    const Outcome outcome = onde::test::onde(
        folder, render(CORNELL, {"--seed", "7", "--spp", "3", "-o", "a.png", "-o", "b.exr"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const Outcome info = onde::test::onde(folder, {"info", CORNELL, "--json"});
    const std::string hash = nlohmann::json::parse(info.out).at("hash");
    for (const char* name : {"a.png", "b.exr"}) {
        INFO(name);
        const onde::ImageMetadata metadata = onde::read_image_metadata(folder / name);
        CHECK(metadata.at("onde:seed") == "7");
        CHECK(metadata.at("onde:samples") == "3");
        CHECK(metadata.at("onde:version") == ONDE_VERSION);
        CHECK(metadata.at("onde:scene_hash") == hash);
        CHECK_FALSE(metadata.at("onde:device").empty());
    }
}

TEST_CASE("--json writes the numbers of a render for scripts") {
    const Folder folder;
    const Outcome outcome =
        onde::test::onde(folder, render(CORNELL, {"-o", "a.png", "--json", "a.json"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.empty());
    const auto report = nlohmann::json::parse(content(folder / "a.json"));
    for (const char* key :
         {"scene", "scene_hash", "version", "device", "platform", "driver", "engine", "settings"})
        CHECK(report.at(key).is_string());
    for (const char* key :
         {"depth", "seed", "spheres", "instances", "load_seconds", "bvh_seconds", "pack_seconds",
          "kernel_build_seconds", "render_seconds", "write_seconds", "total_seconds", "scene_bytes",
          "state_bytes", "film_bytes", "mrays_per_second", "invalid_samples"})
        CHECK(report.at(key).is_number());
    CHECK(report.at("width") == 16);
    CHECK(report.at("height") == 12);
    CHECK(report.at("samples") == 1.0);
    CHECK(report.at("triangles") == 36);
    CHECK(report.at("interrupted") == false);
    CHECK(report.at("kernels_from_cache").is_boolean());
    CHECK(report.at("closest_hit_rays").at(0) == 16 * 12);
    CHECK(report.at("shadow_rays").is_array());
    CHECK(report.at("kernels").at("fused").at("launches") == 1);
}

TEST_CASE("a scene given to another integrator is rendered, and what was mapped is told") {
    const Folder folder;
    const std::string furnace = in_project("scenes/furnace.toml"); // of depth 256
    const Outcome whitted =
        onde::test::onde(folder, render(furnace, {"--integrator", "whitted", "-o", "w.png"}));
    INFO(whitted.err);
    CHECK(whitted.code == 0);
    CHECK_THAT(whitted.err, Catch::Contains("depth of 256 was cut to 255"));
    const std::string tori = in_project("scenes/chapter/tori.toml");
    const Outcome path =
        onde::test::onde(folder, render(tori, {"--integrator", "path", "-o", "p.png"}));
    INFO(path.err);
    CHECK(path.code == 0);
    CHECK_THAT(path.err, Catch::Contains("phong materials were taken as physical ones: 3 diffuse, "
                                         "1 dielectric"));
}

TEST_CASE("--quiet prints nothing") {
    const Folder folder;
    const Outcome outcome = onde::test::onde(folder, render(CORNELL, {"--quiet"}));
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
}

TEST_CASE("the first render compiles, the second takes the kernels from the cache") {
    const Folder folder;
    const Environment own_cache{{"ONDE_CACHE_DIR", (folder / "cache").string()}};
    const auto render_once = [&](const Arguments& options) {
        return onde::test::onde(folder, render(CORNELL, options), own_cache);
    };
    const Outcome first = render_once({"--stats"});
    INFO(first.out << first.err);
    CHECK(first.code == 0);
    CHECK_THAT(first.err, Catch::Contains("kernels compiled in "));
    CHECK_THAT(first.out, Catch::Contains("kernels   compiled in "));
    const Outcome second = render_once({"--stats"});
    CHECK_THAT(second.err, Catch::Contains("kernels loaded in "));
    CHECK_THAT(second.out, Catch::Contains("kernels   loaded from the cache in "));

    for (const auto& entry : fs::directory_iterator(folder / "cache"))
        std::ofstream(entry.path(), std::ios::binary | std::ios::app) << "damage";
    const Outcome damaged = render_once({});
    CHECK(damaged.code == 0);
    CHECK_THAT(damaged.err, Catch::Contains("kernels compiled in "));
}

TEST_CASE("the same seed gives the same pixels and another seed others") {
    const Folder folder;
    const auto seven = pixels_of(folder, "a.exr", {"--seed", "7"});
    CHECK(pixels_of(folder, "b.exr", {"--seed", "7"}) == seven);
    CHECK(pixels_of(folder, "c.exr", {"--seed", "8"}) != seven);
}

TEST_CASE("--light-sampler decides which light a path samples, and so which film goes on") {
    const Folder folder;
    const std::string lights = in_project("scenes/lights.toml");
    const auto film_by = [&](const char* sampler, const Arguments& more) {
        Arguments all{"--light-sampler", sampler, "--spp", "64", "--film"};
        all.insert(all.end(), more.begin(), more.end());
        return onde::test::onde(folder, render(lights, all));
    };
    REQUIRE(film_by("power", {"power.exr"}).code == 0);
    REQUIRE(film_by("auto", {"auto.exr"}).code == 0); // few lights
    REQUIRE(film_by("tree", {"tree.exr"}).code == 0);
    const auto pixels = [&](const char* name) { return onde::read_image(folder / name).pixels; };
    CHECK(pixels("power.exr") == pixels("auto.exr"));
    CHECK(pixels("power.exr") != pixels("tree.exr"));
    const Outcome other = film_by("power", {"next.exr", "--resume", "tree.exr"});
    CHECK(other.code == 2);
    CHECK_THAT(other.err, Catch::Contains("light sampler"));
    CHECK(film_by("bvh", {"next.exr"}).code == 2);
    // The scene may say it too.
    std::string scene = onde::read_file(lights);
    scene.insert(scene.find("[render]\n") + 9, "light_sampler = \"tree\"\n");
    std::ofstream(folder / "own.toml") << scene;
    REQUIRE(onde::test::onde(
                folder, {"render", "own.toml", "--size", "32x24", "--spp", "4", "-o", "own.exr"})
                .code == 0);
    const auto own = pixels("own.exr");
    const auto by = [&](const char* sampler) {
        const Outcome outcome =
            onde::test::onde(folder, {"render", "own.toml", "--size", "32x24", "--spp", "4",
                                      "--light-sampler", sampler, "-o", "by.exr"});
        REQUIRE(outcome.code == 0);
        return pixels("by.exr");
    };
    CHECK(own == by("tree"));
    CHECK(own != by("power"));
}

TEST_CASE("a render in small waves has the pixels of a render in one") {
    const Folder folder;
    const Arguments samples{"--spp", "5"}, small{"--spp", "5", "--wave-size", "512"};
    CHECK(pixels_of(folder, "a.exr", samples) == pixels_of(folder, "b.exr", small));
}

TEST_CASE("--time ends a render with as many samples in every pixel as there was time for") {
    const Folder folder;
    const Outcome outcome = onde::test::onde(
        folder,
        render(CORNELL, {"--time", "0.3", "--spp", "10000000", "--json", "a.json", "-o", "a.png"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    check_is_picture(folder / "a.png");
    const auto report = nlohmann::json::parse(content(folder / "a.json"));
    const double samples = report.at("samples");
    CHECK(samples >= 1);
    CHECK(samples < 10000000);
    CHECK(samples == std::floor(samples));
    CHECK(report.at("render_seconds") >= 0.3);
    CHECK(report.at("interrupted") == false);
}

TEST_CASE("Ctrl-C saves the picture so far and ends with code 130") {
    const Folder folder;
    Process process(folder, render(CORNELL, {"--spp", "10000000", "-o", "a.png"}));
    REQUIRE(process.wait_until_interrupt_is_caught(true));
    std::this_thread::sleep_for(std::chrono::milliseconds(300)); // for the first samples
    process.send(SIGINT);
    const Outcome outcome = process.wait();
    INFO(outcome.err);
    CHECK(outcome.code == 130);
    CHECK_THAT(outcome.err, Catch::Contains("saving the picture so far"));
    check_is_picture(folder / "a.png");
    CHECK(folder.files().size() == 1);
    const std::string samples = onde::read_image_metadata(folder / "a.png").at("onde:samples");
    CHECK(std::stod(samples) > 0.0);
    CHECK(std::stod(samples) < 10000000.0);
}

TEST_CASE("a second Ctrl-C ends the program at once and leaves the old picture alone") {
    const Folder folder;
    folder.write("a.png", "a picture that took days");
    const auto before = folder.files();
    // Waves of seconds, so that the render is still busy with one.
    Process process(folder, render(CORNELL, {"--size", "1024x1024", "--spp", "1000000",
                                             "--wave-size", "4194304", "-o", "a.png"}));
    REQUIRE(process.wait_until_interrupt_is_caught(true));
    process.send(SIGINT);
    REQUIRE(process.wait_until_interrupt_is_caught(false));
    process.send(SIGINT);
    const Outcome outcome = process.wait();
    CHECK(outcome.signal == SIGINT);
    CHECK(folder.files() == before);
}

namespace {

std::vector<std::string> cost_names() {
    return {"traversal_cost.R", "traversal_cost.G", "traversal_cost.B"};
}

} // namespace

TEST_CASE("--aov traversal-cost writes what each pixel tests beside every picture") {
    const Folder folder;
    const Outcome outcome = onde::test::onde(
        folder, render(CORNELL, {"-o", "a.png", "-o", "b.exr", "--aov", "traversal-cost"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(folder.files().size() == 3);
    check_is_picture(folder / "a.traversal-cost.png");
    double sum = 0;
    const onde::Image counts = onde::read_exr(folder / "b.exr", cost_names());
    for (size_t i = 0; i < counts.pixels.size(); i += 3) {
        CHECK(counts.pixels[i] + counts.pixels[i + 1] == counts.pixels[i + 2]);
        sum += counts.pixels[i + 2];
    }
    CHECK_THAT(outcome.err, Catch::Contains(std::to_string(long(sum)) + " tests of boxes"));
}

TEST_CASE("--aov alpha writes the matte that a transparent background gives the picture") {
    const Folder folder;
    folder.write("ball.toml", "[camera]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n"
                              "[[shape]]\ntype = \"sphere\"\n[environment]\nradiance = 1\n");
    const Outcome outcome =
        onde::test::onde(folder, render("ball.toml", {"-o", "a.png", "--spp", "4", "--aov", "alpha",
                                                      "--background", "transparent"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto image_of = [&](const char* name) {
        const std::string bytes = content(folder / name);
        return onde::decode_texels({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()},
                                   name);
    };
    const onde::TexelImage picture = image_of("a.png"), matte = image_of("a.alpha.png");
    std::set<uint8_t> seen;
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
        CHECK(std::abs(int(matte.rgba[i]) - int(picture.rgba[i + 3])) <= 1);
        seen.insert(matte.rgba[i]);
    }
    CHECK((seen.contains(0) && seen.contains(255) && seen.size() > 3));
}

TEST_CASE("--aov sample-count writes how many samples each pixel has") {
    const Folder folder;
    const Outcome outcome =
        onde::test::onde(folder, render(CORNELL, {"--spp", "70", "-o", "a.png", "-o", "b.exr",
                                                  "--aov", "sample-count,traversal-cost"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(folder.files().size() == 4);
    const onde::Image counts = onde::read_exr(folder / "b.exr", {"sample_count.X"});
    CHECK(counts.channels == 1);
    CHECK(std::ranges::all_of(counts.pixels, [](float count) { return count == 70; }));
    const onde::Image white = onde::read_image(folder / "a.sample-count.png");
    CHECK(std::ranges::all_of(white.pixels, [](float value) { return value == 1; }));
}

TEST_CASE("an .exr has every channel that is asked for, by names of one's choice") {
    const Folder folder;
    const auto channels = [&](const char* file, Arguments more) {
        Arguments options{"--spp", "4",
                          "-o",    file,
                          "--aov", "depth,normal,denoise-albedo,uv,direct,variance,sample-count"};
        options.insert(options.end(), more.begin(), more.end());
        const Outcome outcome = onde::test::onde(folder, render(CORNELL, options));
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
    };
    channels("plain.exr", {});
    channels("blender.exr", {"--exr-names", "blender"});
    CHECK(folder.files().size() == 2);
    const std::pair<const char*, const char*> pairs[] = {
        {"R", "ViewLayer.Combined.R"},
        {"depth.Z", "ViewLayer.Depth.Z"},
        {"normal.X", "ViewLayer.Normal.X"},
        {"denoise_albedo.G", "ViewLayer.Denoising Albedo.G"},
        {"uv.U", "ViewLayer.UV.U"},
        {"direct.B", "ViewLayer.Direct.B"},
        {"variance.R", "ViewLayer.Variance.R"},
        {"sample_count.X", "ViewLayer.Sample Count.X"}};
    for (const auto& [plain, blender] : pairs) {
        INFO(plain);
        const onde::Image a = onde::read_exr(folder / "plain.exr", {plain});
        CHECK(a.pixels == onde::read_exr(folder / "blender.exr", {blender}).pixels);
        CHECK(std::ranges::any_of(a.pixels, [](float number) { return number != 0; }));
    }
    const onde::Image down = onde::read_exr(folder / "plain.exr", {"uv.U", "uv.V"});
    const onde::Image up = onde::read_exr(folder / "blender.exr", {"ViewLayer.UV.V"});
    for (size_t i = 0; i < up.pixels.size(); i++) {
        const bool is_surface = down.pixels[2 * i] != 0 || down.pixels[2 * i + 1] != 0;
        CHECK(up.pixels[i] == (is_surface ? 1 - down.pixels[2 * i + 1] : 0));
    }
    CHECK_THROWS_AS(onde::read_exr(folder / "plain.exr", {"depth.R"}), onde::InputError);
}

TEST_CASE("plain trees and the watertight option render the production tree's picture") {
    const Folder folder;
    const std::vector<float> expected = pixels_of(folder, "a.exr", {});
    CHECK(pixels_of(folder, "b.exr", {"--bvh", "median"}) == expected);
    CHECK(pixels_of(folder, "c.exr", {"--bvh", "median-spatial"}) == expected);
    CHECK(pixels_of(folder, "d.exr", {"--bvh", "none"}) == expected);
    CHECK(pixels_of(folder, "e.exr", {"--watertight"}).size() == expected.size());
}

TEST_CASE(
    "a tree in a layout for GPUs renders the wide one's picture, with and without instances") {
    const Folder folder;
    for (const char* scene : {"cornell", "instances"}) {
        const std::string file = in_project(fmt::format("scenes/{}.toml", scene));
        std::vector<onde::Image> pictures;
        for (const char* layout : {"wide", "compressed", "binary"}) {
            INFO(scene << ", " << layout);
            const std::string output = fmt::format("{}.exr", layout);
            const Outcome outcome =
                onde::test::onde(folder, render(file, {"--layout", layout, "--float", "-o", output,
                                                       "--aov", "traversal-cost"}));
            INFO(outcome.err);
            REQUIRE(outcome.code == 0);
            pictures.push_back(onde::read_image(folder / output));
            // Where distances round otherwise, a path may go another way.
            const auto& expected = pictures[0].pixels;
            size_t equal = 0;
            for (size_t i = 0; i < expected.size(); ++i)
                equal += std::abs(pictures.back().pixels[i] - expected[i]) <=
                         1e-4f * std::abs(expected[i]);
            CHECK(equal >= expected.size() * 98 / 100);
            const onde::Image counts = onde::read_exr(folder / output, cost_names());
            for (size_t i = 0; i < counts.pixels.size(); i += 3)
                CHECK(counts.pixels[i + 2] > 0); // every ray tests the root's boxes
        }
    }
}

TEST_CASE(
    "every integrator that traces rays makes the wide tree's picture from the other layouts") {
    const Folder folder;
    const std::string five = in_project("scenes/chapter/five-objects.toml");
    const std::string tori = in_project("scenes/chapter/tori-glass.toml");
    const std::pair<std::string, const char*> pictures[] = {
        {five, "whitted"}, {tori, "whitted"}, {CORNELL, "light"}};
    for (const auto& [scene, integrator] : pictures) {
        std::vector<float> expected;
        for (const char* layout : {"wide", "compressed", "binary"}) {
            INFO(scene << ", " << integrator << ", " << layout);
            const Outcome outcome =
                onde::test::onde(folder, render(scene, {"--integrator", integrator, "--layout",
                                                        layout, "--float", "-o", "picture.exr"}));
            INFO(outcome.err);
            REQUIRE(outcome.code == 0);
            const std::vector<float> pixels = onde::read_image(folder / "picture.exr").pixels;
            if (expected.empty()) expected = pixels;
            size_t equal = 0;
            for (size_t i = 0; i < pixels.size(); ++i)
                equal += std::abs(pixels[i] - expected[i]) <= 1e-4f * std::abs(expected[i]);
            CHECK(equal >= expected.size() * 98 / 100);
        }
    }
}

TEST_CASE("onde volumes prints a line for every volume and hierarchy, and plots them") {
    const Folder folder;
    const Outcome outcome = onde::test::onde(
        folder, {"volumes", CORNELL, "--rays", "4096", "--trials", "1e4", "--plot", "plot.svg"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    for (const char* name : {"box", "oriented box", "7 slabs", "13 slabs", "sphere", "none",
                             "median", "median, spatial cuts", "SAH, 16 wide"}) {
        CHECK_THAT(outcome.out, Catch::Contains(std::string("\n") + name + " "));
        CHECK_THAT(content(folder / "plot.svg"), Catch::Contains(std::string(">") + name + "<"));
    }
    CHECK_THAT(outcome.out, Catch::Contains("sphere                rejected 0 rays that hit"));
}
