#include "scene/json_parse.h"

#include "core/error.h"
#include "core/shown.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace onde {

namespace {

using Json = nlohmann::json;

constexpr size_t MAX_NESTING = 200;

/// Bytes of a value in its array, which grows by halves, and of an object's entry.
constexpr uint64_t VALUE_BYTES = 2 * sizeof(Json), ENTRY_BYTES = 96;

/// Told each value by the library's parser, which keeps no tree and does not recurse.
class Builder : public nlohmann::json_sax<Json> {
  public:
    Builder(const std::string& name, std::string_view text, LoadContext& context)
        : name_(name), text_(text), context_(context) {}

    Json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool binary(binary_t&) override { return false; } // JSON text has none
    bool string(string_t& value) override {
        context_.spend(value.size(), 1, name_);
        return add(std::move(value));
    }
    bool start_object(size_t) override { return open(Json::object()); }
    bool start_array(size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& key) override {
        context_.spend(ENTRY_BYTES + key.size(), 1, name_);
        const auto [entry, is_new] = open_.back()->get_ref<Json::object_t&>().try_emplace(key);
        if (!is_new)
            throw InputError("{}: '{}' stands twice in an object of its JSON; export it again",
                             name_, shown(key));
        slot_ = &entry->second;
        return true;
    }

    bool parse_error(size_t position, const std::string& token,
                     const Json::exception& error) override {
        constexpr int TOO_LARGE = 406; // nlohmann's number of it
        const std::string_view before = text_.substr(0, position ? position - 1 : 0);
        const size_t line = size_t(std::ranges::count(before, '\n')) + 1;
        const size_t column = before.size() - (before.rfind('\n') + 1) + 1; // npos + 1 is 0
        if (error.id == TOO_LARGE)
            throw InputError("{}: the number {} of its JSON is too large at line {}, column {}; "
                             "export it again",
                             name_, shown(token, 40), line, column);
        throw InputError("{}: not valid JSON at line {}, column {}; export it again", name_, line,
                         column);
    }

  private:
    bool add(Json value) {
        place(std::move(value));
        return true;
    }

    /// Where the next value belongs: the last key, the end of an array, or the root.
    Json* place(Json value) {
        context_.spend(VALUE_BYTES, 1, name_);
        if (open_.empty()) return &(root_ = std::move(value));
        if (!open_.back()->is_array()) return &(*slot_ = std::move(value));
        return &open_.back()->emplace_back(std::move(value));
    }

    bool open(Json container) {
        if (open_.size() >= MAX_NESTING)
            throw InputError("{}: its JSON is nested more than {} deep; the file is damaged", name_,
                             MAX_NESTING);
        open_.push_back(place(std::move(container)));
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    const std::string& name_;
    std::string_view text_;
    LoadContext& context_;
    Json root_;
    std::vector<Json*> open_; ///< not yet ended, outermost first
    Json* slot_ = nullptr;    ///< the value of the last key
};

} // namespace

Json parse_json(std::string_view text, const std::string& name, LoadContext& context) {
    Builder builder(name, text, context);
    Json::sax_parse(text, &builder);
    return builder.take();
}

} // namespace onde
