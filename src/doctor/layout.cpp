// One definition of each shared record, read alike by the host's and the device's compiler.
#include "probe/layout.h"
#include "doctor/checks.h"
#include "doctor/tally.h"

#include <cstddef>

namespace onde::doctor {

namespace {

struct Place {
    const char* what;
    size_t bytes;
};

#define PLACE_OF_SIZE(Type) {"the size of " #Type, sizeof(Type)},
#define PLACE_OF_FIELD(Type, field) {#Type "." #field, offsetof(Type, field)},
const Place PLACES[] = {SHARED_LAYOUT(PLACE_OF_SIZE, PLACE_OF_FIELD)};

} // namespace

Finding check_layout(const CheckContext& context) {
    gpu::Program program = context.programs.build({"probe/layout.cl", {}, {{"layout", 1}}});
    const gpu::Buffer<uint32_t> out(context.device(), std::size(PLACES));
    gpu::Kernel& kernel = program.kernel("layout");
    kernel.set_from(0, uint32_t(1), out);
    kernel.launch(1);
    const std::vector<uint32_t> bytes = out.read(context.device());
    Tally tally;
    for (size_t i = 0; i < bytes.size(); i++)
        tally.expect(bytes[i] == PLACES[i].bytes, [&] {
            return fmt::format("{} is {} on the host and {} on the device", PLACES[i].what,
                               PLACES[i].bytes, bytes[i]);
        });
    return tally.finding("sizes and offsets differ");
}

} // namespace onde::doctor
