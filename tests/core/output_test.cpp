#include "core/error.h"
#include "core/files.h"
#include "core/folder.h"
#include "core/output.h"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <thread>

using namespace onde;
using onde::test::Folder;
using onde::test::write;
namespace fs = std::filesystem;

namespace {

mode_t mode_of(const fs::path& path) {
    struct stat status {};
    REQUIRE(stat(path.c_str(), &status) == 0);
    return status.st_mode & 07777;
}

} // namespace

TEST_CASE("a written file has these bytes, zeros included, and no other file is left") {
    const Folder folder;
    const std::string bytes("a\0b", 3);
    for (const std::string& content : {bytes, std::string(), std::string(3 << 20, 'x')}) {
        write_file(folder.path / "f", content);
        CHECK(read_file(folder.path / "f") == content);
        CHECK(folder.count() == 1);
    }
}

TEST_CASE("a new file has the mode that the user's mask gives") {
    const Folder folder;
    const mode_t before = umask(027);
    write_file(folder.path / "f", "new");
    umask(before);
    CHECK(mode_of(folder.path / "f") == 0640);
}

TEST_CASE("a replaced file keeps its mode") {
    const Folder folder;
    for (const mode_t mode : {0664, 0600, 0755}) {
        write(folder.path / "f", "old");
        REQUIRE(chmod((folder.path / "f").c_str(), mode) == 0);
        write_file(folder.path / "f", "new");
        CHECK(read_file(folder.path / "f") == "new");
        CHECK(mode_of(folder.path / "f") == mode);
    }
}

TEST_CASE("a replaced file keeps its owner, where root writes") {
    if (geteuid() != 0) {
        WARN("skipped: only root gives files away");
        return;
    }
    const Folder folder;
    write(folder.path / "f", "old");
    REQUIRE(chown((folder.path / "f").c_str(), 1234, 4321) == 0);
    write_file(folder.path / "f", "new");
    struct stat status {};
    REQUIRE(stat((folder.path / "f").c_str(), &status) == 0);
    CHECK(status.st_uid == 1234);
    CHECK(status.st_gid == 4321);
}

TEST_CASE("a read-only file is refused, for root too, and stays") {
    const Folder folder;
    write(folder.path / "f", "old");
    REQUIRE(chmod((folder.path / "f").c_str(), 0444) == 0);
    CHECK_THROWS_WITH(check_writable(folder.path / "f"), Catch::Contains("read-only"));
    CHECK_THROWS_WITH(write_file(folder.path / "f", "new"), Catch::Contains("read-only"));
    CHECK(read_file(folder.path / "f") == "old");
    CHECK(folder.count() == 1);
}

TEST_CASE("a symbolic link stays, and what it leads to is replaced") {
    const Folder folder;
    fs::create_directory(folder.path / "far");
    write(folder.path / "far/real", "old");
    fs::create_symlink("far/real", folder.path / "link");
    fs::create_symlink("link", folder.path / "link to link");
    write_file(folder.path / "link to link", "new");
    CHECK(fs::is_symlink(folder.path / "link to link"));
    CHECK(fs::is_symlink(folder.path / "link"));
    CHECK(read_file(folder.path / "far/real") == "new");
}

TEST_CASE("a link to nothing yet makes the file it names") {
    const Folder folder;
    fs::create_symlink("later", folder.path / "link");
    CHECK_NOTHROW(check_writable(folder.path / "link"));
    write_file(folder.path / "link", "new");
    CHECK(fs::is_symlink(folder.path / "link"));
    CHECK(read_file(folder.path / "later") == "new");
    fs::create_symlink("gone/later", folder.path / "lost");
    CHECK_THROWS_AS(check_writable(folder.path / "lost"), InputError);
    fs::create_symlink("circle", folder.path / "circle");
    CHECK_THROWS_AS(write_file(folder.path / "circle", "new"), InputError);
}

TEST_CASE("a pipe is written to and stays a pipe") {
    const Folder folder;
    const fs::path pipe = folder.path / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK_NOTHROW(check_writable(pipe)); // does not wait for a reader
    std::string received;
    std::thread reader([&] {
        std::ifstream in(pipe, std::ios::binary);
        received.assign(std::istreambuf_iterator<char>(in), {});
    });
    const std::string bytes(1 << 20, 'x');
    write_file(pipe, bytes);
    reader.join();
    CHECK(received == bytes);
    CHECK(fs::is_fifo(pipe));
}

