// The two kinds of failure a user meets. Both carry one sentence: what, where, what to do.
// Thrown anywhere, caught once in app/main.cpp, which turns them into exit codes.
#pragma once

#include "core/text.h"

#include <fmt/format.h>

#include <stdexcept>
#include <type_traits>

namespace onde {

/// Names are put into a sentence as `printable` shows them; numbers as they are.
template <class T>
decltype(auto) in_sentence(const T& value) {
    if constexpr (std::is_convertible_v<const T&, std::string_view>)
        return printable(value);
    else
        return (value);
}

/// The sentence with foreign names made harmless.
template <class... Values>
std::string format_sentence(fmt::string_view format, const Values&... values) {
    return fmt::vformat(format, fmt::make_format_args(values...));
}

/// Wrong input: a file, a number in it, an option. Exit code 2.
class InputError : public std::runtime_error {
  public:
    /// The sentence as it is.
    explicit InputError(const std::string& sentence) : std::runtime_error(sentence) {}

    template <class... Args>
    explicit InputError(fmt::format_string<Args...> format,
                        Args&&... args) requires(sizeof...(Args) > 0)
        : std::runtime_error(format_sentence(format, in_sentence(args)...)) {}
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
