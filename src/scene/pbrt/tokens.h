// The words, texts and brackets of a pbrt file. What they mean is the business of others.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace onde::pbrt {

struct Token {
    enum class Kind { word, text, open, close };
    Kind kind = Kind::word;
    std::string_view text; ///< of a text without its quotes, escapes as they stand
    size_t line = 1;
};

class Tokens {
  public:
    /// Of the file `name`, whose text this is; both must outlive the tokens.
    Tokens(const std::string& name, std::string_view text) : name_(name), rest_(text) {}

    /// The next token; nothing at the end. Throws InputError for a text that does not end in its
    /// line.
    std::optional<Token> next();

    /// The same, which stays the next.
    std::optional<Token> peek();

    /// "FILE:LINE" of the token that next() returned last.
    std::string where() const;

  private:
    void skip_blanks();
    Token read_text();

    const std::string& name_;
    std::string_view rest_;
    size_t line_ = 1, last_line_ = 1;
    std::optional<Token> peeked_;
};

/// A text with its escapes resolved.
std::string unescaped(std::string_view text);

} // namespace onde::pbrt
