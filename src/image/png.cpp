// PNG by libpng. Its errors jump: what they jump over owns nothing.
#include "image/stored_image.h"

#include <png.h>

#include <csetjmp>
#include <cstring>

namespace onde {
namespace {

/// What libpng's callbacks share with the code that calls it.
struct State {
    FileBytes rest;      ///< what is not yet read
    std::string written; ///< or what is written so far
    char message[200] = "";
};

State& state_of(png_const_structp png) {
    return *static_cast<State*>(png_get_error_ptr(png));
}

[[noreturn]] void fail(png_structp png, png_const_charp message) {
    std::strncpy(state_of(png).message, message, sizeof(State::message) - 1);
    std::longjmp(png_jmpbuf(png), 1);
}

void ignore(png_structp, png_const_charp) {}

void read(png_structp png, png_bytep to, size_t count) {
    FileBytes& rest = static_cast<State*>(png_get_io_ptr(png))->rest;
    if (count > rest.size()) png_error(png, "the file ends early");
    std::memcpy(to, rest.data(), count);
    rest = rest.subspan(count);
}

void write(png_structp png, png_bytep from, size_t count) {
    static_cast<State*>(png_get_io_ptr(png))
        ->written.append(reinterpret_cast<const char*>(from), count);
}

void flush(png_structp) {}

/// A libpng reader over a file in memory.
class Reader {
  public:
    explicit Reader(FileBytes file) : state_{file, {}, {}} {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state_, fail, ignore);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) {
            png_destroy_read_struct(&png_, nullptr, nullptr);
            throw std::bad_alloc();
        }
        constexpr png_alloc_size_t LARGEST_CHUNK = 4 << 20;
        constexpr png_uint_32 MOST_CHUNKS = 256;
        png_set_chunk_malloc_max(png_, LARGEST_CHUNK);
        png_set_chunk_cache_max(png_, MOST_CHUNKS);
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // ours come later
        png_set_read_fn(png_, &state_, read);
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// Calls `work`, over which libpng's errors jump. Throws ImageProblem for them.
    template <class Work>
    void run(Work work) {
        if (setjmp(png_jmpbuf(png_))) throw ImageProblem(state_.message);
        work(png_, info_);
    }

    png_structp png() const { return png_; }
    png_infop info() const { return info_; }

  private:
    State state_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

/// Palettes become RGB, transparent colours alpha, and fewer than 8 bits 8. Allocates two rows.
void expand(png_structp png, png_infop info) {
    png_set_expand(png);
    png_set_swap(png); // 16-bit samples are stored with their high byte first
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

void read_info(png_structp png, png_infop info) {
    png_read_info(png, info);
}

/// As many as there are once it is expanded.
uint32_t expanded_channels(png_structp png, png_infop info) {
    const int colours = png_get_color_type(png, info);
    const bool alpha = (colours & PNG_COLOR_MASK_ALPHA) || png_get_valid(png, info, PNG_INFO_tRNS);
    return (colours & PNG_COLOR_MASK_COLOR ? 3 : 1) + (alpha ? 1 : 0);
}

ImageHeader header_of(const Reader& reader) {
    ImageHeader header{png_get_image_width(reader.png(), reader.info()),
                       png_get_image_height(reader.png(), reader.info()),
                       expanded_channels(reader.png(), reader.info())};
    if (png_get_bit_depth(reader.png(), reader.info()) == 16) header.sample_bytes = 2;
    constexpr uint64_t MOST_IN_A_BYTE = 8; // of one bit each, before they were expanded
    header.least_bytes = header.pixels() / (MOST_DEFLATED * MOST_IN_A_BYTE);
    return header;
}

ImageHeader header(FileBytes file) {
    Reader reader(file);
    reader.run(read_info);
    return header_of(reader);
}

template <class T>
Samples read_rows(Reader& reader, const ImageHeader& header) {
    const size_t row_samples = size_t(header.width) * header.channels;
    std::vector<T> samples = samples_of<T>(header.pixels(), header.channels);
    std::vector<png_bytep> rows(header.height);
    for (size_t y = 0; y < rows.size(); ++y)
        rows[y] = reinterpret_cast<png_bytep>(samples.data() + y * row_samples);
    reader.run([&](png_structp png, png_infop) { png_read_image(png, rows.data()); });
    return samples;
}

StoredImage decode(FileBytes file) {
    Reader reader(file);
    reader.run(read_info);
    const ImageHeader h = header_of(reader);
    reader.run(expand);
    if (png_get_channels(reader.png(), reader.info()) != h.channels)
        throw ImageProblem("its kind of colour is damaged");
    const bool wide = png_get_bit_depth(reader.png(), reader.info()) == 16;
    return {h.width, h.height, h.channels,
            wide ? read_rows<uint16_t>(reader, h) : read_rows<uint8_t>(reader, h)};
}

ImageMetadata metadata(FileBytes file) {
    Reader reader(file);
    reader.run(read_info);
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(reader.png(), reader.info(), &texts, &count);
    ImageMetadata all;
    for (int i = 0; i < count; ++i)
        if (texts[i].key && texts[i].text) all.emplace(texts[i].key, texts[i].text);
    return all;
}

bool recognise(FileBytes file) {
    using namespace std::literals;
    return as_text(file).starts_with("\x89PNG\r\n\x1a\n"sv);
}

/// A libpng writer to memory.
class Writer {
  public:
    Writer() {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state_, fail, ignore);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
        if (!info_) {
            png_destroy_write_struct(&png_, nullptr);
            throw std::bad_alloc();
        }
        png_set_write_fn(png_, &state_, write, flush);
    }
    ~Writer() { png_destroy_write_struct(&png_, &info_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    template <class Work>
    void run(Work work) {
        if (setjmp(png_jmpbuf(png_))) throw ImageProblem(state_.message);
        work(png_, info_);
    }

    std::string take() { return std::move(state_.written); }

  private:
    State state_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

int colour_type(uint32_t channels) {
    if (channels == 1) return PNG_COLOR_TYPE_GRAY;
    return channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB;
}

/// Keys of a PNG are Latin-1 of at most 79 bytes; ours are short and plain.
std::vector<png_text> text_chunks(const ImageMetadata& metadata) {
    std::vector<png_text> texts;
    for (const auto& [key, value] : metadata) {
        png_text text{};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = const_cast<png_charp>(key.c_str());
        text.text = const_cast<png_charp>(value.c_str());
        text.text_length = value.size();
        texts.push_back(text);
    }
    return texts;
}

} // namespace

const ImageFormat PNG_FORMAT{"PNG", recognise, header, decode, metadata};

std::string encode_png(std::span<const uint8_t> bytes, uint32_t width, uint32_t height,
                       uint32_t channels, const ImageMetadata& metadata) {
    const std::vector<png_text> texts = text_chunks(metadata);
    const size_t row_bytes = size_t(width) * channels;
    Writer writer;
    writer.run([&](png_structp png, png_infop info) {
        png_set_IHDR(png, info, width, height, 8, colour_type(channels), PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
        png_set_text(png, info, texts.data(), int(texts.size()));
        png_write_info(png, info);
        for (size_t y = 0; y < height; ++y) png_write_row(png, bytes.data() + y * row_bytes);
        png_write_end(png, info);
    });
    return writer.take();
}

} // namespace onde
