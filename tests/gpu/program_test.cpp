// From kernel files to launches.
#include "gpu/program.h"
#include "gpu/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::gpu;
using Catch::Matchers::Contains;

namespace {

/// A kernel folder with scale.cl: out[i] = SCALE * in[i] + offset, for i < count.
class ScaleProgram {
  public:
    ScaleProgram() {
        folder_.write("scale.cl", R"(#include "lib/scale.h"
__kernel void scale(uint count, float offset, __global const float* in, __global float* out) {
    const size_t i = get_global_id(0);
    if (i < count) out[i] = scaled(in[i]) + offset;
}
)");
        folder_.write("lib/scale.h", "float scaled(float x) { return SCALE * x; }\n");
    }

    KernelSources sources() const { return KernelSources::folder(folder_.path()); }

    static ProgramRequest request(const std::string& scale = "SCALE=2.0f",
                                  KernelShape shape = {"scale", 4}) {
        return {"scale.cl", {scale}, {shape}};
    }

    /// As a run of the program with that cache on disk does it.
    Program build(std::optional<ProgramCache> cache = {}) const {
        return build(request(), std::move(cache));
    }
    Program build(const ProgramRequest& request, std::optional<ProgramCache> cache = {}) const {
        return Programs(device_, sources(), std::move(cache)).build(request);
    }

    /// What the kernel makes of `values` with an offset of 1.
    std::vector<float> run(Program& program, const std::vector<float>& values) const {
        const Buffer<float> in(device_, values);
        const Buffer<float> out(device_, values.size());
        Kernel& kernel = program.kernel("scale");
        kernel.set_from(0, uint32_t(values.size()), 1.0f, in, out);
        kernel.launch(values.size());
        return out.read(device_);
    }

    const Device& device() const { return device_; }
    const test::TemporaryFolder& folder() const { return folder_; }

  private:
    test::TemporaryFolder folder_;
    Device device_ = open_device();
};

const std::vector<float> VALUES{1, 2, 3, 4, 5};
const std::vector<float> SCALED{3, 5, 7, 9, 11};

} // namespace

TEST_CASE("a program built from kernel files computes what they say") {
    const ScaleProgram scale;
    Program program = scale.build();
    CHECK(scale.run(program, VALUES) == SCALED);
    CHECK_FALSE(program.report().from_cache);
    CHECK(program.report().seconds > 0);
}

TEST_CASE("a build error names our file and line, in a header too") {
    const ScaleProgram scale;
    scale.folder().write("lib/scale.h", "// one\n\nfloat scaled(float x) { return no_such(x); }\n");
    CHECK_THROWS_AS(scale.build(), DeviceError);
    CHECK_THROWS_WITH(scale.build(), Contains("kernels/lib/scale.h:3:") && Contains("no_such"));
    scale.folder().write("lib/scale.h", "float scaled(float x) { return x; }\n");
    scale.folder().write("scale.cl",
                         "#include \"lib/scale.h\"\n\n__kernel void scale(uint count) { oops }\n");
    CHECK_THROWS_WITH(scale.build(), Contains("kernels/scale.cl:3:"));
}

TEST_CASE("a kernel that its file lacks is an error that names it") {
    const ScaleProgram scale;
    const auto build = [&] { return scale.build(ScaleProgram::request("SCALE=2", {"shrink"})); };
    CHECK_THROWS_AS(build(), DeviceError);
    CHECK_THROWS_WITH(build(), Contains("shrink"));
}

TEST_CASE("a kernel that was not asked for is an error that names it") {
    const ScaleProgram scale;
    Program program = scale.build();
    CHECK_THROWS_AS(program.kernel("shrink"), DeviceError);
    CHECK_THROWS_WITH(program.kernel("shrink"), Contains("shrink"));
}

TEST_CASE("warming takes kernels with numbers and with global, constant and local pointers") {
    const ScaleProgram scale;
    scale.folder().write("many.cl", R"(
__kernel void many(uint count, float a, __global uint* b, __constant float* c, __local uint* d,
                   uint e, __global const float* f) {
    if (count == 0) return;
    d[get_local_id(0)] = e;
    b[get_global_id(0)] = d[get_local_id(0)] + (uint)(a + c[0] + f[0]);
}
)");
    const ProgramRequest request{"many.cl", {}, {{"many", 8}}};
    CHECK_NOTHROW(scale.build(request));
}

