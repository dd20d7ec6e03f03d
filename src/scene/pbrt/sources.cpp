#include "scene/pbrt/sources.h"

namespace onde::pbrt {

std::optional<std::filesystem::path> Sources::find(const std::string& name,
                                                   const char* what) const {
    if (const auto found = files.find(name)) return context.resolve(files.folder(), *found, name);
    notes.wrong(std::string(what) + (files.may_use(name)
                                         ? " that are missing are left out"
                                         : " outside of the scene's folder are left out (--root)"),
                name);
    return std::nullopt;
}

} // namespace onde::pbrt
