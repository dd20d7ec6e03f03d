#include "scene/pbrt/tokens.h"

#include "core/error.h"

#include <algorithm>

namespace onde::pbrt {

void Tokens::skip_blanks() {
    while (!rest_.empty()) {
        const char c = rest_.front();
        if (c == '#') {
            rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
            continue;
        }
        if (c != ' ' && c != '\t' && c != '\r' && c != '\n') return;
        line_ += c == '\n';
        rest_.remove_prefix(1);
    }
}

Token Tokens::read_text() {
    for (size_t i = 1; i < rest_.size() && rest_[i] != '\n'; ++i) {
        if (rest_[i] == '"') {
            const Token token{Token::Kind::text, rest_.substr(1, i - 1), line_};
            rest_.remove_prefix(i + 1);
            return token;
        }
        if (rest_[i] == '\\') ++i;
    }
    throw InputError("{}:{}: a text does not end in its line; close it with a quotation mark",
                     name_, line_);
}

std::optional<Token> Tokens::peek() {
    if (!peeked_) {
        const size_t last = last_line_;
        peeked_ = next();
        last_line_ = last;
    }
    return peeked_;
}

std::optional<Token> Tokens::next() {
    std::optional<Token> token = peeked_;
    peeked_.reset();
    if (!token) {
        skip_blanks();
        if (rest_.empty()) return std::nullopt;
        if (rest_.front() == '"') {
            token = read_text();
        } else if (rest_.front() == '[' || rest_.front() == ']') {
            const auto kind = rest_.front() == '[' ? Token::Kind::open : Token::Kind::close;
            token = Token{kind, rest_.substr(0, 1), line_};
            rest_.remove_prefix(1);
        } else {
            const size_t end = std::min(rest_.find_first_of(" \t\r\n\"[]#"), rest_.size());
            token = Token{Token::Kind::word, rest_.substr(0, end), line_};
            rest_.remove_prefix(end);
        }
    }
    last_line_ = token->line;
    return token;
}

std::string Tokens::where() const {
    return name_ + ":" + std::to_string(last_line_);
}

std::string unescaped(std::string_view text) {
    std::string result;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\' || i + 1 == text.size()) {
            result += text[i];
            continue;
        }
        const char c = text[++i];
        result += c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c;
    }
    return result;
}

} // namespace onde::pbrt
