#include "core/shown.h"

#include <catch2/catch.hpp>

using namespace onde;

TEST_CASE("foreign text is shown without control characters") {
    CHECK(shown("plain text") == "plain text");
    CHECK(shown("a\x1b[31m\n\x7f") == "a\\x1b[31m\\n\\x7f");
    CHECK(shown("\xc2\x9b") == "\\x9b"); // a C1 control in UTF-8
    CHECK(shown("\xe2\x9d\xa4") == "\xe2\x9d\xa4");
}

TEST_CASE("long foreign text is cut between characters") {
    CHECK(shown("abcdef", 6) == "abcdef");
    CHECK(shown("abcdef", 5) == "abcde...");
    CHECK(shown("ab\xe2\x9d\xa4", 4) == "ab...");
    CHECK(shown("ab\xe2\x9d\xa4", 5) == "ab\xe2\x9d\xa4");
}
