// Buffers stated once, planned or allocated.
#include "gpu/buffer_list.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::gpu;

namespace {

struct Two {
    Buffer<float> numbers;
    Buffer<uint32_t> zeros, copied, empty;

    explicit Two(BufferList& list)
        : numbers(list.add<float>("numbers", 10)), zeros(list.add_filled("zeros", 3, 0u)),
          copied(list.add_copy("copied", std::vector<uint32_t>{7, 8})),
          empty(list.add<uint32_t>("empty", 0)) {}
};

uint64_t bytes_of(const cl::Buffer& buffer) {
    return buffer.getInfo<CL_MEM_SIZE>();
}

} // namespace

TEST_CASE("a list without a device plans what one with a device allocates") {
    const Device device = open_device();
    BufferList plan, list(device);
    const Two planned(plan), allocated(list);
    CHECK(planned.numbers.size() == 0);
    CHECK(plan.sizes() == list.sizes());
    CHECK(total_bytes(list.sizes()) == bytes_of(allocated.numbers.raw()) +
                                           bytes_of(allocated.zeros.raw()) +
                                           bytes_of(allocated.copied.raw()));
    CHECK(list.sizes().back() == BufferSize{"empty", 0});
    CHECK(list.sizes()[0] == BufferSize{"numbers", 40});
}

TEST_CASE("a listed buffer holds what it was filled with or copied from") {
    const Device device = open_device();
    BufferList list(device);
    const Two two(list);
    CHECK(two.zeros.read(device) == std::vector<uint32_t>{0, 0, 0});
    CHECK(two.copied.read(device) == std::vector<uint32_t>{7, 8});
}
