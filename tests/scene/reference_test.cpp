// docs/scene-format.md shows the tables that the loaders read.
#include "core/files.h"
#include "scene/file_words.h"
#include "scene/reference.h"
#include "support/folders.h"

#include <catch2/catch.hpp>

#include <set>

using namespace onde;

namespace {

const std::string END = "<!-- end -->\n";

std::string page() {
    return read_file(onde::test::in_project("docs/scene-format.md"));
}

} // namespace

TEST_CASE("the tables of docs/scene-format.md are up to date; else run tools/write_reference.py") {
    const std::string text = page();
    for (const ReferenceTable& table : reference_tables()) {
        const std::string begin = "<!-- table " + table.name + " -->\n";
        INFO(begin);
        const size_t at = text.find(begin);
        REQUIRE(at != std::string::npos);
        const size_t first = at + begin.size(), end = text.find(END, first);
        REQUIRE(end != std::string::npos);
        CHECK(text.substr(first, end - first) == table.markdown);
    }
}

TEST_CASE("the page has no table that nothing writes") {
    std::set<std::string> names;
    for (const ReferenceTable& table : reference_tables()) names.insert(table.name);
    CHECK(names.size() == reference_tables().size());
    const std::string text = page(), begin = "<!-- table ";
    for (size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
        const size_t first = at + begin.size();
        CHECK(names.contains(text.substr(first, text.find(" -->", first) - first)));
    }
}

TEST_CASE("every word of other formats' files that a reader knows is in a table, once") {
    for (const auto& words : {mtl::statement_words(), mtl::map_option_words(), ply::element_words(),
                              ply::property_words(), pbrt::directive_words(),
                              pbrt::material_words(), mitsuba::plugin_words()}) {
        std::set<std::string_view> seen;
        CHECK(words.size() > 2);
        for (const FileWord& word : words) {
            INFO(word.word);
            CHECK(seen.insert(word.word).second);
            CHECK_FALSE(word.becomes.empty());
            CHECK_THAT(page(), Catch::Contains("`" + std::string(word.word) + "`"));
        }
    }
}

TEST_CASE("a table says each key, its values and its default") {
    for (const ReferenceTable& table : reference_tables()) {
        if (table.name != "material") continue;
        CHECK_THAT(table.markdown, Catch::Contains("| `base_color` (or `color`) |"));
        CHECK_THAT(table.markdown, Catch::Contains("`\"metallic-roughness\"`"));
        CHECK_THAT(table.markdown, Catch::Contains("| number 0.01 to 100: "));
        CHECK_THAT(table.markdown, Catch::Contains("| `1.5` |"));
    }
}
