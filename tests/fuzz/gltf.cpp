// Fuzzes the reader of glTF: what begins with "glTF" as GLB, the rest as JSON.
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view bytes = onde::fuzz::text(data, size);
    onde::fuzz::load(onde::fuzz::write(bytes.starts_with("glTF") ? "a.glb" : "a.gltf", bytes));
    return 0;
}
