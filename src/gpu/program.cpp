// Compiles a program or takes it from the cache, and warms its kernels.
#include "gpu/program.h"

#include "core/hash.h"
#include "core/timer.h"
#include "gpu/cl_error.h"

#include <fmt/ranges.h>

namespace onde::gpu {
namespace {

/// Where PoCL specialises kernels, it does so for grids below this many work items and for others.
constexpr size_t LARGE_GRID = 65535;

std::string join_options(const DeviceFacts& facts, const ProgramRequest& request) {
    std::vector<std::string> options = device_options(facts);
    for (const std::string& define : request.defines) options.push_back("-D" + define);
    return fmt::format("{}", fmt::join(options, " "));
}

/// A change of anything that could change the binary changes the key.
std::string cache_key(const DeviceFacts& facts, const std::string& source,
                      const std::string& options, const std::vector<KernelShape>& kernels) {
    Hasher hasher;
    hasher.text(source).text(options);
    hasher.text(facts.platform).text(facts.platform_version);
    hasher.text(facts.name).text(facts.driver_version);
    hasher.value(uint32_t(facts.avx2)).value(uint32_t(facts.avx512));
    for (const KernelShape& shape : kernels) // the binary holds what was launched
        hasher.text(shape.name)
            .value(uint64_t(shape.local_size))
            .value(uint32_t(shape.items >= LARGE_GRID));
    return hasher.hex();
}

cl::Program compile(const Device& device, const std::string& file, const std::string& source,
                    const std::string& options) {
    cl::Program program(device.context(), source);
    try {
        program.build({device.raw()}, options.c_str());
    } catch (const cl::BuildError& error) {
        std::string log;
        for (const auto& [of_device, text] : error.getBuildLog()) log += text;
        throw DeviceError("kernels/{} does not build on {} with {}:\n{}", file, device.facts().name,
                          options, log);
    }
    return program;
}

/// Sets an argument to zero, to the buffer of zeros, or to a little local memory. Drivers that keep
/// no argument info, for example of binaries, tell which it is by refusing what it is not.
void clear_argument(const cl::Kernel& kernel, cl_uint index, const cl::Buffer& zeros) {
    cl_kernel_arg_address_qualifier space = CL_KERNEL_ARG_ADDRESS_PRIVATE;
    clGetKernelArgInfo(kernel(), index, CL_KERNEL_ARG_ADDRESS_QUALIFIER, sizeof space, &space,
                       nullptr);
    const cl_uint zero = 0; // of the bits of 0.0f, too
    if (space == CL_KERNEL_ARG_ADDRESS_PRIVATE &&
        clSetKernelArg(kernel(), index, sizeof zero, &zero) == CL_SUCCESS)
        return;
    if (space != CL_KERNEL_ARG_ADDRESS_LOCAL &&
        clSetKernelArg(kernel(), index, sizeof(cl_mem), &zeros()) == CL_SUCCESS)
        return;
    constexpr size_t LOCAL_BYTES = 256;
    cl::detail::errHandler(clSetKernelArg(kernel(), index, LOCAL_BYTES, nullptr), "clSetKernelArg");
}

/// Launches the kernel as it will be launched, but with a count of 0: drivers finish compiling at
/// the first launch. On a kernel object of its own, so that an argument that is never set is still
/// noticed by the driver.
void warm(const Device& device, const cl::Program& program, const KernelShape& shape,
          const cl::Buffer& zeros) {
    checked(fmt::format("kernel {} failed at its first, empty launch in groups of {}", shape.name,
                        shape.local_size),
            [&] {
                cl::Kernel kernel(program, shape.name.c_str());
                const cl_uint arguments = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
                for (cl_uint i = 0; i < arguments; ++i) clear_argument(kernel, i, zeros);
                Kernel(kernel, shape, device).launch(shape.items);
            });
}

void warm(const Device& device, const cl::Program& program,
          const std::vector<KernelShape>& shapes) {
    Buffer<uint32_t> zeros(device, 1024); // compilers load ahead of the test of the count
    zeros.fill(device, 0);
    for (const KernelShape& shape : shapes) warm(device, program, shape, zeros.raw());
    device.finish();
}

std::vector<Kernel> make_kernels(const Device& device, const cl::Program& program,
                                 const std::vector<KernelShape>& shapes) {
    std::vector<Kernel> kernels;
    for (const KernelShape& shape : shapes)
        kernels.push_back(checked(fmt::format("kernel {} cannot be made", shape.name), [&] {
            return Kernel(cl::Kernel(program, shape.name.c_str()), shape, device);
        }));
    return kernels;
}

/// A cached binary, warmed; nothing when this driver does not take it.
std::optional<cl::Program> load_binary(const Device& device, const std::string& binary,
                                       const std::string& options,
                                       const std::vector<KernelShape>& shapes) {
    try {
        const std::vector<unsigned char> bytes(binary.begin(), binary.end());
        cl::Program program(device.context(), {device.raw()}, {bytes});
        program.build({device.raw()}, options.c_str());
        warm(device, program, shapes);
        return program;
    } catch (const cl::Error&) {
        return std::nullopt;
    } catch (const DeviceError&) {
        return std::nullopt;
    }
}

void store_binary(const ProgramCache& cache, const std::string& key, const cl::Program& program) {
    try {
        const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.size() == 1 && !binaries[0].empty())
            cache.store(key, std::string(binaries[0].begin(), binaries[0].end()));
    } catch (const cl::Error&) { // a driver that gives no binaries compiles each time
    }
}

} // namespace

std::vector<std::string> device_options(const DeviceFacts& facts) {
    // Without -w, PoCL's compiler counts its warnings on standard error, behind our back.
    std::vector<std::string> options{"-cl-std=CL1.2", "-cl-kernel-arg-info", "-w"};
    if (facts.correctly_rounded_divide_sqrt)
        options.push_back("-cl-fp32-correctly-rounded-divide-sqrt");
    const bool takes_builtins = facts.is_pocl && facts.is_cpu;
    options.push_back(fmt::format("-DONDE_CPU={:d}", facts.is_cpu));
    options.push_back(fmt::format("-DONDE_AVX2={:d}", takes_builtins && facts.avx2));
    options.push_back(fmt::format("-DONDE_AVX512={:d}", takes_builtins && facts.avx512));
    return options;
}

Programs::Programs(const Device& device, KernelSources sources, std::optional<ProgramCache> cache)
    : device_(device), sources_(std::move(sources)), cache_(std::move(cache)) {}

Program Programs::build(const ProgramRequest& request) {
    const Timer timer;
    std::vector<std::string> files = request.before;
    files.push_back(request.file);
    const std::string source = sources_.flatten(files);
    const std::string options = join_options(device_.facts(), request);
    const std::string key = cache_key(device_.facts(), source, options, request.kernels);
    bool compiled = false;
    if (!built_.contains(key)) {
        std::optional<cl::Program> program;
        if (const auto binary = cache_ ? cache_->load(key) : std::nullopt)
            program = load_binary(device_, *binary, options, request.kernels);
        compiled = !program;
        if (compiled) {
            program = compile(device_, request.file, source, options);
            warm(device_, *program, request.kernels);
            if (cache_) store_binary(*cache_, key, *program);
        }
        built_.emplace(key, *program);
    }
    return Program(make_kernels(device_, built_.at(key), request.kernels),
                   {timer.seconds(), !compiled});
}

} // namespace onde::gpu
