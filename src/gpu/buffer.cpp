#include "gpu/buffer.h"

#include "gpu/cl_error.h"

#include <algorithm>

namespace onde::gpu::detail {

cl::Buffer allocate(const Device& device, cl_mem_flags flags, size_t count, size_t element_size,
                    const void* host) {
    const DeviceFacts& facts = device.facts();
    if (count > facts.max_allocation / element_size)
        throw OutOfMemory("a buffer of {} elements of {} bytes was asked for, but {} allows {} "
                          "bytes in one buffer; use a smaller scene, film or wave",
                          count, element_size, facts.name, facts.max_allocation);
    if (count == 0) { // there is nothing to copy or to use; bound buffers must not be null
        flags &= ~cl_mem_flags(CL_MEM_COPY_HOST_PTR | CL_MEM_USE_HOST_PTR);
        host = nullptr;
    }
    const size_t bytes = std::max<size_t>(count, 1) * element_size;
    device.count_allocation(count * element_size);
    try {
        return cl::Buffer(device.context(), flags, bytes, const_cast<void*>(host));
    } catch (const cl::Error& error) {
        throw OutOfMemory("{} refused a buffer of {} bytes ({})", facts.name, bytes,
                          error_name(error.err()));
    }
}

void read_bytes(const Device& device, const cl::Buffer& buffer, size_t offset, size_t size,
                void* host) {
    if (size == 0) return;
    checked(fmt::format("{} bytes could not be read from {}", size, device.facts().name),
            [&] { device.queue().enqueueReadBuffer(buffer, CL_TRUE, offset, size, host); });
}

void write_bytes(const Device& device, const cl::Buffer& buffer, size_t size, const void* host) {
    if (size == 0) return;
    checked(fmt::format("{} bytes could not be written to {}", size, device.facts().name),
            [&] { device.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, size, host); });
}

void fill_bytes(const Device& device, const cl::Buffer& buffer, size_t size, const void* pattern,
                size_t pattern_size) {
    if (size == 0) return;
    checked(fmt::format("{} bytes could not be filled on {}", size, device.facts().name), [&] {
        // By the C function: cl::CommandQueue::enqueueFillBuffer wants the pattern as a type.
        cl::detail::errHandler(clEnqueueFillBuffer(device.queue()(), buffer(), pattern,
                                                   pattern_size, 0, size, 0, nullptr, nullptr),
                               "clEnqueueFillBuffer");
    });
    device.finish();
}

void check_range(size_t first, size_t count, size_t size) {
    if (first > size || count > size - first)
        throw DeviceError("elements {} to {} of a device buffer were asked for, but it has {}",
                          first, first + count, size);
}

} // namespace onde::gpu::detail
