// The painter's sort: the device's radix sort against std::stable_sort, and keys in the order of
// depths.
#include "chapter/raster_sort.h"
#include "kernels/columns.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace onde;
using namespace onde::test;

namespace {

using Words = std::vector<uint32_t>;

struct Pairs {
    Words keys, values;
};

/// Sorts the first `count` pairs on the device.
Pairs sort_on_device(RadixSort& sort, const Pairs& pairs, uint32_t count) {
    gpu::Buffer<uint32_t> keys(device(), pairs.keys.size());
    gpu::Buffer<uint32_t> values(device(), pairs.keys.size());
    keys.write(device(), pairs.keys);
    values.write(device(), pairs.values);
    sort.sort(keys, values, count);
    return {keys.read(device()), values.read(device())};
}

/// Values are the places before.
Pairs numbered(Words keys) {
    Words values(keys.size());
    std::iota(values.begin(), values.end(), 0u);
    return {std::move(keys), std::move(values)};
}

Pairs sort_on_host(const Pairs& pairs, uint32_t count) {
    Pairs sorted = pairs;
    std::stable_sort(sorted.values.begin(), sorted.values.begin() + count,
                     [&](uint32_t a, uint32_t b) { return pairs.keys[a] < pairs.keys[b]; });
    for (size_t i = 0; i < sorted.keys.size(); i++) sorted.keys[i] = pairs.keys[sorted.values[i]];
    return sorted;
}

std::string first_difference(const Words& got, const Words& wanted) {
    for (size_t i = 0; i < wanted.size(); i++)
        if (got[i] != wanted[i]) return fmt::format("{}: {} for {}", i, got[i], wanted[i]);
    return {};
}

void check_sort(RadixSort& sort, const Pairs& pairs, uint32_t count) {
    const Pairs got = sort_on_device(sort, pairs, count), wanted = sort_on_host(pairs, count);
    INFO(count << " pairs");
    CHECK(first_difference(got.keys, wanted.keys) == "");
    CHECK(first_difference(got.values, wanted.values) == "");
}

constexpr uint32_t CAPACITY = 100'000; // several blocks, and no multiple of one

RadixSort small_sort(uint32_t group) {
    gpu::BufferList list(device());
    return RadixSort(programs(), SortBuffers(list, device().facts(), CAPACITY), CAPACITY, group);
}

} // namespace

TEST_CASE("the radix sort puts pairs where std::stable_sort does") {
    const uint32_t group = GENERATE(1u, 16u); // of CPUs and of GPUs
    RadixSort sort = small_sort(group);
    Generator generator(1);
    for (uint32_t count :
         {1u, 2u, 3u, 255u, 256u, 257u, 16383u, 16384u, 16385u, 40'000u, CAPACITY}) {
        Words any(count), few(count);
        for (uint32_t& key : any) key = uint32_t(generator());
        for (uint32_t& key : few) key = uint32_t(generator()) % 3 << 15; // most are equal
        check_sort(sort, numbered(any), count);
        check_sort(sort, numbered(few), count);
    }
}

TEST_CASE("the radix sort of no pairs, and of some of a buffer, leaves the rest alone") {
    RadixSort sort = small_sort(RadixSort::best_group(device().facts()));
    const Pairs pairs = numbered({5, 4, 3, 2, 1, 0});
    check_sort(sort, pairs, 0);
    check_sort(sort, pairs, 4);
    REQUIRE_THROWS(sort_on_device(sort, numbered(Words(CAPACITY + 1)), CAPACITY + 1));
}

TEST_CASE("sorted, reversed, equal and extreme keys are sorted") {
    RadixSort sort = small_sort(RadixSort::best_group(device().facts()));
    constexpr uint32_t COUNT = 33'333;
    Words rising(COUNT), falling(COUNT), extreme(COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        rising[i] = i * 128'000;
        falling[i] = ~rising[i];
        extreme[i] = i % 5 ? UINT32_MAX : i % 3 ? 0 : 0x80000000u;
    }
    for (const Words& keys : {rising, falling, extreme, Words(COUNT, 7)})
        check_sort(sort, numbered(keys), COUNT);
}

TEST_CASE("keys rise from the farthest depth to the nearest, and -0 has the key of 0") {
    constexpr float INF = std::numeric_limits<float>::infinity();
    const Column depths{INF,  3e38f,   1e10f,   2.0f,  1.0000001f,  1.0f,  1e-38f, 1e-45f,
                        0.0f, -1e-45f, -1e-38f, -1.0f, -1.0000001f, -5e4f, -3e38f, -INF};
    Columns in{depths};
    in[0].push_back(-0.0f);
    const Columns out = Probe("raster.cl", 1, {"far_to_near_key"}).run("far_to_near_key", in, 1);
    for (size_t i = 1; i < depths.size(); i++) {
        INFO(depths[i - 1] << " and " << depths[i]);
        CHECK(from_word(out[0][i - 1]) < from_word(out[0][i]));
    }
    CHECK(from_word(out[0].back()) == from_word(out[0][8]));
}
