// Which devices are found and chosen, and what is said when there is none.
#include "core/error.h"
#include "gpu/device.h"
#include "gpu/subprocess.h"
#include "gpu/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::gpu;
using Catch::Matchers::Contains;

namespace {

DeviceFacts device(const std::string& name, bool is_gpu, const std::string& problem = {}) {
    DeviceFacts facts;
    facts.name = name;
    facts.platform = "Made Up";
    facts.is_gpu = is_gpu;
    facts.is_cpu = !is_gpu;
    facts.problem = problem;
    return facts;
}

PlatformReport platform(const std::string& name, std::vector<DeviceFacts> devices) {
    for (DeviceFacts& facts : devices) facts.platform = name;
    return {name, "OpenCL 3.0", std::move(devices), {}};
}

/// Indices: 0 CPU, 1 broken GPU, 2 GPU "3090", 3 GPU.
std::vector<PlatformReport> workstation() {
    return {platform("Host", {device("Ten Cores", false)}),
            platform("Vendor", {device("Old Card", true, "its driver has no compiler"),
                                device("RTX 3090", true), device("RTX 4090", true)})};
}

} // namespace

TEST_CASE("a listed device has a name, units, memory and no problem") {
    const std::vector<PlatformReport> platforms = list_platforms();
    REQUIRE_FALSE(platforms.empty());
    REQUIRE_FALSE(platforms[0].devices.empty());
    const DeviceFacts& facts = platforms[0].devices[0];
    CHECK_FALSE(facts.name.empty());
    CHECK(facts.platform == platforms[0].name);
    CHECK_FALSE(facts.driver_version.empty());
    CHECK(facts.compute_units > 0);
    CHECK(facts.max_allocation > 0);
    CHECK(facts.max_allocation <= facts.global_memory);
    CHECK(facts.problem == "");
}

TEST_CASE("the default device is the first usable GPU, then the first usable CPU") {
    std::vector<PlatformReport> platforms = workstation();
    CHECK(choose_device(platforms) == 2);
    platforms.pop_back();
    CHECK(choose_device(platforms) == 0);
    platforms[0].devices[0].problem = "it is big-endian";
    CHECK_FALSE(choose_device(platforms));
}

TEST_CASE("a selector is an index through all platforms, or part of a name of device or platform") {
    const std::vector<PlatformReport> platforms = workstation();
    CHECK(choose_device(platforms, "0") == 0);
    CHECK(choose_device(platforms, "3") == 3);
    CHECK(choose_device(platforms, "rtx 4") == 3);
    CHECK(choose_device(platforms, "hOST") == 0);
    CHECK_FALSE(choose_device(platforms, "Radeon"));
}

TEST_CASE("a number beyond the list is looked for in the names") {
    CHECK(choose_device(workstation(), "3090") == 2);
    CHECK_FALSE(choose_device(workstation(), "17"));
    CHECK_FALSE(choose_device(workstation(), "30")); // a number, not a part of "3090"
}

TEST_CASE("among devices of a matching platform a usable one is preferred, a named one is obeyed") {
    CHECK(choose_device(workstation(), "vendor") == 2);
    CHECK(choose_device(workstation(), "old card") == 1);
}

TEST_CASE("a device opens by default, by index and by name") {
    const std::string name = open_device().facts().name;
    CHECK(open_device("0").facts().name == list_platforms()[0].devices[0].name);
    CHECK(open_device(name).facts().name == name);
}

TEST_CASE("an unknown device is refused with the list of what there is") {
    const std::string name = list_platforms()[0].devices[0].name;
    CHECK_THROWS_AS(open_device("no such thing"), DeviceError);
    CHECK_THROWS_WITH(open_device("no such thing"),
                      Contains("'no such thing'") && Contains("0: " + name));
}

TEST_CASE("without any platform the error names the package to install") {
    if (!test::is_rerun()) {
        const test::TemporaryFolder no_vendors;
        CHECK(test::rerun_with("OCL_ICD_VENDORS=" + no_vendors.path().string(),
                               "without any platform the error names the package to install"));
        return;
    }
    CHECK(list_platforms().empty());
    CHECK_THROWS_AS(open_device(), DeviceError);
    CHECK_THROWS_WITH(open_device(), Contains("pocl-opencl-icd"));
}

TEST_CASE("ONDE_DEVICE names the device where nothing else does") {
    if (!test::is_rerun()) {
        const std::string name = "ONDE_DEVICE names the device where nothing else does";
        CHECK(test::rerun_with("ONDE_DEVICE=abacus", name));
        return;
    }
    CHECK(default_selector() == "abacus");
    CHECK_THROWS_WITH(open_device(), Contains("no OpenCL device matches 'abacus' of ONDE_DEVICE"));
    CHECK(open_device("0").facts().name == list_platforms()[0].devices[0].name);
}

TEST_CASE("launches are timed only where that is asked for") {
    const auto properties = [](Profiling profiling) {
        const Device device = open_device({}, profiling);
        return device.queue().getInfo<CL_QUEUE_PROPERTIES>() & CL_QUEUE_PROFILING_ENABLE;
    };
    CHECK(properties(Profiling::off) == 0);
    CHECK(properties(Profiling::on) != 0);
}

TEST_CASE("a platform without devices is listed with that problem") {
    if (!test::is_rerun()) {
        CHECK(test::rerun_with("POCL_DEVICES=nonsense OCL_ICD_FILENAMES=",
                               "a platform without devices is listed with that problem"));
        return;
    }
    for (const PlatformReport& report : list_platforms()) {
        if (report.name.find("Portable") == std::string::npos) continue;
        CHECK(report.devices.empty());
        CHECK(report.problem == "it has no devices");
    }
    CHECK_THROWS_WITH(open_device("Portable"), Contains("it has no devices"));
}

TEST_CASE("broken platforms and devices are listed with their reasons and do not hide the others") {
    if (!test::is_rerun()) {
        const test::TemporaryFolder vendors;
        vendors.write("0.icd", ONDE_BROKEN_DRIVER "\n");
        for (const auto& entry : std::filesystem::directory_iterator("/etc/OpenCL/vendors"))
            std::filesystem::copy(entry.path(), vendors.path() / entry.path().filename());
        CHECK(test::rerun_with("OCL_ICD_VENDORS=" + vendors.path().string(),
                               "broken platforms and devices are listed with their reasons and do "
                               "not hide the others"));
        return;
    }
    const auto named = [all = list_platforms()](const std::string& name) {
        for (const PlatformReport& report : all)
            if (report.name == name) return report;
        FAIL("platform " << name << " is not listed");
        return PlatformReport{};
    };
    CHECK_THAT(named("Speechless").problem, Contains("CL_OUT_OF_HOST_MEMORY"));
    CHECK(named("Speechless").devices.empty());
    REQUIRE(named("Half There").devices.size() == 2);
    const DeviceFacts silent = named("Half There").devices[0];
    CHECK(silent.name == "Silent Card");
    CHECK_THAT(silent.problem, Contains("CL_OUT_OF_RESOURCES"));
    const DeviceFacts twofold = named("Half There").devices[1]; // says that it is CPU and GPU
    CHECK(twofold.is_gpu);
    CHECK_FALSE(twofold.is_cpu);

    CHECK(open_device().facts().problem == "");
    CHECK_THROWS_AS(open_device("silent"), DeviceError);
    CHECK_THROWS_WITH(open_device("silent"), Contains("Silent Card cannot be used"));
}
