// SPDX-License-Identifier: Apache-2.0
// The grammar that expressions of certificates and of model files share: sums of products of
// factors, calls of functions, and single characters between white space.
#pragma once

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

// These do not depend on the locale, as the classifications of <cctype> do.
inline bool is_digit(char c) noexcept { return '0' <= c && c <= '9'; }
inline bool is_letter(char c) noexcept { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }
inline bool is_of_name(char c) noexcept { return is_letter(c) || is_digit(c) || c == '_'; }

/// Returns true if a name stands in a text as a word.
[[nodiscard]] bool mentions(std::string_view text, std::string_view name);

/// A parser by recursive descent. The derived class defines what a factor is.
class InfixReader {
 protected:
  InfixReader(std::string_view text, Graph& graph) : text_(text), graph_(graph) {}
  ~InfixReader() = default;

  /// Reads all of the text, which must not begin with white space.
  [[nodiscard]] NodeId all();
  [[nodiscard]] NodeId sum();
  /// Reads the arguments of a function, up to the closing parenthesis, and adds the call.
  [[nodiscard]] NodeId call(Op function);

  /// If the next character is `c`, takes it and the white space after it.
  [[nodiscard]] bool take(char c);
  void expect(char c);
  void skip_space();
  void skip_digits();
  [[nodiscard]] bool is_at_number() const;

  virtual NodeId factor() = 0;
  [[nodiscard]] virtual bool is_space(char c) const = 0;
  [[noreturn]] virtual void fail(const std::string& expected) const = 0;

  const std::string_view text_;
  Graph& graph_;
  std::size_t at_ = 0;

 private:
  [[nodiscard]] NodeId product();
};

}  // namespace regulus::verifier
