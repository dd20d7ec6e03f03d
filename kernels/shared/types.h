// The scalar types that shared structs may use: float, int, uint. Nothing with padding, no pointers.
#ifndef ONDE_SHARED_TYPES_H
#define ONDE_SHARED_TYPES_H

#ifndef __OPENCL_VERSION__
    #include <cstdint>
using uint = std::uint32_t;
#endif

#endif
