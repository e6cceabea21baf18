// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_tokens.hpp"

#include "runtime/verifier/infix_reader.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

using Kind = CoqToken::Kind;

bool begins_word(char c) { return is_letter(c) || c == '_'; }
bool is_part_of_word(char c) { return begins_word(c) || is_digit(c) || c == '\''; }
bool is_blank(char c) { return c == ' ' || c == '\n'; }

class Tokenizer {
 public:
  explicit Tokenizer(std::string_view text) : text_(text) {}

  std::vector<CoqToken> all() {
    while (at_ < text_.size()) {
      if (is_blank(text_[at_]))
        skip_blank();
      else if (text_.substr(at_, 2) == "(*")
        skip_comment();
      else
        add();
    }
    return std::move(tokens_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Rejection("line " + std::to_string(line_) + ": " + what);
  }

  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\n';
  }

  void skip_blank() { line_ += text_[at_++] == '\n'; }

  /// Comments nest. To Coq, a comment does not end between quotation marks.
  void skip_comment() {
    const std::size_t begin = line_;
    std::string_view rest = text_.substr(at_);
    for (int depth = 0;;) {
      const std::string_view two = rest.substr(0, 2);
      if (two == "(*" || two == "*)") {
        depth += two == "(*" ? 1 : -1;
        rest.remove_prefix(2);
        if (depth == 0) break;
      } else if (rest.empty()) {
        line_ = begin;
        fail("this comment has no end");
      } else {
        take_of_comment(rest);
      }
    }
    at_ = text_.size() - rest.size();
  }

  void take_of_comment(std::string_view& rest) {
    const char32_t c = take_character(rest);
    if (c == '\n')
      ++line_;
    else if (c == '"' || !is_plain_character(c))
      fail("a comment has a quotation mark, or a character that may hide text");
  }

  void add() {
    const std::size_t begin = at_;
    const Kind kind = skip_token();
    tokens_.push_back({kind, text_.substr(begin, at_ - begin), line_});
  }

  Kind skip_token() {
    if (begins_word(peek())) {
      skip_word();
      return Kind::kWord;
    }
    if (is_digit(peek())) {
      skip_number();
      if (is_part_of_word(peek())) fail("a number stands beside a word");
      return Kind::kNumber;
    }
    if (peek() == '.') {
      if (!is_blank(peek(1))) fail("a period is followed by neither a space nor a new line");
      ++at_;
      return Kind::kPeriod;
    }
    skip_symbol();
    return Kind::kSymbol;
  }

  void skip_word() {
    while (at_ < text_.size() && is_part_of_word(text_[at_])) ++at_;
  }

  void skip_digits(bool are_hexadecimal) {
    const auto is_part = [&](char c) {
      return is_digit(c) || (are_hexadecimal && 'a' <= c && c <= 'f');
    };
    while (is_part(peek())) ++at_;
  }

  void skip_number() {
    const bool is_hexadecimal = peek() == '0' && peek(1) == 'x';
    if (is_hexadecimal) at_ += 2;
    skip_digits(is_hexadecimal);
    if (peek() == '.' && !is_blank(peek(1))) {
      ++at_;
      skip_digits(is_hexadecimal);
    }
    if (peek() != (is_hexadecimal ? 'p' : 'e')) return;
    ++at_;
    if (peek() == '-' || peek() == '+') ++at_;
    if (!is_digit(peek())) fail("the exponent of a number has no digits");
    skip_digits(false);
  }

  /// Coq takes the longest symbol that it knows; these are the only ones of two characters.
  void skip_symbol() {
    constexpr std::string_view kSingle = "()[]{};,:+-*/^%=<>";
    for (const std::string_view two : {":=", "=>", "->", "<=", "/\\"})
      if (text_.substr(at_, 2) == two) {
        at_ += 2;
        return;
      }
    if (kSingle.find(peek()) == std::string_view::npos)
      fail("a character that has no meaning in a plain file");
    ++at_;
  }

  const std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  std::vector<CoqToken> tokens_;
};

}  // namespace

bool is_plain_character(char32_t c) noexcept {
  // Latin, Greek and Cyrillic letters, and the signs before them; U+00AD is a hyphen that is not seen.
  return (c >= U' ' && c <= U'~') || (c >= 0xA1 && c < 0x530 && c != 0xAD);
}

char32_t take_character(std::string_view& text) noexcept {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const auto is_later = [&](std::size_t i) {
    return i < text.size() && (byte(i) & 0xC0U) == 0x80U;
  };
  char32_t c = first < 0x80 ? first : 0;
  std::size_t length = 1;
  if (first >= 0xC2 && first < 0xE0 && is_later(1)) {
    c = (first & 0x1FU) << 6U | (byte(1) & 0x3FU);
    length = 2;
  }
  text.remove_prefix(length);
  return c;
}

std::vector<CoqToken> coq_tokens(std::string_view text) { return Tokenizer(text).all(); }

std::string joined(const std::vector<CoqToken>& tokens) {
  std::string text;
  for (const CoqToken& token : tokens) {
    if (!text.empty()) text += ' ';
    text += token.text;
  }
  return text;
}

}  // namespace regulus::verifier
