#include "core/error.h"
#include "core/files.h"
#include "core/folder.h"

#include <catch2/catch.hpp>

using namespace onde;
using onde::test::Folder;
using onde::test::write;

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

TEST_CASE("an extension is compared in lower case") {
    CHECK(lower_extension("a/X.PNG") == ".png");
    CHECK(lower_extension("x.Exr") == ".exr");
    CHECK(lower_extension("png").empty());
}
