// The buffers of one user, stated once: on a device they are allocated, without one they are
// planned.
#pragma once

#include "gpu/buffer.h"

#include <string>

namespace onde::gpu {

/// One device buffer: what it holds, for people, and the size of that.
struct BufferSize {
    std::string name;
    uint64_t bytes = 0;

    bool operator==(const BufferSize&) const = default;
};

uint64_t total_bytes(std::span<const BufferSize> buffers);

class BufferList {
  public:
    /// A plan: buffers are empty, their names and sizes are kept.
    BufferList() = default;
    /// Buffers are allocated on the device, which outlives the list.
    explicit BufferList(const Device& device) : device_(&device) {}

    /// Uninitialised memory for `count` elements.
    template <class T>
    Buffer<T> add(std::string name, size_t count) {
        note(std::move(name), count, sizeof(T));
        return device_ ? Buffer<T>(*device_, count) : Buffer<T>();
    }
    /// Memory for `count` elements that are all `value`.
    template <class T>
    Buffer<T> add_filled(std::string name, size_t count, const T& value) {
        Buffer<T> buffer = add<T>(std::move(name), count);
        if (device_) buffer.fill(*device_, value);
        return buffer;
    }
    /// A copy of the values, read-only to kernels.
    template <class T>
    Buffer<T> add_copy(std::string name, const std::vector<T>& values) {
        note(std::move(name), values.size(), sizeof(T));
        return device_ ? Buffer<T>(*device_, std::span<const T>(values)) : Buffer<T>();
    }

    const std::vector<BufferSize>& sizes() const { return sizes_; }

  private:
    void note(std::string name, size_t count, size_t element_size);

    const Device* device_ = nullptr;
    std::vector<BufferSize> sizes_;
};

} // namespace onde::gpu
