#include "scene/gltf/meshopt.h"

#include "core/error.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace onde::gltf {

namespace {

/// Whether the library's functions, which only assert, may be called.
bool is_sound(const Meshopt& source) {
    const bool is_index = source.stride == 2 || source.stride == 4;
    switch (source.mode) {
    case MeshoptMode::attributes:
        if (source.stride == 0 || source.stride % 4 != 0 || source.stride > 256) return false;
        break;
    case MeshoptMode::triangles:
        if (!is_index || source.count % 3 != 0) return false;
        break;
    case MeshoptMode::indices:
        if (!is_index) return false;
        break;
    }
    switch (source.filter) {
    case MeshoptFilter::none:
    case MeshoptFilter::exponential:
        return source.filter == MeshoptFilter::none || source.stride % 4 == 0;
    case MeshoptFilter::octahedral:
    case MeshoptFilter::color:
        return source.stride == 4 || source.stride == 8;
    case MeshoptFilter::quaternion:
        return source.stride == 8;
    }
    return false;
}

bool decode_elements(const Meshopt& source, std::span<const uint8_t> stream, std::string& result) {
    constexpr uint8_t ATTRIBUTES_V1 = 0xa1;
    const size_t count = size_t(source.count), stride = source.stride;
    if (source.mode == MeshoptMode::triangles)
        return meshopt_decodeIndexBuffer(result.data(), count, stride, stream.data(),
                                         stream.size()) == 0;
    if (source.mode == MeshoptMode::indices)
        return meshopt_decodeIndexSequence(result.data(), count, stride, stream.data(),
                                           stream.size()) == 0;
    if (!stream.empty() && stream[0] == ATTRIBUTES_V1)
        return decode_meshopt_attributes(stream, count, stride,
                                         reinterpret_cast<uint8_t*>(result.data()));
    return meshopt_decodeVertexBuffer(result.data(), count, stride, stream.data(), stream.size()) ==
           0;
}

/// YCoCg colours with alpha to RGBA (KHR_meshopt_compression, appendix B, filter 4). The highest
/// bit that alpha sets is the scale of all four.
template <class Unsigned, class Signed>
void decode_colors(std::string& bytes) {
    constexpr float MAX = float(std::numeric_limits<Unsigned>::max());
    for (size_t at = 0; at + 4 * sizeof(Unsigned) <= bytes.size(); at += 4 * sizeof(Unsigned)) {
        Unsigned value[4];
        std::memcpy(value, bytes.data() + at, sizeof(value));
        int scale = value[3]; // becomes all ones up to its highest bit
        for (int shift = 1; shift < 16; shift *= 2) scale |= scale >> shift;
        const int y = value[0], co = Signed(value[1]), cg = Signed(value[2]);
        const int alpha = ((value[3] << 1) & scale) | (value[3] & 1);
        const int rgba[4] = {y + co - cg, y + cg, y - co - cg, alpha};
        for (size_t c = 0; c < 4; ++c) {
            const float scaled = float(rgba[c]) / float(std::max(scale, 1)) * MAX;
            value[c] = Unsigned(std::lround(std::clamp(scaled, 0.0f, MAX)));
        }
        std::memcpy(bytes.data() + at, value, sizeof(value));
    }
}

void apply_filter(const Meshopt& source, std::string& bytes) {
    switch (source.filter) {
    case MeshoptFilter::none:
        return;
    case MeshoptFilter::octahedral:
        return meshopt_decodeFilterOct(bytes.data(), size_t(source.count), source.stride);
    case MeshoptFilter::quaternion:
        return meshopt_decodeFilterQuat(bytes.data(), size_t(source.count), source.stride);
    case MeshoptFilter::exponential:
        return meshopt_decodeFilterExp(bytes.data(), size_t(source.count), source.stride);
    case MeshoptFilter::color:
        return source.stride == 4 ? decode_colors<uint8_t, int8_t>(bytes)
                                  : decode_colors<uint16_t, int16_t>(bytes);
    }
}

} // namespace

std::string decode_meshopt(const Meshopt& source, std::span<const uint8_t> stream,
                           const std::string& where) {
    std::string result;
    if (is_sound(source)) {
        result.resize(size_t(source.count) * source.stride);
        if (source.count == 0 || decode_elements(source, stream, result)) {
            apply_filter(source, result);
            return result;
        }
    }
    throw InputError("{}: its meshopt compression is damaged; export it again", where);
}

} // namespace onde::gltf
