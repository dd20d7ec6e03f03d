// What is kept of a path between two stages, as lists of columns: one word of each slot a column. A
// list is written here once; from it come the struct that kernels work with, its loads, stores and
// moves (trace/columns.h), and the host's sizes. VECTOR is three words, REAL and NATURAL one.
#ifndef ONDE_SHARED_COLUMNS_H
#define ONDE_SHARED_COLUMNS_H

// The words of a list: COLUMN_COUNT(PATH_COLUMNS).
#define ONDE_THREE_WORDS(name) +3
#define ONDE_ONE_WORD(name) +1
#define COLUMN_COUNT(LIST) (0 LIST(ONDE_THREE_WORDS, ONDE_ONE_WORD, ONDE_ONE_WORD))

// Whether a path is told of what came before, which guides and shares of light need.
#ifndef ONDE_TRAIL
    #define ONDE_TRAIL 0
#endif

// Groups of lights whose light the film has by itself: 0, or those of the scene.
#ifndef ONDE_GROUPS
    #define ONDE_GROUPS 0
#endif

// Whether light goes straight through some thin walls; and whether it does through solid glass, if
// it comes from where no other way would find it.
#ifndef ONDE_PANES
    #define ONDE_PANES 0
#endif
#ifndef ONDE_MEDIA
    #define ONDE_MEDIA 0
#endif
#ifndef ONDE_DISPERSION
    #define ONDE_DISPERSION 0
#endif
#ifndef ONDE_UNBENT
    #define ONDE_UNBENT 0
#endif
// Whether something moves while the shutter is open.
#ifndef ONDE_SHUTTER
    #define ONDE_SHUTTER 0
#endif

// A path of the path tracer. pdf: of the direction at the last vertex, 0 if light can't have been
// sampled there. (The ray comes first in every list.)
#define PATH_COLUMNS(VECTOR, REAL, NATURAL)                                                        \
    VECTOR(origin) VECTOR(direction) VECTOR(throughput) REAL(pdf)

// And of paths of either kind, where something moves: when they see it, in [0, 1) of the shutter.
// It follows the columns that all paths have.
#define TIME_COLUMNS(VECTOR, REAL, NATURAL) REAL(time)

// What it has beside that where AOVs ask what came before: shares of its light by what the first
// surface did (see film/light_shares.h), and whether it has met nothing but mirrors.
#define TRAIL_COLUMNS(VECTOR, REAL, NATURAL) VECTOR(diffuse) REAL(transmitted) NATURAL(mirrored)

// And where lights are chosen by a tree: the normal at the last vertex, as in Receiver.
#define RECEIVER_COLUMNS(VECTOR, REAL, NATURAL) VECTOR(normal)

// And where there are panes: how far it has come straight through them.
#define PANE_COLUMNS(VECTOR, REAL, NATURAL) REAL(passed)

// And where light meets media: the one that it is in, and the one around that; see shade/media.h.
#define MEDIA_COLUMNS(VECTOR, REAL, NATURAL) NATURAL(media)

// And where glass disperses light: whether it has one wavelength only.
#define WAVE_COLUMNS(VECTOR, REAL, NATURAL) NATURAL(dispersed)

// A path from a light. Its power is emitted times throughput, that of the surfaces so far.
#define LIGHT_PATH_COLUMNS(VECTOR, REAL, NATURAL)                                                  \
    VECTOR(origin) VECTOR(direction) VECTOR(emitted) VECTOR(throughput)

// The ray of a ray tree that is in flight. factor: of its colour in its parent's; product: of all
// factors down to here, largest components; passed: distance from where the ray began to its
// origin, which is clear of the surface; color: what its hit has gathered so far.
#define WHITTED_COLUMNS(VECTOR, REAL, NATURAL)                                                     \
    VECTOR(origin)                                                                                 \
    VECTOR(direction)                                                                              \
    VECTOR(factor) REAL(product) REAL(passed) NATURAL(kind) NATURAL(level) VECTOR(color)

// What a ray has met.
#define HIT_COLUMNS(VECTOR, REAL, NATURAL)                                                         \
    REAL(t) REAL(u) REAL(v) NATURAL(primitive) NATURAL(instance)

// A connection whose value is for its own path. Behind that may stand its target, a pixel or a
// group of lights, then shares of its light, then how it goes.
#define CONNECTION_COLUMNS(VECTOR, REAL, NATURAL)                                                  \
    VECTOR(origin) VECTOR(direction) REAL(distance) VECTOR(value)
#define TARGET_COLUMNS(VECTOR, REAL, NATURAL) NATURAL(target)
#define SHARE_COLUMNS(VECTOR, REAL, NATURAL) VECTOR(diffuse) REAL(transmitted)
#define WAY_COLUMNS(VECTOR, REAL, NATURAL) NATURAL(way)
#define NO_COLUMNS(VECTOR, REAL, NATURAL)
#define SPLAT_COLUMNS(VECTOR, REAL, NATURAL)                                                       \
    CONNECTION_COLUMNS(VECTOR, REAL, NATURAL) TARGET_COLUMNS(VECTOR, REAL, NATURAL)

#endif
