#include "render/memory_plan.h"

#include "core/error.h"

#include <catch2/catch.hpp>

namespace onde::test {
namespace {

constexpr uint64_t MIB = uint64_t(1) << 20;

gpu::DeviceFacts small_device() {
    gpu::DeviceFacts facts{};
    facts.name = "abacus";
    facts.max_allocation = 256 * MIB;
    facts.global_memory = 1024 * MIB;
    return facts;
}

std::string refusal(const MemoryPlan& plan) {
    try {
        check_memory(plan, small_device());
    } catch (const DeviceError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("buffers that fill the device's memory exactly are accepted, one byte more is not") {
    MemoryPlan plan;
    plan.scene = {{"BVH nodes", 256 * MIB}};
    plan.paths = {{"path states", 256 * MIB}, {"path sums", 256 * MIB}};
    plan.film = {{"film sums", 255 * MIB}, {"pixel order", MIB}};
    CHECK(refusal(plan) == "");
    plan.film.push_back({"ray counters", 1});
    CHECK(refusal(plan) == "the render takes 1.00 GiB (scene 256.00 MiB, paths in flight "
                           "512.00 MiB, film 256.00 MiB), but abacus has 1.00 GiB; "
                           "use a smaller scene, --texture-memory, --wave-size or --size");
}

TEST_CASE("a buffer larger than the device allows is named, with what makes it smaller") {
    MemoryPlan plan;
    plan.paths = {{"path states", 256 * MIB + 1}};
    CHECK(refusal(plan) == "the path states take 256.00 MiB in one buffer, but abacus allows "
                           "256.00 MiB; use a smaller --wave-size");
}

} // namespace onde::test
