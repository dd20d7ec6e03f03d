// Whatever is wrong with the input: one sentence, the right exit code, and nothing written.
#include "image/image_io.h"
#include "onde_process.h"
#include "support/folders.h"

#include <cstring>
#include <limits>

using namespace onde::test;

namespace {

constexpr int WRONG_INPUT = 2, NO_DEVICE = 3;
constexpr const char* PRECIOUS = "a picture that took days";

template <class T>
std::string bytes_of(std::initializer_list<T> values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.begin(), bytes.size());
    return bytes;
}

/// A glTF file of one triangle whose parts may be spoiled.
std::string gltf(const std::string& uri, const std::string& nodes = R"([{"mesh": 0}])",
                 const std::string& count = "3") {
    return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": )" + nodes +
           R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
           "buffers": [{"uri": ")" +
           uri + R"(", "byteLength": 42}],
           "bufferViews": [{"buffer": 0, "byteLength": 36},
                           {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
           "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": )" +
           count + R"(}, {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 3}]})";
}

std::string triangle(float second_x, uint16_t last_index) {
    return bytes_of<float>({0, 0, 0, second_x, 0, 0, 0, 1, 0}) +
           bytes_of<uint16_t>({0, 1, last_index});
}

/// The inputs, good and bad, and an output that must survive.
void furnish(const Folder& folder) {
    folder.write("out.png", PRECIOUS);
    folder.write("good.bin", triangle(1, 2));
    folder.write("nan.bin", triangle(std::numeric_limits<float>::quiet_NaN(), 2));
    folder.write("index.bin", triangle(1, 7));
    folder.write("good.gltf", gltf("good.bin"));
    folder.write("nan.gltf", gltf("nan.bin"));
    folder.write("index.gltf", gltf("index.bin"));
    folder.write("cyclic.gltf",
                 gltf("good.bin", R"([{"children": [1]}, {"children": [0], "mesh": 0}])"));
    folder.write("huge.gltf", gltf("good.bin", R"([{"mesh": 0}])", "4000000000"));
    folder.write("outside.gltf", gltf("../../../etc/passwd"));
    folder.write("truncated.glb", "glTF" + bytes_of<uint32_t>({2, 5000, 4000}) + "JSON{\"asset\"");
    folder.write("folder.toml/inside", "");
    folder.write("scene.blend", "BLENDER");
    folder.write("key.toml", "[camera]\nfov = 30\n");
    folder.write("type.toml", "[render]\nsamples = \"many\"\n");
    folder.write("syntax.toml", "[render\n");
    folder.write("empty.toml", "");
    folder.write("light.toml", "[[light]]\ntype = \"rectangle\"\ncorner = [0, 0, 0]\n"
                               "edge1 = [1, 0, 0]\nedge2 = [1, 0, 0]\nradiance = 5\n");
    folder.write("itself.toml", "[[include]]\nfile = \"itself.toml\"\n");
    const std::string ball =
        "[[shape]]\ntype = \"sphere\"\n[[light]]\ntype = \"directional\"\n"
        "direction = [0, -1, 0]\nirradiance = 1\n[camera]\nposition = [0, 0, 5]\n"
        "look_at = [0, 0, 0]\n";
    folder.write("screen.toml", ball + "screen = { size = [4, 2], distance = 3 }\n");
    folder.write("tiny.toml", "[[shape]]\ntype = \"mesh\"\ntriangles = [[0, 1, 2]]\n"
                              "positions = [[1e-8, 0, 0], [0, 1e-8, 0], [0, 0, 1e-8]]\n");
    folder.write("empty.obj", "");
    folder.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    folder.write("flat.toml", // with what makes its kernels those of the Cornell box
                 R"([[material]]
                    name = "glass"
                    kind = "dielectric"
                    [[shape]]
                    type = "sphere"
                    center = [0, 0, -3]
                    radius = 1
                    material = "glass"
                    [[material]]
                    name = "lamp"
                    emission = 5
                    [[shape]]
                    type = "mesh"
                    material = "lamp"
                    positions = [[1, 0, 0], [1, 0, 0], [2, 0, 0]]
                    triangles = [[0, 0, 0], [0, 1, 2], [0, 2, 0]]
                    [[light]]
                    type = "rectangle"
                    corner = [-1, 2, -1]
                    edge1 = [2, 0, 0]
                    edge2 = [0, 0, 2]
                    radiance = 5)");
    folder.write("zeros.hdr", std::string(100, '\0'));
    fs::create_directory(folder / "nothing");
}

/// One line, ours, with the culprit's name, and nothing changed in the folder.
void check_refused(const Folder& folder, const Arguments& arguments, const std::string& culprit,
                   int code = WRONG_INPUT, const Environment& environment = {}) {
    std::string command;
    for (const std::string& argument : arguments) command += " " + argument;
    INFO("onde" << command);
    const auto before = folder.files();
    const Outcome outcome = onde::test::onde(folder, arguments, environment);
    INFO(outcome.err);
    CHECK(outcome.code == code);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.starts_with("onde: "));
    CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
    CHECK_THAT(outcome.err, Catch::Contains(culprit));
    CHECK(folder.files() == before);
}

