#!/usr/bin/env python3
"""Decodes the Cryptomatte layers of an .exr, by nothing of the project: its own reader of OpenEXR,
its own hash.

    cryptomatte.py FILE.exr LAYER             checks ids, shares and manifest; lists each name's share
    cryptomatte.py FILE.exr LAYER NAME MATTE  and that NAME's matte is the channel MATTE, exactly

Exits 1 with a sentence where something is wrong.
"""

import json
import struct
import sys
import zlib

SIZE_OF = {0: 4, 1: 2, 2: 4}  # UINT, HALF, FLOAT
FORMAT_OF = {0: "I", 1: "e", 2: "f"}


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def read_header(data):
    """Attributes by name, as (type, bytes), and where the header ends."""
    assert struct.unpack_from("<I", data)[0] == 20000630, "no OpenEXR file"
    at, attributes = 8, {}
    while data[at]:
        name, at = text_at(data, at)
        kind, at = text_at(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = (kind, data[at + 4 : at + 4 + size])
        at += 4 + size
    return attributes, at + 1


def read_channels(value):
    at, channels = 0, []
    while value[at]:
        name, at = text_at(value, at)
        channels.append((name, struct.unpack_from("<i", value, at)[0]))
        at += 16
    return channels


def unpacked(block, size):
    """ZIP of OpenEXR: deflated, differences, even and odd bytes apart."""
    if len(block) == size:
        return block
    raw = bytearray(zlib.decompress(block))
    for i in range(1, len(raw)):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 255
    half = (len(raw) + 1) // 2
    whole = bytearray(len(raw))
    whole[0::2], whole[1::2] = raw[:half], raw[half:]
    return bytes(whole)


def read_exr(path):
    """Texts of the header, and words of 32 bits of each channel as bytes, row by row."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = read_header(data)
    channels = read_channels(attributes["channels"][1])
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"][1])
    width, height = right - left + 1, bottom - top + 1
    assert attributes["compression"][1][0] == 3, "not compressed by ZIP"
    rows = {name: [None] * height for name, _ in channels}
    for offset in struct.unpack_from(f"<{(height + 15) // 16}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        count = min(16, bottom + 1 - y)
        row = sum(SIZE_OF[kind] * width for _, kind in channels)
        block = unpacked(data[offset + 8 : offset + 8 + size], row * count)
        place = 0
        for line in range(count):
            for name, kind in channels:
                rows[name][y - top + line] = (kind, block[place : place + SIZE_OF[kind] * width])
                place += SIZE_OF[kind] * width
    texts = {name: value.decode() for name, (kind, value) in attributes.items() if kind == "string"}
    return texts, rows


def numbers(rows, form=None):
    """All pixels of a channel; its words as that form where one is given."""
    all_words = []
    for kind, words in rows:
        letter = form or FORMAT_OF[kind]
        all_words += struct.unpack(f"<{len(words) // SIZE_OF[kind]}{letter}", words)
    return all_words


def murmur3(key):
    """MurmurHash3_x86_32 with seed 0."""
    h, rest = 0, len(key) & ~3
    for word in [*struct.unpack(f"<{rest // 4}I", key[:rest]), int.from_bytes(key[rest:], "little")]:
        k = word * 0xCC9E2D51 & 0xFFFFFFFF
        k = (k << 15 | k >> 17) * 0x1B873593 & 0xFFFFFFFF
        h ^= k
        if rest >= 4:
            h = (h << 13 | h >> 19) & 0xFFFFFFFF
            h = h * 5 + 0xE6546B64 & 0xFFFFFFFF
        rest -= 4
    h ^= len(key)
    for shift, factor in ((16, 0x85EBCA6B), (13, 0xC2B2AE35), (16, 1)):
        h = (h ^ h >> shift) * factor & 0xFFFFFFFF
    return h


def id_of(name):
    bits = murmur3(name.encode())
    return bits ^ 1 << 23 if bits >> 23 & 255 in (0, 255) else bits


def read_manifest(texts, layer):
    prefix = f"cryptomatte/{murmur3(layer.encode()):08x}"[: len("cryptomatte/") + 7]
    found = {key.rsplit("/", 1)[1]: value for key, value in texts.items() if key.startswith(prefix)}
    assert found["name"] == layer, "another name of the layer"
    assert found["hash"] == "MurmurHash3_32" and found["conversion"] == "uint32_to_float32"
    manifest = json.loads(found["manifest"])
    for name, bits in manifest.items():
        assert int(bits, 16) == id_of(name) and len(bits) == 8, f"{name} has another id"
    return manifest


def read_mattes(rows, layer, manifest):
    """The share of every pixel, by id."""
    mattes = {int(bits, 16): None for bits in manifest.values()}
    size = len(numbers(rows[f"{layer}00.R"]))
    last = [2.0] * size
    total = [0.0] * size
    mattes = {bits: [0.0] * size for bits in mattes}
    number = 0
    while f"{layer}{number:02}.R" in rows:
        for ids, shares in ("RG", "BA"):
            bits = numbers(rows[f"{layer}{number:02}.{ids}"], "I")
            values = numbers(rows[f"{layer}{number:02}.{shares}"])
            for i, (one, share) in enumerate(zip(bits, values)):
                assert share <= last[i], "shares are not in order"
                last[i] = share
                if share == 0:
                    continue
                assert one in mattes, f"the id {one:08x} is in no manifest"
                mattes[one][i] += share
                total[i] += share
        number += 1
    assert max(total) < 1 + 1e-5, "a pixel has more than all of its samples"
    return mattes


def main():
    path, layer = sys.argv[1:3]
    texts, rows = read_exr(path)
    manifest = read_manifest(texts, layer)
    mattes = read_mattes(rows, layer, manifest)
    for name, bits in manifest.items():
        matte = mattes[int(bits, 16)]
        print(f"{sum(matte) / len(matte):.6f} {name}")
    if len(sys.argv) == 5:
        name, channel = sys.argv[3:]
        expected = numbers(rows[channel])
        matte = mattes[id_of(name)]
        assert 0 < sum(matte) < len(matte), f"{name} is nowhere or everywhere"
        worst = max(abs(a - b) for a, b in zip(matte, expected))
        assert worst < 1e-6, f"the matte of {name} differs by {worst} from {channel}"


if __name__ == "__main__":
    try:
        main()
    except (AssertionError, KeyError) as problem:
        sys.exit(f"{sys.argv[1]}: {problem}")
