// Content hashes for cache keys and for the scene hash stored in pictures (XXH3, 64 bits).
#pragma once

#define XXH_STATIC_LINKING_ONLY // declares the state, which lives inside a Hasher
#include <xxhash.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace onde {

/// Accumulates bytes; the order of the calls matters.
class Hasher {
  public:
    Hasher() { XXH3_64bits_reset(&state_); }

    Hasher& bytes(const void* data, size_t size) {
        XXH3_64bits_update(&state_, data, size);
        return *this;
    }
    /// Text is hashed with its length, so that "ab","c" differs from "a","bc".
    Hasher& text(std::string_view text) {
        return value(uint64_t(text.size())).bytes(text.data(), text.size());
    }
    /// T must have no padding.
    template <class T>
    Hasher& value(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        return bytes(&value, sizeof(T));
    }
    template <class T>
    Hasher& span(std::span<const T> values) {
        return value(uint64_t(values.size())).bytes(values.data(), values.size_bytes());
    }
    uint64_t digest() const { return XXH3_64bits_digest(&state_); }

    /// The digest as 16 hexadecimal digits.
    std::string hex() const;

  private:
    XXH3_state_t state_;
};

} // namespace onde
