// The scalar types that shared structs may use: float, int, uint, uchar. Nothing with padding, no
// pointers.
#ifndef ONDE_SHARED_TYPES_H
#define ONDE_SHARED_TYPES_H

#ifdef __cplusplus
    #include <cstdint>
using uint = std::uint32_t;
using uchar = std::uint8_t;
#endif

#endif
