// TIFF by libtiff: plain rows of 8-bit, 16-bit or float samples as they are; what else libtiff
// knows (palettes, tiles, inks) as 8-bit RGBA.
#include "image/stored_image.h"

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

namespace onde {
namespace {

/// A file in memory, as libtiff reads it.
struct Source {
    FileBytes file;
    toff_t at = 0;
};

tmsize_t read(thandle_t handle, void* to, tmsize_t count) {
    Source& source = *static_cast<Source*>(handle);
    const uint64_t left = source.at < source.file.size() ? source.file.size() - source.at : 0;
    const uint64_t taken = std::min(uint64_t(std::max<tmsize_t>(count, 0)), left);
    if (taken > 0) std::memcpy(to, source.file.data() + source.at, taken);
    source.at += taken;
    return tmsize_t(taken);
}

tmsize_t write(thandle_t, void*, tmsize_t) {
    return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
    Source& source = *static_cast<Source*>(handle);
    if (whence == SEEK_SET) source.at = offset;
    if (whence == SEEK_CUR) source.at += offset;
    if (whence == SEEK_END) source.at = source.file.size() + offset;
    return source.at;
}

int close(thandle_t) {
    return 0;
}

toff_t size(thandle_t handle) {
    return static_cast<Source*>(handle)->file.size();
}

/// The first picture of a file.
class Reader {
  public:
    explicit Reader(FileBytes file) : source_{file} {
        TIFFSetErrorHandler(nullptr); // else they print
        TIFFSetWarningHandler(nullptr);
        tiff_.reset(TIFFClientOpen("memory", "rm", &source_, read, write, seek, close, size,
                                   nullptr, nullptr));
        if (!tiff_) throw ImageProblem("its header is damaged");
    }

    TIFF* get() const { return tiff_.get(); }

    template <class T>
    T field(uint32_t tag) const {
        T value{};
        TIFFGetFieldDefaulted(get(), tag, &value);
        return value;
    }

  private:
    struct Close {
        void operator()(TIFF* tiff) const { TIFFClose(tiff); }
    };
    Source source_;
    std::unique_ptr<TIFF, Close> tiff_;
};

/// How the samples of a picture lie.
struct Layout {
    uint32_t width, height;
    uint16_t channels, bits, format;
    bool plain; ///< interleaved rows of numbers that are brightness
};

Layout layout_of(const Reader& tiff) {
    Layout l{
        tiff.field<uint32_t>(TIFFTAG_IMAGEWIDTH),      tiff.field<uint32_t>(TIFFTAG_IMAGELENGTH),
        tiff.field<uint16_t>(TIFFTAG_SAMPLESPERPIXEL), tiff.field<uint16_t>(TIFFTAG_BITSPERSAMPLE),
        tiff.field<uint16_t>(TIFFTAG_SAMPLEFORMAT),    false};
    const auto photometric = tiff.field<uint16_t>(TIFFTAG_PHOTOMETRIC);
    const bool number = l.format == SAMPLEFORMAT_UINT
                            ? l.bits == 8 || l.bits == 16
                            : l.format == SAMPLEFORMAT_IEEEFP && l.bits == 32;
    l.plain =
        number && !TIFFIsTiled(tiff.get()) && l.channels >= 1 && l.channels <= 4 &&
        (photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_RGB) &&
        (l.channels == 1 || tiff.field<uint16_t>(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG) &&
        tiff.field<uint16_t>(TIFFTAG_ORIENTATION) == ORIENTATION_TOPLEFT;
    return l;
}

ImageHeader header(FileBytes file) {
    const Layout l = layout_of(Reader(file));
    ImageHeader size{l.width, l.height, l.plain ? l.channels : 4u};
    if (l.plain) size.sample_bytes = l.bits / 8;
    size.least_bytes = least_bytes_of_any(size.samples());
    return size;
}

template <class T>
StoredImage read_plain(const Reader& tiff, const Layout& l) {
    const size_t row = size_t(l.width) * l.channels;
    if (size_t(TIFFScanlineSize64(tiff.get())) != row * sizeof(T))
        throw ImageProblem("the length of its rows is wrong");
    auto samples = samples_of<T>(uint64_t(l.width) * l.height, l.channels);
    for (uint32_t y = 0; y < l.height; ++y)
        if (TIFFReadScanline(tiff.get(), samples.data() + y * row, y) != 1)
            throw ImageProblem("it is damaged or ends early");
    return {l.width, l.height, l.channels, std::move(samples)};
}

StoredImage read_converted(const Reader& tiff, const Layout& l) {
    char reason[1024] = "";
    if (!TIFFRGBAImageOK(tiff.get(), reason)) throw ImageProblem(reason);
    std::vector<uint8_t> samples(size_t(l.width) * l.height * 4);
    if (!TIFFReadRGBAImageOriented(tiff.get(), l.width, l.height,
                                   reinterpret_cast<uint32_t*>(samples.data()), ORIENTATION_TOPLEFT,
                                   1))
        throw ImageProblem("it is damaged or ends early");
    for (size_t at = 0; at < samples.size(); at += 4) {
        uint32_t p;
        std::memcpy(&p, &samples[at], sizeof(p));
        const std::array rgba{TIFFGetR(p), TIFFGetG(p), TIFFGetB(p), TIFFGetA(p)};
        for (size_t c = 0; c < 4; ++c) samples[at + c] = uint8_t(rgba[c]);
    }
    return {l.width, l.height, 4, std::move(samples)};
}

StoredImage decode(FileBytes file) {
    const Reader tiff(file);
    const Layout l = layout_of(tiff);
    if (!l.plain) return read_converted(tiff, l);
    if (l.format == SAMPLEFORMAT_IEEEFP) return read_plain<float>(tiff, l);
    return l.bits == 16 ? read_plain<uint16_t>(tiff, l) : read_plain<uint8_t>(tiff, l);
}

bool recognise(FileBytes file) {
    using namespace std::literals;
    const std::string_view text = as_text(file);
    return text.starts_with("II*\0"sv) || text.starts_with("MM\0*"sv) ||
           text.starts_with("II+\0"sv) || text.starts_with("MM\0+"sv);
}

} // namespace

const ImageFormat TIFF_FORMAT{"TIFF", recognise, header, decode, nullptr};

} // namespace onde
