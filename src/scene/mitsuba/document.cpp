#include "scene/mitsuba/document.h"

#include "core/error.h"
#include "core/shown.h"
#include "scene/inclusion_count.h"

#include <pugixml.hpp>

#include <algorithm>

namespace onde::mitsuba {
namespace fs = std::filesystem;

const std::string& Element::operator[](std::string_view attribute) const {
    static const std::string NONE;
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? NONE : found->second;
}

/// Turns the nodes of files into elements, in the order in which the scene names them.
class Expansion {
  public:
    Expansion(Document& document, const std::string& name)
        : document_(document), cost_(document.context_, name) {}

    void read_file(const fs::path& path, Element& parent);

  private:
    struct File {
        std::string name, bytes;
        std::vector<size_t> lines; ///< where each begins

        std::string where(const pugi::xml_node& node) const {
            const auto next = std::ranges::upper_bound(lines, size_t(node.offset_debug()));
            return fmt::format("{}:{}", name, next - lines.begin());
        }
    };

    void add(const File& file, const pugi::xml_node& node, Element& parent, size_t depth);
    void include(const std::string& name, const std::string& where, Element& parent);
    void add_path(const std::string& folder, const std::string& where);
    std::string with_values(const std::string& text, const std::string& where);

    static constexpr size_t MAX_NESTED = 16, MAX_DEPTH = 64, MAX_VALUES = 4096;
    static constexpr uint64_t ELEMENT_BYTES = 512; ///< about, with its attributes and its place

