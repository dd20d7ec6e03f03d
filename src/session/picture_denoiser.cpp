#include "session/picture_denoiser.h"

#include "core/error.h"
#include "core/memory.h"
#include "denoise/find_oidn.h"
#include "render/film.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>

namespace onde {
namespace {

using Either = std::variant<OpenImageDenoise, DeviceDenoiser>;

constexpr uint64_t MOST_BYTES = uint64_t(3) << 30;

/// What guides a denoiser, in the order of NoisyPicture.
constexpr const char* GUIDES[] = {"variance", "denoise-albedo", "denoise-normal", "depth"};

/// The library that is named, by option or environment, else the one that is installed.
std::optional<std::filesystem::path> library_of(const std::filesystem::path& named) {
    if (!named.empty()) return named_oidn(named, "--denoiser-library");
    if (const char* place = std::getenv(OIDN_VARIABLE); place && *place)
        return named_oidn(place, OIDN_VARIABLE);
    return installed_oidn();
}

std::optional<OpenImageDenoise> open_library(const DenoiserOptions& options,
                                             const std::function<void(std::string)>& note) {
    const bool must_be = options.denoiser == Denoiser::open_image;
    try {
        if (const auto library = library_of(options.oidn)) return OpenImageDenoise(*library);
    } catch (const InputError& error) {
        if (must_be || !options.oidn.empty()) throw;
        note(fmt::format("{}; the picture is denoised by our own denoiser", error.what()));
    }
    if (must_be)
        throw InputError(
            "--denoise oidn: no Open Image Denoise is found; install Python's package "
            "pyoidn, name the library with --denoiser-library, or take --denoise onde");
    return std::nullopt;
}

Either choose(gpu::Programs& programs, const DenoiserOptions& options, uint32_t picture_width,
              const std::function<void(std::string)>& note) {
    if (options.denoiser != Denoiser::own)
        if (auto library = open_library(options, note)) return *std::move(library);
    return DeviceDenoiser(programs, denoiser_cut(programs.device().facts(), picture_width));
}

/// The parts are the light of groups.
NoisyPicture noisy_picture(const Film& film) {
    std::vector<FilmChannel> channels{RADIANCE};
    for (const char* name : GUIDES) channels.push_back(*find_channel(name));
    for (uint32_t i = 0; i < film.planes().groups; i++)
        channels.push_back(group_channel("group", i));
    std::vector<Image> all = film.develop(channels);
    const auto parts = all.begin() + std::ssize(GUIDES) + 1;
    return {
        std::move(all[0]), std::move(all[1]),
        std::move(all[2]), std::move(all[3]),
        std::move(all[4]), {std::make_move_iterator(parts), std::make_move_iterator(all.end())}};
}

} // namespace

uint32_t denoiser_aovs() {
    uint32_t bits = 0;
    for (const char* name : GUIDES) bits |= 1u << find_channel(name)->sums;
    return bits;
}

void check_denoisable(IntegratorKind integrator) {
    if (integrator != IntegratorKind::path)
        throw InputError("--denoise needs albedo and normals, which --integrator {} does not find; "
                         "take --integrator path, or --denoise off",
                         word_of(integrator));
}

std::string found_denoiser() {
    try {
        if (const auto library = library_of({}))
            return fmt::format("{}, {}", OpenImageDenoise(*library).name(), library->string());
        return "our own, as no Open Image Denoise is found (Python's package pyoidn has it)";
    } catch (const InputError& error) {
        return fmt::format("our own, as {}", error.what());
    }
}

PictureDenoiser::PictureDenoiser(gpu::Programs& programs, const DenoiserOptions& options,
                                 uint32_t picture_width,
                                 const std::function<void(std::string)>& note)
    : quality_(options.quality), denoiser_(choose(programs, options, picture_width, note)) {}

std::string PictureDenoiser::name() const {
    const auto* library = std::get_if<OpenImageDenoise>(&denoiser_);
    return library ? library->name() : "Onde";
}

DenoisedPicture PictureDenoiser::denoise(const Film& film) {
    const NoisyPicture noisy = noisy_picture(film);
    if (const auto* library = std::get_if<OpenImageDenoise>(&denoiser_))
        return library->denoise(noisy, quality_ == DenoiseQuality::high,
                                std::min(available_memory() / 4, MOST_BYTES));
    return std::get<DeviceDenoiser>(denoiser_).denoise(noisy);
}

} // namespace onde
