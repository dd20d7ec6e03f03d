// The attribute codec of meshopt, version 1, by its specification: deltas of bytes, 16 elements at
// a time, whose differences are taken by bytes, by 16-bit words, or by exclusive or of 32-bit
// words.
#include "scene/gltf/meshopt.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace onde::gltf {

namespace {

constexpr size_t GROUP = 16, MAX_BLOCK = 256;

/// Bytes that are taken from the front; taking more than there are makes it bad.
struct Stream {
    std::span<const uint8_t> bytes;
    bool good = true;

    std::span<const uint8_t> take(size_t count) {
        good = good && count <= bytes.size();
        if (!good) return {};
        const auto taken = bytes.first(count);
        bytes = bytes.subspan(count);
        return taken;
    }
};

/// 16 deltas of `bits` bits each; those of all ones stand for a byte that follows.
void read_group(Stream& stream, unsigned bits, uint8_t* deltas) {
    if (bits == 0) {
        std::fill_n(deltas, GROUP, uint8_t(0));
        return;
    }
    const auto packed = stream.take(GROUP * bits / 8);
    if (!stream.good) return;
    const unsigned per_byte = 8 / bits, ones = (1u << bits) - 1;
    for (size_t i = 0; i < GROUP; ++i) {
        const unsigned place = unsigned(i % per_byte);
        const unsigned shift = bits == 1 ? place : 8 - bits * (place + 1);
        deltas[i] = uint8_t((packed[i / per_byte] >> shift) & ones);
    }
    if (bits == 8) return;
    for (size_t i = 0; i < GROUP && stream.good; ++i) {
        if (deltas[i] != ones) continue;
        const auto byte = stream.take(1);
        if (stream.good) deltas[i] = byte[0];
    }
}

/// The deltas of one byte of each element of a block.
void read_deltas(Stream& stream, unsigned control, size_t count, uint8_t* deltas) {
    constexpr unsigned BITS[2][4] = {{0, 1, 2, 4}, {1, 2, 4, 8}};
    const size_t groups = (count + GROUP - 1) / GROUP;
    if (control == 2) {
        std::fill_n(deltas, count, uint8_t(0));
    } else if (control == 3) {
        const auto literal = stream.take(count);
        std::copy(literal.begin(), literal.end(), deltas);
    } else {
        const auto header = stream.take((groups + 3) / 4);
        for (size_t g = 0; g < groups && stream.good; ++g) {
            const unsigned mode = (header[g / 4] >> (g % 4 * 2)) & 3u;
            read_group(stream, BITS[control][mode], deltas + g * GROUP);
        }
    }
}

template <class Word>
Word unzigzag(Word value) {
    return Word((value & 1) != 0 ? ~(value >> 1) : value >> 1);
}

/// Adds the deltas of a channel's words to the words of the element before, element by element.
template <class Word, class Apply>
void apply_deltas(const std::array<uint8_t, MAX_BLOCK>* deltas, size_t count, size_t stride,
                  uint8_t* previous, uint8_t* result, const Apply& apply) {
    for (size_t part = 0; part < 4; part += sizeof(Word)) {
        Word last;
        std::memcpy(&last, previous + part, sizeof(Word));
        for (size_t i = 0; i < count; ++i) {
            uint32_t delta = 0;
            for (size_t b = 0; b < sizeof(Word); ++b)
                delta |= uint32_t(deltas[part + b][i]) << (8 * b);
            last = apply(last, Word(delta));
            std::memcpy(result + i * stride + part, &last, sizeof(Word));
        }
        std::memcpy(previous + part, &last, sizeof(Word));
    }
}

/// The four bytes of a channel of a block.
void apply_channel(uint8_t mode, const std::array<uint8_t, MAX_BLOCK>* deltas, size_t count,
                   size_t stride, uint8_t* previous, uint8_t* result) {
    if ((mode & 3) == 0)
        apply_deltas<uint8_t>(deltas, count, stride, previous, result,
                              [](uint8_t a, uint8_t d) { return uint8_t(a + unzigzag(d)); });
    else if ((mode & 3) == 1)
        apply_deltas<uint16_t>(deltas, count, stride, previous, result,
                               [](uint16_t a, uint16_t d) { return uint16_t(a + unzigzag(d)); });
    else
        apply_deltas<uint32_t>(deltas, count, stride, previous, result,
                               [&](uint32_t a, uint32_t d) { return a ^ std::rotr(d, mode >> 4); });
}

bool is_mode(uint8_t mode) {
    return mode == 0 || mode == 1 || (mode & 15) == 2;
}

} // namespace

bool decode_meshopt_attributes(std::span<const uint8_t> stream, size_t count, size_t stride,
                               uint8_t* result) {
    constexpr size_t MIN_TAIL = 24;
    const size_t tail = stride + stride / 4, padded = std::max(tail, MIN_TAIL);
    if (stream.size() < 1 + padded) return false;
    std::array<uint8_t, 256> previous{};
    std::ranges::copy(stream.last(tail).first(stride), previous.begin());
    const auto modes = stream.last(stride / 4);
    if (!std::ranges::all_of(modes, is_mode)) return false;
    Stream blocks{stream.first(stream.size() - padded).subspan(1)};
    const size_t most = std::min((8192 / stride) & ~(GROUP - 1), MAX_BLOCK);
    for (size_t done = 0; done < count; done += most) {
        const size_t size = std::min(most, count - done);
        const auto control = blocks.take(stride / 4);
        for (size_t channel = 0; channel < stride / 4 && blocks.good; ++channel) {
            std::array<uint8_t, MAX_BLOCK> deltas[4];
            for (unsigned b = 0; b < 4; ++b)
                read_deltas(blocks, (control[channel] >> (2 * b)) & 3u, size, deltas[b].data());
            if (!blocks.good) break;
            apply_channel(modes[channel], deltas, size, stride, previous.data() + 4 * channel,
                          result + done * stride + 4 * channel);
        }
        if (!blocks.good) return false;
    }
    return blocks.bytes.empty();
}

} // namespace onde::gltf
