#include "scene/loaders.h"
#include "scene/file_words.h"
#include "core/error.h"
namespace onde {
Scene load_mitsuba(const std::filesystem::path& path, LoadContext&) { throw InputError("{}: no", path.string()); }
std::vector<FileWord> mitsuba::plugin_words() { return {}; }
}
