// Lines, words and numbers of text files as other programs really write them. What they mean is the
// business of each format's reader.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace onde::text {

/// The bytes of a text file as UTF-8 without a byte-order mark: UTF-16 is converted where a mark
/// says so, and what is not UTF-8 is taken as Latin-1. Nothing when they hold a zero byte, which no
/// text does.
std::optional<std::string> decode(std::string bytes);

/// Without blanks at both ends.
std::string_view trim(std::string_view text);

/// The number that the word is, also "nan", "inf" and MSVC's "-1.#IND"; nothing when it is no
/// number. What exceeds a double is infinite, what is too small for one is zero.
std::optional<double> number(std::string_view word);

/// The words of a line, one after the other. A word that begins with '#' begins a comment.
class Words {
  public:
    explicit Words(std::string_view line) : rest_(trim(line)) {}

    std::string_view next(); ///< empty at the end
    double next_number();    ///< NaN at the end, or when the next word is no number

    /// All that is left, comments included, without blanks at both ends.
    std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_;
};

/// The lines of a text. They end in LF, CR LF or CR; one that ends in a backslash is joined with
/// the next by a blank, unless it is a comment.
class Lines {
  public:
    /// `text` must outlive the lines.
    explicit Lines(std::string_view text) : rest_(text) {}

    /// The next line, valid until the next call.
    std::optional<std::string_view> next();

    /// Of the line returned last, or of its first one when several were joined; counts from 1.
    size_t number() const { return number_; }

  private:
    std::string_view take();

    std::string_view rest_;
    std::string joined_;
    size_t number_ = 0, taken_ = 0;
};

} // namespace onde::text
