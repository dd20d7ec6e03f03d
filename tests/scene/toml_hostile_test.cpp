// Mistakes in a scene file: each gets one sentence with the file, the line, the key and the remedy.
#include "scratch.h"

using namespace onde;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

const std::string SPHERE = "[[shape]]\ntype = \"sphere\"\n";

struct Case {
    std::string toml;
    std::vector<std::string> culprits;
};

void check_refused(const Case& c) {
    ScratchFolder folder;
    folder.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    INFO(c.toml.substr(0, 200));
    const std::string error = load_error(folder.write("evil.toml", c.toml));
    CHECK_THAT(error, Catch::Contains("evil.toml"));
    for (const std::string& culprit : c.culprits) CHECK_THAT(error, Catch::Contains(culprit));
    CHECK(error.find('\n') == std::string::npos);
}

} // namespace

TEST_CASE("a misspelt key is refused with its place and the nearest key") {
    check_refused(
        {SPHERE + "raduis = 2\n", {"evil.toml:3:", "shape[0].raduis", "did you mean 'radius'"}});
    check_refused({"shapes = 1\n", {"evil.toml:1:", "shapes", "'shape'"}});
    check_refused({SPHERE + "[render]\nspp = 4\n", {"render.spp", "samples"}});
    check_refused({SPHERE + "edge1 = [1, 2, 3]\n", {"shape[0].edge1"}});
}

TEST_CASE("the keys that a table may have are listed once each") {
    ScratchFolder folder;
    const std::string error = load_error(
        folder.write("evil.toml", SPHERE + "[[material]]\nname = \"a\"\nspekular = 1\n"));
    const std::string listed = error.substr(error.find("Allowed: "));
    const size_t first = listed.find(" specular,");
    CHECK(first != std::string::npos);
    CHECK(listed.find(" specular,", first + 1) == std::string::npos);
}

TEST_CASE("values of the wrong type are refused with their key") {
    for (const Case& c : std::vector<Case>{
             {SPHERE + "radius = \"big\"\n", {":3:", "shape[0].radius", "number"}},
             {SPHERE + "radius = true\n", {"radius", "number"}},
             {SPHERE + "center = [1, 2]\n", {"shape[0].center", "3 numbers"}},
             {SPHERE + "center = 1\n", {"shape[0].center", "3 numbers"}},
             {SPHERE + "[render]\nsamples = 1.5\n", {"render.samples", "whole number"}},
             {SPHERE + "material = 5\n", {"shape[0].material", "text"}},
             {"shape = 5\n", {"shape", "[[shape]]"}},
             {"shape = [1, 2]\n", {"shape", "[[shape]]"}},
             {SPHERE + "include = 5\n", {"include"}},
             {"include = [5]\n", {"include", "texts"}},
             {SPHERE + "[[material]]\nname = \"a\"\ntwo_sided = 1\n",
              {"two_sided", "true or false"}}})
        check_refused(c);
}

TEST_CASE("an aperture of two blades is refused") {
    check_refused({SPHERE +
                       "[[camera]]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\naperture_blades "
                       "= 2\n",
                   {"camera", "at least 3 blades"}});
}

TEST_CASE("blends and media that can't be are refused") {
    const std::string material = SPHERE + "[[material]]\nname = \"a\"\n";
    check_refused({material + "blend_with = \"b\"\n", {"material[0].blend_with", "'b'"}});
    check_refused({material + "blend_with = \"a\"\n", {"blend_with", "another material"}});
    check_refused(
        {material + "medium = { scattering = 1 }\n", {"'a'", "medium needs a clear kind"}});
    check_refused({material + "kind = \"dielectric\"\nmedium = { scatering = 1 }\n",
                   {"medium.scatering", "'scattering'"}});
    check_refused(
        {SPHERE + "[medium]\nscattering = -1\n", {"medium.scattering", "must not be negative"}});
    check_refused({SPHERE + "[medium]\nanisotropy = 1\n", {"medium.anisotropy", "0.99"}});
}

