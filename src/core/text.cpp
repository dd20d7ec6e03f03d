#include "core/text.h"

#include <fmt/format.h>

#include <cstdint>

namespace onde {
namespace {

/// One character: how many bytes it takes, and its code point unless they are not UTF-8.
struct Character {
    size_t bytes = 1;
    uint32_t code = 0;
    bool valid = false;
};

Character first_character(std::string_view text) {
    const auto byte = [&](size_t i) { return uint8_t(text[i]); };
    const uint8_t lead = byte(0);
    if (lead < 0x80) return {1, lead, true};
    const size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
    uint32_t code = lead & (0x7f >> bytes);
    for (size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3f);
    }
    constexpr uint32_t LEAST[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    if (code < LEAST[bytes] || code > 0x10ffff || surrogate) return {};
    return {bytes, code, true};
}

bool is_control(uint32_t code) {
    return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

/// Line separators, and marks by which a text is shown in another order than it is written in.
bool disturbs_line(uint32_t code) {
    return code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
           (code >= 0x2066 && code <= 0x2069) || code == 0xfeff;
}

std::string escape_of(uint32_t code) {
    if (code == '\n') return "\\n";
    if (code == '\r') return "\\r";
    if (code == '\t') return "\\t";
    return code < 0x100 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:x}}}", code);
}

std::string escape(std::string_view text) {
    std::string line;
    for (size_t at = 0; at < text.size();) {
        const Character next = first_character(text.substr(at));
        if (next.valid && !is_control(next.code) && !disturbs_line(next.code))
            line += text.substr(at, next.bytes);
        else
            line += escape_of(next.valid ? next.code : uint8_t(text[at]));
        at += next.bytes;
    }
    return line;
}

/// Moves a place in the text to where a character begins.
size_t character_start(std::string_view text, size_t at) {
    while (at > 0 && at < text.size() && (text[at] & 0xc0) == 0x80) --at;
    return at;
}

} // namespace

std::string printable(std::string_view text, size_t longest) {
    if (text.size() <= longest) return escape(text);
    const size_t head = character_start(text, longest * 3 / 4);
    const size_t tail = character_start(text, text.size() - longest / 4);
    return escape(text.substr(0, head)) + "..." + escape(text.substr(tail));
}

std::string printable_lines(std::string_view text) {
    std::string lines;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        if (begin > 0) lines += '\n';
        lines += escape(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

} // namespace onde
