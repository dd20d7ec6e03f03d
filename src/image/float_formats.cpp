// Two float formats that take a page each: Radiance's RGBE (Ward, "Real Pixels", Graphics Gems II,
// 1991) and PFM.
#include "image/stored_image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

namespace onde {
namespace {

/// Takes bytes and words off the front of a file.
class Cursor {
  public:
    explicit Cursor(FileBytes file) : rest_(file) {}

    uint8_t byte() {
        if (rest_.empty()) throw ImageProblem("the file ends early");
        const uint8_t value = rest_[0];
        rest_ = rest_.subspan(1);
        return value;
    }
    /// Up to the line feed, which is taken too.
    std::string_view line() {
        const std::string_view text = as_text(rest_);
        constexpr size_t LONGEST = 4096;
        const size_t end = text.substr(0, LONGEST).find('\n');
        if (end == std::string_view::npos) throw ImageProblem("its header is damaged");
        rest_ = rest_.subspan(end + 1);
        return text.substr(0, end);
    }
    /// Up to one blank, which is taken too.
    std::string_view word() {
        const std::string_view text = as_text(rest_);
        const size_t end = text.substr(0, 64).find_first_of(" \t\r\n");
        if (end == std::string_view::npos) throw ImageProblem("its header is damaged");
        rest_ = rest_.subspan(end + 1);
        return text.substr(0, end);
    }
    FileBytes rest() const { return rest_; }

  private:
    FileBytes rest_;
};

uint32_t positive(std::string_view word) {
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value == 0)
        throw ImageProblem("its header is damaged");
    return value;
}

/// What a Radiance file's header tells. Its pixels come in runs along an axis of the picture.
struct RadianceHeader {
    uint32_t width = 0, height = 0;
    bool flip_x = false, flip_y = false, columns = false;
};

/// "-Y 512 +X 1024", rows from the top; the axes may be turned and swapped.
RadianceHeader read_resolution(std::string_view line) {
    std::array<std::string_view, 4> words;
    for (std::string_view& word : words) {
        word = line.substr(0, line.find_first_of(" \r"));
        line.remove_prefix(std::min(line.size(), word.size() + 1));
    }
    RadianceHeader header;
    header.columns = words[0].ends_with('X');
    if (header.columns) {
        std::swap(words[0], words[2]);
        std::swap(words[1], words[3]);
    }
    const bool known =
        (words[0] == "-Y" || words[0] == "+Y") && (words[2] == "+X" || words[2] == "-X");
    if (!known) throw ImageProblem("its header has no size");
    header.height = positive(words[1]);
    header.width = positive(words[3]);
    header.flip_y = words[0] == "+Y";
    header.flip_x = words[2] == "-X";
    return header;
}

RadianceHeader read_radiance_header(Cursor& cursor) {
    constexpr int MOST_LINES = 1000;
    for (int i = 0; i < MOST_LINES; ++i) {
        const std::string_view line = cursor.line();
        if (line.starts_with("FORMAT=") && !line.starts_with("FORMAT=32-bit_rle_rgbe"))
            throw ImageProblem("its colours are not RGB");
        if (line.empty() || line == "\r") return read_resolution(cursor.line());
    }
    throw ImageProblem("its header is damaged");
}

ImageHeader radiance_header(FileBytes file) {
    Cursor cursor(file);
    const RadianceHeader header = read_radiance_header(cursor);
    ImageHeader size{.width = header.width,
                     .height = header.height,
                     .channels = 3,
                     .sample_bytes = sizeof(float)};
    size.least_bytes = least_bytes_of_any(size.samples());
    return size;
}

using Rgbe = std::array<uint8_t, 4>;

/// The four components one after the other, each in runs of equal or of different bytes.
void read_packed_run(Cursor& cursor, std::span<Rgbe> run) {
    constexpr unsigned EQUAL = 128;
    for (size_t component = 0; component < 4; ++component)
        for (size_t at = 0; at < run.size();) {
            unsigned count = cursor.byte();
            const bool equal = count > EQUAL;
            if (equal) count -= EQUAL;
            if (count == 0 || count > run.size() - at) throw ImageProblem("it is damaged");
            uint8_t value = equal ? cursor.byte() : uint8_t(0);
            for (const size_t end = at + count; at < end; ++at)
                run[at][component] = equal ? value : cursor.byte();
        }
}

/// Pixel by pixel; one of 1, 1, 1 repeats the pixel before it, more such ones 256 times as often.
void read_plain_run(Cursor& cursor, std::span<Rgbe> run, Rgbe pixel) {
    unsigned shift = 0;
    for (size_t at = 0; at < run.size();) {
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            constexpr unsigned MOST_SHIFT = 24;
            const size_t count = shift > MOST_SHIFT ? 0 : size_t(pixel[3]) << shift;
            if (at == 0 || count > run.size() - at) throw ImageProblem("it is damaged");
            std::fill_n(run.begin() + ptrdiff_t(at), count, run[at - 1]);
            at += count;
            shift += 8;
        } else {
            run[at++] = pixel;
            shift = 0;
        }
        if (at < run.size())
            for (uint8_t& byte : pixel) byte = cursor.byte();
    }
}

