// A budget of memory for textures, as users give it.
#include "image/image_io.h"
#include "onde_process.h"

#include <nlohmann/json.hpp>

using namespace onde::test;

namespace {

/// A quad with a texture of 4 MiB.
void write_quad(const Folder& folder) {
    onde::Image image(1024, 1024, 3);
    for (size_t i = 0; i < image.pixels.size(); i++) image.pixels[i] = float(i % 7) / 7;
    onde::write_png(folder / "a.png", image, {}, {});
    folder.write("quad.obj", "mtllib quad.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    folder.write("quad.mtl", "newmtl a\nmap_Kd a.png\n");
}

} // namespace

TEST_CASE("--texture-memory halves textures until they fit, and says so") {
    const Folder folder;
    write_quad(folder);
    const auto bytes = [&](const Arguments& more) {
        Arguments all = render("quad.obj", {"-o", "b.png", "--json", "b.json"});
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = onde::test::onde(folder, all);
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        const bool told =
            outcome.err.find("1 of 1 pictures have fewer texels") < outcome.err.size();
        CHECK(told == !more.empty());
        const auto report = nlohmann::json::parse(content(folder / "b.json"));
        CHECK(report.at("texture_bytes") < report.at("scene_bytes"));
        return report.at("texture_bytes").get<uint64_t>();
    };
    constexpr uint64_t RECORD = 64, MEBI = 1 << 20;
    CHECK(bytes({}) == 4 * MEBI + RECORD);
    CHECK(bytes({"--texture-memory", "0.001"}) == MEBI + RECORD);
    const Outcome info =
        onde::test::onde(folder, {"info", "quad.obj", "--texture-memory", "0.001"});
    CHECK(info.code == 0);
    CHECK_THAT(info.out, Catch::Contains("1.00 MiB"));
    const Outcome wrong = onde::test::onde(folder, render("quad.obj", {"--texture-memory", "0"}));
    CHECK(wrong.code == 2);
    CHECK_THAT(wrong.err, Catch::Contains("--texture-memory 0 is out of range"));
}
