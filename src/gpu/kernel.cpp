// Arguments and launches.
#include "gpu/cl_error.h"
#include "gpu/program.h"

#include <algorithm>

namespace onde::gpu {

/// The group size nearest to `wanted` that the kernel has on the device.
static size_t fitting_local_size(const cl::Kernel& kernel, const Device& device, size_t wanted) {
    const cl::Device& raw = device.raw();
    const size_t required = kernel.getWorkGroupInfo<CL_KERNEL_COMPILE_WORK_GROUP_SIZE>(raw)[0];
    if (required > 0) return required;
    const size_t most = kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(raw);
    if (wanted <= most) return wanted;
    const size_t multiple =
        kernel.getWorkGroupInfo<CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE>(raw);
    return multiple > 0 && most >= multiple ? most / multiple * multiple
                                            : std::max<size_t>(most, 1);
}

Kernel::Kernel(cl::Kernel kernel, KernelShape shape, const Device& device)
    : kernel_(std::move(kernel)), shape_(std::move(shape)), queue_(device.queue()) {
    checked(fmt::format("the group size of kernel {} is not known", name()),
            [&] { shape_.local_size = fitting_local_size(kernel_, device, shape_.local_size); });
}

void Kernel::set_bytes(uint32_t index, size_t size, const void* value) {
    checked(fmt::format("kernel {}: argument {} cannot be set to a value of {} bytes", name(),
                        index, size),
            [&] { kernel_.setArg(index, size, value); });
}

void Kernel::set_memory(uint32_t index, const cl::Buffer& buffer) {
    checked(fmt::format("kernel {}: argument {} cannot be set to a buffer", name(), index),
            [&] { kernel_.setArg(index, buffer); });
}

void Kernel::launch(size_t items, Profiler* profiler) {
    if (items == 0) return;
    const size_t local = shape_.local_size;
    const size_t global = (items + local - 1) / local * local;
    cl::Event event;
    checked(fmt::format("kernel {} cannot be launched with {} items in groups of {}", name(),
                        global, local),
            [&] {
                queue_.enqueueNDRangeKernel(kernel_, cl::NullRange, global, local, nullptr,
                                            profiler ? &event : nullptr);
            });
    if (profiler) profiler->record(name(), event);
}

Kernel& Program::kernel(std::string_view name) {
    const auto found = std::find_if(kernels_.begin(), kernels_.end(),
                                    [&](const Kernel& kernel) { return kernel.name() == name; });
    if (found == kernels_.end())
        throw DeviceError("kernel {} was not asked for when its program was built", name);
    return *found;
}

} // namespace onde::gpu
