// One definition of each shared struct, read alike by the host's and the device's compiler.
#include "probe/layout.h"
#include "support/probe.h"

#include <catch2/catch.hpp>

#include <cstddef>

using namespace onde;
using namespace onde::test;

namespace {

struct Place {
    const char* what;
    size_t bytes;
};

#define PLACE_OF_SIZE(Type) {"size of " #Type, sizeof(Type)},
#define PLACE_OF_FIELD(Type, field) {#Type "." #field, offsetof(Type, field)},
const Place PLACES[] = {SHARED_LAYOUT(PLACE_OF_SIZE, PLACE_OF_FIELD)};

} // namespace

TEST_CASE("host and device place every field of every shared struct alike") {
    gpu::Program program = programs().build({"probe/layout.cl", {}, {{"layout", 1}}});
    const gpu::Buffer<uint32_t> out(device(), std::size(PLACES));
    gpu::Kernel& kernel = program.kernel("layout");
    kernel.set_from(0, uint32_t(1), out);
    kernel.launch(1);
    const std::vector<uint32_t> bytes = out.read(device());
    for (size_t i = 0; i < bytes.size(); i++) {
        INFO(PLACES[i].what);
        CHECK(bytes[i] == PLACES[i].bytes);
    }
}
