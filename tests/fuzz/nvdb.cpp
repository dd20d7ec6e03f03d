// Fuzzes the reader of NanoVDB files: as they are, and by single numbers in a whole one.
#include "fuzz/fuzz.h"
#include "scene/grid/formats.h"

#include <cstring>

/// A file of a ball, plain, as NanoVDB 32.4 writes it.
static const std::string& whole() {
    static const std::string bytes = [] {
        std::ifstream file(ONDE_FUZZ_DATA "/grids/tiny.nvdb", std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    }();
    return bytes;
}

/// Each 12 bytes of the data are a place and a number.
static std::string damaged(std::string_view data) {
    std::string bytes = whole();
    for (; data.size() >= 12 && bytes.size() > 8; data.remove_prefix(12)) {
        uint32_t place;
        std::memcpy(&place, data.data(), 4);
        std::memcpy(&bytes[place % (bytes.size() - 8)], &data[4], 8);
    }
    return bytes;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text = onde::fuzz::text(data, size);
    const bool is_file = text.starts_with("NanoVDB") || whole().empty();
    try {
        onde::LoadContext context({.limit = uint64_t(256) << 20});
        onde::read_nanovdb(context, "a.nvdb", is_file ? std::string(text) : damaged(text));
    } catch (const onde::InputError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
    return 0;
}