Arguments onto_precious(const std::string& scene, Arguments more = {}) {
    more.insert(more.end(), {"-o", "out.png"});
    return render(scene, more);
}

} // namespace

TEST_CASE("a scene that is no good is refused by its name") {
    Folder folder;
    furnish(folder);
    struct Case {
        std::string scene, culprit;
    };
    const Case cases[] = {
        {"missing.toml", "missing.toml: no such file"},
        {"folder.toml", "folder.toml: is a folder"},
        {"nothing", "nothing"},
        {"scene.blend", "scene.blend"},
        {"truncated.glb", "truncated.glb"},
        {"nan.gltf",
         "nan.gltf: the scene is empty; add a shape or a mesh, or see to what was noted: "},
        {"index.gltf",
         "index.gltf: mesh 0 primitive 0 indices: index 2 is 7, but there are 3 positions"},
        {"cyclic.gltf", "cyclic.gltf: node 0"},
        {"huge.gltf", "4000000000 elements overrun buffer view 0"},
        {"outside.gltf", "outside.gltf: buffer 0: '../../../etc/passwd' leaves the scene's folder"},
        {"key.toml", "key.toml:2:7: camera.fov is not a key"},
        {"type.toml", "type.toml:2:"},
        {"syntax.toml", "syntax.toml:"},
        {"empty.toml", "empty.toml"},
        {"light.toml", "light.toml:5:9: light[0].edge2"},
        {"itself.toml", "itself.toml"},
        {"screen.toml", "pixels of 0.25 x 0.166667"},
        {"empty.obj", "empty.obj"},
        {"index.obj", "index.obj"},
    };
    for (const Case& c : cases) check_refused(folder, onto_precious(c.scene), c.culprit);
}

TEST_CASE("an output that cannot be written is refused before the scene is read") {
    Folder folder;
    furnish(folder);
    const auto to = [](const std::string& path) { return render("missing.toml", {"-o", path}); };
    check_refused(folder, to("no/such/out.png"), "the folder no/such does not exist");
    check_refused(folder, to("good.bin/out.png"), "the folder good.bin does not exist");
    check_refused(folder, to("nothing/"), "nothing/");
    check_refused(folder, to("out.jpg"), "out.jpg: pictures are written as .png or .exr");
    check_refused(folder, to("out"), "out: pictures are written as .png or .exr");
    check_refused(folder, onto_precious(CORNELL, {"--json", "no/such.json"}), "no/such.json");
}

TEST_CASE("an option with a value that makes no sense is refused by its name") {
    Folder folder;
    furnish(folder);
    struct Case {
        Arguments options;
        std::string culprit;
    };
    const Case cases[] = {
        {{"--size", "0x5"}, "width 0 is out of range"},
        {{"--size", "5x0"}, "height 0 is out of range"},
        {{"--size", "5"}, "--size 5 is not of the form WIDTHxHEIGHT"},
        {{"--size", "axb"}, "--size axb"},
        {{"--size", "-5x5"}, "--size -5x5"},
        {{"--size", "99999999999x5"}, "--size 99999999999x5"},
        {{"--size", "70000x5"}, "width 70000 is out of range"},
        {{"--spp", "0"}, "samples per pixel 0 is out of range"},
        {{"--spp", "-4"}, "--spp: -4 is out of range; use 0 to 4294967295"},
        {{"--spp", "4.5"}, "--spp = 4.5: not a value"},
        {{"--depth", "-1"}, "--depth: -1 is out of range"},
        {{"--depth", "0"}, "depth 0 is out of range"},
        {{"--depth", "5000"}, "depth 5000 is out of range"},
        {{"--seed", "one"}, "--seed = one"},
        {{"--time", "-1"}, "--time -1 is not a positive number"},
        {{"--time", "nan"}, "--time nan"},
        {{"--exposure", "nan"}, "--exposure nan"},
        {{"--exposure", "inf"}, "--exposure inf"},
        {{"--environment-rotation", "nan"}, "--environment-rotation nan"},
        {{"--chunk", "48"}, "chunk 48 is not a power of two"},
        {{"--camera", "left"}, "--camera left: no such camera; the scene has 0"},
        {{"--engine", "steam"}, "--engine: steam is none of wavefront"},
        {{"--bvh", "octree"}, "--bvh: octree is none of sah"},
        {{"--aov", "depth,alpha,depth"}, "--aov names depth twice"},
        {{"--aov", "depths"}, "--aov: depths is none of traversal-cost"},
        {{"--environment", "missing.hdr"}, "missing.hdr: no such file"},
        {{"--environment", "zeros.hdr"}, "zeros.hdr"},
        {{"--kernels", "missing"}, "missing: no such folder"},
        {{"--frob"}, "--frob: no such option"},
        {{"second.toml"},
         "second.toml: one word more than onde render takes; see onde render --help"},
        {{"--depth"}, "--depth = -o: not a value"},
        {{"--wave-size", "0"}, "wave size 0 is out of range"},
        {{"--wave-size", "4294967295"}, "wave size 4294967295 is out of range"},
    };
    for (const Case& c : cases) check_refused(folder, onto_precious(CORNELL, c.options), c.culprit);
    check_refused(folder, {"render", CORNELL, "--lanes", "3"}, "width 3 of lanes is not one of");
}

