// The shapes of parallelism that the builder uses, each with its serial twin.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <cstddef>

namespace onde::accel {

/// Calls body(i) for every i < count.
template <class Body>
void for_each_index(size_t count, bool parallel, const Body& body) {
    constexpr size_t GRAIN = 4096;
    if (!parallel || count <= GRAIN) {
        for (size_t i = 0; i < count; ++i) body(i);
        return;
    }
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, GRAIN), [&](const auto& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) body(i);
    });
}

/// Calls body(i) for the few children of a node, each as a task of its own when `parallel`.
template <class Body>
void for_each_child(size_t count, bool parallel, const Body& body) {
    if (parallel)
        tbb::parallel_for(size_t(0), count, body);
    else
        for (size_t i = 0; i < count; ++i) body(i);
}

/// Folds [0, count) into `value` by body(value, begin, end), in parts that are joined by merge().
/// Both must be exact in any order (minima, maxima, counts), or results would depend on threads.
template <class Value, class Body>
void fold_ranges(Value& value, size_t count, bool parallel, const Body& body) {
    constexpr size_t GRAIN = 16384;
    if (!parallel || count <= 2 * GRAIN) return body(value, size_t(0), count);
    const Value neutral = value;
    value.merge(tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, count, GRAIN), neutral,
        [&](const auto& range, Value part) {
            body(part, range.begin(), range.end());
            return part;
        },
        [](Value a, const Value& b) {
            a.merge(b);
            return a;
        }));
}

/// Runs both, side by side when `parallel`.
template <class First, class Second>
void run_both(bool parallel, const First& first, const Second& second) {
    if (parallel) {
        tbb::parallel_invoke(first, second);
    } else {
        first();
        second();
    }
}

} // namespace onde::accel
