#include "core/aligned.h"

#include <catch2/catch.hpp>

#include <cstdint>

using namespace onde;

namespace {

template <class T>
bool is_aligned(const AlignedVector<T>& values, uintptr_t alignment) {
    return reinterpret_cast<uintptr_t>(values.data()) % alignment == 0;
}

} // namespace

TEST_CASE("small vectors begin on a page, large ones on a huge page") {
    const AlignedVector<float> small(1), large(1 << 20);
    CHECK(is_aligned(small, 4096));
    CHECK(is_aligned(large, 2 << 20));
}

TEST_CASE("an aligned vector grows, copies and keeps its elements and alignment") {
    AlignedVector<uint32_t> values;
    for (uint32_t i = 0; i < 1000000; ++i) values.push_back(i);
    const AlignedVector<uint32_t> copy = values;
    CHECK(copy == values);
    CHECK(copy.back() == 999999);
    CHECK(is_aligned(copy, 2 << 20));
}

TEST_CASE("memory of no bytes can be allocated and freed") {
    std::free(allocate_aligned(0));
}
