// Probes of what the painter sorts by.
#include "chapter/raster/sort_key.h"
#include "probe/probe.h"

// In: a depth. Out: its key. For width 1.
PROBE(far_to_near_key) {
    output(items, 0, far_to_near_key(input(items, 0)));
}
