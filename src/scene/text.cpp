#include "scene/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace onde::text {

namespace {

constexpr std::string_view BLANKS = " \t\v\f";

void append_utf8(std::string& text, uint32_t code) {
    const auto tail = [&](uint32_t shift) { text += char(0x80 | ((code >> shift) & 0x3f)); };
    if (code < 0x80) {
        text += char(code);
    } else if (code < 0x800) {
        text += char(0xc0 | (code >> 6));
        tail(0);
    } else if (code < 0x10000) {
        text += char(0xe0 | (code >> 12));
        tail(6);
        tail(0);
    } else {
        text += char(0xf0 | (code >> 18));
        tail(12);
        tail(6);
        tail(0);
    }
}

/// Halves of pairs that stand alone become U+FFFD, the replacement character.
std::string from_utf16(std::string_view bytes, bool big_endian) {
    const auto unit = [&](size_t i) {
        const uint32_t first = uint8_t(bytes[i]), second = uint8_t(bytes[i + 1]);
        return big_endian ? first << 8 | second : second << 8 | first;
    };
    std::string text;
    for (size_t i = 0; i + 1 < bytes.size(); i += 2) {
        uint32_t code = unit(i);
        const uint32_t next = i + 3 < bytes.size() ? unit(i + 2) : 0;
        const bool high = code >= 0xd800 && code < 0xdc00, low = next >= 0xdc00 && next < 0xe000;
        if (high && low) {
            code = 0x10000 + ((code - 0xd800) << 10) + (next - 0xdc00);
            i += 2;
        } else if (code >= 0xd800 && code < 0xe000) {
            code = 0xfffd;
        }
        append_utf8(text, code);
    }
    return text;
}

/// The bytes of the character that begins here, or 0 where that is not UTF-8.
size_t utf8_length(std::string_view text) {
    const auto byte = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : 0u; };
    if (byte(0) < 0x80) return 1;
    const size_t length = byte(0) < 0xc2 ? 0 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
    if (byte(0) > 0xf4) return 0;
    for (size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    return length;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const size_t length = utf8_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string from_latin1(std::string_view bytes) {
    std::string text;
    for (const char c : bytes) append_utf8(text, uint8_t(c));
    return text;
}

/// Of a number without sign that no double can hold: whether it is too small rather than too large.
bool is_tiny(std::string_view word) {
    const size_t exponent = word.find_first_of("eE");
    if (exponent != std::string_view::npos) return word.substr(exponent + 1).starts_with('-');
    return word.find_first_not_of("0.") > word.find('.');
}

} // namespace

std::optional<std::string> decode(std::string bytes) {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);
    const bool big = bytes.starts_with("\xfe\xff");
    if (big || bytes.starts_with("\xff\xfe"))
        bytes = from_utf16(std::string_view(bytes).substr(2), big);
    if (bytes.find('\0') != std::string::npos) return std::nullopt;
    if (!is_utf8(bytes)) return from_latin1(bytes);
    return bytes;
}

std::string_view trim(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(BLANKS), text.size()));
    return text.substr(0, text.find_last_not_of(BLANKS) + 1);
}

std::optional<double> number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const bool negative = word.starts_with('-');
    double value = 0.0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop == end && error == std::errc()) return value;
    if (stop == end && error == std::errc::result_out_of_range) {
        const double huge = std::numeric_limits<double>::infinity();
        return is_tiny(word.substr(negative)) ? 0.0 : negative ? -huge : huge;
    }
    if (word.find(".#") != std::string_view::npos) // 1.#QNAN and others
        return std::numeric_limits<double>::quiet_NaN();
    return std::nullopt;
}

std::string_view Words::next() {
    if (rest_.starts_with('#')) rest_ = {};
    const std::string_view word = rest_.substr(0, rest_.find_first_of(BLANKS));
    rest_ = trim(rest_.substr(word.size()));
    return word;
}

double Words::next_number() {
    return number(next()).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string_view Lines::take() {
    const size_t length = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, length);
    const size_t end = rest_.substr(length).starts_with("\r\n") ? 2 : 1;
    rest_.remove_prefix(std::min(length + end, rest_.size()));
    ++taken_;
    return line;
}

/// Without the backslash at its end, or nothing when the line does not continue.
static std::optional<std::string_view> continued(std::string_view line) {
    const size_t last = line.find_last_not_of(BLANKS);
    if (last == std::string_view::npos || line[last] != '\\') return std::nullopt;
    if (trim(line).starts_with('#') || line.find(" #") != std::string_view::npos)
        return std::nullopt;
    return line.substr(0, last);
}

std::optional<std::string_view> Lines::next() {
    if (rest_.empty()) return std::nullopt;
    std::string_view line = take();
    number_ = taken_;
    auto part = continued(line);
    if (!part || rest_.empty()) return part.value_or(line);
    joined_.clear();
    while (part && !rest_.empty()) {
        joined_.append(*part) += ' ';
        line = take();
        part = continued(line);
    }
    joined_ += part.value_or(line);
    return joined_;
}

} // namespace onde::text
