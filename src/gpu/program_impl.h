// Typed kernel arguments. Included by gpu/program.h only.
#pragma once

namespace onde::gpu {

template <class T>
void Kernel::set(uint32_t index, const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    set_bytes(index, sizeof(T), &value);
}

template <class T>
void Kernel::set(uint32_t index, const Buffer<T>& buffer) {
    set_memory(index, buffer.raw());
}

template <class... Args>
uint32_t Kernel::set_from(uint32_t first, const Args&... args) {
    (set(first++, args), ...);
    return first;
}

} // namespace onde::gpu
