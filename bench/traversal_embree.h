// Embree as a contender: one ray per call, all hardware threads.
#pragma once

#include "traversal_rays.h"

#include <embree3/rtcore.h>

#include <memory>

namespace onde::bench {

class EmbreeTracer {
  public:
    EmbreeTracer(const Model& model, RTCBuildQuality quality);

    double build_seconds() const { return build_seconds_; }
    uint64_t bytes() const { return *bytes_; } ///< of the tree, as Embree's memory monitor says

    /// By rtcIntersect1 and rtcOccluded1, with Embree's default (not robust) arithmetic.
    void closest(std::span<const Ray> rays, std::span<Hit> hits) const;
    void occluded(std::span<const Ray> rays, std::span<uint32_t> blocked) const;

  private:
    template <class Object, void (*RELEASE)(Object)>
    struct Release {
        using pointer = Object;
        void operator()(Object object) const { RELEASE(object); }
    };
    std::unique_ptr<int64_t> bytes_ = std::make_unique<int64_t>(0);
    std::unique_ptr<RTCDevice, Release<RTCDevice, rtcReleaseDevice>> device_;
    std::unique_ptr<RTCScene, Release<RTCScene, rtcReleaseScene>> scene_;
    double build_seconds_ = 0;
};

} // namespace onde::bench
