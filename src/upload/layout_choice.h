// Which layout of the tree suits a device: measured once, and remembered.
#pragma once

#include "upload/ray_query.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace onde {

/// How many rays a device traces per second in trees of a layout.
struct LayoutRate {
    BvhLayout layout = BvhLayout::wide;
    double mrays = 0; ///< million rays a second: closest and any hits of camera and diffuse rays
};

/// The layouts that may suit a device: the wide one, which is written in vectors of 16, only where
/// they stay vectors.
std::vector<BvhLayout> layouts_for(const gpu::DeviceFacts& facts);

/// Traces half a million rays through a hilly field of 131,072 triangles in each layout for the
/// device, one ray per work item: the median of three runs. Compiles a small program for each.
std::vector<LayoutRate> measure_layouts(gpu::Programs& programs);

/// The fastest layout; `rates` is not empty.
BvhLayout fastest_layout(std::span<const LayoutRate> rates);

/// What was measured on which device, one small file each beside the compiled kernels. A damaged
/// file counts as none, and failures to write are silent.
class LayoutMemory {
  public:
    explicit LayoutMemory(std::filesystem::path folder = gpu::ProgramCache::default_folder());

    std::optional<BvhLayout> recall(const gpu::DeviceFacts& facts) const;
    void remember(const gpu::DeviceFacts& facts, BvhLayout layout) const;

  private:
    std::filesystem::path path(const gpu::DeviceFacts& facts) const;

    std::filesystem::path folder_;
};

/// What is remembered of the device; else the layout for its kind: the wide one where it may be
/// used, as it is the fastest there by far, the compressed one elsewhere.
BvhLayout known_layout(const gpu::DeviceFacts& facts, const LayoutMemory& memory = LayoutMemory());

/// The same, but a device for which the wide one is not and that is not known yet is measured,
/// which takes seconds; `announce` is told so before.
BvhLayout suitable_layout(gpu::Programs& programs,
                          const std::function<void(const std::string&)>& announce = {},
                          const LayoutMemory& memory = LayoutMemory());

} // namespace onde
