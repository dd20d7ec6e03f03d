// Many files, a picture each: names, failures and what they leave alone.
#include "onde_process.h"

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
}
