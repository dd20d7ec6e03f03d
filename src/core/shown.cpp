#include "core/shown.h"

#include <fmt/format.h>

#include <algorithm>

namespace onde {

/// Whether the byte goes on with the UTF-8 sequence of the byte before it.
static bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u;
}

std::string shown(std::string_view text, size_t most) {
    size_t end = std::min(text.size(), most);
    while (end > 0 && end < text.size() && continues(text[end])) --end;
    std::string result;
    for (size_t i = 0; i < end; ++i) {
        const unsigned byte = static_cast<unsigned char>(text[i]);
        const unsigned next = i + 1 < end ? static_cast<unsigned char>(text[i + 1]) : 0;
        if (byte < 0x20 || byte == 0x7f)
            result += fmt::format("\\x{:02x}", byte);
        else if (byte == 0xc2 && next >= 0x80 && next < 0xa0) // C1 controls in UTF-8
            result += fmt::format("\\x{:02x}", unsigned(static_cast<unsigned char>(text[++i])));
        else
            result += text[i];
    }
    return end < text.size() ? result + "..." : result;
}

} // namespace onde
