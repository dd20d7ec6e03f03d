// The values after a PLY file's header, one after the other, whatever their encoding and type.
#pragma once

#include "scene/ply/header.h"

namespace onde::ply {

/// Where we are in a file. Whatever fails is an InputError that names the file and the element.
class Body {
  public:
    /// `name` and `bytes`, those after the header, must outlive the body.
    Body(const std::string& name, std::string_view bytes, Encoding encoding)
        : name_(name), rest_(bytes), encoding_(encoding) {}

    /// What follows is this element's. Fails when the rest of the file is too short for its count,
    /// so that memory may be reserved for it.
    void begin(const Element& element);

    /// What follows is this one of the element's rows.
    void begin_row(uint64_t index) { row_ = index; }

    /// The next value; fails when it is a word that is no number. It may be NaN or infinite.
    double number(const Property& property);

    /// The next value, of an integer type; fails unless it is an integer from 0 and below `end`,
    /// the number of `things` that there are.
    uint32_t index(Type type, uint64_t end, const char* things);

    /// As index(), but nothing for -1.
    std::optional<uint32_t> index_or_none(Type type, uint64_t end, const char* things);

    /// The length of the next list, which the rest of the file can hold. Its items follow.
    uint64_t length(const Property& list);

    void skip(const Property& property);
    void skip(const Element& element); ///< begins it as well

    /// Throws "FILE: ELEMENT ROW: problem"; the problem ends in what to do.
    [[noreturn]] void fail(const std::string& problem) const;

  private:
    double value(Type type); ///< NaN for a word that is no number
    double binary_value(Type type);
    uint32_t checked_index(double number, uint64_t end, const char* things) const;
    std::string_view word();
    std::string_view take(size_t bytes);
    template <class T>
    double load();
    size_t smallest(Type type) const;      ///< bytes that a value takes at least
    uint64_t room_for(size_t bytes) const; ///< how many of that size the rest can hold
    [[noreturn]] void fail_truncated() const;

    const std::string& name_;
    std::string_view rest_;
    Encoding encoding_;
    const Element* element_ = nullptr;
    uint64_t row_ = 0;
};

} // namespace onde::ply
