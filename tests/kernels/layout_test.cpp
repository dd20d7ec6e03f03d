// One definition of each shared struct, read alike by the host's and the device's compiler.
#include "doctor/checks.h"
#include "support/programs.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

TEST_CASE("host and device place every field of every shared struct alike") {
    const doctor::Finding finding = doctor::check_layout({programs()});
    INFO(finding.text);
    CHECK(finding.passed);
}
