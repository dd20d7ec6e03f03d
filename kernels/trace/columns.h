// State in memory: word k of slot i lies at k * stride + i, so that the lanes of a group lie side
// by side. What words there are is a list of shared/columns.h.
#ifndef ONDE_TRACE_COLUMNS_H
#define ONDE_TRACE_COLUMNS_H

#include "math/vector.h"
#include "shared/columns.h"

typedef struct {
    __global float* words;
    uint stride;
} Columns;

// The columns from the k-th on.
INLINE Columns columns_from(Columns c, uint k) {
    c.words += (size_t)k * c.stride;
    return c;
}

INLINE __global float* column(Columns c, uint k, uint i) {
    return c.words + (size_t)k * c.stride + i;
}

INLINE real3 load3(Columns c, uint k, uint i) {
    return make3(load_real(column(c, k, i)), load_real(column(c, k + 1, i)),
                 load_real(column(c, k + 2, i)));
}
INLINE void store3(Columns c, uint k, uint i, real3 a) {
    store_real(column(c, k, i), a.x);
    store_real(column(c, k + 1, i), a.y);
    store_real(column(c, k + 2, i), a.z);
}

// Moves the first `count` words of the lanes in `bits` of the group at slot i to consecutive slots
// from j of `to`. In place it is safe for j <= i.
INLINE void move_columns(Columns from, uint i, Columns to, uint j, uint count, uint bits) {
    for (uint k = 0; k < count; k++)
        compress_real(column(to, k, j), load_real(column(from, k, i)), bits);
}

#define DECLARE_VECTOR(name) real3 name;
#define DECLARE_REAL(name) real name;
#define DECLARE_NATURAL(name) natural name;
#define LOAD_VECTOR(name)                                                                          \
    value.name = load3(from, k, i);                                                                \
    k += 3;
#define LOAD_REAL(name) value.name = load_real(column(from, k++, i));
#define LOAD_NATURAL(name) value.name = load_natural(column(from, k++, i));
#define STORE_VECTOR(name)                                                                         \
    store3(to, k, i, value.name);                                                                  \
    k += 3;
#define STORE_REAL(name) store_real(column(to, k++, i), value.name);
#define STORE_NATURAL(name) store_natural(column(to, k++, i), value.name);

// The struct of a list's words.
#define COLUMNS_TYPE(Type, LIST)                                                                   \
    typedef struct {                                                                               \
        LIST(DECLARE_VECTOR, DECLARE_REAL, DECLARE_NATURAL)                                        \
    } Type

#define CHOOSE_WORD(name) value.name = choose(m, a.name, b.name);

// choose(m, a, b) of such structs.
#define COLUMNS_CHOICE(Type, LIST)                                                                 \
    OVERLOAD Type choose(mask m, Type a, Type b) {                                                 \
        Type value;                                                                                \
        LIST(CHOOSE_WORD, CHOOSE_WORD, CHOOSE_WORD)                                                \
        return value;                                                                              \
    }

// load_NAME and store_NAME: a group's values of a type that has at least the list's words.
#define COLUMNS_ACCESS(Type, name, LIST)                                                           \
    INLINE Type load_##name(Columns from, uint i) {                                                \
        Type value;                                                                                \
        uint k = 0;                                                                                \
        LIST(LOAD_VECTOR, LOAD_REAL, LOAD_NATURAL)                                                 \
        return value;                                                                              \
    }                                                                                              \
    INLINE void store_##name(Columns to, uint i, Type value) {                                     \
        uint k = 0;                                                                                \
        LIST(STORE_VECTOR, STORE_REAL, STORE_NATURAL)                                              \
    }

#endif
