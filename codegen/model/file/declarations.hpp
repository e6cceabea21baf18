// SPDX-License-Identifier: GPL-3.0-or-later
// The names that a model declares: pose parameters, geometry, named sub-expressions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "codegen/model/exact/expression_parser.hpp"

namespace regulus::detail {

class Declarations final : public Names {
 public:
  /// Throws InputError for a text that is not a name, a reserved name, or one declared before.
  void declare(const std::string& name, ParsedExpression meaning, const Place& place);

  /// Declares a sub-expression. It is read at its first use, so declarations may be in any order.
  void declare_expression(const std::string& name, std::string text, const Place& place);

  /// Throws InputError for a cycle of sub-expressions, which it names.
  [[nodiscard]] const ParsedExpression* find(const std::string& name, int depth) override;

  [[nodiscard]] std::vector<std::string> all() const override;

 private:
  enum class State { kUnread, kBeingRead, kRead };
  struct Declaration {
    State state = State::kRead;
    ParsedExpression meaning{};
    std::string text{};
    Place place{};
  };

  void insert(const std::string& name, Declaration declaration);
  [[noreturn]] void refuse_cycle(const std::string& name) const;

  std::map<std::string, Declaration> declarations_;
  std::vector<std::string> being_read_;
};

/// Throws InputError unless `name` is a name that the language of model files does not use itself.
void require_free_name(const std::string& name, const Place& place);

}  // namespace regulus::detail
