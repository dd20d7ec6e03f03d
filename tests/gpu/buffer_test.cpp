// Typed device memory.
#include "core/aligned.h"
#include "gpu/buffer.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace onde;
using namespace onde::gpu;
using Catch::Matchers::Contains;

namespace {

struct Triple { // 12 bytes: not a size that OpenCL fills with
    float x, y, z;
    bool operator==(const Triple&) const = default;
};

std::vector<uint32_t> ascending(size_t count) {
    std::vector<uint32_t> values(count);
    std::iota(values.begin(), values.end(), 1u);
    return values;
}

} // namespace

TEST_CASE("values come back from the device as they went") {
    const Device device = open_device();
    const std::vector<uint32_t> values = ascending(1000);
    const Buffer<uint32_t> buffer(device, values);
    CHECK(buffer.size() == 1000);
    CHECK(buffer.read(device) == values);
}

TEST_CASE("a part of a buffer can be read") {
    const Device device = open_device();
    const Buffer<uint32_t> buffer(device, ascending(1000));
    CHECK(buffer.read(device, 998, 2) == std::vector<uint32_t>{999, 1000});
    CHECK(buffer.read(device, 1000, 0).empty());
}

TEST_CASE("writing replaces the front of a buffer and leaves the rest") {
    const Device device = open_device();
    Buffer<uint32_t> buffer(device, ascending(4));
    buffer.write(device, std::vector<uint32_t>{70, 80});
    CHECK(buffer.read(device) == std::vector<uint32_t>{70, 80, 3, 4});
}

TEST_CASE("filling sets every element, also of sizes that are no power of two") {
    const Device device = open_device();
    Buffer<uint32_t> words(device, 33);
    words.fill(device, 0xdeadbeefu);
    CHECK(words.read(device) == std::vector<uint32_t>(33, 0xdeadbeefu));
    Buffer<Triple> triples(device, 33);
    triples.fill(device, {1, 2, 3});
    CHECK(triples.read(device) == std::vector<Triple>(33, {1, 2, 3}));
}

TEST_CASE("an empty buffer exists, reads as nothing and takes empty writes and fills") {
    const Device device = open_device();
    Buffer<float> buffer(device, std::span<const float>{});
    CHECK(buffer.size() == 0);
    CHECK(buffer.raw()() != nullptr);
    CHECK(buffer.read(device).empty());
    buffer.write(device, {});
    buffer.fill(device, 1.0f);
    CHECK(Buffer<float>::in_place(device, {}).raw()() != nullptr);
}

TEST_CASE("a read or write beyond the end is refused with both ranges") {
    const Device device = open_device();
    Buffer<uint32_t> buffer(device, ascending(4));
    CHECK_THROWS_AS(buffer.read(device, 3, 2), DeviceError);
    CHECK_THROWS_WITH(buffer.read(device, 3, 2), Contains("3 to 5") && Contains("has 4"));
    CHECK_THROWS_AS(buffer.read(device, size_t(-1), 2), DeviceError);
    CHECK_THROWS_AS(buffer.write(device, ascending(5)), DeviceError);
}

TEST_CASE("a buffer beyond the device's limit is refused with what was asked and what is allowed") {
    const Device device = open_device();
    const uint64_t limit = device.facts().max_allocation;
    CHECK_THROWS_AS(Buffer<uint32_t>(device, limit / 4 + 1), DeviceError);
    CHECK_THROWS_WITH(Buffer<uint32_t>(device, limit / 4 + 1),
                      Contains(std::to_string(limit / 4 + 1)) && Contains(std::to_string(limit)));
    CHECK_THROWS_AS(Buffer<uint32_t>(device, size_t(-1)), DeviceError); // no overflow
}

TEST_CASE("in place, a device that shares the host's memory uses it itself") {
    const Device device = open_device();
    const std::vector<uint32_t> values = ascending(1 << 20); // 4 MiB: huge pages
    AlignedVector<uint32_t> host(values.begin(), values.end());
    const auto buffer = Buffer<uint32_t>::in_place(device, host);
    CHECK(buffer.read(device) == values);
    if (!device.facts().unified_memory) return;
    void* mapped = device.queue().enqueueMapBuffer(buffer.raw(), CL_TRUE, CL_MAP_READ, 0, 4);
    CHECK(mapped == host.data());
    device.queue().enqueueUnmapMemObject(buffer.raw(), mapped);
    device.finish();
    CHECK((buffer.raw().getInfo<CL_MEM_FLAGS>() & CL_MEM_USE_HOST_PTR) != 0);
}
