// What users ask of a load, whatever the format: strictness, a root folder, a limit of memory.
#include "scene/load_context.h"
#include "scene/mean_color.h"
#include "scratch.h"

#include <algorithm>
#include <limits>

using namespace onde;
using onde::test::ScratchFolder;

namespace {

std::string error_with(const LoadOptions& options, const std::filesystem::path& path) {
    try {
        load_scene(path, options);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("a root folder lets references leave the scene's folder, but not the root") {
    ScratchFolder folder;
    folder.write("textures/blue.png", test::blue_png());
    const auto scene = folder.write("scenes/a.toml", R"(
[[material]]
name = "m"
base_color_texture = "../textures/blue.png"
[[shape]]
type = "sphere"
material = "m"
)");
    CHECK_THAT(error_with({}, scene), Catch::Contains("--root"));
    CHECK(error_with({.root = folder.path()}, scene).empty());
    CHECK_THAT(error_with({.root = folder.path() / "scenes"}, scene), Catch::Contains("leaves"));
    CHECK_THAT(error_with({.root = folder.path() / "textures"}, scene), Catch::Contains("leaves"));
}

TEST_CASE("strict notes refuse what is wrong, but not what is merely left out") {
    LoadContext strict({.strict = true}), tolerant;
    Notes notes = tolerant.notes_of("a.obj");
    notes.wrong("Bad normals are replaced", "mesh 3");
    CHECK(notes.sentences() == std::vector<std::string>{"Bad normals are replaced (mesh 3)."});
    Notes refused = strict.notes_of("a.obj");
    refused.add("Lines are skipped");
    CHECK(refused.sentences().size() == 1);
    CHECK_THROWS_WITH(refused.wrong("Bad normals are replaced", "mesh 3"),
                      Catch::StartsWith("a.obj: mesh 3: Bad normals are replaced"));
}

TEST_CASE("a load's budget is one for all that it loads and can't be passed by an overflow") {
    LoadContext context({.limit = 1000});
    context.spend(10, 60, "a");
    CHECK(context.left() == 400);
    CHECK_THROWS_WITH(context.spend(1, 401, "b.gltf: mesh 0"),
                      Catch::StartsWith("b.gltf: mesh 0") && Catch::Contains("--load-limit"));
    CHECK_THROWS_AS(context.spend(uint64_t(1) << 61, 8, "c"), InputError);
    context.spend(400, 1, "d");
    CHECK(context.left() == 0);
}

TEST_CASE("includes of includes of lights are refused before they take the memory") {
    ScratchFolder folder;
    folder.write("0.toml", "[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 1\n");
    std::string ten;
    for (int i = 0; i < 10; ++i) ten += "\"NAME.toml\", ";
    for (int level = 1; level <= 8; ++level) {
        std::string text = "include = [" + ten + "]\n[[shape]]\ntype = \"sphere\"\n";
        for (size_t at; (at = text.find("NAME")) != std::string::npos;)
            text.replace(at, 4, std::to_string(level - 1));
        folder.write(std::to_string(level) + ".toml", text);
    }
    CHECK(error_with({}, folder.path() / "3.toml").empty());
    CHECK_THAT(error_with({}, folder.path() / "8.toml"), Catch::Contains("include fewer"));
    LoadOptions little;
    little.limit = 1 << 16;
    CHECK_THAT(error_with(little, folder.path() / "3.toml"), Catch::Contains("--load-limit"));
}

TEST_CASE("an image is counted by its header, before it is decoded") {
    ScratchFolder folder; // 4096 x 4096 pixels, of which most are missing
    folder.write("big.bmp", std::string("BM\0\0\0\0\0\0\0\0\x1a\0\0\0\x0c\0\0\0", 18) +
                                std::string("\x00\x10\x00\x10\x01\0\x18\0", 8) +
                                std::string(300000, 'x'));
    const auto obj = folder.write("a.obj", "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                           "f 1 2 3\n");
    folder.write("a.mtl", "newmtl a\nmap_Kd big.bmp\n");
    LoadOptions little;
    little.limit = 100 << 20;
    CHECK_THAT(error_with(little, obj),
               Catch::Contains("big.bmp") && Catch::Contains("--load-limit"));
    CHECK(error_with({}, obj).empty()); // there it is only damaged, which costs the texture
}

TEST_CASE("textures of TOML materials that nothing in the scene has are not read") {
    ScratchFolder folder;
    folder.write("no.png", "no picture");
    const std::string materials = "[[material]]\nname = \"a\"\nbase_color_texture = \"no.png\"\n"
                                  "[[material]]\nname = \"b\"\n[[shape]]\ntype = \"sphere\"\n";
    CHECK(error_with({}, folder.write("b.toml", materials + "material = \"b\"\n")).empty());
    CHECK_THAT(error_with({}, folder.write("a.toml", materials + "material = \"a\"\n")),
               Catch::Contains("no.png"));
    const auto wrong = folder.write("c.toml", "[[material]]\nname = \"a\"\nbase_color_texture = 1\n"
                                              "[[shape]]\ntype = \"sphere\"\n");
    CHECK_THAT(error_with({}, wrong), Catch::Contains("base_color_texture must be a text"));
}

TEST_CASE("pixels of a texture that are negative, infinite or no numbers are counted in a note") {
    ScratchFolder folder;
    constexpr float INF = std::numeric_limits<float>::infinity();
    constexpr float NAN_ = std::numeric_limits<float>::quiet_NaN();
    folder.write("odd.pfm",
                 "PF\n5 1\n-1\n" + test::bytes_of({0.5f, -0.5f, -1.0f, INF, 0.0f, 0.0f, NAN_, 0.0f,
                                                   0.0f, 0.5f, 9.0f, 0.0f, -0.0f, 0.0f, 1.0f}));
    const Scene scene = load_scene(folder.write("a.toml", R"(
[[material]]
name = "m"
base_color_texture = "odd.pfm"
[[shape]]
type = "sphere"
material = "m"
)"));
    const auto told = std::ranges::count_if(scene.notes, [](const std::string& note) {
        return note.starts_with("3 pixels of the texture odd.pfm are negative, infinite");
    });
    CHECK(told == 1);
    const TexelImage& image = scene.textures[0].image;
    CHECK(image.sample(1) == 0);     // -0.5
    CHECK(image.sample(4) == 65504); // infinite
    CHECK(image.sample(8) == 0);     // no number
    CHECK(image.sample(13) == 9);    // beyond white
}

TEST_CASE("floats of a texture are linear, as colours and as data") {
    ScratchFolder folder;
    folder.write("half.pfm", "PF\n1 1\n-1\n" + test::bytes_of({0.5f, 0.5f, 0.5f}));
    const Scene scene = load_scene(folder.write("a.toml", R"(
[[material]]
name = "m"
kind = "metallic-roughness"
base_color_texture = "half.pfm"
metallic_roughness_texture = "half.pfm"
emission_texture = "half.pfm"
[[shape]]
type = "sphere"
material = "m"
)"));
    const Material& m = scene.materials[0];
    CHECK(scene.textures[0].image.floats == std::vector<float>{0.5f, 0.5f, 0.5f, 1.0f});
    CHECK(m.base_color_texture == 0);
    CHECK(m.emission_texture == 0);
    CHECK(scene.textures[size_t(m.metallic_roughness_texture)].same_image_as == 0);
    CHECK(mean_color(scene, 0) == glm::vec3(0.5f));
    CHECK(mean_color(scene, m.metallic_roughness_texture) == glm::vec3(0.5f));
}
