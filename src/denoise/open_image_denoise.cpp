#include "denoise/open_image_denoise.h"

#include "core/error.h"

#include <sched.h>

#include <algorithm>
#include <thread>

namespace onde {
namespace {

int usable_processors() {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(CPU_COUNT(&set), 1);
    return int(std::max(std::thread::hardware_concurrency(), 1u));
}

/// One filter of the library, made for one size and run once. Its pictures have three channels.
class Filter {
  public:
    Filter(const OidnFunctions& oidn, OidnDevice device, uint64_t most_bytes)
        : oidn_(oidn), filter_(oidn.oidnNewFilter(device, "RT")) {
        const uint64_t mebibytes = std::clamp<uint64_t>(most_bytes >> 20, 1, 1u << 20);
        if (filter_) oidn_.oidnSetFilterInt(filter_, "maxMemoryMB", int(mebibytes));
    }
    ~Filter() {
        if (filter_) oidn_.oidnReleaseFilter(filter_);
    }
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    void set(const char* name, bool value) {
        if (filter_) oidn_.oidnSetFilterBool(filter_, name, value);
    }
    /// The library writes to the output alone.
    void set(const char* name, const Image& image) {
        if (filter_)
            oidn_.oidnSetSharedFilterImage(filter_, name, const_cast<float*>(image.pixels.data()),
                                           OIDN_FLOAT3, image.width, image.height, 0, 0, 0);
    }
    /// What it made of pictures of that size.
    Image run(uint32_t width, uint32_t height) {
        Image output(width, height, 3);
        set("output", output);
        if (filter_) oidn_.oidnCommitFilter(filter_);
        if (filter_) oidn_.oidnExecuteFilter(filter_);
        return output;
    }

  private:
    const OidnFunctions& oidn_;
    OidnFilter filter_;
};

/// Albedo as the library wants it.
Image clamped(Image albedo) {
    for (float& value : albedo.pixels) value = std::clamp(value, 0.0f, 1.0f);
    return albedo;
}

/// Scales the parts of each number so that they add up to the whole; where they are all 0, the
/// first has all of it.
void fit_parts(DenoisedPicture& picture) {
    for (size_t i = 0; i < picture.radiance.pixels.size() && !picture.parts.empty(); ++i) {
        float sum = 0;
        for (const Image& part : picture.parts) sum += part.pixels[i];
        const float whole = picture.radiance.pixels[i];
        if (sum > 0)
            for (Image& part : picture.parts) part.pixels[i] *= whole / sum;
        else
            picture.parts.front().pixels[i] = whole;
    }
}

} // namespace

OpenImageDenoise::OpenImageDenoise(const std::filesystem::path& library)
    : library_(library), oidn_(open_oidn(library)),
      device_(oidn_.oidnNewDevice(OIDN_CPU),
              [release = oidn_.oidnReleaseDevice](OidnDevice device) {
                  if (device) release(device);
              }) {
    if (device_) {
        oidn_.oidnSetDeviceInt(device_.get(), "numThreads", usable_processors());
        oidn_.oidnSetDeviceBool(device_.get(), "setAffinity", false); // others work here too
        oidn_.oidnCommitDevice(device_.get());
    }
    check();
    const int version = oidn_.oidnGetDeviceInt(device_.get(), "version");
    name_ = fmt::format("Open Image Denoise {}.{}.{}", version / 10000, version / 100 % 100,
                        version % 100);
}

void OpenImageDenoise::check() const {
    const char* message = nullptr; // a device that could not be made has errors too
    if (oidn_.oidnGetDeviceError(device_.get(), &message) != 0 || !device_)
        throw InputError("{}: Open Image Denoise fails here ({}); take --denoise onde",
                         library_.string(), message ? message : "it gives no reason");
}

DenoisedPicture OpenImageDenoise::denoise(const NoisyPicture& noisy, bool prefiltered,
                                          uint64_t most_bytes) const {
    const uint32_t width = noisy.radiance.width, height = noisy.radiance.height;
    const auto prefilter = [&](const char* name, Image image) {
        if (!prefiltered) return image;
        Filter filter(oidn_, device_.get(), most_bytes);
        filter.set(name, image);
        return filter.run(width, height);
    };
    const Image albedo = prefilter("albedo", clamped(noisy.albedo));
    const Image normal = prefilter("normal", noisy.normal);
    const auto denoised = [&](const Image& radiance) {
        Filter filter(oidn_, device_.get(), most_bytes);
        filter.set("color", radiance);
        filter.set("albedo", albedo);
        filter.set("normal", normal);
        filter.set("hdr", true);
        filter.set("cleanAux", prefiltered);
        return filter.run(width, height);
    };
    DenoisedPicture picture{denoised(noisy.radiance)};
    for (const Image& part : noisy.parts) picture.parts.push_back(denoised(part));
    check();
    fit_parts(picture);
    return picture;
}

} // namespace onde
