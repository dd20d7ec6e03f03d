// PLY files that a renderer must refuse with a sentence that names the file and the culprit.
#include "scratch.h"

using namespace onde;
using onde::test::bytes_of;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

/// The parts of a valid ASCII file of one triangle; each case spoils one of them.
struct Parts {
    std::string format = "ply\nformat ascii 1.0\n";
    std::string vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    std::string end = "end_header\n";
    std::string positions = "0 0 0\n1 0 0\n0 1 0\n";
    std::string corners = "3 0 1 2\n";

    std::string text() const { return format + vertex + face + end + positions + corners; }
};

Parts with(std::string Parts::*part, const std::string& text) {
    Parts parts;
    parts.*part = text;
    return parts;
}

std::string error_of(const std::string& file) {
    ScratchFolder folder;
    const std::string error = load_error(folder.write("evil.ply", file));
    if (!error.empty()) CHECK_THAT(error, Catch::Contains("evil.ply"));
    CHECK(error.find('\n') == std::string::npos);
    return error;
}

struct Case {
    Parts parts;
    std::string culprit;
};

/// A valid binary file of one triangle with corners of that type.
Parts binary(const std::string& vertices, const std::string& corner_type,
             const std::string& corners) {
    Parts parts;
    parts.format = "ply\nformat binary_little_endian 1.0\n";
    parts.vertex =
        "element vertex " + vertices + "\nproperty float x\nproperty float y\nproperty float z\n";
    parts.face = "element face 1\nproperty list " + corner_type + " vertex_indices\n";
    parts.positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
    parts.corners = corners;
    return parts;
}

} // namespace

TEST_CASE("the PLY files that every hostile case spoils are themselves valid") {
    CHECK(error_of(Parts().text()).empty());
    CHECK(error_of(binary("3", "uchar uchar", std::string("\3\0\1\2", 4)).text()).empty());
}

TEST_CASE("damaged PLY headers are refused with their line") {
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const Case cases[] = {
        {with(&Parts::format, ""), "evil.ply:1: not a valid PLY file: it doesn't begin with 'ply'"},
        {with(&Parts::format, "ply\n"), "without a format"},
        {with(&Parts::format, "ply\nformat ascii 2.0\n"), "evil.ply:2"},
        {with(&Parts::format, "ply\nformat ascii 1.0\nformat ascii 1.0\n"), "evil.ply:3"},
        {with(&Parts::format, "ply\nformat binary 1.0\n"), "neither ascii nor binary"},
        {with(&Parts::format, "ply\nformat ascii 1.0\nproperty int a\n"), "evil.ply:3"},
        {with(&Parts::format, "ply\nformat ascii 1.0\nhello\n"), "not a line of a PLY header"},
        {with(&Parts::format, "ply\ncomment " + std::string(5000, 'x') + "\n"),
         "evil.ply:2: not a valid PLY file: more than 4096 characters"},
        {with(&Parts::format, "ply\n" + std::string(70000, '\n')), "exceeds 65536 bytes"},
        {with(&Parts::vertex, "element vertex\n" + xyz), "needs a name and a count"},
        {with(&Parts::vertex, "element vertex -3\n" + xyz), "not a number of elements"},
        {with(&Parts::vertex, "element vertex 18446744073709551616\n" + xyz), "not a number of"},
        {with(&Parts::vertex, "element vertex 3\nproperty quaternion q\n" + xyz), "no such type"},
        {with(&Parts::vertex, "element vertex 3\nproperty float x\n" + xyz), "declared twice"},
        {with(&Parts::vertex, Parts().vertex + Parts().vertex), "declared twice"},
        {with(&Parts::vertex, "element vertex 3\nproperty float x\n"), "no x, y and z"},
        {with(&Parts::vertex, "element vertex 3\nproperty list uchar float x\nproperty float y\n"
                              "property float z\n"),
         "no x, y and z"},
        {with(&Parts::vertex, ""), "lists no vertices or no faces"},
        {with(&Parts::face, ""), "lists no vertices or no faces"},
        {with(&Parts::face, "element face 1\nproperty int vertex_indices\n"), "no list"},
        {with(&Parts::face, "element face 1\nproperty list float int vertex_indices\n"),
         "length must be an integer"},
        {with(&Parts::face, "element face 1\nproperty list uchar float vertex_indices\n"),
         "of integers"},
        {with(&Parts::end, ""), "not a line of a PLY header"},
    };
    for (const Case& c : cases) {
        INFO(c.culprit);
        CHECK_THAT(error_of(c.parts.text()), Catch::Contains(c.culprit));
    }
    CHECK_THAT(error_of(""), Catch::Contains("evil.ply:1"));
    CHECK_THAT(error_of("ply"), Catch::Contains("no end"));
    CHECK_THAT(error_of("ply\nformat ascii 1.0\n"), Catch::Contains("no end"));
    const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
    CHECK_THAT(
        error_of(with(&Parts::face, strips)
                     .text()
                     .replace(with(&Parts::face, strips).text().find("3 0 1 2"), 7, "3 0 1 -2")),
        Catch::Contains("names vertex -2"));
    Parts reversed;
    std::swap(reversed.vertex, reversed.face);
    CHECK_THAT(error_of(reversed.text()), Catch::Contains("faces come before"));
}

