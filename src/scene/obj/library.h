// The MTL files that an OBJ names, and the materials in them by name.
#pragma once

#include "scene/obj/material.h"

#include <set>
#include <unordered_map>

namespace onde::obj {

struct LibraryMaterial {
    mtl::Material material;
    std::string folder; ///< of the library, within the finder's folder
};

class Libraries {
  public:
    /// Reads the libraries that the OBJ's mtllib statements name: each one file whose name may hold
    /// blanks, or several. What is missing is noted.
    Libraries(const std::vector<std::string>& statements, FileFinder& files, Notes& notes);

    /// The material that a usemtl statement names, or null. A comment that begins with " #" in
    /// either place does not count, unless it is a part of both names.
    const LibraryMaterial* find(const std::string& name) const;

  private:
    void read(const std::string& statement);
    bool read_named(const std::string& name);
    void note_missing(const std::string& name);

    FileFinder& files_;
    Notes& notes_;
    std::set<std::string> read_; ///< files, so that each is read once
    std::vector<LibraryMaterial> materials_;
    std::unordered_map<std::string, size_t> by_name_, by_short_name_;
};

} // namespace onde::obj
