// Accessors: typed, strided, possibly sparse windows into a glTF file's bytes (glTF 2.0, section
// 3.6.2). Every offset is checked in 64 bits before a byte is read.
#include "core/error.h"
#include "scene/gltf_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace onde::gltf {

namespace {

/// Elements without a buffer view are zeros; so many would be a hostile file.
constexpr uint64_t MAX_ZEROS = uint64_t(1) << 24;

size_t component_size(const File& file, int type, const std::string& user) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        throw InputError("{}: {}: its accessor has the component type {}, which glTF does not "
                         "know; export it again",
                         file.path.string(), user, type);
    }
}

/// Checked elements in a buffer.
struct Window {
    const uint8_t* first = nullptr;
    size_t stride = 0;
    const uint8_t* operator[](size_t i) const { return first + i * stride; }
};

Window window(const File& file, int view, uint64_t offset, uint64_t count, uint64_t element_size,
              const std::string& user) {
    const std::span<const uint8_t> bytes = view_bytes(file, view, user);
    const uint64_t given = file.model.bufferViews[size_t(view)].byteStride;
    const uint64_t stride = given ? given : element_size;
    const bool fits =
        count == 0 || (offset <= bytes.size() && element_size <= bytes.size() - offset &&
                       count - 1 <= (bytes.size() - offset - element_size) / stride);
    if (!fits)
        throw InputError("{}: {}: its {} elements overrun buffer view {} of {} bytes; export it "
                         "again",
                         file.path.string(), user, count, view, bytes.size());
    return {bytes.data() + offset, size_t(stride)};
}

template <class T>
T load(const uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// One component as a float; normalised as glTF 2.0, section 3.6.2.3 says.
float load_float(const uint8_t* bytes, int type, bool normalized) {
    const auto convert = [&](float value, float largest) {
        return normalized ? std::max(value / largest, -1.0f) : value;
    };
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return convert(load<int8_t>(bytes), 127.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return convert(load<uint8_t>(bytes), 255.0f);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return convert(load<int16_t>(bytes), 32767.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return convert(load<uint16_t>(bytes), 65535.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return float(load<uint32_t>(bytes));
    default:
        return load<float>(bytes);
    }
}

/// Components as floats or as unsigned integers, whatever T is.
template <class T>
struct Decode;

template <glm::length_t N>
struct Decode<glm::vec<N, float, glm::defaultp>> {
    static constexpr size_t COMPONENTS = N;
    static glm::vec<N, float, glm::defaultp> element(const uint8_t* bytes, int type,
                                                     bool normalized, size_t size) {
        glm::vec<N, float, glm::defaultp> value;
        for (size_t c = 0; c < N; ++c) value[c] = load_float(bytes + c * size, type, normalized);
        return value;
    }
};

template <>
struct Decode<uint32_t> {
    static constexpr size_t COMPONENTS = 1;
    static uint32_t element(const uint8_t* bytes, int, bool, size_t size) {
        if (size == 1) return load<uint8_t>(bytes);
        return size == 2 ? load<uint16_t>(bytes) : load<uint32_t>(bytes);
    }
};

int components_of(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    default:
        return 0;
    }
}

bool is_unsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Replaces the elements that the accessor's sparse part names.
template <class T>
void apply_sparse(const File& file, const tinygltf::Accessor& accessor, const std::string& user,
                  std::vector<T>& values) {
    const auto& sparse = accessor.sparse;
    const size_t index_size = component_size(file, sparse.indices.componentType, user);
    const size_t size = component_size(file, accessor.componentType, user);
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
        !is_unsigned(sparse.indices.componentType))
        throw InputError("{}: {}: its sparse accessor is damaged; export it again",
                         file.path.string(), user);
    const uint64_t count = uint64_t(sparse.count);
    const Window indices = window(file, sparse.indices.bufferView,
                                  uint64_t(sparse.indices.byteOffset), count, index_size, user);
    const Window data = window(file, sparse.values.bufferView, uint64_t(sparse.values.byteOffset),
                               count, size * Decode<T>::COMPONENTS, user);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t target = Decode<uint32_t>::element(indices[i], 0, false, index_size);
        if (target >= values.size())
            throw InputError("{}: {}: its sparse index {} is beyond its {} elements; export it "
                             "again",
                             file.path.string(), user, target, values.size());
        values[target] =
            Decode<T>::element(data[i], accessor.componentType, accessor.normalized, size);
    }
}

