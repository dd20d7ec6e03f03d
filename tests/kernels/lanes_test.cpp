// Width-generic code does in every lane what it does at width 1, bit for bit.
#include "kernels/columns.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

namespace {

constexpr size_t COUNT = 4096;
const std::vector<uint32_t> WIDTHS{8, 16};

Column random_condition(Generator& generator, size_t count) {
    Column column(count);
    // Groups with no lane and with all lanes are among them.
    for (size_t i = 0; i < count; i++) {
        const size_t group = i / 16;
        const float share = group % 8 == 0 ? 0.0f : group % 8 == 1 ? 1.0f : 0.3f;
        column[i] = unit(generator) < share ? 1.0f : 0.0f;
    }
    return column;
}

uint32_t bits_of_group(const Column& condition, size_t item, uint32_t width) {
    const size_t first = item / width * width;
    uint32_t bits = 0;
    for (uint32_t k = 0; k < width; k++) bits |= uint32_t(condition[first + k] != 0) << k;
    return bits;
}

/// Everything in basics.cl that is lane by lane, with inputs from its domain.
struct Mapped {
    const char* name;
    size_t words;
    Columns in;
};

std::vector<Mapped> basics() {
    Generator generator(31);
    const auto uniform = [&](float low, float high) {
        return uniform_column(generator, COUNT, low, high);
    };
    const auto words = [&] {
        Column column(COUNT);
        for (float& a : column) a = word(uint32_t(generator()));
        return column;
    };
    Columns basis;
    add_vectors(basis, unit_vectors(generator, COUNT));
    add_vectors(basis, unit_vectors(generator, COUNT));
    return {
        {"math", 6, {uniform(-3, 3), uniform(-1, 1), uniform(-1, 1), words()}},
        {"basis", 15, basis},
        {"random", 2, {words(), words(), word_column(COUNT, 9), word_column(COUNT, 5)}},
        {"sampling", 15, {uniform(0, 1), uniform(0, 1), uniform(0, 2)}},
        {"heuristic", 1, {uniform(0, 10), uniform(0, 10)}},
        {"fresnel",
         4,
         {uniform(0, 1), uniform(0.5f, 2), uniform(0, 1), uniform(0, 1), uniform(0, 1),
          uniform(0, 1)}},
    };
}

/// BSDFs of every kind, smooth and rough, side by side in the lanes; wo; then 3 numbers or wi.
Columns mixed_bsdfs(bool with_wi) {
    Generator generator(37);
    Columns in(11, Column(COUNT));
    for (size_t i = 0; i < COUNT; i++) {
        const uint32_t kind = uint32_t(generator()) % 4;
        for (size_t k = 0; k < 6; k++) in[k][i] = unit(generator);
        in[6][i] = kind == 0 ? 0.0f : 1.0f;
        in[7][i] = generator() % 4 == 0 ? 0.0f : unit(generator);
        in[8][i] = kind == 0 ? 0.0f : kind == 1 ? 1.0f : 0.1f + 0.8f * unit(generator);
        in[9][i] = generator() % 2 ? 1.5f : 1 / 1.5f;
        in[10][i] = kind == 3 ? 1.0f : 0.0f;
    }
    std::vector<glm::vec3> wo = unit_vectors(generator, COUNT);
    for (glm::vec3& v : wo) v.z = std::max(std::abs(v.z), 1e-4f);
    add_vectors(in, wo);
    if (with_wi)
        add_vectors(in, unit_vectors(generator, COUNT));
    else
        for (int k = 0; k < 3; k++) in.push_back(uniform_column(generator, COUNT));
    return in;
}

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
    const std::vector<Mapped> all = basics();
    std::vector<std::string> names;
    for (const Mapped& mapped : all) names.push_back(mapped.name);
    Probe scalar("basics.cl", 1, names);
    for (uint32_t width : WIDTHS) {
        Probe wide("basics.cl", width, names);
        for (const Mapped& mapped : all) {
            INFO(mapped.name << " at width " << width);
            CHECK(first_bit_difference(wide.run(mapped.name, mapped.in, mapped.words),
                                       scalar.run(mapped.name, mapped.in, mapped.words)) == "");
        }
    }
}

TEST_CASE("mixed BSDFs have the same bits at every width") {
    Probe scalar("bsdf.cl", 1, {"bsdf_eval", "bsdf_sample"});
    const Columns eval = mixed_bsdfs(true), sample = mixed_bsdfs(false);
    const Columns values = scalar.run("bsdf_eval", eval, 4);
    const Columns samples = scalar.run("bsdf_sample", sample, 9);
    for (uint32_t width : WIDTHS) {
        INFO("width " << width);
        Probe wide("bsdf.cl", width, {"bsdf_eval", "bsdf_sample"});
        CHECK(first_bit_difference(wide.run("bsdf_eval", eval, 4), values) == "");
        CHECK(first_bit_difference(wide.run("bsdf_sample", sample, 9), samples) == "");
    }
}
