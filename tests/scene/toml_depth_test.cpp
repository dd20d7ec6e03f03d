// TOML that would make a parser recurse until its stack overflows is refused before.
#include "scene/toml/depth.h"
#include "scratch.h"

using namespace onde;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

std::string repeated(const std::string& text, size_t times) {
    std::string result;
    for (size_t i = 0; i < times; ++i) result += text;
    return result;
}

} // namespace

TEST_CASE("keys of many parts and brackets in brackets are refused with their line") {
    const std::string deep = repeated("a.", 31000) + "a";
    for (const std::string& toml :
         {deep + " = 1", "[" + deep + "]", "[[" + deep + "]]", "a = { " + deep + " = 1 }",
          "a = " + repeated("[", 31000), "a = " + repeated("{a=", 31000),
          "x = '''\n'''''\n" + deep + " = 1", "s = \"\"\"\"x\"\"\"\"\n" + deep + " = 1",
          "a = {s = \"\"\"\"x\"\"\"\"\", " + deep + " = 1}",
          repeated("'a' . \"a\".", 31000) + "a=1"}) {
        INFO(toml.substr(0, 60));
        ScratchFolder folder;
        CHECK_THAT(load_error(folder.write("evil.toml", "\n" + toml)),
                   Catch::Contains("evil.toml:") && Catch::Contains("nested too deep"));
    }
}

TEST_CASE("points and brackets in texts, comments and numbers do not nest") {
    const std::string points = repeated(".", 100), brackets = repeated("[", 100);
    for (const std::string& toml :
         {"# " + points + brackets, "a = \"" + points + brackets + "\"",
          "a = '" + points + "'\nb = '" + brackets + "'",
          "a = '''" + points + "\n" + points + "'''", "a = \"\\\"" + points + "\"",
          "a = [" + repeated("0.5, ", 1000) + "1]", repeated("[a.b]\nx.y = [0.5]\n", 100)})
        CHECK_FALSE(line_nested_deeper(toml, 32));
    CHECK(line_nested_deeper("a = 1\nb.b.b = 2", 2) == 2);
    CHECK_FALSE(line_nested_deeper("a = 1\nb.b.b = 2", 3));
}