TEST_CASE("a command line without sense is refused with the help that has it") {
    Folder folder;
    furnish(folder);
    check_refused(folder, {}, "see onde --help");
    check_refused(folder, {"frobnicate"}, "frobnicate: no such command; see onde --help");
    check_refused(folder, {"--frob"}, "--frob: no such option");
    check_refused(folder, {"render"}, "scene is required; see onde render --help");
    check_refused(folder, {"render", CORNELL, "--depth"}, "--depth needs a value behind it");
    check_refused(folder, {"cache"}, "see onde cache --help");
    check_refused(folder, {"cache", "shrink"}, "shrink: no such command");
    check_refused(folder, {"cache", "prewarm", "missing.toml"}, "missing.toml");
    check_refused(folder, {"info", "missing.toml"}, "missing.toml: no such file");
    check_refused(folder, {"info", "nan.gltf"}, "nan.gltf");
    check_refused(folder, {"compare", "out.png"}, "B is required");
    check_refused(folder, {"compare", "missing.exr", "out.png"}, "missing.exr");
    check_refused(folder, {"compare", "out.png", "out.png"}, "out.png");
}

TEST_CASE("a device that cannot be had ends the program with code 3") {
    Folder folder;
    furnish(folder);
    const Environment no_platform{{"OCL_ICD_VENDORS", (folder / "nothing").string()}};
    check_refused(folder, onto_precious(CORNELL, {"--device", "abacus"}),
                  "no OpenCL device matches 'abacus'; choose from: 0:", NO_DEVICE);
    check_refused(folder, onto_precious(CORNELL, {"--device", "99"}), "'99'", NO_DEVICE);
    check_refused(folder, onto_precious(CORNELL), "matches 'abacus' of ONDE_DEVICE; choose from",
                  NO_DEVICE, {{"ONDE_DEVICE", "abacus"}});
    check_refused(folder, onto_precious(CORNELL), "no OpenCL platform is installed", NO_DEVICE,
                  no_platform);
    check_refused(folder, {"cache", "prewarm"}, "no OpenCL platform is installed", NO_DEVICE,
                  no_platform);
}

TEST_CASE("a render that the device's memory cannot hold is refused with both numbers") {
    Folder folder;
    furnish(folder);
    const Environment one_gibibyte{{"POCL_MEMORY_LIMIT", "1"}};
    const std::pair<Arguments, std::string> cases[] = {
        {{"--size", "16000x16000"}, "the film sums take 3.81 GiB in one buffer, but"},
        {{"--size", "4096x4095", "--spp", "1024"}, "the render takes 1."}};
    for (auto [options, culprit] : cases) {
        options.insert(options.end(), {"--device", "Portable Computing Language"});
        check_refused(folder, onto_precious(CORNELL, options), culprit, NO_DEVICE, one_gibibyte);
    }
}

TEST_CASE("waves that the device's memory cannot hold are halved, and a line says so") {
    const Folder folder;
    const Outcome outcome =
        onde::test::onde(folder,
                         {"render", CORNELL, "--size", "16x12", "--spp", "1", "--wave-size",
                          "60000000", "--device", "Portable Computing Language"},
                         {{"POCL_MEMORY_LIMIT", "1"}});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("waves of 60000000 paths do not fit the memory of"));
}