TEST_CASE("values out of range are refused with what is allowed") {
    for (const Case& c : std::vector<Case>{
             {SPHERE + "radius = -1\n", {"shape[0].radius", "above 0", "-1"}},
             {SPHERE + "radius = 0\n", {"shape[0].radius", "above 0"}},
             {SPHERE + "radius = nan\n", {"shape[0].radius"}},
             {SPHERE + "center = [inf, 0, 0]\n", {"shape[0].center", "finite"}},
             {SPHERE + "center = [1e300, 0, 0]\n",
              {"shape[0].center", "too large for single precision, which ends at 3.4e+38"}},
             {SPHERE + "radius = 1e39\n", {"shape[0].radius", "too large", "not 1e+39"}},
             {SPHERE + "radius = -1e39\n", {"shape[0].radius", "above 0"}},
             {SPHERE + "[film]\nsize = [0, 100]\n", {"film.size", "between 1 and 65535"}},
             {SPHERE + "[film]\nsize = [1.5, 100]\n", {"film.size", "whole"}},
             {SPHERE + "[render]\nsamples = 0\n", {"render.samples", "between 1"}},
             {SPHERE + "[render]\ndepth = 1024\n", {"render.depth", "between 1 and 1023"}},
             {SPHERE + "[render]\nfilter = \"boxx\"\n", {"render.filter", "'box'"}},
             {SPHERE + "[[material]]\nname = \"a\"\ncolor = 2\n", {"material[0].color", "0 and 1"}},
             {SPHERE + "[[material]]\nname = \"a\"\nemission = -1\n",
              {"material[0].emission", "be negative"}},
             {SPHERE + "[[material]]\nname = \"a\"\nkind = \"metal\"\n", {"kind", "conductor"}},
             {"[[shape]]\ntype = \"box\"\nscale = [1, 0, 1]\n",
              {"shape[0].scale", "must not be 0"}},
             {"[[shape]]\ntype = \"cube\"\n", {"shape[0].type", "sphere, rectangle"}}})
        check_refused(c);
}

TEST_CASE("what would mean nothing is refused, not taken for absent") {
    const std::string camera = "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n";
    const std::string glass = "[[material]]\nname = \"a\"\nkind = \"dielectric\"\n";
    const std::string point = "[[light]]\ntype = \"point\"\nposition = [0, 3, 0]\n";
    const std::string disk = "[[light]]\ntype = \"disk\"\n";
    for (const Case& c : std::vector<Case>{
             {SPHERE + camera + "orthographic_height = 0\n", {"orthographic_height", "above 0"}},
             {SPHERE + camera + "orthographic_height = -2\n", {"orthographic_height", "above 0"}},
             {SPHERE + glass + "abbe = 0\n", {"material[0].abbe", "above 0"}},
             {SPHERE + point + "intensity = 0\nchapter_intensity = 1\n", {"intensity", "black"}},
             {SPHERE + point + "intensity = 1\nchapter_intensity = 0\n",
              {"chapter_intensity", "black"}},
             {SPHERE + disk + "radiance = 1\nchapter_intensity = 0\n",
              {"light[0].chapter_intensity", "black"}}})
        check_refused(c);
}

TEST_CASE("what is missing is named") {
    for (const Case& c : std::vector<Case>{
             {"", {"empty"}},
             {"[film]\nsize = [8, 8]\n", {"empty"}},
             {"[[shape]]\n", {"shape[0].type", "missing"}},
             {SPHERE + "[[material]]\n", {"material[0].name", "missing"}},
             {SPHERE + "[camera]\nlook_at = [0, 0, 0]\n", {"camera.position", "missing"}},
             {SPHERE + "[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\n",
              {"intensity", "missing"}},
             {"[[shape]]\ntype = \"mesh\"\n", {"positions"}},
             {"[[shape]]\ntype = \"mesh\"\nfile = \"gone.obj\"\n", {"gone.obj", "does not exist"}},
             {"[[include]]\nfile = \"gone.glb\"\n", {"include[0].file", "gone.glb"}},
             {SPHERE + "[environment]\nmap = \"gone.hdr\"\n", {"environment.map", "gone.hdr"}},
             {SPHERE + "[[material]]\nname = \"a\"\nbase_color_texture = \"gone.png\"\n",
              {"material[0].base_color_texture", "gone.png"}}})
        check_refused(c);
}

TEST_CASE("a material that does not exist is named beside those that do") {
    check_refused({"[[material]]\nname = \"clay\"\n" + SPHERE + "material = \"cley\"\n",
                   {"shape[0].material", "'cley'", "clay"}});
    check_refused({"[[material]]\nname = \"a\"\n[[material]]\nname = \"a\"\n" + SPHERE,
                   {"material[1].name", "taken"}});
}

TEST_CASE("cameras that look nowhere are refused") {
    check_refused({SPHERE + "[camera]\nposition = [1, 1, 1]\nlook_at = [1, 1, 1]\n",
                   {"camera.look_at", "differ"}});
    check_refused({SPHERE + "[camera]\nposition = [0, 5, 0]\nlook_at = [0, 0, 0]\n",
                   {"camera.up", "parallel"}});
    check_refused(
        {SPHERE + "[camera]\nposition = [0, 5, 1]\nlook_at = [0, 0, 0]\nvertical_fov = 180\n",
         {"camera.vertical_fov"}});
}

TEST_CASE("meshes with bad indices and rectangles without area are refused") {
    check_refused({"[[shape]]\ntype = \"mesh\"\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n"
                   "triangles = [[0, 1, 3]]\n",
                   {"shape[0].triangles", "index 3"}});
    check_refused({"[[shape]]\ntype = \"mesh\"\npositions = [[0, 0]]\ntriangles = []\n",
                   {"shape[0].positions", "rows of three"}});
    check_refused({"[[shape]]\ntype = \"rectangle\"\ncorner = [0, 0, 0]\nedge1 = [1, 0, 0]\n"
                   "edge2 = [2, 0, 0]\n",
                   {"shape[0].edge2", "parallel"}});
}

