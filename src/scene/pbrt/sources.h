// What the converters of a pbrt file's parts need beside their parameters: the files beside it, and
// where to say what was mapped.
#pragma once

#include "scene/find_file.h"
#include "scene/notes.h"

#include <string>

namespace onde::pbrt {

struct Sources {
    LoadContext& context;
    FileFinder& files;
    Notes& notes;

    /// The path of a file that a parameter names; nothing, with a note, where there is none that
    /// the scene may use. `what` are such files: "Meshes".
    std::optional<std::filesystem::path> find(const std::string& name, const char* what) const;
};

} // namespace onde::pbrt
