// Mistakes and malice in pbrt files: one sentence each, which names the file.
#include "scratch.h"

using namespace onde;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

void check_refused(const std::string& text, const std::vector<std::string>& culprits,
                   const LoadOptions& options = {}) {
    ScratchFolder folder;
    folder.write("again.pbrt", "Include \"evil.pbrt\"\n");
    INFO(text.substr(0, 200));
    std::string error;
    try {
        load_scene(folder.write("evil.pbrt", text), options);
    } catch (const InputError& e) {
        error = e.what();
    }
    CHECK_THAT(error, Catch::Contains(".pbrt"));
    CHECK(error.find('\n') == std::string::npos);
    for (const std::string& culprit : culprits) CHECK_THAT(error, Catch::Contains(culprit));
}

std::string repeated(const std::string& text, size_t count) {
    std::string all;
    for (size_t i = 0; i < count; ++i) all += text;
    return all;
}

} // namespace

TEST_CASE("broken statements of pbrt files are refused with their line") {
    check_refused("WorldBegin\nShape \"sphere", {"evil.pbrt:2", "does not end"});
    check_refused("WorldBegin\nShape", {":2", "a kind of shape"});
    check_refused("Shape \"sphere\" \"float radius\" [ 1", {":1", "radius"});
    check_refused("Shape \"sphere\" \"float radius\"", {"radius", "no value"});
    check_refused("Shape \"sphere\" \"radius\" 1", {"type and its name"});
    check_refused("Shape \"sphere\" \"float radius\" [ x ]", {"'x'", "no number"});
    check_refused("Shape \"sphere\" \"float radius\" nan", {"no finite number"});
    check_refused("Shape \"sphere\" \"float radius\" 1e999", {"no finite number"});
    check_refused("Shape \"sphere\" \"bool a\" 1", {"neither true nor false"});
    check_refused("Translate 1 2", {"Translate", "a number"});
    check_refused("Scale inf 1 1", {"Scale", "finite"});
    check_refused("Transform [ 1 2 3 ]", {"Transform"});
    check_refused("LookAt 0 0 0 0 0 0 0 1 0", {"its own place"});
    check_refused("[ 1 2 3 ]", {"where a directive should"});
    check_refused("Scale 0 0 0\nCamera \"perspective\"", {"without an inverse"});
    check_refused(std::string("Shape\0x", 7), {"not a text file"});
}

TEST_CASE("includes that go in circles or nowhere, and objects in objects, are refused") {
    check_refused("Include \"evil.pbrt\"", {"includes itself"});
    check_refused("Include \"again.pbrt\"", {"includes itself"});
    check_refused("Include \"none.pbrt\"", {"does not exist"});
    check_refused("Include \"../x.pbrt\"", {"leaves the scene's folder"});
    check_refused("Include \".\"", {"evil.pbrt:1", "is the scene's folder"});
    check_refused("ObjectBegin \"a\"\nObjectBegin \"b\"", {"within another"});
    check_refused("ObjectBegin \"a\"\nObjectInstance \"a\"", {"within another"});
}

TEST_CASE("absurd counts and sizes in pbrt files are refused before they take memory") {
    const std::string mesh = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] ";
    check_refused(mesh + "\"integer indices\" [ 0 1 3 ]", {"has 3", "3 points"});
    check_refused(mesh + "\"integer indices\" [ 0 1 -1 ]", {"has -1"});
    check_refused(mesh + "\"integer indices\" [ 0 1 1.5 ]", {"has 1.5"});
    check_refused("Film \"rgb\" \"integer xresolution\" 1e9\nWorldBegin\n" + mesh, {"width"});
    check_refused("Sampler \"sobol\" \"integer pixelsamples\" -5\nWorldBegin\n" + mesh,
                  {"samples"});
    check_refused(repeated("AttributeBegin\n", 2000), {"nested"});
    check_refused("WorldBegin\n", {"empty"});
    check_refused("WorldBegin\nShape \"curve\"\n", // with what was left out
                  {"empty", "Shapes of kinds that Onde does not have are left out (curve)"});
    // A thousand spheres, placed a thousand times a line.
    const std::string bomb = "WorldBegin\nObjectBegin \"a\"\n" +
                             repeated("Shape \"sphere\"\n", 5000) + "ObjectEnd\n" +
                             repeated("ObjectInstance \"a\"\n", 5000);
    check_refused(bomb, {}, {.limit = uint64_t(64) << 20});
}

TEST_CASE("files that include each other again and again are refused, however small they are") {
    ScratchFolder folder;
    for (int i = 0; i < 12; ++i)
        folder.write(fmt::format("{}.pbrt", i),
                     repeated(fmt::format("Include \"{}.pbrt\"\n", i + 1), 8));
    folder.write("12.pbrt", "");
    CHECK_THAT(load_error(folder.write("bomb.pbrt", "Include \"0.pbrt\"\n")),
               Catch::Contains(".pbrt: more than 16384 files are included"));
}
