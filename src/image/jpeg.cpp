// JPEG by libjpeg-turbo. Its errors jump: what they jump over owns nothing.
#include "image/stored_image.h"

#include <csetjmp>
#include <cstdio>

#include <jerror.h>
#include <jpeglib.h>

namespace onde {
namespace {

/// What libjpeg's callbacks share with the code that calls it; libjpeg sees the first member.
struct Errors {
    jpeg_error_mgr manager;
    jmp_buf end;
    char message[JMSG_LENGTH_MAX];
};

Errors& errors_of(j_common_ptr jpeg) {
    return *reinterpret_cast<Errors*>(jpeg->err);
}

[[noreturn]] void fail(j_common_ptr jpeg) {
    Errors& errors = errors_of(jpeg);
    errors.manager.format_message(jpeg, errors.message);
    std::longjmp(errors.end, 1);
}

/// Level -1 is a warning. A file that ends early is damaged; of others the picture shows.
void warn(j_common_ptr jpeg, int level) {
    if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) fail(jpeg);
}

/// Each scan of a progressive file costs a pass over the whole picture.
void count_scans(j_common_ptr jpeg) {
    constexpr int MOST_SCANS = 200;
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > MOST_SCANS) fail(jpeg);
}

void print_nothing(j_common_ptr) {}

/// A decompressor over a file in memory, whose header is read.
class Reader {
  public:
    explicit Reader(FileBytes file) {
        jpeg_.err = jpeg_std_error(&errors_.manager);
        errors_.manager.error_exit = fail;
        errors_.manager.emit_message = warn;
        errors_.manager.output_message = print_nothing;
        progress_.progress_monitor = count_scans;
        if (setjmp(errors_.end)) throw_problem();
        jpeg_create_decompress(&jpeg_);
        jpeg_.progress = &progress_;
        jpeg_mem_src(&jpeg_, file.data(), file.size());
        jpeg_read_header(&jpeg_, TRUE);
        if (jpeg_.out_color_space == JCS_YCCK) jpeg_.out_color_space = JCS_CMYK;
        jpeg_calc_output_dimensions(&jpeg_);
    }
    ~Reader() { jpeg_destroy_decompress(&jpeg_); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// `out` has room for the whole picture.
    void read_rows(uint8_t* out) {
        if (setjmp(errors_.end)) throw ImageProblem(errors_.message);
        jpeg_start_decompress(&jpeg_);
        const size_t row = size_t(jpeg_.output_width) * size_t(jpeg_.output_components);
        while (jpeg_.output_scanline < jpeg_.output_height) {
            JSAMPROW to = out + row * jpeg_.output_scanline;
            jpeg_read_scanlines(&jpeg_, &to, 1);
        }
    }

    const jpeg_decompress_struct& jpeg() const { return jpeg_; }

  private:
    [[noreturn]] void throw_problem() {
        jpeg_destroy_decompress(&jpeg_);
        throw ImageProblem(errors_.message);
    }

    jpeg_decompress_struct jpeg_{};
    jpeg_progress_mgr progress_{};
    Errors errors_{};
};

uint32_t picture_channels(const jpeg_decompress_struct& jpeg) {
    return jpeg.output_components == 1 ? 1 : 3;
}

ImageHeader header(FileBytes file) {
    const Reader reader(file);
    const jpeg_decompress_struct& jpeg = reader.jpeg();
    ImageHeader size{jpeg.output_width, jpeg.output_height, picture_channels(jpeg)};
    constexpr uint64_t MOST_PER_BYTE =
        1 << 11; // a block of 64 takes a bit or more, a run of them less
    size.least_bytes = size.samples() / MOST_PER_BYTE;
    return size;
}

/// Four inks become three lights, where they stand. Programs of Adobe store inks inverted, and the
/// others do not.
void light_of_inks(std::vector<uint8_t>& samples, bool inverted) {
    const auto light = [&](uint8_t ink) { return unsigned(inverted ? ink : 255 - ink); };
    size_t at = 0;
    for (size_t i = 0; i + 3 < samples.size(); i += 4) {
        const unsigned black = light(samples[i + 3]);
        for (size_t c = 0; c < 3; ++c)
            samples[at++] = uint8_t((light(samples[i + c]) * black + 127) / 255);
    }
    samples.resize(at);
}

StoredImage decode(FileBytes file) {
    Reader reader(file);
    const jpeg_decompress_struct& jpeg = reader.jpeg();
    const uint32_t width = jpeg.output_width, height = jpeg.output_height;
    auto samples = samples_of<uint8_t>(uint64_t(width) * height, uint32_t(jpeg.output_components));
    reader.read_rows(samples.data());
    if (jpeg.output_components == 4) light_of_inks(samples, jpeg.saw_Adobe_marker != FALSE);
    return {width, height, picture_channels(jpeg), std::move(samples)};
}

bool recognise(FileBytes file) {
    return as_text(file).starts_with("\xff\xd8\xff");
}

} // namespace

const ImageFormat JPEG_FORMAT{"JPEG", recognise, header, decode, nullptr};

} // namespace onde
