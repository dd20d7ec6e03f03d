// `onde compare`.
#include "image/image_io.h"
#include "onde_process.h"

#include <nlohmann/json.hpp>

using namespace onde::test;

namespace {

onde::Image plain(float value) {
    onde::Image image(4, 3, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

} // namespace

TEST_CASE("compare measures pictures, equal or not, and ends with code 0 for both") {
    const Folder folder;
    onde::write_exr(folder / "a.exr", plain(0.5f), {});
    onde::write_exr(folder / "b.exr", plain(0.75f), {});
    CHECK_THAT(output_of(folder, {"compare", "a.exr", "a.exr"}),
               Catch::Contains("RMSE         0\n"));
    CHECK_THAT(output_of(folder, {"compare", "a.exr", "b.exr"}),
               Catch::Contains("RMSE         0.25\n"));
    const auto equal =
        nlohmann::json::parse(output_of(folder, {"compare", "a.exr", "a.exr", "--json"}));
    CHECK(equal.at("rmse") == 0.0);
    CHECK(equal.at("psnr").is_null()); // infinite
    const std::string line = output_of(folder, {"compare", "a.exr", "b.exr", "--json"});
    CHECK(line.find('\n') == line.size() - 1);
    CHECK(nlohmann::json::parse(line).at("worst").at("b") == 0.75);
}

TEST_CASE("compare tests whether a picture is its reference but for noise") {
    const Folder folder;
    onde::write_exr(folder / "a.exr", plain(0.5f), {});
    onde::write_exr(folder / "b.exr", plain(0.75f), {});
    onde::write_exr(folder / "v.exr", plain(1.0f), {});
    const auto within = [&](const std::string& samples) {
        return nlohmann::json::parse(output_of(folder, {"compare", "a.exr", "b.exr", "--variance",
                                                        "v.exr", "--samples", samples, "--json"}))
            .at("within_noise");
    };
    CHECK(within("16") == 1.0);
    CHECK(within("1024") == 0.0);
    CHECK_THAT(
        output_of(folder, {"compare", "a.exr", "b.exr", "--variance", "v.exr", "--samples", "16"}),
        Catch::Contains("within noise 100.000 %"));
    const Outcome half = onde::test::onde(folder, {"compare", "a.exr", "b.exr", "--samples", "4"});
    CHECK(half.code == 2);
    CHECK_THAT(half.err, Catch::Contains("go together"));
}

TEST_CASE("compare writes the difference, and refuses what it cannot compare or write") {
    const Folder folder;
    onde::write_exr(folder / "a.exr", plain(0.5f), {});
    onde::write_exr(folder / "b.exr", plain(0.75f), {});
    onde::write_exr(folder / "small.exr", onde::Image(2, 2, 3), {});
    output_of(folder, {"compare", "a.exr", "b.exr", "--diff", "d.exr"});
    CHECK(onde::read_image(folder / "d.exr").pixels == plain(0.25f).pixels);
    const auto before = folder.files();
    const Arguments wrong[] = {{"compare", "a.exr", "small.exr"},
                               {"compare", "a.exr", "b.exr", "--diff", "d.jpg"},
                               {"compare", "a.exr", "b.exr", "--diff", "no/such/d.png"}};
    for (const Arguments& arguments : wrong) {
        const Outcome outcome = onde::test::onde(folder, arguments);
        INFO(outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.starts_with("onde: "));
    }
    CHECK(folder.files() == before);
}
