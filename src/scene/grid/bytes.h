// Numbers in the bytes of a file from outside, each within its bounds or refused.
#pragma once

#include "core/error.h"

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

namespace onde {

class Bytes {
  public:
    /// Both must outlive it.
    Bytes(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

    uint64_t size() const { return bytes_.size(); }
    std::string_view all() const { return bytes_; }

    /// Throws InputError where they reach beyond the end.
    std::string_view part(uint64_t offset, uint64_t size) const {
        if (offset > bytes_.size() || size > bytes_.size() - offset)
            throw InputError("{}: it ends too early; it is truncated or damaged, copy it again",
                             name_);
        return bytes_.substr(size_t(offset), size_t(size));
    }

    /// Of little-endian numbers.
    template <class T>
    T at(uint64_t offset) const {
        static_assert(std::endian::native == std::endian::little);
        T value;
        std::memcpy(&value, part(offset, sizeof(T)).data(), sizeof(T));
        return value;
    }

    [[noreturn]] void fail(std::string_view problem) const {
        throw InputError("{}: {}", name_, problem);
    }

  private:
    std::string_view bytes_;
    const std::string& name_;
};

} // namespace onde
