#include "scene/ply/body.h"

#include "core/error.h"
#include "scene/text.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace onde::ply {

namespace {

constexpr const char* SPACES = " \t\r\n\v\f";
constexpr size_t MAX_WORD = 64; ///< digits of a number

} // namespace

void Body::fail(const std::string& problem) const {
    throw InputError("{}: {} {}: {}", name_, element_->name, row_, problem);
}

void Body::fail_truncated() const {
    fail(fmt::format("the file ends here, but the header claims {} of them; it is truncated, copy "
                     "or export it again",
                     element_->count));
}

size_t Body::smallest(Type type) const {
    return encoding_ == Encoding::ascii ? 2 : size_of(type); // a digit and a space
}

uint64_t Body::room_for(size_t bytes) const {
    const bool last_space_may_miss = encoding_ == Encoding::ascii;
    return (rest_.size() + last_space_may_miss) / bytes;
}

void Body::begin(const Element& element) {
    element_ = &element;
    row_ = 0;
    size_t row = 0;
    for (const Property& property : element.properties)
        row += smallest(property.count_type.value_or(property.type));
    if (row != 0 && element.count > room_for(row))
        fail(fmt::format("the header claims {} of them, more than the {} bytes that are left can "
                         "hold; copy or export the file again",
                         element.count, rest_.size()));
}

std::string_view Body::take(size_t bytes) {
    if (bytes > rest_.size()) fail_truncated();
    const std::string_view taken = rest_.substr(0, bytes);
    rest_.remove_prefix(bytes);
    return taken;
}

std::string_view Body::word() {
    take(std::min(rest_.find_first_not_of(SPACES), rest_.size()));
    if (rest_.empty()) fail_truncated();
    const std::string_view start = rest_.substr(0, MAX_WORD + 1);
    const size_t length = std::min(start.find_first_of(SPACES), start.size());
    if (length > MAX_WORD)
        fail(fmt::format("a number of more than {} characters; export it again", MAX_WORD));
    return take(length);
}

template <class T>
double Body::load() {
    char bytes[sizeof(T)];
    std::memcpy(bytes, take(sizeof(T)).data(), sizeof(T));
    const bool big = encoding_ == Encoding::big_endian;
    if (big != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return double(value);
}

double Body::value(Type type) {
    if (encoding_ != Encoding::ascii) return binary_value(type);
    return text::number(word()).value_or(std::nan(""));
}

double Body::binary_value(Type type) {
    switch (type) {
    case Type::int8:
        return load<int8_t>();
    case Type::uint8:
        return load<uint8_t>();
    case Type::int16:
        return load<int16_t>();
    case Type::uint16:
        return load<uint16_t>();
    case Type::int32:
        return load<int32_t>();
    case Type::uint32:
        return load<uint32_t>();
    case Type::float32:
        return load<float>();
    case Type::float64:
        break;
    }
    return load<double>();
}

double Body::number(const Property& property) {
    if (encoding_ != Encoding::ascii) return binary_value(property.type);
    const std::optional<double> number = text::number(word());
    if (!number) fail(fmt::format("its {} is not a number; correct it", property.name));
    return *number;
}

uint32_t Body::checked_index(double number, uint64_t end, const char* things) const {
    if (!(number >= 0 && number < double(end) && number == std::floor(number)))
        fail(fmt::format("names {} {}, but there are {}, counted from 0; export it again", things,
                         number, end));
    return uint32_t(number);
}

uint32_t Body::index(Type type, uint64_t end, const char* things) {
    return checked_index(value(type), end, things);
}

std::optional<uint32_t> Body::index_or_none(Type type, uint64_t end, const char* things) {
    const double number = value(type);
    if (number == -1.0) return std::nullopt;
    return checked_index(number, end, things);
}

uint64_t Body::length(const Property& list) {
    const double number = value(*list.count_type);
    const double room = double(room_for(smallest(list.type)));
    if (!(number >= 0 && number <= room && number == std::floor(number)))
        fail(fmt::format("its list {} has the length {}, which the file can't hold; export it "
                         "again",
                         list.name, number));
    return uint64_t(number);
}

void Body::skip(const Property& property) {
    const uint64_t values = property.count_type ? length(property) : 1;
    if (encoding_ != Encoding::ascii)
        take(values * size_of(property.type));
    else
        for (uint64_t i = 0; i < values; ++i) word();
}

void Body::skip(const Element& element) {
    begin(element);
    if (element.properties.empty()) return;
    for (uint64_t i = 0; i < element.count; ++i) {
        begin_row(i);
        for (const Property& property : element.properties) skip(property);
    }
}

} // namespace onde::ply
