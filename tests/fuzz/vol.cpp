// Fuzzes the reader of Mitsuba's volumes.
#include "fuzz/fuzz.h"
#include "scene/grid/formats.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    try {
        onde::LoadContext context({.limit = uint64_t(256) << 20});
        onde::read_vol(context, "a.vol", onde::fuzz::text(data, size));
    } catch (const onde::InputError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
    return 0;
}
