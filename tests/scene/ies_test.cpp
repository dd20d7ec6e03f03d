// Files of measured lamps.
#include "scene/ies.h"
#include "scene/scratch.h"

#include <fmt/format.h>

#include <cmath>

using namespace onde;
using namespace onde::test;

namespace {

/// A file whose numbers behind TILT are these.
std::string file_of(const std::string& numbers, const std::string& tilt = "TILT=NONE") {
    return "IESNA:LM-63-1995\r\n[TEST] none\r\n" + tilt + "\r\n" + numbers;
}

/// One lamp, `rows` by `columns`, a multiplier.
std::string header(int rows, int columns, double multiplier = 1) {
    return fmt::format("1 1000 {} {} {} 1 2 0 0 0\n1 1 100\n", multiplier, rows, columns);
}

LightProfile profile_of(const std::string& text) {
    LoadContext context;
    Notes notes;
    return read_ies(text, "lamp.ies", context, notes);
}

/// At a vertical and a horizontal angle, degrees, which must be a node.
float at(const LightProfile& p, double v, double h) {
    const double row = v / 180 * p.rows, column = h / 360 * p.columns;
    REQUIRE(row == Approx(std::round(row)));
    return p.node(uint32_t(std::lround(row)), uint32_t(std::lround(column)));
}

std::string refused(const std::string& text) {
    try {
        profile_of(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE(
    "a lamp with one horizontal angle shines alike all around, and not where none is stated") {
    const LightProfile p = profile_of(file_of(header(4, 1, 2) + "0 30 60 90\n0\n100, 80\n30 0\n"));
    CHECK(p.columns == 1);
    CHECK(p.rows == 6);
    CHECK(at(p, 0, 0) == 200);
    CHECK(at(p, 30, 90) == 160);
    CHECK(at(p, 60, 200) == 60);
    CHECK(at(p, 120, 0) == 0);
    CHECK(at(p, 180, 0) == 0);
}

TEST_CASE("what a file leaves out by symmetry is filled in") {
    const std::string vertical = "0 90 180\n";
    const LightProfile quadrant =
        profile_of(file_of(header(3, 3) + vertical + "0 45 90\n1 10 1\n1 20 1\n1 30 1\n"));
    for (const auto& [h, candela] : {std::pair(0, 10),
                                     {45, 20},
                                     {90, 30},
                                     {135, 20},
                                     {180, 10},
                                     {225, 20},
                                     {270, 30},
                                     {315, 20}})
        CHECK(at(quadrant, 90, h) == float(candela));
    const LightProfile half =
        profile_of(file_of(header(3, 3) + vertical + "0 90 180\n1 10 1\n1 20 1\n1 30 1\n"));
    for (const auto& [h, candela] : {std::pair(0, 10), {90, 20}, {180, 30}, {270, 20}})
        CHECK(at(half, 90, h) == float(candela));
    const LightProfile across =
        profile_of(file_of(header(3, 3) + vertical + "90 180 270\n1 10 1\n1 20 1\n1 30 1\n"));
    for (const auto& [h, candela] : {std::pair(90, 10), {180, 20}, {270, 30}, {0, 20}})
        CHECK(at(across, 90, h) == float(candela));
    const LightProfile whole = profile_of(file_of(
        header(3, 5) + vertical + "0 90 180 270 360\n1 10 1\n1 20 1\n1 30 1\n1 40 1\n1 10 1\n"));
    for (const auto& [h, candela] : {std::pair(0, 10), {90, 20}, {180, 30}, {270, 40}})
        CHECK(at(whole, 90, h) == float(candela));
}

TEST_CASE("a lamp that shines upward only is dark below") {
    const LightProfile p = profile_of(file_of(header(3, 1) + "90 120 180\n0\n5 6 7\n"));
    CHECK(at(p, 0, 0) == 0);
    CHECK(at(p, 60, 0) == 0);
    CHECK(at(p, 90, 0) == 5);
    CHECK(at(p, 180, 0) == 7);
}

TEST_CASE("uneven angles are interpolated on a grid of their finest step") {
    const LightProfile p = profile_of(file_of(header(4, 1) + "0 10 30 90\n0\n100 50 30 0\n"));
    CHECK(p.rows == 18);
    CHECK(at(p, 20, 0) == Approx(40));
    CHECK(at(p, 60, 0) == Approx(15));
}

TEST_CASE("the factors of ballasts count, included tilts are passed over with a note") {
    const std::string numbers = "1 -1 2 2 1 1 1 0 0 0\n0.5 3 100\n0 90\n0\n10 4\n";
    CHECK(at(profile_of(file_of(numbers)), 0, 0) == 30);
    LoadContext context;
    Notes notes;
    const LightProfile p = read_ies(file_of("1\n3\n0 45 90\n1 0.9 0.8\n" + numbers, "TILT=INCLUDE"),
                                    "lamp.ies", context, notes);
    CHECK(at(p, 90, 0) == 12);
    CHECK(notes.sentences().size() == 1);
}

TEST_CASE("what is no file of a lamp is refused in one sentence that says where") {
    const std::string good = header(2, 1) + "0 90\n0\n1 2\n";
    CHECK(refused(file_of(good)) == "");
    CHECK_THAT(refused("solid"), Catch::Contains("no line TILT="));
    CHECK_THAT(refused(file_of(header(2, 1) + "0 90\n0\n1")),
               Catch::Contains("ends before its candela"));
    CHECK_THAT(refused(file_of(header(2, 1) + "0 x\n0\n1 2")), Catch::Contains("'x' stands where"));
    CHECK_THAT(refused(file_of(header(2, 1) + "90 0\n0\n1 2")), Catch::Contains("must rise"));
    CHECK_THAT(refused(file_of(header(2, 1) + "0 200\n0\n1 2")), Catch::Contains("at most 180"));
    CHECK_THAT(refused(file_of(header(2, 1) + "0 nan\n0\n1 2")), Catch::Contains("'nan'"));
    CHECK_THAT(refused(file_of("1 1 1 0 1 1 1 0 0 0 1 1 1")),
               Catch::Contains("vertical angles is 0"));
    CHECK_THAT(refused(file_of("1 1 1 9999999 1 1 1 0 0 0 1 1 1")), Catch::Contains("from 1 to"));
    CHECK_THAT(refused(file_of("1 1 1 2 1 2 1 0 0 0 1 1 1\n0 90\n0\n1 2")),
               Catch::Contains("type C"));
    CHECK_THAT(refused(file_of("1 1 -1 2 1 1 1 0 0 0 1 1 1\n0 90\n0\n1 2")),
               Catch::Contains("negative"));
    CHECK_THAT(refused(file_of("1\n99999\n", "TILT=INCLUDE")), Catch::Contains("number of tilts"));
}

TEST_CASE("a scene's photometric lights name files beside it") {
    const ScratchFolder folder;
    folder.write("lamp.ies", file_of(header(2, 1) + "0 90\n0\n683 0\n"));
    const std::string light =
        "[[shape]]\ntype = \"sphere\"\n[[light]]\ntype = \"photometric\"\nposition = [1, 2, 3]\n";
    const Scene scene = load_scene(folder.write("a.toml", light + "ies = \"lamp.ies\"\n"));
    REQUIRE(scene.photometric_lights.size() == 1);
    const PhotometricLight& lamp = scene.photometric_lights[0];
    CHECK(lamp.back == glm::vec3(0, 1, 0)); // straight down
    CHECK(lamp.intensity == glm::vec3(1));
    CHECK(lamp.profile.node(0, 0) == 683);
    const auto refused_scene = [&](const std::string& more) {
        return load_error(folder.write("b.toml", light + more));
    };
    CHECK_THAT(refused_scene(""), Catch::Contains("ies is missing"));
    CHECK_THAT(refused_scene("ies = \"no.ies\""), Catch::Contains("does not exist"));
    CHECK_THAT(refused_scene("ies = \"../lamp.ies\""), Catch::Contains("ies"));
    CHECK_THAT(refused_scene("ies = \"lamp.ies\"\nstart = [0, 3, 0]"),
               Catch::Contains("along direction"));
}
