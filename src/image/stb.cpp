// BMP and TGA by stb_image. It takes what is beyond the end of a file for zeros and says nothing,
// so it reads through a source that notices.
#include "image/stored_image.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_MALLOC(bytes) std::calloc(1, bytes) // what it does not fill is black
#define STBI_REALLOC(memory, bytes) std::realloc(memory, bytes)
#define STBI_FREE(memory) std::free(memory)
#include <stb/stb_image.h>

namespace onde {
namespace {

/// A file in memory that notices when more is wanted than it has.
struct Source {
    FileBytes rest;
    bool ended_early = false;
};

int read(void* user, char* to, int count) {
    Source& source = *static_cast<Source*>(user);
    const size_t taken = std::min(size_t(count), source.rest.size());
    source.ended_early |= taken == 0;
    if (taken > 0) std::memcpy(to, source.rest.data(), taken);
    source.rest = source.rest.subspan(taken);
    return int(taken);
}

void skip(void* user, int count) {
    Source& source = *static_cast<Source*>(user);
    const size_t left = source.rest.size();
    source.rest = source.rest.subspan(std::min(size_t(std::max(count, 0)), left));
}

int at_end(void* user) {
    return static_cast<const Source*>(user)->rest.empty();
}

constexpr stbi_io_callbacks CALLBACKS{read, skip, at_end};

std::string reason() {
    const char* text = stbi_failure_reason();
    return text ? text : "it is damaged";
}

ImageHeader header(FileBytes file) {
    Source source{file};
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_callbacks(&CALLBACKS, &source, &width, &height, &channels))
        throw ImageProblem(reason());
    ImageHeader size{uint32_t(width), uint32_t(height), uint32_t(channels)};
    constexpr uint64_t MOST_PER_BYTE = 64; // two bytes say "128 times this"
    size.least_bytes = size.pixels() / MOST_PER_BYTE;
    return size;
}

StoredImage decode(FileBytes file) {
    struct Free {
        void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
    };
    Source source{file};
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, Free> pixels(
        stbi_load_from_callbacks(&CALLBACKS, &source, &width, &height, &channels, 0));
    if (!pixels) throw ImageProblem(reason());
    if (source.ended_early) throw ImageProblem("the file ends early");
    const size_t count = size_t(width) * size_t(height) * size_t(channels);
    return {uint32_t(width), uint32_t(height), uint32_t(channels),
            std::vector<uint8_t>(pixels.get(), pixels.get() + count)};
}

bool is_bmp(FileBytes file) {
    return as_text(file).starts_with("BM");
}

/// Targa has no signature: what its header can't be is not Targa.
bool is_tga(FileBytes file) {
    constexpr size_t HEADER = 18;
    if (file.size() < HEADER) return false;
    const uint8_t colour_map = file[1], type = file[2] & 0xf7, bits = file[16];
    const bool known = type >= 1 && type <= 3 && file[2] < 12;
    return known && colour_map <= 1 && (colour_map == 1) == (type == 1) &&
           (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32);
}

} // namespace

const ImageFormat BMP_FORMAT{"BMP", is_bmp, header, decode, nullptr};
const ImageFormat TGA_FORMAT{"TGA", is_tga, header, decode, nullptr};

} // namespace onde
