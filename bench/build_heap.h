// Counts what the program takes from the heap, by standing before glibc's malloc.
#pragma once

#include <cstdint>

namespace onde::bench {

/// While one lives, the bytes of every block taken and given back are counted, in all threads. At
/// most one at a time. Costs time: measure speed without.
class HeapMeter {
  public:
    HeapMeter();
    ~HeapMeter();
    HeapMeter(const HeapMeter&) = delete;
    HeapMeter& operator=(const HeapMeter&) = delete;

    uint64_t peak_bytes() const; ///< the most at a time, on top of what there was at first
};

} // namespace onde::bench
