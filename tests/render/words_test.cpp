// Every word that a scene file or an option takes is in the documentation.
#include "accel/bvh.h"
#include "core/files.h"
#include "image/image_io.h"
#include "render/options.h"
#include "scene/toml/keys.h"
#include "support/folders.h"

#include <catch2/catch.hpp>

#include <regex>

namespace onde {
namespace {

std::string documentation() {
    const std::filesystem::path root(onde::test::in_project(""));
    std::string text = read_file(root / "README.md");
    for (const auto& entry : std::filesystem::directory_iterator(root / "docs"))
        if (entry.path().extension() == ".md") text += read_file(entry.path());
    return text;
}

/// As `word`, `"word"` or after an option, as in `--option word`.
template <WordedEnum Enum>
void check_words(const std::string& text) {
    for (const std::string_view word : all_words<Enum>()) {
        INFO(word << " is not in README.md or docs/*.md");
        const std::regex quoted("(`\"?|--[a-z-]+ )" + std::string(word) + "[\"` ]");
        CHECK(std::regex_search(text, quoted));
    }
}

} // namespace

TEST_CASE("every word of an enum is documented") {
    const std::string text = documentation();
    check_words<IntegratorKind>(text);
    check_words<Filter>(text);
    check_words<MaterialKind>(text);
    check_words<Wrap>(text);
    check_words<Reflectivity>(text);
    check_words<toml_keys::ShapeType>(text);
    check_words<toml_keys::LightType>(text);
    check_words<ToneMap>(text);
    check_words<BvhBuilder>(text);
    check_words<BvhLayout>(text);
    check_words<Engine>(text);
    check_words<gpu::Launch>(text);
}

} // namespace onde