TEST_CASE("PLY values that are no coordinates, corners or lengths are refused with their row") {
    const Case cases[] = {
        {with(&Parts::positions, "0 0 0\n1 nan 0\n0 1 0\n"), "all faces have positions"},
        {with(&Parts::positions, "0 0 0\n1 0 inf\n0 1 0\n"), "all faces have positions"},
        {with(&Parts::positions, "0 0 0\n1 0 0\n1e999 1 0\n"), "all faces have positions"},
        {with(&Parts::positions, "0 0 0\n1 0 0\n1e60 1 0\n"), "all faces have positions"},
        {with(&Parts::positions, "0 0 0\n1 0 0\n0x1 1 0\n"), "vertex 2: its x is not a number"},
        {with(&Parts::positions, "0 0 0\n1 0 0\n1,5 1 0\n"), "vertex 2: its x is not a number"},
        {with(&Parts::positions, "0 0 0\n1 0 0\n" + std::string(100, '1') + " 1 0\n"),
         "more than 64 characters"},
        {with(&Parts::corners, "3 0 1 3\n"), "face 0: names vertex 3, but there are 3"},
        {with(&Parts::corners, "3 0 1 -1\n"), "face 0: names vertex -1"},
        {with(&Parts::corners, "3 0 1 1.5\n"), "face 0: names vertex 1.5"},
        {with(&Parts::corners, "3 0 1 4294967296\n"), "face 0: names vertex 4294967296"},
        {with(&Parts::corners, "4000000000 0 1 2\n"), "has the length 4000000000"},
        {with(&Parts::corners, "-3 0 1 2\n"), "has the length -3"},
        {with(&Parts::corners, "many 0 1 2\n"), "has the length nan"},
        {with(&Parts::corners, "3 0 1\n"), "face 0: the file ends here"},
        {with(&Parts::corners, ""), "face 0: the file ends here, but the header claims 1 of them"},
        {with(&Parts::positions, "0 0"), "vertex 0: the header claims 3 of them"},
        {with(&Parts::face, "element face 0\nproperty list uchar int vertex_indices\n"), "empty"},
    };
    for (const Case& c : cases) {
        INFO(c.culprit);
        CHECK_THAT(error_of(c.parts.text()), Catch::Contains(c.culprit));
    }
}

TEST_CASE("binary PLY files that are cut or lie about their size are refused") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string corners("\3\0\1\2", 4);
    Parts not_finite = binary("3", "uchar uchar", corners);
    not_finite.positions = bytes_of<float>({0, 0, 0, 1, 0, nan, 0, 1, 0});
    const Case cases[] = {
        {not_finite, "all faces have positions"},
        {binary("4000000000", "uchar uchar", corners), "more than 268435456 vertices"},
        {binary("200000000", "uchar uchar", corners), "more than the 40 bytes that are left"},
        {binary("18446744073709551615", "uchar uchar", corners), "more than 268435456 vertices"},
        {binary("3", "uint uchar", std::string(4, '\xff') + corners), "has the length 4294967295"},
        {binary("3", "int uchar", std::string(4, '\xff') + corners), "has the length -1"},
        {binary("3", "uchar int", "\3" + bytes_of<int32_t>({0, 1, -2})), "names vertex -2"},
        {binary("3", "uchar uint", "\3" + bytes_of<uint32_t>({0, 1, 0xffffffff})),
         "names vertex 4294967295"},
        {binary("3", "uchar uchar", std::string("\3\0\1", 3)), "has the length 3"},
        {binary("3", "uchar uchar", ""), "face 0: the header claims 1 of them, more than the 0"},
    };
    for (const Case& c : cases) {
        INFO(c.culprit);
        CHECK_THAT(error_of(c.parts.text()), Catch::Contains(c.culprit));
    }
}

TEST_CASE("a PLY file cut anywhere is refused, and so is one with elements that aren't there") {
    const std::string whole = binary("3", "uchar uchar", std::string("\3\0\1\2", 4)).text();
    for (size_t size = 0; size < whole.size(); ++size) {
        INFO(size);
        CHECK_FALSE(error_of(whole.substr(0, size)).empty());
    }
    Parts parts;
    parts.face += "element edge 18446744073709551615\nproperty int a\n";
    CHECK_THAT(error_of(parts.text()), Catch::Contains("edge 0: the header claims 18446744"));
    parts.face = Parts().face + "element nothing 18446744073709551615\n"; // takes no time
    CHECK(error_of(parts.text()).empty());
}