TEST_CASE("files out of the scene's folder are refused") {
    check_refused({"include = [\"../tri.obj\"]\n", {"include", "leaves the scene's folder"}});
    check_refused({"include = [\"/etc/passwd\"]\n", {"include", "absolute"}});
    check_refused(
        {SPHERE + "[environment]\nmap = \"../sky.hdr\"\n", {"environment.map", "leaves"}});
}

TEST_CASE("a scene that includes itself is refused, directly or in a circle") {
    check_refused({"include = [\"evil.toml\"]\n", {"includes itself"}});
    ScratchFolder folder;
    folder.write("b.toml", "include = [\"a.toml\"]\n");
    CHECK_THAT(load_error(folder.write("a.toml", "include = [\"b.toml\"]\n")),
               Catch::Contains("includes itself"));
}

TEST_CASE("includes that are too deep or multiply beyond all memory are refused") {
    ScratchFolder folder;
    folder.write("s0.toml", SPHERE);
    for (int i = 1; i <= 20; ++i)
        folder.write("s" + std::to_string(i) + ".toml",
                     "include = [\"s" + std::to_string(i - 1) + ".toml\"]\n");
    CHECK_THAT(load_error(folder.path() / "s20.toml"), Catch::Contains("deep"));
    CHECK(load_error(folder.path() / "s10.toml").empty());
    folder.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::string inner = "tri.obj";
    for (int level = 0; level < 6; ++level) {
        std::string toml = "include = [";
        for (int i = 0; i < 200; ++i) toml += "\"" + inner + "\", ";
        inner = "m" + std::to_string(level) + ".toml";
        folder.write(inner, toml + "]\n");
    }
    CHECK_THAT(load_error(folder.path() / inner), Catch::Contains("include fewer"));
}

TEST_CASE("a glowing sphere that an include would stretch is refused") {
    ScratchFolder folder;
    folder.write("ball.toml", "[[light]]\ntype = \"sphere\"\nradiance = 1\n");
    const auto path =
        folder.write("evil.toml", "[[include]]\nfile = \"ball.toml\"\nscale = [1, 2, 1]\n");
    CHECK_THAT(load_error(path), Catch::Contains("evil.toml:2") && Catch::Contains("ball.toml") &&
                                     Catch::Contains("stretched"));
}

TEST_CASE("impossible shapes are refused with their line") {
    const std::string torus = "[[shape]]\ntype = \"torus\"\n";
    check_refused({torus + "minor_radius = 1\n", {"minor_radius", "below major_radius"}});
    check_refused({torus + "major_radius = 0\n", {"major_radius"}});
    check_refused({torus + "scale = [1, 0, 1]\n", {"scale"}});
    check_refused({torus + "radius = 1\n", {"radius"}});
    check_refused({"[[shape]]\ntype = \"cone\"\nheight = -1\n", {"height"}});
    check_refused({"[[shape]]\ntype = \"cylinder\"\nradius = nan\n", {"radius"}});
    check_refused({"[[shape]]\ntype = \"donut\"\n", {"did you mean"}});
}

TEST_CASE("control characters of a scene file do not reach its sentences") {
    for (const std::string toml :
         {"\"a\\u001b[31m\\n\" = 1\n", "[film]\n\"\\n\" = 2\n", "include = [\"a\\n.obj\"]\n",
          "include = [\"../a\\u0007\"]\n", "[[material]]\nname = \"m\"\nkind = \"\\n\"\n",
          "[[shape]]\ntype = \"sphere\"\nmaterial = \"\\u001b\"\n"}) {
        ScratchFolder folder;
        const std::string error = load_error(folder.write("evil.toml", toml));
        CHECK_THAT(error, Catch::Contains("evil.toml"));
        for (const char c : error) CHECK((c >= ' ' || c < 0));
    }
}

TEST_CASE("damaged TOML is refused with its line") {
    check_refused({"[film]\nsize = [1,\n", {"not valid TOML"}});
    check_refused({"a = = 2\n", {"evil.toml:1:"}});
    check_refused({std::string(100000, '['), {"nested too deep"}});
    check_refused({"a = " + std::string(100000, '['), {"nested too deep"}});
    check_refused({"\xff\xfe\x00", {"not valid TOML"}});
}

TEST_CASE("files that are missing, folders or of no known format are refused") {
    ScratchFolder folder;
    CHECK_THAT(load_error(folder.path() / "gone.toml"), Catch::Contains("gone.toml"));
    CHECK_THAT(load_error(folder.path() / "gone.gltf"), Catch::Contains("gone.gltf"));
    CHECK_THAT(load_error(folder.write("a.blend", "x")),
               Catch::Contains("a.blend") && Catch::Contains(".gltf"));
    std::filesystem::create_directory(folder.path() / "dir.obj");
    CHECK_THAT(load_error(folder.path() / "dir.obj"), Catch::Contains("dir.obj"));
}
