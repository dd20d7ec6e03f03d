// Homes, disks and systems that are not as they should be: a picture all the same.
#include "onde_process.h"
#include "support/folders.h"

using namespace onde::test;

namespace {

/// Runs onde in a shell of its own, in which file systems may be mounted. `before` is run first;
/// "$ONDE" is the render that it ends with.
void check_picture(const std::string& before, const std::string& last = "exec $ONDE") {
    if (std::system("unshare -rm true 2>/dev/null") != 0) {
        WARN("skipped: file systems cannot be mounted here");
        return;
    }
    const Folder folder;
    folder.write("run.sh", "cd " + folder.path().string() + "\nexport ONDE=\"" + built_program() +
                               " render " + CORNELL +
                               " --lanes 1 --size 16x12 --spp 1 --quiet -o picture.png\"\n"
                               "export ONDE_CACHE_DIR=" +
                               test_cache_folder().string() + "\n" + before + "\n" + last + "\n");
    const std::string command =
        "unshare -rm sh " + (folder / "run.sh").string() + " 2>" + (folder / "err").string();
    INFO(before << "\n" << last);
    CHECK(std::system(command.c_str()) == 0);
    CHECK(content(folder / "err") == "");
    CHECK(fs::exists(folder / "picture.png"));
}

const std::string NO_CACHE = "unset ONDE_CACHE_DIR XDG_CACHE_HOME\n";
const std::string FULL = "mkdir full; mount -t tmpfs -o size=64k none full\n"
                         "dd if=/dev/zero of=full/rest bs=4k 2>/dev/null\n";

} // namespace

TEST_CASE("an empty environment gives a picture") {
    check_picture("", "exec env -i $ONDE --no-cache");
}

TEST_CASE("a home that is missing, a file or read-only gives a picture") {
    check_picture(NO_CACHE + "unset HOME");
    check_picture(NO_CACHE + "export HOME=/etc/passwd");
    check_picture(NO_CACHE + "mkdir home; mount -t tmpfs -o ro none home; export HOME=$PWD/home");
}

TEST_CASE("a full disk under the caches gives a picture") {
    check_picture(NO_CACHE + FULL + "export XDG_CACHE_HOME=$PWD/full");
    check_picture(NO_CACHE + FULL + "export HOME=$PWD/full TMPDIR=$PWD/full");
}

TEST_CASE("a system without /sys gives a picture") {
    check_picture("mount -t tmpfs none /sys");
}

TEST_CASE("damaged compiled kernels, of PoCL or our own, do no harm") {
    const std::string damage = "for f in $(find pocl ours -type f); do truncate -s 4096 $f; done";
    check_picture("export ONDE_CACHE_DIR=$PWD/ours POCL_CACHE_DIR=$PWD/pocl\n"
                  "$ONDE; rm picture.png\n" +
                  damage);
}

TEST_CASE("where no folder takes what PoCL compiles, one sentence says so") {
    const Folder folder;
    const Outcome outcome =
        onde::test::onde(folder, render(CORNELL, {"-o", "picture.png"}),
                         {{"POCL_CACHE_DIR", "/proc/nowhere"}, {"ONDE_DEVICE", "Portable"}});
    CHECK(outcome.code == 3);
    CHECK_THAT(outcome.err, Catch::Contains("it compiles in POCL_CACHE_DIR, which names "
                                            "/proc/nowhere, where it cannot write"));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

TEST_CASE("PoCL that is told to compile for an older processor gives the same picture") {
    const Folder folder;
    const auto picture = [&](const std::string& name, Environment environment) {
        environment["ONDE_DEVICE"] = "Portable";
        return onde::test::onde(
            folder,
            {"render", CORNELL, "--size", "16x12", "--spp", "1", "--quiet", "--float", "-o", name},
            environment);
    };
    REQUIRE(picture("own.exr", {}).code == 0);
    for (const std::string kernels : {"avx2", "sse2"}) {
        INFO(kernels);
        REQUIRE(picture("older.exr", {{"POCL_KERNELLIB_NAME", kernels}}).code == 0);
        const Outcome compared = onde::test::onde(folder, {"compare", "own.exr", "older.exr"});
        CHECK_THAT(compared.out, Catch::Contains("RMSE         0\n"));
    }
}