TEST_CASE("kernels that are not there or do not compile are named with file and line") {
    Folder folder;
    furnish(folder);
    check_refused(folder, onto_precious(CORNELL, {"--kernels", "nothing"}),
                  "there is no kernel file \"trace/layout_wide.h\" in nothing", NO_DEVICE);

    const fs::path kernels = folder / "kernels";
    fs::copy(in_project("kernels"), kernels, fs::copy_options::recursive);
    const fs::path broken = kernels / "path" / "path.h";
    const std::string text = content(broken);
    const std::string line = std::to_string(1 + std::count(text.begin(), text.end(), '\n'));
    std::ofstream(broken, std::ios::app) << "int broken(void) { return not_declared; }\n";
    const auto before = folder.files();
    const Outcome outcome =
        onde::test::onde(folder, onto_precious(CORNELL, {"--kernels", "kernels"}));
    INFO(outcome.err);
    CHECK(outcome.code == NO_DEVICE);
    CHECK_THAT(outcome.err, Catch::Contains("onde: kernels/wavefront/fused.cl does not build"));
    CHECK_THAT(outcome.err, Catch::Contains("path/path.h:" + line));
    CHECK(folder.files() == before);
}

TEST_CASE("triangles without area are rendered as if they were not there") {
    Folder folder;
    furnish(folder);
    const Outcome outcome = onde::test::onde(folder, render("flat.toml", {"-o", "flat.exr"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    for (const float value : onde::read_image(folder / "flat.exr").pixels)
        CHECK((value >= 0 && value < 1e3f));
    CHECK_THAT(outcome.err, !Catch::Contains("not finite"));
}

TEST_CASE("the laboratory refuses what it cannot measure") {
    Folder folder;
    furnish(folder);
    struct Case {
        Arguments arguments;
        std::string culprit;
    };
    const Case cases[] = {
        {{"missing.toml"}, "missing.toml: no such file"},
        {{"empty.toml"}, "empty.toml"},
        {{"tiny.toml"}, "sphere of radius 8.16497e-09; the laboratory measures 1e-07 to 1e+09"},
        {{CORNELL, "--rays", "0"}, "--rays 0 is out of range"},
        {{CORNELL, "--rays", "many"}, "--rays = many"},
        {{CORNELL, "--trials", "-1"}, "--trials -1 is out of range"},
        {{CORNELL, "--trials", "nan"}, "--trials nan is out of range"},
        {{CORNELL, "--plot", "plot.png"}, "plot.png: plots are written as .svg"},
        {{CORNELL, "--plot", "no/such.svg"}, "the folder no does not exist"},
        {{CORNELL, "--kernels", "missing"}, "missing: no such folder"},
        {{"flat.toml", "--frob"}, "--frob: no such option"},
    };
    for (const Case& c : cases) {
        Arguments arguments{"volumes"};
        arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
        check_refused(folder, arguments, c.culprit);
    }
}

TEST_CASE("--load-limit bounds what a file may take, in every command that loads one") {
    const Folder folder;
    std::string points; // 2 MB of them, of which three are used
    for (int i = 0; i < 100000; ++i) points += "v 0.1234567 " + std::to_string(i) + " 0\n";
    folder.write("a.obj", points + "f 1 2 3\n");
    for (const Arguments& command :
         {Arguments{"info", "a.obj"}, Arguments{"render", "a.obj", "-o", "a.png"},
          Arguments{"thumbnail", "a.obj", "-o", "."}}) {
        Arguments limited = command;
        limited.insert(limited.end(), {"--load-limit", "0.002"});
        const Outcome outcome = onde::test::onde(folder, limited);
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains("a.obj") && Catch::Contains("0.002 GiB"));
        CHECK(folder.files().size() == 1);
    }
    CHECK(onde::test::onde(folder, {"info", "a.obj", "--load-limit", "0.1"}).code == 0);
    folder.write("sky.pfm", "PF\n400 200\n-1\n" + std::string(400 * 200 * 12, '\0'));
    const Outcome sky = onde::test::onde(
        folder,
        render(CORNELL, {"--environment", "sky.pfm", "-o", "a.png", "--load-limit", "0.004"}));
    CHECK(sky.code == 2);
    CHECK_THAT(sky.err, Catch::Contains("sky.pfm: ") && Catch::Contains("--load-limit"));
    CHECK(onde::test::onde(folder, {"info", "a.obj", "--load-limit", "0"}).code == 2);
}
