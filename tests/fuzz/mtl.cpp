// Fuzzes the reader of MTL files, by an OBJ whose faces use materials "a" and "b".
#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const std::filesystem::path obj = onde::fuzz::write(
        "a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                 "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 3/3 2/2 1/1\n");
    onde::fuzz::write("m.mtl", onde::fuzz::text(data, size));
    onde::fuzz::load(obj);
    return 0;
}
