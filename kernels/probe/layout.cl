// The device compiler's sizes and offsets of the shared structs, in the order of probe/layout.h.
#include "probe/layout.h"

#define WRITE_SIZE(Type) out[n++] = sizeof(Type);
#define WRITE_OFFSET(Type, field) out[n++] = __builtin_offsetof(Type, field);

__kernel void layout(uint count, __global uint* out) {
    if (get_global_id(0) >= count) return;
    uint n = 0;
    SHARED_LAYOUT(WRITE_SIZE, WRITE_OFFSET)
}