TEST_CASE("warming takes kernels that load before they test their count, as compilers make them") {
    const ScaleProgram scale;
    scale.folder().write("eager.cl", R"(
__kernel void eager(uint count, __global const uint* in, __global uint* out) {
    const uint first = *(volatile __global const uint*)in;
    if (count > 0) out[0] = first;
}
)");
    const ProgramRequest request{"eager.cl", {}, {{"eager", 1}}};
    CHECK_NOTHROW(scale.build(request));
}

TEST_CASE("a group is as large as the kernel requires, and no larger than it takes") {
    const ScaleProgram scale;
    scale.folder().write("groups.cl", R"(
__kernel __attribute__((reqd_work_group_size(4, 1, 1))) void four(uint count, __global uint* size) {
    if (count > 0) *size = get_local_size(0);
}
__kernel void fitting(uint count, __global uint* size) {
    if (count > 0) *size = get_local_size(0);
}
)");
    constexpr size_t TOO_MANY = 1u << 30;
    const ProgramRequest request{"groups.cl", {}, {{"four", 1}, {"fitting", TOO_MANY}}};
    Program program = scale.build(request);
    const auto launched = [&](Kernel& kernel) {
        const Buffer<uint32_t> size(scale.device(), 1);
        kernel.set_from(0, 1u, size);
        kernel.launch(1);
        return size.read(scale.device())[0];
    };
    CHECK(launched(program.kernel("four")) == 4);
    CHECK(program.kernel("fitting").local_size() <= scale.device().facts().max_work_group_size);
    CHECK(launched(program.kernel("fitting")) == program.kernel("fitting").local_size());
}

TEST_CASE("an empty launch leaves memory untouched") {
    const ScaleProgram scale;
    Program program = scale.build();
    const Buffer<float> in(scale.device(), 8);
    Buffer<float> out(scale.device(), 8);
    out.fill(scale.device(), 7.0f);
    Kernel& kernel = program.kernel("scale");
    kernel.set_from(0, 0u, 1.0f, in, out);
    kernel.launch(8);
    kernel.launch(0);
    CHECK(out.read(scale.device()) == std::vector<float>(8, 7.0f));
}

TEST_CASE("a launch with an argument never set is an error that names the kernel") {
    const ScaleProgram scale;
    Program program = scale.build();
    CHECK_THROWS_AS(program.kernel("scale").launch(4), DeviceError);
    CHECK_THROWS_WITH(program.kernel("scale").launch(4), Contains("kernel scale"));
}

TEST_CASE("an argument of the wrong size is an error that names kernel and argument") {
    const ScaleProgram scale;
    Program program = scale.build();
    CHECK_THROWS_AS(program.kernel("scale").set(0, 1.0), DeviceError);
    CHECK_THROWS_WITH(program.kernel("scale").set(0, 1.0),
                      Contains("kernel scale") && Contains("argument 0"));
}

TEST_CASE("launches are rounded up to whole groups") {
    const ScaleProgram scale;
    scale.folder().write("scale.cl", "__kernel void scale(uint count, __global uint* items) {\n"
                                     "    if (count > 0) atomic_inc(items);\n}\n");
    Program program = scale.build();
    Buffer<uint32_t> items(scale.device(), 1);
    items.fill(scale.device(), 0);
    program.kernel("scale").set_from(0, 5u, items);
    program.kernel("scale").launch(5);
    CHECK(items.read(scale.device())[0] == 8);
}

TEST_CASE("a second build comes from the cache and computes the same") {
    const ScaleProgram scale;
    const test::TemporaryFolder folder;
    const ProgramCache cache(folder.path());
    CHECK_FALSE(scale.build(cache).report().from_cache);
    CHECK(cache.list().size() == 1);
    Program cached = scale.build(cache);
    CHECK(cached.report().from_cache);
    CHECK(scale.run(cached, VALUES) == SCALED);
    CHECK(cache.list().size() == 1);
}

TEST_CASE("another define, source, local size or size class of grid is another cache entry") {
    const ScaleProgram scale;
    const test::TemporaryFolder folder;
    const ProgramCache cache(folder.path());
    const auto is_hit = [&](const std::string& define, KernelShape shape) {
        return scale.build(ScaleProgram::request(define, shape), cache).report().from_cache;
    };
    CHECK_FALSE(is_hit("SCALE=2.0f", {"scale", 4}));
    CHECK_FALSE(is_hit("SCALE=3.0f", {"scale", 4}));
    CHECK_FALSE(is_hit("SCALE=2.0f", {"scale", 8}));
    CHECK_FALSE(is_hit("SCALE=2.0f", {"scale", 4, 1 << 20}));
    CHECK(is_hit("SCALE=2.0f", {"scale", 4, 1000}));
    scale.folder().write("lib/scale.h", "float scaled(float x) { return SCALE * x; } // new\n");
    CHECK_FALSE(is_hit("SCALE=2.0f", {"scale", 4}));
}

