// Typed device memory.
#pragma once

#include "core/error.h"
#include "gpu/device.h"

#include <span>
#include <type_traits>
#include <vector>

namespace onde::gpu {

/// The device has no room for a buffer.
struct OutOfMemory : DeviceError {
    using DeviceError::DeviceError;
};

/// A device buffer of `size()` elements. At least one element is always allocated, so that an empty
/// buffer may be bound to a kernel. Throws OutOfMemory when the device refuses.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    Buffer() = default;

    /// Uninitialised memory for reading and writing by kernels.
    Buffer(const Device& device, size_t count);

    /// A copy of `values`, read-only to kernels.
    Buffer(const Device& device, std::span<const T> values);

    /// Uses the memory of `values` in place where the device shares the host's, else copies it. It
    /// must be aligned as AlignedVector does and outlive the buffer. Read-only to kernels.
    static Buffer in_place(const Device& device, std::span<const T> values);

    size_t size() const { return count_; }
    const cl::Buffer& raw() const { return buffer_; }

    /// Blocking copies and fills, on the device's queue.
    void write(const Device& device, std::span<const T> values);
    std::vector<T> read(const Device& device) const;
    std::vector<T> read(const Device& device, size_t first, size_t count) const;
    void fill(const Device& device, const T& value);

  private:
    cl::Buffer buffer_;
    size_t count_ = 0;
};

} // namespace onde::gpu

#include "gpu/buffer_impl.h"