void read_run(Cursor& cursor, std::span<Rgbe> run) {
    Rgbe first;
    for (uint8_t& byte : first) byte = cursor.byte();
    constexpr size_t SHORTEST_PACKED = 8, LONGEST_PACKED = 0x7fff;
    const bool packed = first[0] == 2 && first[1] == 2 && (first[2] & 0x80) == 0 &&
                        run.size() >= SHORTEST_PACKED && run.size() <= LONGEST_PACKED;
    if (!packed) return read_plain_run(cursor, run, first);
    if (size_t(first[2]) << 8 != (run.size() & 0xff00) || first[3] != (run.size() & 0xff))
        throw ImageProblem("the length of its rows is wrong");
    read_packed_run(cursor, run);
}

StoredImage decode_radiance(FileBytes file) {
    Cursor cursor(file);
    const RadianceHeader h = read_radiance_header(cursor);
    std::vector<float> pixels(size_t(h.width) * h.height * 3);
    std::vector<Rgbe> run(h.columns ? h.height : h.width);
    const uint32_t runs = h.columns ? h.width : h.height;
    for (uint32_t i = 0; i < runs; ++i) {
        read_run(cursor, run);
        for (uint32_t k = 0; k < run.size(); ++k) {
            uint32_t x = h.columns ? i : k, y = h.columns ? k : i;
            if (h.flip_x) x = h.width - 1 - x;
            if (h.flip_y) y = h.height - 1 - y;
            constexpr int MANTISSA = 8, BIAS = 128;
            for (size_t c = 0; c < 3 && run[k][3] != 0; ++c)
                pixels[(size_t(y) * h.width + x) * 3 + c] =
                    std::ldexp(float(run[k][c]), int(run[k][3]) - BIAS - MANTISSA);
        }
    }
    return {h.width, h.height, 3, std::move(pixels)};
}

bool is_radiance(FileBytes file) {
    return as_text(file).starts_with("#?RADIANCE") || as_text(file).starts_with("#?RGBE");
}

struct PfmHeader {
    uint32_t width = 0, height = 0, channels = 0;
    bool little_endian = false;
};

/// "PF", width, height, and a number whose sign is the order of bytes; one blank after each.
PfmHeader read_pfm_header(Cursor& cursor) {
    PfmHeader header;
    header.channels = cursor.word() == "PF" ? 3 : 1;
    header.width = positive(cursor.word());
    header.height = positive(cursor.word());
    header.little_endian = cursor.word().starts_with('-');
    return header;
}

ImageHeader pfm_header(FileBytes file) {
    Cursor cursor(file);
    const PfmHeader header = read_pfm_header(cursor);
    ImageHeader size{.width = header.width,
                     .height = header.height,
                     .channels = header.channels,
                     .sample_bytes = sizeof(float)};
    size.least_bytes = size.samples() * sizeof(float);
    return size;
}

float read_float(const uint8_t* bytes, bool little_endian) {
    uint32_t bits = 0;
    for (size_t i = 0; i < 4; ++i) bits |= uint32_t(bytes[i]) << 8 * (little_endian ? i : 3 - i);
    return std::bit_cast<float>(bits);
}

StoredImage decode_pfm(FileBytes file) {
    Cursor cursor(file);
    const PfmHeader h = read_pfm_header(cursor);
    const size_t row = size_t(h.width) * h.channels;
    if (cursor.rest().size() / sizeof(float) / row < h.height)
        throw ImageProblem("the file ends early");
    std::vector<float> pixels(row * h.height);
    const uint8_t* next = cursor.rest().data();
    for (uint32_t y = h.height; y-- > 0;) // rows come from the bottom
        for (size_t i = 0; i < row; ++i, next += sizeof(float))
            pixels[y * row + i] = read_float(next, h.little_endian);
    return {h.width, h.height, h.channels, std::move(pixels)};
}

bool is_pfm(FileBytes file) {
    const std::string_view text = as_text(file);
    return text.size() > 3 && (text.starts_with("PF") || text.starts_with("Pf")) &&
           (text[2] == '\n' || text[2] == ' ' || text[2] == '\r');
}

} // namespace

const ImageFormat HDR_FORMAT{"Radiance HDR", is_radiance, radiance_header, decode_radiance,
                             nullptr};
const ImageFormat PFM_FORMAT{"PFM", is_pfm, pfm_header, decode_pfm, nullptr};

} // namespace onde
