// Where the pictures of a request go.
#include "app/render_request.h"

#include "app/film_request.h"
#include "app/id_channels.h"

#include "core/error.h"
#include "core/files.h"
#include "core/output.h"
#include "scene/light_groups.h"

#include <algorithm>
#include <map>
#include <set>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

/// Of a request's outputs: each can be written, and goes to a place of its own.
class OutputCheck {
  public:
    void check(const fs::path& path) {
        writable_.check(path);
        std::error_code ignored;
        const bool standard = is_standard_output(path);
        // Devices and pipes may take several.
        if (!standard && fs::is_other(path, ignored)) return;
        if (!taken_.insert(standard ? STANDARD_OUTPUT : place_of(path)).second)
            throw InputError("{}: two outputs cannot go to the same place; name another",
                             standard ? "standard output" : path.string());
    }

  private:
    /// Behind its links. Of what is new in a folder that is known, the name is enough.
    fs::path place_of(const fs::path& path) {
        std::error_code ignored;
        if (fs::exists(fs::symlink_status(path, ignored)))
            return fs::weakly_canonical(fs::absolute(path), ignored);
        const auto [folder, is_new] = folders_.try_emplace(path.parent_path());
        if (is_new)
            folder->second = fs::weakly_canonical(fs::absolute(path).parent_path(), ignored);
        return folder->second / path.filename();
    }

    WritableCheck writable_;
    std::set<fs::path> taken_;
    std::map<fs::path, fs::path> folders_; ///< of new files, with where they really are
};

} // namespace

std::filesystem::path aov_path(const std::filesystem::path& output, const std::string& name) {
    std::filesystem::path path = output;
    return path.replace_extension(name + output.extension().string());
}

bool is_exr(const std::filesystem::path& output) {
    return lower_extension(output) == ".exr";
}

std::vector<fs::path> named_outputs(const RenderRequest& request) {
    std::vector<fs::path> outputs = request.outputs;
    if (outputs.empty() && film_path(request).empty())
        outputs.push_back(request.scene.stem().string() + ".png");
    for (const fs::path& path : outputs) {
        if (is_standard_output(path) && !request.aovs.empty())
            throw InputError("--aov needs a file to name its pictures after; give one with -o");
        if (!is_standard_output(path) && lower_extension(path) != ".png" && !is_exr(path))
            throw InputError("{}: pictures are written as .png or .exr; change the extension",
                             path.string());
    }
    return outputs;
}

/// Files of AOVs are called so; each group of lights has one.
static std::vector<std::string> companions_of(const std::vector<std::string>& aovs,
                                              const Scene& scene) {
    std::vector<std::string> names;
    for (const std::string& aov : aovs) {
        if (aov != LIGHT_GROUPS) names.push_back(aov);
        if (aov == LIGHT_GROUPS)
            for (const std::string& group : light_groups(scene))
                names.push_back(group_layer(group));
    }
    return names;
}

/// These, what is written beside them, and the report.
static std::vector<fs::path> all_outputs(const std::vector<fs::path>& outputs,
                                         const RenderRequest& request,
                                         const std::vector<std::string>& companions) {
    std::vector<fs::path> all = outputs;
    for (const fs::path& output : outputs)
        if (!is_exr(output) && !is_standard_output(output))
            for (const std::string& name : companions) all.push_back(aov_path(output, name));
    if (!request.json.empty()) all.push_back(request.json);
    return all;
}

void check_outputs(const std::vector<fs::path>& outputs, const RenderRequest& request) {
    OutputCheck check;
    for (const fs::path& path : all_outputs(outputs, request, request.aovs)) check.check(path);
}

void check_outputs_not_read(const std::vector<fs::path>& outputs, const RenderRequest& request,
                            const Scene& scene) {
    std::vector<fs::path> files = scene.files;
    if (!request.environment.empty()) files.emplace_back(request.environment);
    const std::vector<std::string> aovs = requested_aovs(request, scene);
    OutputCheck check;
    for (const fs::path& path : all_outputs(outputs, request, companions_of(aovs, scene))) {
        check.check(path); // those that only the scene names too
        check_not_read(path, files);
    }
}

} // namespace onde::app
