// The two kinds of failure a user meets. Both carry one sentence: what, where, what to do.
// Thrown anywhere, caught once in app/main.cpp, which turns them into exit codes.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace onde {

/// Wrong input: a file, a number in it, an option. Exit code 2.
class InputError : public std::runtime_error {
  public:
    explicit InputError(const std::string& sentence) : std::runtime_error(sentence) {}

    template <class... Args>
    explicit InputError(fmt::format_string<Args...> format,
                        Args&&... args) requires(sizeof...(Args) > 0)
        : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

/// No usable device, a kernel that does not build, a launch that fails. Exit code 3.
class DeviceError : public std::runtime_error {
  public:
    explicit DeviceError(const std::string& sentence) : std::runtime_error(sentence) {}

    template <class... Args>
    explicit DeviceError(fmt::format_string<Args...> format,
                         Args&&... args) requires(sizeof...(Args) > 0)
        : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

} // namespace onde
