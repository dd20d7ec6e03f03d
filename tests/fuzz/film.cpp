// Fuzzes the reader of film files, and what is told and made of them.
#include "film/ledger.h"
#include "film/merge.h"
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr uint64_t MOST_PIXELS = uint64_t(1) << 20; // more only takes longer
    const auto file = onde::fuzz::write("film.exr", onde::fuzz::text(data, size));
    try {
        onde::FilmMerge merge({file});
        const onde::FilmIdentity& identity = merge.header().identity;
        if (uint64_t(identity.width) * identity.height > MOST_PIXELS) return 0;
        merge.missing();
        merge.picture();
        merge.write(onde::fuzz::folder() / "merged.exr");
    } catch (const onde::InputError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
    return 0;
}
