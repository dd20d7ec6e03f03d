// Pictures of a camera that goes round the scene.
#include "onde_process.h"

using namespace onde::test;

TEST_CASE("--turntable writes numbered pictures that differ, the first from where it was") {
    const Folder folder;
    folder.write("wedge.obj",
                 "v 0 0 0\nv 3 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const Outcome turn = onde::test::onde(
        folder, render("wedge.obj", {"-o", "turn.png", "-o", "turn.exr", "--turntable", "3"}));
    INFO(turn.err);
    REQUIRE(turn.code == 0);
    CHECK(turn.err.find("kernels", turn.err.find("turn.0001.png")) == std::string::npos);
    CHECK(folder.files().size() == 7);
    CHECK(content(folder / "turn.0001.exr") != content(folder / "turn.0002.exr"));
    CHECK(content(folder / "turn.0002.exr") != content(folder / "turn.0003.exr"));
    const Outcome one = onde::test::onde(folder, render("wedge.obj", {"-o", "one.exr"}));
    CHECK(one.code == 0);
    CHECK(content(folder / "one.exr") == content(folder / "turn.0001.exr"));
}

TEST_CASE("--turntable needs a number of pictures, and files for them") {
    const Folder folder;
    CHECK(onde::test::onde(folder, render(CORNELL, {"--turntable", "0"})).code == 2);
    CHECK(onde::test::onde(folder, render(CORNELL, {"--turntable", "2", "-o", "-"})).code == 2);
    CHECK(folder.files().empty());
}
