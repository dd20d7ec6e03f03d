// What takes the noise from a session's picture: Open Image Denoise or our own, as it is asked for
// and as the library is found.
#pragma once

#include "core/enum_words.h"
#include "denoise/device_denoiser.h"
#include "denoise/open_image_denoise.h"
#include "scene/settings.h"

#include <filesystem>
#include <functional>
#include <string>
#include <variant>

namespace onde {

class Film;

enum class DenoiseQuality {
    high, ///< what guides the denoiser is denoised first
    fast,
};

constexpr auto enum_words(DenoiseQuality) {
    return std::array{EnumWord{DenoiseQuality::high, "high"},
                      EnumWord{DenoiseQuality::fast, "fast"}};
}

struct DenoiserOptions {
    Denoiser denoiser = Denoiser::off;
    std::filesystem::path oidn{}; ///< Open Image Denoise, or a folder that has it; else it is
                                  ///< looked for
    DenoiseQuality quality = DenoiseQuality::high;
};

/// Bits of the AOVs that a film must have to be denoised.
uint32_t denoiser_aovs();

/// Throws InputError for an integrator that has no such AOVs.
void check_denoisable(IntegratorKind integrator);

/// What --denoise takes here, in one line: the library's name and place, or our own denoiser and
/// why.
std::string found_denoiser();

class PictureDenoiser {
  public:
    /// The options' denoiser is not off. Throws InputError where Open Image Denoise is asked for
    /// and can't be opened; `note` is told where automatic finds one that can't. The programs
    /// outlive it.
    PictureDenoiser(gpu::Programs& programs, const DenoiserOptions& options, uint32_t picture_width,
                    const std::function<void(std::string)>& note);

    /// For reports.
    std::string name() const;
    /// The film's mean radiance. Throws InputError or DeviceError where it fails.
    DenoisedPicture denoise(const Film& film);

  private:
    DenoiseQuality quality_;
    std::variant<OpenImageDenoise, DeviceDenoiser> denoiser_;
};

} // namespace onde
