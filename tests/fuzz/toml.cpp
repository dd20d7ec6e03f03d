// Fuzzes the reader of TOML files.
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    onde::fuzz::load(onde::fuzz::write("a.toml", onde::fuzz::text(data, size)));
    return 0;
}
