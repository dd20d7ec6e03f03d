// A parsed glTF file and bounds-checked access to its binary data.
#pragma once

#include "scene/notes.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace onde::gltf {

/// The JSON tree with its buffers in memory. Nothing in `model` has been checked but its syntax.
struct File {
    std::filesystem::path path;
    std::filesystem::path folder;
    tinygltf::Model model;
    Notes notes;

    /// "FILE: what".
    std::string where(const std::string& what) const { return path.string() + ": " + what; }
};

/// Parses .gltf or .glb and loads its buffers; images stay encoded. Throws InputError for damaged
/// files, versions other than 2, references out of the folder and required extensions that would
/// change what the data means.
File open_file(const std::filesystem::path& path);

/// Element `index` of a list of the file; throws InputError when there is none.
template <class T>
const T& at(const File& file, const std::vector<T>& list, int index, const char* kind,
            const std::string& user);

[[noreturn]] void throw_missing(const File& file, const char* kind, int index, size_t count,
                                const std::string& user);

/// The bytes of a buffer view, checked against its buffer.
std::span<const uint8_t> view_bytes(const File& file, int view, const std::string& user);

/// The floats of an accessor with that many components, integers normalised where it says so,
/// sparse values applied; all finite. `user` names what asks, as in "mesh 0 POSITION".
std::vector<glm::vec2> read_vec2(const File& file, int accessor, const std::string& user);
std::vector<glm::vec3> read_vec3(const File& file, int accessor, const std::string& user);

/// The unsigned integers of a scalar accessor.
std::vector<uint32_t> read_indices(const File& file, int accessor, const std::string& user);

/// A number in an extension's JSON object, or `fallback`.
double number_in(const tinygltf::Value& object, const char* key, double fallback);

template <class T>
const T& at(const File& file, const std::vector<T>& list, int index, const char* kind,
            const std::string& user) {
    if (index < 0 || size_t(index) >= list.size())
        throw_missing(file, kind, index, list.size(), user);
    return list[size_t(index)];
}

} // namespace onde::gltf
