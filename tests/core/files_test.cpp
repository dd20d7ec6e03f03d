#include "core/error.h"
#include "core/files.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <fstream>

using namespace onde;
namespace fs = std::filesystem;

namespace {

/// A fresh folder that is removed with everything in it.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("onde-core-test-" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    size_t count() const {
        return size_t(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
    }
};

void write(const fs::path& path, std::string_view text) {
    std::ofstream(path, std::ios::binary) << text;
}

} // namespace

TEST_CASE("a file is read to its last byte, zeros included") {
    const Folder folder;
    const std::string bytes("a\0b\n", 4);
    write(folder.path / "f", bytes);
    CHECK(read_file(folder.path / "f") == bytes);
    write(folder.path / "empty", "");
    CHECK(read_file(folder.path / "empty").empty());
}

TEST_CASE("missing files, folders and files over the limit are refused by name") {
    const Folder folder;
    write(folder.path / "f", "12345");
    CHECK_THROWS_WITH(read_file(folder.path / "gone"), Catch::Contains("gone"));
    CHECK_THROWS_AS(read_file(folder.path), InputError);
    CHECK_NOTHROW(read_file(folder.path / "f", 5));
    CHECK_THROWS_AS(read_file(folder.path / "f", 4), InputError);
}

TEST_CASE("a replaced file is new as a whole, and its old content stays until then") {
    const Folder folder;
    const fs::path file = folder.path / "picture.exr";
    write(file, "old");
    replace_file(file, [&](const fs::path& temporary) {
        write(temporary, "new");
        CHECK(read_file(file) == "old");
        CHECK(temporary.parent_path() == file.parent_path());
        CHECK(temporary.extension() == ".exr");
    });
    CHECK(read_file(file) == "new");
    CHECK(folder.count() == 1);
}

TEST_CASE("a write that throws leaves the old file and no other") {
    const Folder folder;
    const fs::path file = folder.path / "f";
    write(file, "old");
    CHECK_THROWS_AS(replace_file(file,
                                 [](const fs::path& temporary) {
                                     write(temporary, "half");
                                     throw InputError("the disk is full");
                                 }),
                    InputError);
    CHECK(read_file(file) == "old");
    CHECK(folder.count() == 1);
}

TEST_CASE("a write that makes no file is an error that names the target") {
    const Folder folder;
    CHECK_THROWS_WITH(replace_file(folder.path / "target", [](const fs::path&) {}),
                      Catch::Contains("target"));
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
    CHECK_THROWS_WITH(check_writable(folder.path / "gone" / "f"), Catch::Contains("gone"));
    CHECK_THROWS_AS(check_writable(folder.path), InputError);
    CHECK_THROWS_AS(check_writable(folder.path / ""), InputError);
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