    Document& document_;
    GradualSpending cost_;
    std::vector<fs::path> ancestors_;
    InclusionCount inclusions_;
    std::map<std::string, std::string, std::greater<>> values_; ///< of parameters, long names first
};

void Expansion::read_file(const fs::path& path, Element& parent) {
    constexpr uint64_t NODE_SHARE = 24; // of pugixml's nodes to the bytes that make them
    const fs::path self = fs::weakly_canonical(path);
    if (std::ranges::find(ancestors_, self) != ancestors_.end())
        throw InputError("{}: includes itself, directly or through another file; break the cycle",
                         path.string());
    if (ancestors_.size() >= MAX_NESTED)
        throw InputError("{}: files are included more than {} deep; flatten them", path.string(),
                         MAX_NESTED);
    inclusions_.add(path);
    ancestors_.push_back(self);
    File file{
        .name = path.string(), .bytes = read_file_within(document_.context_, path), .lines = {0}};
    document_.context_.spend(file.bytes.size(), NODE_SHARE, file.name);
    for (size_t i = 0; i < file.bytes.size(); ++i)
        if (file.bytes[i] == '\n') file.lines.push_back(i + 1);
    pugi::xml_document document;
    const auto result = document.load_buffer(file.bytes.data(), file.bytes.size());
    if (!result) {
        const auto next = std::ranges::upper_bound(file.lines, size_t(result.offset));
        throw InputError("{}:{}: not valid XML: {}", file.name, next - file.lines.begin(),
                         result.description());
    }
    const pugi::xml_node scene = document.document_element();
    if (std::string_view(scene.name()) != "scene")
        throw InputError("{}: holds no <scene>, as Mitsuba's files do; give another file",
                         file.name);
    if (ancestors_.size() == 1) parent.tag = "scene";
    for (const pugi::xml_node& node : scene.children()) add(file, node, parent, 0);
    ancestors_.pop_back();
}

/// Values may hold values, so that a short text can ask for more than any memory holds.
std::string Expansion::with_values(const std::string& text, const std::string& where) {
    std::string result;
    size_t from = 0;
    for (size_t at; (at = text.find('$', from)) != std::string::npos;) {
        const auto named = [&](const auto& value) {
            return text.compare(at + 1, value.first.size(), value.first) == 0;
        };
        const auto found = std::ranges::find_if(values_, named);
        if (found == values_.end())
            throw InputError("{}: '{}' names a parameter without a value; add <default "
                             "name=\"...\" value=\"...\"/>",
                             where, shown(text));
        cost_.add(at - from + found->second.size());
        result.append(text, from, at - from).append(found->second);
        from = at + 1 + found->first.size();
    }
    result.append(text, from);
    return result;
}

void Expansion::add(const File& file, const pugi::xml_node& node, Element& parent, size_t depth) {
    if (node.type() != pugi::node_element) return;
    cost_.add(ELEMENT_BYTES);
    Element element;
    element.tag = node.name();
    element.where = file.where(node);
    if (depth == MAX_DEPTH)
        throw InputError("{}: elements are nested more than {} deep; flatten them", element.where,
                         MAX_DEPTH);
    for (const pugi::xml_attribute& attribute : node.attributes()) {
        std::string value = with_values(attribute.value(), element.where);
        cost_.add(2 * value.size() + ELEMENT_BYTES / 4);
        element.attributes[attribute.name()] = std::move(value);
    }
    if (element.tag == "default") {
        if (values_.size() == MAX_VALUES)
            throw InputError("{}: more than {} parameters; write some values where they are used",
                             element.where, MAX_VALUES);
        values_.try_emplace(element["name"], element["value"]);
    } else if (element.tag == "include") {
        include(element["filename"], element.where, parent);
    } else if (element.tag == "path") {
        add_path(element["value"], element.where);
    } else if (element.tag == "alias") {
        document_.aliases_[element["as"]] = element["id"];
    } else {
        for (const pugi::xml_node& child : node.children()) add(file, child, element, depth + 1);
        parent.children.push_back(std::move(element));
    }
}

void Expansion::include(const std::string& name, const std::string& where, Element& parent) {
    if (const auto path = document_.search(name)) return read_file(*path, parent);
    document_.context_.resolve(document_.files_.folder(), name,
                               where); // says what is wrong with it
    throw InputError("{}: names '{}', which does not exist; check the name", where, shown(name));
}

void Expansion::add_path(const std::string& folder, const std::string& where) {
    constexpr size_t MOST = 64;
    if (document_.folders_.size() == MOST)
        throw InputError("{}: more than {} folders are to be searched; remove some", where, MOST);
    document_.folders_.push_back(folder);
}

Document::Document(const fs::path& path, LoadContext& context, Notes& notes)
    : context_(context), notes_(notes),
      files_(path.has_parent_path() ? path.parent_path() : fs::path("."), context) {
    Expansion(*this, path.string()).read_file(path, root_);
    collect_ids(root_);
}

void Document::collect_ids(const Element& element) {
    if (const std::string& id = element["id"]; !id.empty() && element.tag != "ref")
        by_id_.try_emplace(id, &element);
    for (const Element& child : element.children) collect_ids(child);
}

const Element* Document::resolved(const Element& element) const {
    if (element.tag != "ref") return &element;
    const std::string& id = element["id"];
    const auto alias = aliases_.find(id);
    const auto found = by_id_.find(alias == aliases_.end() ? id : alias->second);
    if (found != by_id_.end()) return found->second;
    notes_.wrong("References to ids that there are not are left out", id);
    return nullptr;
}

const Element* Document::property(const Element& of, std::string_view name) const {
    of.is_read = true;
    for (const Element& child : of.children)
        if (child["name"] == name) {
            child.is_used = true;
            return resolved(child);
        }
    return nullptr;
}

void Document::note_unused(const Element& element) const {
    constexpr std::string_view PARAMETERS[] = {"boolean", "integer",  "float",     "string",
                                               "point",   "vector",   "transform", "rgb",
                                               "texture", "spectrum", "blackbody"};
    // Of what changes no picture.
    constexpr std::string_view IDLE[] = {
        "near_clip",     "far_clip",     "shutter_open", "shutter_close",
        "file_format",   "pixel_format", "banner",       "component_format",
        "sample_border", "compensate",   "rr_depth",     "sample_visible",
        "seed",          "aovs"};
    const auto is_in = [](const auto& words, std::string_view word) {
        return std::ranges::find(words, word) != std::end(words);
    };
    for (const Element& child : element.children) {
        const std::string& name = child["name"];
        if (element.is_read && !child.is_used && is_in(PARAMETERS, child.tag) && !is_in(IDLE, name))
            notes_.add("Parameters that nothing asks for are ignored", name + ", " + child.where);
        note_unused(child);
    }
}

const Element* Document::child(const Element& of, std::string_view tag) const {
    for (const Element& child : of.children) {
        if (child.tag != tag && child.tag != "ref") continue;
        const Element* found = resolved(child);
        if (found && found->tag == tag) return found;
    }
    return nullptr;
}

std::optional<fs::path> Document::search(const std::string& name) const {
    for (const std::string& folder : folders_)
        if (const auto found = files_.find(name, folder))
            return context_.resolve(files_.folder(), *found, name);
    return std::nullopt;
}

std::optional<fs::path> Document::find(const std::string& name, const char* what) const {
    if (const auto found = search(name)) return found;
    notes_.wrong(fmt::format("{} that are missing or outside of the scene's folder are left out "
                             "(--root)",
                             what),
                 name);
    return std::nullopt;
}

} // namespace onde::mitsuba
