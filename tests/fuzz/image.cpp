// Fuzzes the decoders of pictures, by way of textures and of environments.
#include "fuzz/fuzz.h"
#include "image/image_io.h"

namespace {

/// Anything but a picture or an InputError of one line ends the fuzzer.
template <class Read>
void read_safely(Read read) {
    try {
        read();
    } catch (const onde::InputError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr uint64_t MOST_PIXELS = uint64_t(1) << 20; // more only takes longer
    read_safely([&] { onde::decode_texels({data, size}, "image", MOST_PIXELS); });
    const auto file = onde::fuzz::write("image", onde::fuzz::text(data, size));
    read_safely([&] { onde::read_image(file, MOST_PIXELS); });
    read_safely([&] { onde::read_image_metadata(file); });
    return 0;
}
