// SPDX-License-Identifier: Apache-2.0
// What the expressions of certificates and of model files have in common: sums of products of
// factors, calls of functions, marks between white space.
#pragma once

#include "runtime/certificate/verifier/expression.hpp"

namespace regulus::verifier {

// The classifications of <cctype> depend on the locale.
inline bool is_digit(char c) noexcept { return '0' <= c && c <= '9'; }
inline bool is_letter(char c) noexcept { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }

/// Recursive descent. A factor is what a language says.
class InfixReader {
 protected:
  InfixReader(std::string_view text, Graph& graph) : text_(text), graph_(graph) {}
  ~InfixReader() = default;

  /// All of the text, which does not begin with white space.
  [[nodiscard]] NodeId all();
  [[nodiscard]] NodeId sum();
  /// The function is called with what comes up to the closing parenthesis.
  [[nodiscard]] NodeId call(Op function);

  /// Takes a mark, and the white space after it, if it is next.
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
