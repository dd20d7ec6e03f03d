// Lists of devices, and devices in parts.
#include "gpu/device_list.h"

#include "core/error.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::gpu;
using Catch::Matchers::Contains;

namespace {

/// Indices: 0 CPU, 1 broken GPU, 2 and 3 GPUs.
std::vector<PlatformReport> workstation() {
    PlatformReport platform{"Made Up", "OpenCL 3.0", {}, {}};
    for (const char* name : {"Ten Cores", "Old Card", "RTX 3090, black", "RTX 4090 A/2"}) {
        DeviceFacts facts;
        facts.name = name;
        facts.platform = platform.name;
        facts.is_cpu = platform.devices.empty();
        facts.is_gpu = !facts.is_cpu;
        platform.devices.push_back(facts);
    }
    platform.devices[1].problem = "its driver has no compiler";
    return {platform};
}

using Choices = std::vector<DeviceChoice>;

} // namespace

TEST_CASE("a list names devices by number, by name, in parts, or all that can be used") {
    const std::vector<PlatformReport> platforms = workstation();
    CHECK(choose_devices(platforms, "0,2") == Choices{{0, 1}, {2, 1}});
    CHECK(choose_devices(platforms, "4090,ten") == Choices{{3, 1}, {0, 1}});
    CHECK(choose_devices(platforms, "0/2") == Choices{{0, 2}});
    CHECK(choose_devices(platforms, "/4") == Choices{{2, 4}});
    CHECK(choose_devices(platforms, "3/2,0/3") == Choices{{3, 2}, {0, 3}});
    CHECK(choose_devices(platforms, "all") == Choices{{0, 1}, {2, 1}, {3, 1}});
}

TEST_CASE("names with commas and slashes are names") {
    CHECK(choose_devices(workstation(), "3090, black") == Choices{{2, 1}});
    CHECK(choose_devices(workstation(), "a/2") == Choices{{3, 1}});
    CHECK(choose_devices(workstation(), "a/2/2") == Choices{{3, 2}});
}

TEST_CASE("lists that name nothing, one thing twice or no part are refused") {
    const std::vector<PlatformReport> platforms = workstation();
    CHECK_THROWS_WITH(choose_devices(platforms, "0,Radeon"),
                      Contains("no OpenCL device matches 'Radeon'; choose from: 0: Ten Cores"));
    CHECK_THROWS_WITH(choose_devices(platforms, "0,ten"), Contains("names device 0 twice"));
    CHECK_THROWS_WITH(choose_devices(platforms, "0/0"), Contains("use 1 or more"));
    CHECK_THROWS_AS(choose_devices({}, "all"), DeviceError);
    CHECK_THROWS_WITH(open_devices("0/1000"),
                      Contains("can't be cut into 1000 parts; use at most"));
}

TEST_CASE("parts of a device have shares of its units and memory") {
    const Device whole = open_device("0");
    const uint32_t units = whole.facts().compute_units;
    if (units < 2) return;
    CHECK(names_several("0/2"));
    CHECK_FALSE(names_several("0/1"));
    CHECK_FALSE(names_several("0"));
    const std::vector<Device> parts = open_devices("0/2");
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].facts().compute_units + parts[1].facts().compute_units == units);
    for (const Device& part : parts) {
        CHECK(part.facts().compute_units == part.raw().getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
        CHECK(part.facts().global_memory == whole.facts().global_memory / 2);
        CHECK(part.facts().name == whole.facts().name);
    }
}
