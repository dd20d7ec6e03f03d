#include "core/shown.h"

#include "core/text.h"

namespace onde {

std::string shown(std::string_view text, size_t most) {
    if (text.size() <= most) return printable(text, most);
    while (most > 0 && (text[most] & 0xc0) == 0x80) --most; // between characters
    return printable(text.substr(0, most), most) + "...";
}

} // namespace onde