TEST_CASE("what was built before gives kernels of its own, and is not built again") {
    const ScaleProgram scale;
    Programs programs(scale.device(), scale.sources());
    Program first = programs.build(ScaleProgram::request());
    CHECK_FALSE(first.report().from_cache);
    Program second = programs.build(ScaleProgram::request());
    CHECK(second.report().from_cache);
    CHECK(programs.built() == 1);
    scale.run(first, VALUES); // sets the arguments of the first one only
    CHECK_THROWS_AS(second.kernel("scale").launch(4), DeviceError);
    CHECK(scale.run(second, VALUES) == SCALED);
    programs.build(ScaleProgram::request("SCALE=3.0f"));
    CHECK(programs.built() == 2);
}

TEST_CASE("an edited kernel is built anew by the same programs") {
    const ScaleProgram scale;
    Programs programs(scale.device(), scale.sources());
    programs.build(ScaleProgram::request());
    scale.folder().write("lib/scale.h", "float scaled(float x) { return 0.0f; }\n");
    Program edited = programs.build(ScaleProgram::request());
    CHECK(programs.built() == 2);
    CHECK(scale.run(edited, VALUES) == std::vector<float>(VALUES.size(), 1.0f));
}

TEST_CASE("a cache entry damaged on disk is a miss, and is written anew") {
    const ScaleProgram scale;
    const test::TemporaryFolder folder;
    const ProgramCache cache(folder.path());
    scale.build(cache);
    const auto entry = *std::filesystem::directory_iterator(folder.path());
    {
        std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(std::streamoff(entry.file_size() / 2));
        file.write("damaged", 7);
    }
    Program rebuilt = scale.build(cache);
    CHECK_FALSE(rebuilt.report().from_cache);
    CHECK(scale.run(rebuilt, VALUES) == SCALED);
    CHECK(scale.build(cache).report().from_cache);
}

TEST_CASE("a cached binary that the driver refuses is a miss, and is written anew") {
    const ScaleProgram scale;
    const test::TemporaryFolder folder;
    const ProgramCache cache(folder.path());
    scale.build(cache);
    cache.store(cache.list()[0].key, "no binary of any driver");
    Program rebuilt = scale.build(cache);
    CHECK_FALSE(rebuilt.report().from_cache);
    CHECK(scale.run(rebuilt, VALUES) == SCALED);
    CHECK(scale.build(cache).report().from_cache);
}

TEST_CASE("a cache that cannot be written costs nothing but its hits") {
    const ScaleProgram scale;
    const ProgramCache cache("/proc/no-folder-can-be-made-here");
    Program program = scale.build(cache);
    CHECK(scale.run(program, VALUES) == SCALED);
    CHECK_FALSE(scale.build(cache).report().from_cache);
}

TEST_CASE("device facts become options: x86 builtins on PoCL only") {
    DeviceFacts facts;
    facts.is_cpu = facts.is_pocl = facts.avx2 = facts.avx512 = true;
    const auto has = [](const std::vector<std::string>& options, const std::string& option) {
        return std::find(options.begin(), options.end(), option) != options.end();
    };
    CHECK(has(device_options(facts), "-cl-std=CL1.2"));
    CHECK(has(device_options(facts), "-DONDE_CPU=1"));
    CHECK(has(device_options(facts), "-DONDE_AVX2=1"));
    CHECK(has(device_options(facts), "-DONDE_AVX512=1"));
    facts.is_pocl = false;
    CHECK(has(device_options(facts), "-DONDE_AVX2=0"));
    CHECK(has(device_options(facts), "-DONDE_AVX512=0"));
    CHECK(has(device_options(DeviceFacts{}), "-DONDE_CPU=0"));
}

TEST_CASE("correct rounding is asked of devices that can") {
    DeviceFacts facts;
    const std::string option = "-cl-fp32-correctly-rounded-divide-sqrt";
    const auto count = [&] {
        const std::vector<std::string> options = device_options(facts);
        return std::count(options.begin(), options.end(), option);
    };
    CHECK(count() == 0);
    facts.correctly_rounded_divide_sqrt = true;
    CHECK(count() == 1);
}