template <class T>
std::vector<T> read(const File& file, int index, const std::string& user) {
    const tinygltf::Accessor& accessor = at(file, file.model.accessors, index, "accessor", user);
    const size_t size = component_size(file, accessor.componentType, user);
    constexpr size_t COMPONENTS = Decode<T>::COMPONENTS;
    if (components_of(accessor.type) != int(COMPONENTS))
        throw InputError("{}: {}: its accessor {} must have {} components; export it again",
                         file.path.string(), user, index, COMPONENTS);
    std::vector<T> values;
    if (accessor.bufferView >= 0) {
        const Window data = window(file, accessor.bufferView, accessor.byteOffset, accessor.count,
                                   size * COMPONENTS, user);
        values.resize(accessor.count);
        for (size_t i = 0; i < values.size(); ++i)
            values[i] =
                Decode<T>::element(data[i], accessor.componentType, accessor.normalized, size);
    } else if (accessor.count <= MAX_ZEROS) {
        values.resize(accessor.count, T(0));
    } else {
        throw InputError("{}: {}: its accessor {} claims {} elements but has no data; export it "
                         "again",
                         file.path.string(), user, index, accessor.count);
    }
    if (accessor.sparse.isSparse) apply_sparse(file, accessor, user, values);
    return values;
}

template <class T>
std::vector<T> read_finite(const File& file, int index, const std::string& user) {
    std::vector<T> values = read<T>(file, index, user);
    for (size_t i = 0; i < values.size(); ++i)
        for (size_t c = 0; c < Decode<T>::COMPONENTS; ++c)
            if (!std::isfinite(values[i][c]))
                throw InputError("{}: {}: element {} is not finite; export it again",
                                 file.path.string(), user, i);
    return values;
}

} // namespace

void throw_missing(const File& file, const char* kind, int index, size_t count,
                   const std::string& user) {
    throw InputError("{}: {}: it names {} {}, but there are {}; export it again",
                     file.path.string(), user, kind, index, count);
}

std::span<const uint8_t> view_bytes(const File& file, int index, const std::string& user) {
    const tinygltf::BufferView& view = at(file, file.model.bufferViews, index, "buffer view", user);
    const tinygltf::Buffer& buffer = at(file, file.model.buffers, view.buffer, "buffer", user);
    const uint64_t size = buffer.data.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
        throw InputError("{}: {}: buffer view {} overruns its buffer of {} bytes; export it again",
                         file.path.string(), user, index, size);
    return {buffer.data.data() + view.byteOffset, view.byteLength};
}

std::vector<glm::vec2> read_vec2(const File& file, int accessor, const std::string& user) {
    return read_finite<glm::vec2>(file, accessor, user);
}

std::vector<glm::vec3> read_vec3(const File& file, int accessor, const std::string& user) {
    return read_finite<glm::vec3>(file, accessor, user);
}

std::vector<uint32_t> read_indices(const File& file, int accessor, const std::string& user) {
    const int type = at(file, file.model.accessors, accessor, "accessor", user).componentType;
    if (!is_unsigned(type))
        throw InputError("{}: {}: its indices have the component type {}, which is not an unsigned "
                         "integer; export it again",
                         file.path.string(), user, type);
    return read<uint32_t>(file, accessor, user);
}

double number_in(const tinygltf::Value& object, const char* key, double fallback) {
    if (!object.IsObject() || !object.Has(key)) return fallback;
    const tinygltf::Value& value = object.Get(key);
    return value.IsNumber() ? value.GetNumberAsDouble() : fallback;
}

} // namespace onde::gltf