TEST_CASE("a pipe whose reader leaves is an error that names it and does not end the program") {
    const Folder folder;
    const fs::path pipe = folder.path / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::thread reader([&] { close(open(pipe.c_str(), O_RDONLY)); });
    CHECK_THROWS_WITH(write_file(pipe, std::string(1 << 20, 'x')), Catch::Contains("pipe"));
    reader.join();
}

TEST_CASE("a full device is an error, and the device stays one") {
    const Folder folder;
    fs::create_symlink("/dev/full", folder.path / "x.png");
    CHECK_THROWS_WITH(write_file(folder.path / "x.png", "bytes"), Catch::Contains("No space"));
    CHECK(fs::is_character_file("/dev/full"));
    write_file("/dev/null", "bytes");
    CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a file that may not become that large leaves the old one and no other") {
    const Folder folder;
    write(folder.path / "f", "old");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{4096, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    CHECK_THROWS_WITH(write_file(folder.path / "f", std::string(8192, 'x')),
                      Catch::Contains("the old file is as it was"));
    setrlimit(RLIMIT_FSIZE, &before);
    CHECK(read_file(folder.path / "f") == "old");
    CHECK(folder.count() == 1);
}

TEST_CASE("what a killed process left is removed by the next output in its folder, and no more") {
    const Folder folder;
    const fs::path in_use = folder.path / ".onde-unfinished-1-1", other = folder.path / ".other";
    write(in_use, "being written");
    write(folder.path / ".onde-unfinished-1-2", "left behind");
    write(other, "somebody's");
    const int held = open(in_use.c_str(), O_RDWR);
    REQUIRE(flock(held, LOCK_EX) == 0);
    write_file(folder.path / "f", "new");
    CHECK(fs::exists(in_use));
    CHECK(fs::exists(other));
    CHECK(folder.count() == 3);
    close(held);
    write_file(folder.path / "f", "new");
    CHECK_FALSE(fs::exists(in_use));
}

TEST_CASE("checking that a file could be written leaves nothing and changes nothing") {
    const Folder folder;
    check_writable(folder.path / "new");
    CHECK(folder.count() == 0);
    write(folder.path / "old", "kept");
    const auto before = fs::last_write_time(folder.path / "old");
    check_writable(folder.path / "old");
    CHECK(read_file(folder.path / "old") == "kept");
    CHECK(fs::last_write_time(folder.path / "old") == before);
}

TEST_CASE("outputs in missing folders, or that are folders, are refused") {
    const Folder folder;
    for (const auto& refuse :
         {check_writable, +[](const fs::path& path) { write_file(path, ""); }}) {
        CHECK_THROWS_WITH(refuse(folder.path / "gone" / "f"), Catch::Contains("gone"));
        CHECK_THROWS_AS(refuse(folder.path), InputError);
        CHECK_THROWS_AS(refuse(folder.path / ""), InputError);
    }
    CHECK(folder.count() == 0);
}

TEST_CASE("a file that is written piece by piece takes its place only when it is finished") {
    const Folder folder;
    write(folder.path / "a", "old");
    const auto write_pieces = [&](bool finish) {
        WholeFile file(folder.path / "a");
        file.write_at(4, "of pieces");
        file.write_at(0, "new ");
        CHECK(read_file(folder.path / "a") == "old");
        if (finish) file.finish();
    };
    write_pieces(false);
    CHECK(read_file(folder.path / "a") == "old");
    write_pieces(true);
    CHECK(read_file(folder.path / "a") == "new of pieces");
    CHECK(folder.count() == 1);
    CHECK_THROWS_WITH(WholeFile("/dev/null"), Catch::Contains("is a pipe or a device"));
}

TEST_CASE("an output in a folder without write permission is refused") {
    if (::geteuid() == 0) {
        WARN("skipped: root may write everywhere");
        return;
    }
    const Folder folder;
    fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
    CHECK_THROWS_WITH(check_writable(folder.path / "f"), Catch::Contains("not writable"));
    fs::permissions(folder.path, fs::perms::owner_all);
}

TEST_CASE("the longest name that a file may have can be written") {
    const Folder folder;
    const std::string name(255, 'n');
    write_file(folder.path / name, "new");
    CHECK(read_file(folder.path / name) == "new");
}

TEST_CASE("all outputs are tried, and all failures told together") {
    const Folder folder;
    Outputs outputs;
    for (const char* name : {"gone/a", "b", "lost/c"})
        outputs.attempt([&] { write_file(folder.path / name, "new"); });
    CHECK(read_file(folder.path / "b") == "new");
    CHECK_THROWS_WITH(outputs.check(), Catch::Contains("2 outputs") && Catch::Contains("gone/a") &&
                                           Catch::Contains("lost/c"));
    CHECK_NOTHROW(Outputs().check());
}
