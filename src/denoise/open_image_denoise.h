// Denoising by Open Image Denoise, whose library is opened at run time.
#pragma once

#include "denoise/oidn_functions.h"
#include "denoise/picture.h"

#include <filesystem>
#include <memory>
#include <string>

namespace onde {

class OpenImageDenoise {
  public:
    /// Opens the library and its device for CPUs, with a thread for each processor that this
    /// process may use. Throws InputError as open_oidn() does, or where the device fails.
    explicit OpenImageDenoise(const std::filesystem::path& library);

    /// With its version, for reports.
    const std::string& name() const { return name_; }

    /// From radiance, albedo and normal, which are filtered themselves first where `prefiltered`:
    /// that takes about 7 times as long, and gains most where they are noisy, by depth of field and
    /// motion. Of parts, each is denoised alone; then all of a pixel are scaled by what makes their
    /// sum the denoised radiance. Takes at most `most_bytes` beside the pictures, in tiles where
    /// it must. Throws InputError where the library fails.
    DenoisedPicture denoise(const NoisyPicture& noisy, bool prefiltered, uint64_t most_bytes) const;

  private:
    void check() const;

    std::filesystem::path library_;
    OidnFunctions oidn_;
    std::shared_ptr<OidnDeviceHandle> device_;
    std::string name_;
};

} // namespace onde
