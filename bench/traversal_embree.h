// Embree as a contender: each way of asking it, on all hardware threads.
#pragma once

#include "embree_scene.h"
#include "traversal_rays.h"

#include <span>

namespace onde::bench {

/// How many rays a call of Embree takes: rtcIntersect1, 8 and 16, and rtcIntersect1M with 64; for
/// any hit rtcOccluded.
enum class EmbreeCall { single, packet8, packet16, stream64 };

struct EmbreeMode {
    EmbreeCall call = EmbreeCall::single;
    RTCIntersectContextFlags flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT; ///< not for single rays

    std::string name() const; ///< as "embree packet8 coherent"
};

inline constexpr EmbreeMode EMBREE_SINGLE{};

/// Every mode that this build of Embree supports, single rays first. (Where it has no AVX-512, it
/// cuts packets of 16 in two.)
std::vector<EmbreeMode> embree_modes(const EmbreeScene& scene);

/// Answers the rays in their order, packets and streams being filled as they come; the rays of a
/// last packet that is not full are marked as not valid. As Embree recommends, denormal numbers
/// are flushed to zero. Misses keep t_max.
void embree_closest(const EmbreeScene& scene, EmbreeMode mode, std::span<const Ray> rays,
                    std::span<Hit> hits);
void embree_occluded(const EmbreeScene& scene, EmbreeMode mode, std::span<const Ray> rays,
                     std::span<uint32_t> blocked);

} // namespace onde::bench
