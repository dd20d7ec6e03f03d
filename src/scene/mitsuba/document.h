// A Mitsuba file as a tree: files that it includes in their place, parameters replaced by their
// values, references found. It knows nothing of what the elements mean.
#pragma once

#include "scene/find_file.h"
#include "scene/notes.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace onde::mitsuba {

struct Element {
    std::string tag, where; ///< "FILE:LINE"
    std::map<std::string, std::string, std::less<>> attributes;
    std::vector<Element> children;
    mutable bool is_read = false; ///< something of it has been asked for by name,
    mutable bool is_used = false; ///< and this it was

    /// An attribute's value; empty where it is absent.
    const std::string& operator[](std::string_view attribute) const;
    bool is(std::string_view wanted_tag, std::string_view type) const {
        return tag == wanted_tag && (*this)["type"] == type;
    }
};

/// A whole scene, and the files beside it.
class Document {
  public:
    /// Reads the file and those that it includes. Throws InputError "FILE:LINE: ..." for what is no
    /// XML, includes itself, or asks for too much.
    Document(const std::filesystem::path& path, LoadContext& context, Notes& notes);

    const Element& root() const { return root_; }

    /// Notes what elements that were read have and nothing asked for.
    void note_unused() const { note_unused(root_); }

    /// The element, or the one that it refers to; null, with a note, for an id that there is not.
    const Element* resolved(const Element& element) const;

    /// What an element has by that name, references resolved; or null.
    const Element* property(const Element& of, std::string_view name) const;

    /// The first child with that tag, references resolved, whatever its name; or null.
    const Element* child(const Element& of, std::string_view tag) const;

    /// The path of a file that the scene names; nothing, with a note, where there is none that it
    /// may use. `what` are such files: "Meshes".
    std::optional<std::filesystem::path> find(const std::string& name, const char* what) const;

    LoadContext& context() const { return context_; }
    Notes& notes() const { return notes_; }

  private:
    friend class Expansion;

    std::optional<std::filesystem::path> search(const std::string& name) const;
    void collect_ids(const Element& element);
    void note_unused(const Element& element) const;

    LoadContext& context_;
    Notes& notes_;
    mutable FileFinder files_;
    std::vector<std::string> folders_{"."}; ///< in which files are looked for, within the scene's
    Element root_;
    std::map<std::string, const Element*, std::less<>> by_id_;
    std::map<std::string, std::string, std::less<>> aliases_; ///< other ids
};

} // namespace onde::mitsuba
