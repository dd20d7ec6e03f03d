// Bounding volumes of one object, and the device's ray tests of them (C12).
#pragma once

#include "accel/volumes.h"
#include "gpu/program.h"

#include <array>
#include <span>
#include <vector>

namespace onde {

enum class VolumeKind { box, oriented_box, few_slabs, many_slabs, sphere };

inline constexpr std::array VOLUME_KINDS{VolumeKind::box, VolumeKind::oriented_box,
                                         VolumeKind::few_slabs, VolumeKind::many_slabs,
                                         VolumeKind::sphere};

/// For people.
const char* volume_name(VolumeKind kind);

/// One of each kind around the same points.
struct FittedVolumes {
    BoxVolume box{};
    OrientedBoxVolume oriented_box{};
    SlabsVolume slabs{};
    SphereVolume sphere{};
};

/// At least one point, all finite.
FittedVolumes fit_volumes(std::span<const glm::vec3> points);
VolumeMeasure measure_volume(const FittedVolumes& volumes, VolumeKind kind);

/// A ray without an end. Directions need not be of unit length.
struct VolumeRay {
    glm::vec3 origin{0.0f}, direction{0.0f};
};

/// Rays on the device, as columns.
class VolumeRays {
  public:
    VolumeRays(const gpu::Device& device, std::span<const VolumeRay> rays);

    size_t size() const { return count_; }
    size_t padded() const { return columns_.size() / 6; }
    const gpu::Buffer<float>& columns() const { return columns_; }

  private:
    size_t count_;
    gpu::Buffer<float> columns_;
};

class VolumeTester {
  public:
    /// `width` lanes: 1, 8 or 16. The programs outlive it.
    VolumeTester(gpu::Programs& programs, const FittedVolumes& volumes, uint32_t width);

    /// For each ray whether it meets the volume: 1 or 0.
    std::vector<uint32_t> met(VolumeKind kind, const VolumeRays& rays);

    /// Seconds of testing each ray against `copies` volumes of a kind, at most MOST_COPIES.
    double seconds(VolumeKind kind, const VolumeRays& rays, uint32_t copies);
    static constexpr uint32_t MOST_COPIES = 64;

  private:
    void launch(VolumeKind kind, const VolumeRays& rays, uint32_t copies,
                const gpu::Buffer<uint32_t>& met);

    const gpu::Device& device_;
    gpu::Buffer<BoxVolume> boxes_;
    gpu::Buffer<OrientedBoxVolume> oriented_boxes_;
    gpu::Buffer<SlabsVolume> slabs_;
    gpu::Buffer<SphereVolume> spheres_;
    gpu::Program program_;
};

} // namespace onde
