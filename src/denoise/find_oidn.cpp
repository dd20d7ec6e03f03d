#include "denoise/find_oidn.h"

#include "core/error.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

namespace onde {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

/// The folders of a list such as PATH, without the empty ones.
std::vector<fs::path> folders_of(const char* variable) {
    const char* list = std::getenv(variable);
    std::vector<fs::path> folders;
    std::istringstream text(list ? list : "");
    for (std::string folder; std::getline(text, folder, ':');)
        if (!folder.empty()) folders.emplace_back(folder);
    return folders;
}

/// Adds the folders of packages below `root`, where an installation has lib/python3.11 and the
/// like, the newest version first.
void add_packages(const fs::path& root, std::vector<fs::path>& found) {
    std::vector<fs::path> versions;
    std::error_code error;
    for (fs::directory_iterator entry(root / "lib", error), end; !error && entry != end;
         entry.increment(error))
        if (entry->path().filename().string().starts_with("python3"))
            versions.push_back(entry->path());
    std::ranges::sort(versions, std::greater());
    for (const fs::path& version : versions)
        for (const char* folder : {"site-packages", "dist-packages"})
            found.push_back(version / folder);
}

} // namespace

fs::path named_oidn(const fs::path& place, const char* named_by) {
    std::error_code ignored;
    if (!fs::is_directory(place, ignored)) {
        if (is_file(place)) return fs::absolute(place);
        throw InputError(
            "{} {}: there is no such file or folder; name {} or the folder that has it", named_by,
            place.string(), OIDN_LIBRARY);
    }
    for (const char* below : {"", "lib", "oidn/lib", "pyoidn/oidn/lib"})
        if (const fs::path library = place / below / OIDN_LIBRARY; is_file(library))
            return fs::absolute(library);
    throw InputError("{} {}: this folder has no {}; name the one that does", named_by,
                     place.string(), OIDN_LIBRARY);
}

std::vector<fs::path> python_package_folders() {
    std::vector<fs::path> found = folders_of("PYTHONPATH");
    for (const fs::path& folder : folders_of("PATH")) {
        std::error_code error;
        const fs::path python = folder / "python3";
        if (!fs::exists(python, error)) continue;
        add_packages(folder.parent_path(), found); // also of a virtual environment
        if (const fs::path real = fs::canonical(python, error); !error)
            add_packages(real.parent_path().parent_path(), found);
        add_packages(folder.parent_path() / "local", found); // Debian's, of packages by pip
    }
    if (const char* home = std::getenv("HOME")) add_packages(fs::path(home) / ".local", found);
    return found;
}

std::optional<fs::path> installed_oidn() {
    for (const fs::path& packages : python_package_folders())
        if (const fs::path library = packages / "pyoidn/oidn/lib" / OIDN_LIBRARY; is_file(library))
            return library;
    if (void* library = dlopen(OIDN_LIBRARY, RTLD_LAZY | RTLD_LOCAL)) {
        dlclose(library);
        return OIDN_LIBRARY;
    }
    return std::nullopt;
}

} // namespace onde
