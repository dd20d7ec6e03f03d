// Buffer<T> over untyped memory. Included by gpu/buffer.h only.
#pragma once

namespace onde::gpu {
namespace detail {

/// Device memory of that many elements, at least one. `host` is the memory to copy from or to use,
/// as `flags` say. Throws DeviceError when that is more than the device allows in one buffer.
cl::Buffer allocate(const Device& device, cl_mem_flags flags, size_t count, size_t element_size,
                    const void* host);

/// Blocking copies; offsets and sizes in bytes.
void read_bytes(const Device& device, const cl::Buffer& buffer, size_t offset, size_t size,
                void* host);
void write_bytes(const Device& device, const cl::Buffer& buffer, size_t size, const void* host);
/// `pattern_size` is a power of two up to 128, as OpenCL demands.
void fill_bytes(const Device& device, const cl::Buffer& buffer, size_t size, const void* pattern,
                size_t pattern_size);

/// Throws DeviceError unless [first, first + count) lies within `size` elements.
void check_range(size_t first, size_t count, size_t size);

constexpr bool is_fill_pattern(size_t size) {
    return size <= 128 && (size & (size - 1)) == 0;
}

} // namespace detail

template <class T>
Buffer<T>::Buffer(const Device& device, size_t count)
    : buffer_(detail::allocate(device, CL_MEM_READ_WRITE, count, sizeof(T), nullptr)),
      count_(count) {}

template <class T>
Buffer<T>::Buffer(const Device& device, std::span<const T> values)
    : buffer_(detail::allocate(device, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size(),
                               sizeof(T), values.data())),
      count_(values.size()) {}

template <class T>
Buffer<T> Buffer<T>::in_place(const Device& device, std::span<const T> values) {
    if (!device.facts().unified_memory || values.empty()) return Buffer(device, values);
    Buffer used;
    used.buffer_ = detail::allocate(device, CL_MEM_READ_ONLY | CL_MEM_USE_HOST_PTR, values.size(),
                                    sizeof(T), values.data());
    used.count_ = values.size();
    return used;
}

template <class T>
void Buffer<T>::write(const Device& device, std::span<const T> values) {
    detail::check_range(0, values.size(), count_);
    detail::write_bytes(device, buffer_, values.size_bytes(), values.data());
}

template <class T>
std::vector<T> Buffer<T>::read(const Device& device) const {
    return read(device, 0, count_);
}

template <class T>
std::vector<T> Buffer<T>::read(const Device& device, size_t first, size_t count) const {
    detail::check_range(first, count, count_);
    std::vector<T> values(count);
    detail::read_bytes(device, buffer_, first * sizeof(T), count * sizeof(T), values.data());
    return values;
}

template <class T>
void Buffer<T>::fill(const Device& device, const T& value) {
    if constexpr (detail::is_fill_pattern(sizeof(T)))
        detail::fill_bytes(device, buffer_, count_ * sizeof(T), &value, sizeof(T));
    else
        write(device, std::vector<T>(count_, value));
}

} // namespace onde::gpu
