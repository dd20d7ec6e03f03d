// How work is cut for a device.
#include "gpu/settings.h"

#include <catch2/catch.hpp>

using namespace onde::gpu;
using Catch::Matchers::Contains;

namespace {

DeviceFacts cpu(bool avx2, bool avx512) {
    DeviceFacts facts;
    facts.is_cpu = facts.is_pocl = true;
    facts.avx2 = avx2;
    facts.avx512 = avx512;
    return facts;
}

DeviceFacts graphics_card() {
    DeviceFacts facts;
    facts.is_gpu = true;
    facts.max_work_group_size = 1024;
    return facts;
}

} // namespace

TEST_CASE("a CPU runs fused chunks of 256 paths in groups of one") {
    const DeviceSettings settings = default_settings(cpu(true, true));
    CHECK(settings.wave_size == 65536);
    CHECK(settings.chunk == 256);
    CHECK(settings.local_size == 1);
    CHECK(settings.launch == Launch::fused);
}

TEST_CASE("a CPU shades 16 lanes with AVX-512 and 8 without") {
    CHECK(default_settings(cpu(true, true)).width == 16);
    CHECK(default_settings(cpu(true, false)).width == 8);
    CHECK(default_settings(cpu(false, false)).width == 8);
}

TEST_CASE("a CPU whose compiler is unknown shades one lane") {
    DeviceFacts facts = cpu(true, true);
    facts.is_pocl = false;
    CHECK(default_settings(facts).width == 1);
    facts.is_intel = true;
    CHECK(default_settings(facts).width == 16);
}

TEST_CASE("groups are no larger than the device takes") {
    DeviceFacts facts = graphics_card();
    facts.max_work_group_size = 32;
    CHECK(default_settings(facts).local_size == 32);
}

TEST_CASE("on a CPU rays take turns in trees that are larger than its cache") {
    DeviceFacts facts = cpu(true, true);
    facts.cache = 32 << 20;
    CHECK(default_settings(facts).interleave_above == 32 << 20);
    CHECK(default_settings(graphics_card()).interleave_above == UINT64_MAX);
}

TEST_CASE("a GPU runs separate stages, one path per work item, over a large wave") {
    const DeviceSettings settings = default_settings(graphics_card());
    CHECK(settings.width == 1);
    CHECK(settings.wave_size == 1u << 20);
    CHECK(settings.chunk == 1);
    CHECK(settings.local_size == 64);
    CHECK(settings.launch == Launch::staged);
}

TEST_CASE("chunks are whole groups of lanes and waves are whole chunks") {
    for (const DeviceFacts& facts : {cpu(true, true), cpu(false, false), graphics_card()}) {
        const DeviceSettings settings = default_settings(facts);
        CHECK(settings.chunk % settings.width == 0);
        CHECK(settings.wave_size % (settings.chunk * settings.local_size) == 0);
    }
}

TEST_CASE("settings describe themselves in one line") {
    CHECK_THAT(describe(default_settings(cpu(true, true))),
               Contains("16 lanes") && Contains("waves of 65536 paths") && Contains("fused") &&
                   !Contains("\n"));
    CHECK_THAT(describe(default_settings(graphics_card())), Contains("1 lane,"));
}
