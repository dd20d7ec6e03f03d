// Fuzzes the reader of Mitsuba's scenes.
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    onde::fuzz::load(onde::fuzz::write("a.xml", onde::fuzz::text(data, size)));
    return 0;
}
