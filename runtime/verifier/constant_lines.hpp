// SPDX-License-Identifier: Apache-2.0
// Reads lines of a certificate whose values are constant expressions.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// All functions throw Rejection for a line that is not the expected one.
class ConstantLines {
 public:
  /// Both must outlive this object.
  ConstantLines(Lines& lines, Question& question) : lines_(lines), q_(question) {}

  void advance();
  /// Returns true if the current line is `key` alone, or begins with it and a space.
  [[nodiscard]] bool is(std::string_view key) const;
  /// Returns the text after `key` and a space, which the current line must have.
  [[nodiscard]] std::string_view rest_of(std::string_view key) const;
  /// Returns rest_of(key), and goes to the next line.
  [[nodiscard]] std::string take(std::string_view key);
  /// Returns the texts before and after `mark` in rest_of(key).
  [[nodiscard]] std::pair<std::string_view, std::string_view> two_parts(
      std::string_view key, std::string_view mark) const;
  /// Returns the node of a text, and records it as the stated value "KIND NAME" or "KIND NUMBER".
  [[nodiscard]] NodeId constant(const char* kind, std::string_view name, std::string_view text);
  /// The same of an expression with names.
  [[nodiscard]] NodeId expression(const char* kind, std::string_view name, std::string_view text,
                                  const Scope& scope);
  [[nodiscard]] NodeId constant(const char* kind, std::size_t number, std::string_view text) {
    return constant(kind, std::to_string(number), text);
  }
  /// Reads `count` lines `KEY E`, from the current one on; "KEY I" are their stated values.
  [[nodiscard]] std::vector<NodeId> list(const char* key, std::size_t count);
  /// Reads the lines `wrench`, one for each column, and `wrench-ball`, from the current one on.
  void read_set(VectorSetLines& set);

 private:
  void read_ball(VectorSetLines& set);

  Lines& lines_;
  Question& q_;
};

}  // namespace regulus::verifier
