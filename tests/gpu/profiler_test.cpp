// Time per kernel name.
#include "gpu/program.h"
#include "gpu/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::gpu;

TEST_CASE("the profiler counts launches and adds their time, by kernel") {
    const test::TemporaryFolder folder;
    folder.write("two.cl",
                 "__kernel void first(uint count) {}\n"
                 "__kernel void second(uint count, __global uint* sum) {\n"
                 "    for (uint i = 0; i < count; ++i) sum[get_global_id(0)] += i ^ sum[0];\n}\n");
    const Device device = open_device({}, Profiling::on);
    Programs programs(device, KernelSources::folder(folder.path()));
    Program program = programs.build({"two.cl", {}, {{"first", 1}, {"second", 1}}});
    const Buffer<uint32_t> sum(device, 1);
    program.kernel("first").set(0, 1u);
    program.kernel("second").set_from(0, 10000u, sum);

    Profiler profiler;
    CHECK(profiler.totals().empty());
    for (int i = 0; i < 3; ++i) program.kernel("first").launch(1, &profiler);
    program.kernel("second").launch(1, &profiler);
    program.kernel("second").launch(1); // not asked for
    CHECK(profiler.totals().at("first").launches == 3);
    CHECK(profiler.totals().at("second").launches == 1);
    const double seconds = profiler.totals().at("second").seconds;
    CHECK(seconds > 0);
    CHECK(seconds < 10);

    program.kernel("second").launch(1, &profiler);
    CHECK(profiler.totals().at("second").launches == 2);
    CHECK(profiler.totals().at("second").seconds > seconds);
}
