// Many files, a picture each: names, failures and what they leave alone.
#include "onde_process.h"
#include "support/folders.h"

using namespace onde::test;

namespace {

const std::string TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

Arguments thumbnail(const Arguments& more) {
    Arguments all{"thumbnail", "--size", "16", "--spp", "1", "-o", "pictures"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

} // namespace

TEST_CASE("thumbnail makes a picture of each file, and names that clash get numbers") {
    const Folder folder;
    folder.write("a/Part.obj", TRIANGLE);
    folder.write("b/part.obj", TRIANGLE);
    folder.write("part-2.obj", TRIANGLE);
    const Outcome outcome =
        onde::test::onde(folder, thumbnail({"a/Part.obj", "b/part.obj", "part-2.obj", "--quiet"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    for (const char* name : {"Part.png", "part-2.png", "part-2-2.png"}) {
        INFO(name);
        const std::string bytes = content(folder / (std::string("pictures/") + name));
        REQUIRE(bytes.size() > 24);
        CHECK(bytes.substr(16, 8) == std::string("\0\0\0\x10\0\0\0\x10", 8)); // 16x16
    }
}

TEST_CASE("thumbnail lists the files that fail at the end, and makes the others") {
    const Folder folder;
    folder.write("good.obj", TRIANGLE);
    folder.write("bad.glb", "no glTF");
    const Outcome outcome =
        onde::test::onde(folder, thumbnail({"bad.glb", "missing.ply", "good.obj"}));
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("3 of 3: good.obj to pictures/good.png"));
    const size_t list = outcome.err.find("onde: 2 of 3 files could not be pictured:");
    REQUIRE(list != std::string::npos);
    CHECK(outcome.err.find("\n  bad.glb: ", list) != std::string::npos);
    CHECK(outcome.err.find("\n  missing.ply: ", list) != std::string::npos);
    CHECK(fs::exists(folder / "pictures/good.png"));
    CHECK_FALSE(fs::exists(folder / "pictures/bad.png"));
}

TEST_CASE("thumbnail refuses a size or a folder that can't be") {
    const Folder folder;
    folder.write("good.obj", TRIANGLE);
    folder.write("file", "");
    CHECK(onde::test::onde(folder, {"thumbnail", "good.obj", "--size", "0"}).code == 2);
    CHECK(onde::test::onde(folder, {"thumbnail", "good.obj", "-o", "file"}).code == 2);
    CHECK(onde::test::onde(folder, {"thumbnail"}).code == 2);
    // Told before anything is rendered: one sentence.
    for (const char* wrong : {"-", "file", "file/inner", "/proc", "/proc/self/no"}) {
        INFO(wrong);
        const Outcome outcome = onde::test::onde(folder, {"thumbnail", "good.obj", "-o", wrong});
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err,
                   Catch::Contains("folder") &&
                       Catch::StartsWith(std::string("onde: ") +
                                         (std::string(wrong).size() < 2 ? "-o '" : "") + wrong));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
    const Outcome empty = onde::test::onde(folder, {"thumbnail", "good.obj", "-o", ""});
    CHECK(empty.code == 2);
    CHECK_THAT(empty.err, Catch::Contains("--output: has an empty value"));
    CHECK(folder.files().size() == 2);
}

TEST_CASE("thumbnail says of a folder and of an empty name what they are") {
    const Folder folder;
    fs::create_directories(folder / "models");
    fs::create_directories(folder / "one.obj");
    const Outcome outcome = onde::test::onde(folder, thumbnail({"models", "", "one.obj"}));
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("  models: is a folder; give the name of a scene") &&
                                Catch::Contains("  one.obj: is a folder; give the name") &&
                                Catch::Contains("  '': the name of the scene is empty"));
}

TEST_CASE("thumbnail compiles once for models of all kinds, and pictures them as render does") {
    const Folder folder;
    const Environment own{{"ONDE_CACHE_DIR", (folder / "cache").string()}};
    const fs::path data = in_project("tests/data");
    folder.write("leaf.mtl", "newmtl leaf\nKd .2 .6 .1\nd .5\nnewmtl glass\nNi 1.5\nd .1\n"
                             "newmtl mirror\nillum 3\nKd 0 0 0\nKs .9 .8 .7\n");
    folder.write("leaf.obj", "mtllib leaf.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl leaf\n"
                             "f 1 2 3\nusemtl glass\nf 1 2 4\nusemtl mirror\nf 1 3 4\n");
    folder.write("plain.obj", TRIANGLE);
    fs::copy(data / "motion/slide.gltf", folder.path());
    const Outcome outcome = onde::test::onde(
        folder, thumbnail({"plain.obj", "leaf.obj", "slide.gltf", "--at", "0.5"}), own);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const size_t compiled = outcome.err.find("kernels compiled");
    REQUIRE(compiled != std::string::npos);
    CHECK(outcome.err.find("kernels compiled", compiled + 1) == std::string::npos);
    CHECK_THAT(outcome.err, Catch::Contains("onde: slide.gltf: The file has no camera"));
    for (const std::string name : {"plain.obj", "leaf.obj", "slide.gltf"}) {
        INFO(name);
        const Outcome alone = onde::test::onde(folder, {"render", name, "--at", "0.5", "--size",
                                                        "16x16", "--spp", "1", "-o", "alone.png"});
        REQUIRE(alone.code == 0);
        const std::string picture = fs::path(name).stem().string() + ".png";
        CHECK(content(folder / ("pictures/" + picture)) == content(folder / "alone.png"));
    }
}

TEST_CASE("thumbnail has the options that say what lights a model and how it is shown") {
    const Folder folder;
    folder.write("a.obj", TRIANGLE);
    const auto picture = [&](const Arguments& more) {
        Arguments all = thumbnail({"a.obj"});
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = onde::test::onde(folder, all);
        INFO(outcome.err);
        CHECK(outcome.code == 0);
        return content(folder / "pictures/a.png");
    };
    const std::string usual = picture({});
    CHECK(usual != picture({"--ground", "off"}));
    CHECK(usual != picture({"--studio", "off"}));
    CHECK(usual != picture({"--exposure", "1"}));
    CHECK(usual != picture({"--tone-map", "none"}));
    CHECK(usual == picture({}));
    const Outcome missing =
        onde::test::onde(folder, thumbnail({"a.obj", "a.obj", "--environment", "no.hdr"}));
    CHECK(missing.code == 2);
    CHECK(missing.err.find("1 of 2") == std::string::npos);
}

TEST_CASE("a device that fails ends a batch with code 3, since it is no file's fault") {
    const Folder folder;
    folder.write("a.obj", TRIANGLE);
    fs::create_directories(folder / "no-kernels");
    const Outcome outcome = onde::test::onde(
        folder, thumbnail({"missing.obj", "a.obj", "a.obj", "--kernels", "no-kernels"}));
    CHECK(outcome.code == 3);
    CHECK_THAT(outcome.err, Catch::Contains("onde: a.obj: "));
    CHECK_THAT(outcome.err,
               Catch::Contains("1 of 3 files could not be pictured:\nonde:   missing.obj: "));
    CHECK(outcome.err.find("3 of 3") == std::string::npos);
}
