// `onde gallery`: the page, and what stands in its way.
#include "image/image_io.h"
#include "onde_process.h"
#include "support/folders.h"

using namespace onde::test;

namespace {

const std::string CHAPTER = in_project("scenes/chapter/");

Outcome gallery(const Folder& folder, const Arguments& scenes, const Arguments& more = {}) {
    Arguments all{"gallery", "--spp", "1", "-o", "page"};
    all.insert(all.end(), scenes.begin(), scenes.end());
    all.insert(all.end(), more.begin(), more.end());
    return onde::test::onde(folder, all);
}

/// A lit ball of which `expectation` is stated.
std::string small_scene(const std::string& expectation) {
    return "[film]\nsize = [32, 24]\n[render]\nintegrator = \"depth-buffer\"\n"
           "[[shape]]\ntype = \"box\"\nsize = 100\n[camera]\nposition = [0, 0, 200]\n"
           "look_at = [0, 0, 0]\northographic_height = 2\n"
           "[lesson]\ntitle = \"Balls & <boxes>\"\nsection = \"1.1\"\nformulas = [\"x_1^2 < y\"]\n"
           "[[lesson.expect]]\npixel = [3, 4]\nbecause = \"grey\"\n" +
           expectation;
}

} // namespace

TEST_CASE("the gallery hangs pictures beside their formulas, checks and ray trees") {
    const Folder folder;
    const Outcome outcome =
        gallery(folder, {CHAPTER + "mirror-chain.toml", CHAPTER + "depth-buffer.toml"});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(folder.files().size() == 4); // with the folder itself
    const onde::Image picture = onde::read_image(folder / "page/mirror-chain.png");
    CHECK(picture.width == 481);
    CHECK(onde::read_image(folder / "page/depth-buffer.png").width == 640);
    const std::string page = content(folder / "page/index.html");
    for (const char* part : {"<img src=\"mirror-chain.png\"", "2.5 A chain of mirrors",
                             "<sub>1</sub>", "mirrored ray: meets", "3 of 3 numbers",
                             "3200 times&nbsp;✓", "left out: reflection and refraction"})
        CHECK_THAT(page, Catch::Contains(part));
    CHECK(page.find("1.1 The depth buffer") < page.find("2.5 A chain")); // the chapter's order
    CHECK(page.find("✗") == std::string::npos);
}

TEST_CASE("a number that a picture does not show ends the gallery with 2, and the page marks it") {
    const Folder folder;
    folder.write("right.toml", small_scene("color = 0.8\n"));
    CHECK(gallery(folder, {"right.toml"}).code == 0);
    folder.write("wrong.toml", small_scene("color = 0.7\n"));
    const Outcome outcome = gallery(folder, {"right.toml", "wrong.toml"}); // over the page before
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Catch::Contains("wrong: pixel (3, 4): expected 0.7 within 0.005, "
                                            "measured 0.8"));
    const std::string page = content(folder / "page/index.html");
    CHECK_THAT(page, Catch::Contains("0.8&nbsp;✗") && Catch::Contains("1 of 2 numbers") &&
                         Catch::Contains("Balls &amp; &lt;boxes&gt;") &&
                         Catch::Contains("<var>x</var><sub>1</sub><sup>2</sup> &lt; <var>y</var>"));
}

TEST_CASE("the gallery refuses what is wrong before it renders or makes anything") {
    const Folder folder;
    folder.write("right.toml", small_scene("color = 0.8\n"));
    folder.write("again/right.toml", small_scene("color = 0.8\n"));
    folder.write("outside.toml", small_scene("color = 0.8\n[[lesson.expect]]\npixel = [32, 0]\n"
                                             "color = 1\nbecause = \"x\"\n"));
    folder.write("mine/index.html", "my own page");
    folder.write("empty/notes.txt", "no scene");
    folder.write("file", "not a folder");
    const auto before = folder.files();
    const std::pair<Arguments, std::string> cases[] = {
        {{"missing.toml"}, "missing.toml"},
        {{"right.toml", "again/right.toml"}, "would have the same picture"},
        {{"outside.toml"}, "pixel (32, 0) is not inside"},
        {{"empty"}, "no .toml scene"},
        {{"right.toml", "-o", "mine"}, "not a gallery of Onde's"},
        {{"right.toml", "-o", "file/page"}, "can't be made"},
        {{"right.toml", "--spp", "0"}, "samples"}};
    for (const auto& [arguments, culprit] : cases) {
        Arguments all{"gallery"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = onde::test::onde(folder, all);
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains(culprit));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
    CHECK(folder.files() == before);
}
