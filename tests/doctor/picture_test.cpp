// The built-in picture is the one that these kernels make.
#include "doctor/built_in_picture.h"
#include "doctor/built_in_scene.h"
#include "doctor/checks.h"
#include "doctor/pictures.h"
#include "support/folders.h"
#include "support/programs.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace onde::test {
namespace {

const std::string FILE_OF_PICTURE = in_project("src/doctor/built_in_picture.h");

/// Puts the words of the picture that these kernels make into the source.
void write_picture() {
    const doctor::CheckContext context{programs()};
    const Image image =
        doctor::picture_of(context, doctor::built_in_scene(), doctor::built_in_options(context));
    std::ostringstream before;
    before << std::ifstream(FILE_OF_PICTURE).rdbuf();
    std::string text = before.str();
    const size_t begin = text.find("= {") + 3, end = text.find("};", begin);
    std::string words;
    for (size_t i = 0; i < image.pixels.size(); ++i)
        words += fmt::format("{}0x{:08x},", i % 8 ? " " : "\n    ",
                             std::bit_cast<uint32_t>(image.pixels[i]));
    std::ofstream(FILE_OF_PICTURE) << text.replace(begin, end - begin, words + "\n");
}

} // namespace

TEST_CASE("the built-in picture has the bits that the kernels make; where they are to change, run "
          "ONDE_WRITE_PICTURE=1 onde_test_doctor and build again") {
    if (std::getenv("ONDE_WRITE_PICTURE")) return write_picture();
    const doctor::Finding finding = doctor::check_picture({programs()});
    INFO(finding.text);
    CHECK(finding.value == 0);
}

} // namespace onde::test
