// Accessors: typed, strided, possibly sparse windows into a glTF file's bytes (glTF 2.0, section
// 3.6.2). Every offset is checked in 64 bits before a byte is read.
#include "core/error.h"
#include "scene/gltf/file.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace onde::gltf {

namespace {

size_t component_size(ComponentType type) {
    switch (type) {
    case ComponentType::int8:
    case ComponentType::uint8:
        return 1;
    case ComponentType::int16:
    case ComponentType::uint16:
        return 2;
    default:
        return 4;
    }
}

/// Elements without data are zeros, as sparse accessors begin; with more than these and a byte of
/// the file each, it would take far more memory than the file does.
constexpr uint64_t MAX_ZEROS = uint64_t(1) << 16;

/// Checked elements in a buffer.
struct Window {
    const uint8_t* first = nullptr;
    size_t stride = 0;
    const uint8_t* operator[](size_t i) const { return first + i * stride; }
};

Window window(const File& file, uint32_t view, uint64_t offset, uint64_t count,
              uint64_t element_size, const std::string& user) {
    const std::span<const uint8_t> bytes = view_bytes(file, view, user);
    const uint64_t given = file.document.views[view].stride;
    const uint64_t stride = given ? given : element_size;
    const bool fits =
        count == 0 || (offset <= bytes.size() && element_size <= bytes.size() - offset &&
                       count - 1 <= (bytes.size() - offset - element_size) / stride);
    if (!fits)
        throw InputError("{}: {}: its {} elements overrun buffer view {} of {} bytes; export it "
                         "again",
                         file.name, user, count, view, bytes.size());
    return {bytes.data() + offset, size_t(stride)};
}

template <class T>
T load(const uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// One component as a float; normalised as glTF 2.0, section 3.6.2.3 says.
float load_float(const uint8_t* bytes, ComponentType type, bool normalized) {
    const auto convert = [&](float value, float largest) {
        return normalized ? std::max(value / largest, -1.0f) : value;
    };
    switch (type) {
    case ComponentType::int8:
        return convert(load<int8_t>(bytes), 127.0f);
    case ComponentType::uint8:
        return convert(load<uint8_t>(bytes), 255.0f);
    case ComponentType::int16:
        return convert(load<int16_t>(bytes), 32767.0f);
    case ComponentType::uint16:
        return convert(load<uint16_t>(bytes), 65535.0f);
    case ComponentType::uint32:
        return float(load<uint32_t>(bytes));
    default:
        return load<float>(bytes);
    }
}

uint32_t load_unsigned(const uint8_t* bytes, size_t size) {
    if (size == 1) return load<uint8_t>(bytes);
    return size == 2 ? load<uint16_t>(bytes) : load<uint32_t>(bytes);
}

/// Components as floats or as unsigned integers, whatever T is.
template <class T>
struct Decode;

template <glm::length_t N>
struct Decode<glm::vec<N, float, glm::defaultp>> {
    static constexpr size_t COMPONENTS = N;
    static glm::vec<N, float, glm::defaultp> element(const uint8_t* bytes, ComponentType type,
                                                     bool normalized, size_t size) {
        glm::vec<N, float, glm::defaultp> value;
        for (size_t c = 0; c < N; ++c) value[c] = load_float(bytes + c * size, type, normalized);
        return value;
    }
};

template <>
struct Decode<glm::uvec4> {
    static constexpr size_t COMPONENTS = 4;
    static glm::uvec4 element(const uint8_t* bytes, ComponentType, bool, size_t size) {
        glm::uvec4 value;
        for (size_t c = 0; c < 4; ++c) value[c] = load_unsigned(bytes + c * size, size);
        return value;
    }
};

template <>
struct Decode<std::array<float, 16>> {
    static constexpr size_t COMPONENTS = 16;
    static std::array<float, 16> element(const uint8_t* bytes, ComponentType type, bool normalized,
                                         size_t size) {
        std::array<float, 16> value;
        for (size_t c = 0; c < 16; ++c) value[c] = load_float(bytes + c * size, type, normalized);
        return value;
    }
};

template <>
struct Decode<float> {
    static constexpr size_t COMPONENTS = 1;
    static float element(const uint8_t* bytes, ComponentType type, bool normalized, size_t) {
        return load_float(bytes, type, normalized);
    }
};

template <>
struct Decode<uint32_t> {
    static constexpr size_t COMPONENTS = 1;
    static uint32_t element(const uint8_t* bytes, ComponentType, bool, size_t size) {
        return load_unsigned(bytes, size);
    }
};

bool is_unsigned(ComponentType type) {
    return type == ComponentType::uint8 || type == ComponentType::uint16 ||
           type == ComponentType::uint32;
}

/// Replaces the elements that the accessor's sparse part names.
template <class T>
void apply_sparse(const File& file, const Accessor& accessor, const std::string& user,
                  std::vector<T>& values) {
    const Sparse& sparse = *accessor.sparse;
    const size_t index_size = component_size(sparse.indices_type);
    const size_t size = component_size(accessor.type);
    if (!is_unsigned(sparse.indices_type))
        throw InputError("{}: {}: its sparse indices are not unsigned integers; export it again",
                         file.name, user);
    const Window indices =
        window(file, sparse.indices_view, sparse.indices_offset, sparse.count, index_size, user);
    const Window data = window(file, sparse.values_view, sparse.values_offset, sparse.count,
                               size * Decode<T>::COMPONENTS, user);
    for (size_t i = 0; i < sparse.count; ++i) {
        const uint32_t target =
            Decode<uint32_t>::element(indices[i], sparse.indices_type, false, index_size);
        if (target >= values.size())
            throw InputError("{}: {}: its sparse index {} is beyond its {} elements; export it "
                             "again",
                             file.name, user, target, values.size());
        values[target] = Decode<T>::element(data[i], accessor.type, accessor.normalized, size);
    }
}

/// The accessor, as the primitive's compressed data states it where it has any.
Accessor accessor_at(const File& file, uint32_t index, const std::string& user) {
    Accessor accessor = at(file, file.document.accessors, index, "accessor", user);
    const auto decoded = file.decoded_elements.find(index);
    if (decoded == file.decoded_elements.end()) return accessor;
    accessor.view.reset();
    accessor.count = decoded->second.count;
    accessor.type = decoded->second.type;
    accessor.components = decoded->second.components;
    return accessor;
}

template <class T>
std::vector<T> read(const File& file, uint32_t index, const std::string& user) {
    const Accessor accessor = accessor_at(file, index, user);
    const size_t size = component_size(accessor.type);
    constexpr size_t COMPONENTS = Decode<T>::COMPONENTS;
    if (accessor.components != COMPONENTS)
        throw InputError("{}: {}: its accessor {} must have {} components, not {}; export it again",
                         file.name, user, index, COMPONENTS, accessor.components);
    Window data;
    const auto decoded = file.decoded_elements.find(index);
    if (decoded != file.decoded_elements.end())
        data = {reinterpret_cast<const uint8_t*>(decoded->second.bytes.data()), size * COMPONENTS};
    else if (accessor.view)
        data =
            window(file, *accessor.view, accessor.offset, accessor.count, size * COMPONENTS, user);
    else if (accessor.count > MAX_ZEROS + file.buffer_bytes())
        throw InputError("{}: {}: its accessor {} claims {} elements without data; export it again",
                         file.name, user, index, accessor.count);
    file.context.spend(accessor.count, sizeof(T), file.where(user));
    std::vector<T> values(accessor.count, T{});
    if (data.first)
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = Decode<T>::element(data[i], accessor.type, accessor.normalized, size);
    if (accessor.sparse) apply_sparse(file, accessor, user, values);
    return values;
}

} // namespace

void throw_missing(const File& file, const char* kind, uint32_t index, size_t count,
                   const std::string& user) {
    throw InputError("{}: {}: it names {} {}, but there are {}; export it again", file.name, user,
                     kind, index, count);
}

std::span<const uint8_t> range_of(const File& file, const BufferView& view, uint32_t index,
                                  const std::string& user) {
    const std::span<const uint8_t> buffer = at(file, file.buffers, view.buffer, "buffer", user);
    if (view.offset > buffer.size() || view.length > buffer.size() - view.offset)
        throw InputError("{}: {}: buffer view {} overruns its buffer of {} bytes; export it again",
                         file.name, user, index, buffer.size());
    return buffer.subspan(size_t(view.offset), size_t(view.length));
}

std::span<const uint8_t> view_bytes(const File& file, uint32_t index, const std::string& user) {
    const BufferView& view = at(file, file.document.views, index, "buffer view", user);
    if (!view.meshopt) return range_of(file, view, index, user);
    const std::string& bytes = file.decoded_views.at(index);
    return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

std::vector<glm::vec2> read_vec2(const File& file, uint32_t accessor, const std::string& user) {
    return read<glm::vec2>(file, accessor, user);
}

std::vector<glm::vec3> read_vec3(const File& file, uint32_t accessor, const std::string& user) {
    return read<glm::vec3>(file, accessor, user);
}

template <class T>
static std::vector<float> flattened(const std::vector<T>& values) {
    std::vector<float> floats(values.size() * sizeof(T) / sizeof(float));
    std::memcpy(floats.data(), values.data(), floats.size() * sizeof(float));
    return floats;
}

std::vector<float> read_floats(const File& file, uint32_t accessor, uint32_t components,
                               const std::string& user) {
    switch (components) {
    case 1:
        return read<float>(file, accessor, user);
    case 3:
        return flattened(read<glm::vec3>(file, accessor, user));
    case 4:
        return flattened(read<glm::vec4>(file, accessor, user));
    default:
        return flattened(read<std::array<float, 16>>(file, accessor, user));
    }
}

std::vector<glm::uvec4> read_uvec4(const File& file, uint32_t accessor, const std::string& user) {
    if (!is_unsigned(accessor_at(file, accessor, user).type))
        throw InputError("{}: {}: it does not hold unsigned integers; export it again", file.name,
                         user);
    return read<glm::uvec4>(file, accessor, user);
}

std::vector<glm::vec4> read_any_vec4(const File& file, uint32_t accessor, const std::string& user) {
    return read<glm::vec4>(file, accessor, user);
}

std::vector<glm::vec4> read_color(const File& file, uint32_t accessor, const std::string& user) {
    const Accessor& source = at(file, file.document.accessors, accessor, "accessor", user);
    std::vector<glm::vec4> colors;
    if (source.components == 3) {
        const std::vector<glm::vec3> rgb = read<glm::vec3>(file, accessor, user);
        colors.reserve(rgb.size());
        for (const glm::vec3& color : rgb) colors.emplace_back(color, 1.0f);
    } else {
        colors = read<glm::vec4>(file, accessor, user);
    }
    if (source.normalized || source.type == ComponentType::float32) return colors;
    const float largest = source.type == ComponentType::uint8 ? 255.0f : 65535.0f;
    const float rgb_only = source.components == 3 ? largest : 1.0f;
    for (glm::vec4& color : colors) color *= glm::vec4(1, 1, 1, rgb_only) / largest;
    return colors;
}

std::vector<uint32_t> read_indices(const File& file, uint32_t accessor, const std::string& user) {
    const Accessor source = accessor_at(file, accessor, user);
    if (!is_unsigned(source.type))
        throw InputError("{}: {}: its indices have the component type {}, which is not an unsigned "
                         "integer; export it again",
                         file.name, user, uint32_t(source.type));
    return read<uint32_t>(file, accessor, user);
}

} // namespace onde::gltf
