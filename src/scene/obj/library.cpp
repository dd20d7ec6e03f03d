#include "scene/obj/library.h"

#include "core/error.h"
#include "scene/find_file.h"
#include "scene/text.h"

#include <algorithm>

namespace onde::obj {
namespace fs = std::filesystem;

namespace {

constexpr uint64_t MAX_LIBRARY_BYTES = uint64_t(64) << 20;
constexpr size_t MAX_MATERIALS = 1000000, MAX_NAME = 4096;

/// Without a comment at its end.
std::string short_name(const std::string& name) {
    return std::string(text::trim(name.substr(0, name.find(" #"))));
}

bool ends_in_mtl(std::string_view text) {
    if (text.size() < 4) return false;
    text.remove_prefix(text.size() - 4);
    return std::ranges::equal(text, std::string_view(".mtl"),
                              [](char a, char b) { return a == b || char(a | 0x20) == b; });
}

/// "a\ b.mtl" names "a b.mtl".
std::string without_escapes(std::string name) {
    for (size_t i = name.find("\\ "); i != std::string::npos; i = name.find("\\ ", i))
        name.erase(i, 1);
    return name;
}

} // namespace

Libraries::Libraries(const std::vector<std::string>& statements, FileFinder& files, Notes& notes)
    : files_(files), notes_(notes) {
    for (const std::string& statement : statements) read(statement);
    for (size_t i = 0; i < materials_.size(); ++i) {
        const std::string& name = materials_[i].material.name;
        if (!by_name_.try_emplace(name, i).second)
            notes.wrong("Of materials with the same name the first counts", name);
        by_short_name_.try_emplace(short_name(name), i);
    }
}

/// All of the statement as one name; else its words, joined until they name a file or end in .mtl.
void Libraries::read(const std::string& statement) {
    if (read_named(without_escapes(statement))) return;
    text::Words words(statement);
    std::string name;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (!name.empty()) name += ' ';
        name += word;
        const bool last = words.rest().empty() || words.rest().starts_with('#');
        if (!last && (name.ends_with('\\') || !ends_in_mtl(name)) && name.size() < MAX_NAME)
            continue;
        const std::string file = without_escapes(name);
        if (!read_named(file)) note_missing(file);
        name.clear();
    }
}

void Libraries::note_missing(const std::string& name) {
    notes_.wrong(files_.may_use(name)
                     ? "A material library is missing"
                     : "A material library outside of the scene's folder is not allowed",
                 name);
}

/// Whether there is such a file.
bool Libraries::read_named(const std::string& name) {
    const auto found = files_.find(name);
    if (!found) return false;
    if (!read_.insert(*found).second) return true;
    const std::string folder = fs::path(*found).parent_path().string();
    try {
        const auto text = text::decode(
            read_file_within(files_.context(), files_.folder() / *found, MAX_LIBRARY_BYTES));
        if (!text) throw InputError("not a text file");
        for (mtl::Material& material : mtl::read(*text, notes_))
            if (materials_.size() < MAX_MATERIALS)
                materials_.push_back({std::move(material), folder});
    } catch (const InputError&) {
        notes_.wrong("A material library can't be read", name);
    }
    return true;
}

const LibraryMaterial* Libraries::find(const std::string& name) const {
    if (const auto found = by_name_.find(name); found != by_name_.end())
        return &materials_[found->second];
    const auto found = by_short_name_.find(short_name(name));
    return found == by_short_name_.end() ? nullptr : &materials_[found->second];
}

} // namespace onde::obj
