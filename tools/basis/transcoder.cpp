// The one function that Onde takes from Basis Universal's transcoder (Apache-2.0), as a library that
// is opened at run time: src/image/basis.cpp.
#include <basisu_transcoder.h>

#include <climits>
#include <cstddef>
#include <mutex>

/// The largest level of a KTX2 file of that size as RGBA; 1 for success, else 0.
extern "C" __attribute__((visibility("default"))) int
onde_basis_transcode(const void* file, size_t size, unsigned width, unsigned height,
                     unsigned char* rgba) {
    static std::once_flag once;
    std::call_once(once, basist::basisu_transcoder_init);
    basist::ktx2_transcoder transcoder;
    basist::ktx2_image_level_info level;
    if (size > UINT_MAX || !transcoder.init(file, unsigned(size))) return 0;
    if (transcoder.get_width() != width || transcoder.get_height() != height) return 0;
    if (!transcoder.start_transcoding() || !transcoder.get_image_level_info(level, 0, 0, 0))
        return 0;
    if (level.m_orig_width != width || level.m_orig_height != height) return 0;
    return transcoder.transcode_image_level(0, 0, 0, rgba, width * height,
                                            basist::transcoder_texture_format::cTFRGBA32);
}
