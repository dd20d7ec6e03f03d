// Width-generic code does in every lane what it does at width 1, bit for bit.
#include "doctor/mapped_bsdfs.h"
#include "kernels/columns.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;
using doctor::bits_of_group;
using doctor::Mapped;
using doctor::random_condition;

namespace {

constexpr size_t COUNT = 4096;
const std::vector<uint32_t> WIDTHS{8, 16};

} // namespace

TEST_CASE("lanes, masks, gathers and compressed stores do what they say at every width") {
    Generator generator(41);
    const Column values = uniform_column(generator, COUNT);
    const Column condition = random_condition(generator, COUNT);
    Columns in{values, condition, Column(COUNT)};
    std::vector<uint32_t> index(COUNT);
    for (size_t i = 0; i < COUNT; i++) {
        index[i] = uint32_t(generator()) % COUNT;
        in[2][i] = word(index[i]);
    }
    for (uint32_t width : {1u, 8u, 16u}) {
        INFO("width " << width);
        Probe probe("basics.cl", width, {"lanes", "compress"});
        const Columns out = probe.run("lanes", in, 4);
        const Column packed = probe.run("compress", {values, condition}, 1)[0];
        for (size_t i = 0; i < COUNT; i++) {
            const uint32_t bits = bits_of_group(condition, i, width);
            REQUIRE(from_word(out[0][i]) == bits);
            REQUIRE(out[1][i] == condition[i]);
            REQUIRE(out[2][i] == (bits ? 1.0f : 0.0f));
            REQUIRE(out[3][i] == values[index[i]]);
        }
        for (size_t first = 0; first < COUNT; first += width) {
            size_t next = first;
            for (size_t i = first; i < first + width; i++)
                if (condition[i] != 0) REQUIRE(packed[next++] == values[i]);
            for (; next < first + width; next++) REQUIRE(packed[next] == UNWRITTEN);
        }
    }
}

TEST_CASE("elementary functions have the same bits at every width") {
    const std::vector<Mapped> functions = doctor::mapped_basics(COUNT);
    std::vector<std::string> names;
    for (const Mapped& mapped : functions) names.push_back(mapped.name);
    Probe scalar("basics.cl", 1, names);
    for (uint32_t width : WIDTHS) {
        Probe wide("basics.cl", width, names);
        for (const Mapped& mapped : functions) {
            INFO(mapped.name << " at width " << width);
            CHECK(first_bit_difference(wide.run(mapped.name, mapped.in, mapped.words),
                                       scalar.run(mapped.name, mapped.in, mapped.words)) == "");
        }
    }
}

TEST_CASE("mixed BSDFs have the same bits at every width") {
    for (uint32_t width : WIDTHS)
        CHECK(doctor::first_bsdf_difference(programs(), width, COUNT) == "");
}
