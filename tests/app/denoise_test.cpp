// Denoised pictures, and what is said where they can't be.
#include "onde_process.h"

using namespace onde::test;

namespace {

/// A place that is named and has no library that could be opened.
void write_broken_library(const Folder& folder) {
    folder.write("broken/libOpenImageDenoise.so.2", "no library");
}

} // namespace

TEST_CASE("--denoise writes a denoised picture and reports by what") {
    const Folder folder;
    const Outcome noisy = onde::test::onde(folder, render(CORNELL, {"-o", "noisy.exr"}));
    INFO(noisy.err);
    CHECK(noisy.code == 0);
    const Outcome outcome = onde::test::onde(
        folder, render(CORNELL, {"--denoise", "onde", "-o", "a.exr", "--json", "a.json"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("denoised by Onde in"));
    CHECK(content(folder / "a.exr") != content(folder / "noisy.exr"));
    CHECK_THAT(content(folder / "a.json"),
               Catch::Contains("\"denoiser\": \"Onde\"") && Catch::Contains("denoise_seconds"));
}

TEST_CASE("--denoise stands alone before a scene, and does without a library that is broken") {
    const Folder folder;
    write_broken_library(folder);
    Arguments words = render(CORNELL, {"-o", "a.png"});
    words.insert(words.begin() + 1, "--denoise");
    const Outcome outcome = onde::test::onde(folder, words, {{"ONDE_DENOISER_LIBRARY", "broken"}});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("can't be opened") &&
                                Catch::Contains("denoised by our own denoiser"));
    CHECK(fs::exists(folder / "a.png"));
}

TEST_CASE("a denoiser that is asked for and is not there is told before rendering") {
    const Folder folder;
    write_broken_library(folder);
    const std::vector<std::pair<Arguments, const char*>> wrong{
        {{"--denoise", "oidn", "--denoiser-library", "none"}, "no such file or folder"},
        {{"--denoise", "oidn", "--denoiser-library", "broken"}, "can't be opened"},
        {{"--denoise", "--denoiser-library", "broken"}, "can't be opened"},
        {{"--denoise", "--integrator", "whitted"}, "--integrator path"},
        {{"--denoise=best"}, "--denoise"}};
    for (const auto& [options, sentence] : wrong) {
        INFO(sentence);
        Arguments more{"-o", "a.png"};
        more.insert(more.end(), options.begin(), options.end());
        const Outcome outcome = onde::test::onde(folder, render(CORNELL, more));
        CHECK(outcome.code == 2);
        CHECK_THAT(outcome.err, Catch::Contains(sentence));
        CHECK_FALSE(fs::exists(folder / "a.png"));
    }
}

TEST_CASE("thumbnails are denoised too") {
    const Folder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Outcome outcome = onde::test::onde(folder, {"thumbnail", "a.obj", "--size", "16", "--spp",
                                                      "2", "--denoise", "onde", "-o", "p"});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("denoised by Onde"));
}
