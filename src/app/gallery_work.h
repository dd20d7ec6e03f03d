// An entry of the gallery: what is loaded, rendered and measured of it.
#pragma once

#include "app/gallery_page.h"
#include "render/integrator.h"
#include "scene/load_options.h"

#include <atomic>
#include <filesystem>
#include <optional>
#include <vector>

namespace onde::app {

struct GalleryWork {
    std::filesystem::path file;
    Scene scene; ///< until it is painted
    RenderOptions options;
    Image picture;      ///< linear; empty until it is painted
    GalleryEntry entry; ///< without picture facts and checks until there are some
};

/// What all works of a gallery are made with; the referenced objects outlive it.
struct GalleryStudio {
    gpu::Programs& programs;
    const std::atomic<bool>& stop; ///< true from Ctrl-C on
};

/// Loads the scene; `samples` per pixel instead of its own where given. Throws InputError or
/// DeviceError for all that can be found wrong before anything is rendered.
GalleryWork load_work(const std::filesystem::path& file, const LoadOptions& load,
                      std::optional<uint32_t> samples, const gpu::DeviceFacts& facts);

/// Renders the work's picture into the folder, and replays the pixel that its lesson names. Returns
/// false, with nothing written, when Ctrl-C came first.
bool paint(GalleryWork& work, const GalleryStudio& studio, const std::filesystem::path& folder);

/// Measures what the lessons state in the painted works' pictures, and warns of each number that is
/// not found; returns how many.
size_t measure(std::vector<GalleryWork>& works);

} // namespace onde::app
