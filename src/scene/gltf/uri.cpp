#include "scene/gltf/uri.h"

#include "core/error.h"
#include "scene/references.h"

#include <array>

namespace onde::gltf {

namespace {

constexpr int NOT_BASE64 = -1;

constexpr std::array<int, 256> base64_values() {
    std::array<int, 256> values{};
    values.fill(NOT_BASE64);
    constexpr std::string_view LETTERS =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < LETTERS.size(); ++i) values[size_t(LETTERS[i])] = int(i);
    values['-'] = 62; // the alphabet for URLs (RFC 4648, section 5)
    values['_'] = 63;
    return values;
}

std::string decode_base64(std::string_view text, const std::string& where) {
    static constexpr std::array<int, 256> VALUES = base64_values();
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int count = 0;
    for (char c : text) {
        if (c == '\n' || c == '\r' || c == ' ') continue;
        const int value = VALUES[static_cast<unsigned char>(c)];
        if (value == NOT_BASE64)
            throw InputError("{}: its data URI is not valid base64; export it again", where);
        bits = bits << 6 | uint32_t(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += char(static_cast<unsigned char>(bits >> count));
    }
    return bytes;
}

} // namespace

std::optional<std::string> decode_data_uri(std::string_view uri, const std::string& where) {
    constexpr std::string_view SCHEME = "data:", BASE64 = ";base64";
    if (!uri.starts_with(SCHEME)) return std::nullopt;
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        throw InputError("{}: its data URI has no comma before the data; export it again", where);
    const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
    const std::string unescaped =
        data.find('%') == std::string_view::npos ? "" : decode_uri(std::string(data));
    const std::string_view text = unescaped.empty() ? data : std::string_view(unescaped);
    return head.ends_with(BASE64) ? decode_base64(text, where) : std::string(text);
}

} // namespace onde::gltf
