#include "core/error.h"
#include "core/text.h"

#include <catch2/catch.hpp>

using namespace onde;

TEST_CASE("printable text stays as it is, whatever its language") {
    for (const char* text : {"a name.png", "Stra\u00dfe \u6ce2 \U0001f30a", "C:\\back\\slash", ""})
        CHECK(printable(text) == text);
}

TEST_CASE("what a terminal would obey is escaped") {
    CHECK(printable("red \x1b[31m\x07") == "red \\x1b[31m\\x07");
    CHECK(printable("two\nlines\r\tand a tab") == "two\\nlines\\r\\tand a tab");
    CHECK(printable("\x7f\u009b1m") == "\\x7f\\x9b1m"); // delete, and C1's control sequence
    CHECK(printable("\u202egnp.exe") == "\\u{202e}gnp.exe");
    CHECK(printable(std::string_view("a\0b", 3)) == "a\\x00b");
}

TEST_CASE("bytes that are not UTF-8 are shown as numbers") {
    CHECK(printable("\xff\xfe") == "\\xff\\xfe");
    CHECK(printable("\xc3") == "\\xc3");                       // cut off
    CHECK(printable("\xc0\xaf") == "\\xc0\\xaf");              // longer than need be
    CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");     // half of a surrogate pair
    CHECK(printable("\xf5\x80\x80\x80").starts_with("\\xf5")); // beyond Unicode
}

TEST_CASE("of a long text the middle is left out, between characters") {
    const std::string text(5000, 'x');
    CHECK(printable(text).size() < LONGEST_IN_MESSAGE + 10);
    CHECK(printable("begin" + text + "end").starts_with("begin"));
    CHECK(printable("begin" + text + "end").ends_with("end"));
    std::string waves;
    for (int i = 0; i < 200; ++i) waves += "\u6ce2";
    for (size_t longest = 20; longest < 40; ++longest)
        CHECK(printable(waves, longest).find('\\') == std::string::npos);
}

TEST_CASE("a sentence about input shows names harmless, and numbers as they are") {
    const std::string name = "bad\x1b[2J\nname";
    const InputError error("{}: {} is {:.2f}", name, std::string_view("b\tc"), 0.5);
    CHECK(error.what() == std::string("bad\\x1b[2J\\nname: b\\tc is 0.50"));
}

TEST_CASE("lines of a log stay lines") {
    CHECK(printable_lines("one\x1b\ntwo\n") == "one\\x1b\ntwo\n");
    CHECK(printable_lines("") == "");
}
