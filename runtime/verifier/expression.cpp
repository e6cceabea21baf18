// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/expression.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/proof/format.hpp"
#include "runtime/verifier/infix_reader.hpp"

namespace regulus::verifier {
namespace {

constexpr std::array<std::pair<std::string_view, Op>, 11> kFunctions = {{{"sqrt", Op::kSqrt},
                                                                         {"sin", Op::kSin},
                                                                         {"cos", Op::kCos},
                                                                         {"tan", Op::kTan},
                                                                         {"asin", Op::kAsin},
                                                                         {"acos", Op::kAcos},
                                                                         {"atan", Op::kAtan},
                                                                         {"exp", Op::kExp},
                                                                         {"log", Op::kLog},
                                                                         {"abs", Op::kAbs},
                                                                         {"atan2", Op::kAtan2}}};

/// A parser by recursive descent, at most format::kMostNesting deep.
class Parser final : InfixReader {
 public:
  Parser(std::string_view text, const Scope& scope, Graph& graph)
      : InfixReader(text, graph), scope_(scope) {}

  using InfixReader::all;

 private:
  NodeId factor() override {
    if (take('-')) {
      if (++depth_ > format::kMostNesting) fail("fewer levels");
      const NodeId operand = factor();
      --depth_;
      return graph_.add(Op::kNegate, operand);
    }
    const NodeId base = primary();
    if (!take('^')) return base;
    const int exponent = integer();
    return exponent == 1 ? base : graph_.add(Op::kPower, base, exponent);
  }

  int integer() {
    int value = 0;
    const std::size_t begin = at_;
    for (; at_ < text_.size() && is_digit(text_[at_]); ++at_) {
      value = 10 * value + (text_[at_] - '0');
      if (value > format::kMostPower) fail("a smaller exponent");
    }
    if (at_ == begin || value == 0) fail("a positive integer as exponent");
    skip_space();
    return value;
  }

  NodeId primary() {
    if (++depth_ > format::kMostNesting) fail("fewer levels");
    NodeId result;
    if (take('(')) {
      result = sum();
      expect(')');
    } else if (is_at_number()) {
      result = number();
    } else {
      result = named();
    }
    --depth_;
    return result;
  }

  NodeId number() {
    const std::size_t begin = at_;
    skip_digits();
    if (at_ < text_.size() && text_[at_] == '.') ++at_, skip_digits();
    if (at_ < text_.size() && text_[at_] == 'e') {
      ++at_;
      if (at_ < text_.size() && (text_[at_] == '-' || text_[at_] == '+')) ++at_;
      skip_digits();
    }
    const NodeId result = graph_.number(text_.substr(begin, at_ - begin));
    skip_space();
    return result;
  }

  NodeId named() {
    std::size_t end = at_;
    while (end < text_.size() &&
           (is_letter(text_[end]) || is_digit(text_[end]) || text_[end] == '_'))
      ++end;
    const std::string_view name = text_.substr(at_, end - at_);
    if (!is_name(name)) fail("a number, a name or a parenthesis");
    at_ = end;
    skip_space();
    if (take('(')) {
      if (!is_reserved(name) || name == "pi") fail("a function, not " + std::string(name));
      return call(function_named(name));
    }
    if (name == "pi") return graph_.add(Op::kPi);
    const auto found = scope_.find(name);
    if (found == scope_.end()) fail("a name that is declared, not " + std::string(name));
    return found->second;
  }

  bool is_space(char c) const override { return c == ' '; }

  [[noreturn]] void fail(const std::string& expected) const override {
    throw Rejection("in an expression, at character " + std::to_string(at_ + 1) + ": expected " +
                    expected);
  }

  const Scope& scope_;
  int depth_ = 0;
};

/// Returns a decimal as digits·10^exponent. Throws Rejection.
std::pair<std::string, long> decimal_parts(std::string_view text) {
  const std::size_t e = std::min(text.find('e'), text.size());
  std::string digits(text.substr(0, e));
  long exponent = 0;
  if (e < text.size()) {
    const std::string written(text.substr(e + 1));
    if (written.empty() || !is_digit(written.back()) || written.size() > 6)
      throw Rejection("a number with the exponent '" + written + "'");
    exponent = std::stol(written);
  }
  if (const std::size_t dot = digits.find('.'); dot != std::string::npos) {
    exponent -= long(digits.size() - dot - 1);
    digits.erase(dot, 1);
  }
  if (digits.empty() || digits.size() > format::kMostDigits ||
      std::abs(exponent) > long(format::kMostDigits))
    throw Rejection("a number without digits, or with more than " +
                    std::to_string(format::kMostDigits));
  return {digits, exponent};
}

}  // namespace

/// Most bits of all folded results together. Beyond it, operations on constants are kept.
constexpr std::size_t kMostFoldedBits = std::size_t{1} << 24;

/// Computes exactly, so a quotient of integers beyond the range of doubles keeps its value.
std::optional<Rational> Graph::folded(Op op, int a, int b) const {
  const auto constant = [this](int node) -> const Rational* {
    const Node& n = nodes_[std::size_t(node)];
    return n.op == Op::kConstant ? &rational(n.a) : nullptr;
  };
  if (operands(op) == 0 || folded_bits_ > kMostFoldedBits) return std::nullopt;
  const Rational* const x = constant(a);
  const Rational* const y = operands(op) > 1 ? constant(b) : x;
  if (x == nullptr || y == nullptr) return std::nullopt;
  switch (op) {
    case Op::kNegate:
      return *x * Rational(-1);
    case Op::kAdd:
      return *x + *y;
    case Op::kSubtract:
      return *x - *y;
    case Op::kMultiply:
      return *x * *y;
    case Op::kDivide:
      return y->is_zero() ? std::nullopt : std::optional(*x / *y);
    default:
      return std::nullopt;
  }
}

NodeId Graph::add(Op op, int a, int b) {
  if (const auto value = folded(op, a, b)) {
    folded_bits_ += value->bits();
    return number(*value);
  }
  const auto [place, is_new] = known_.try_emplace({op, a, b}, NodeId(nodes_.size()));
  if (!is_new) return place->second;
  int depth = 0;
  if (operands(op) > 0) depth = depth_[std::size_t(a)] + 1;
  if (operands(op) > 1) depth = std::max(depth, depth_[std::size_t(b)] + 1);
  if (nodes_.size() >= format::kMostNodes || depth > format::kDeepestNode) {
    if (is_read_) throw Unfinished("the proof takes too many operations");
    throw Rejection("more operations than are allowed");
  }
  nodes_.push_back({op, a, b});
  depth_.push_back(depth);
  return place->second;
}

void Graph::renumber_variables(const std::vector<int>& numbers) {
  std::vector<NodeId> variables;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].op == Op::kVariable) variables.push_back(NodeId(i));
  for (const NodeId id : variables) known_.erase({Op::kVariable, nodes_[std::size_t(id)].a, 0});
  for (const NodeId id : variables) {
    int& number = nodes_[std::size_t(id)].a;
    number = numbers.at(std::size_t(number));
    known_.emplace(std::tuple{Op::kVariable, number, 0}, id);
  }
}

NodeId Graph::number(std::string_view text) {
  if (const auto known = numbers_.find(text); known != numbers_.end()) return known->second;
  const auto [digits, exponent] = decimal_parts(text);
  Rational& value = rationals_.emplace_back();
  Rational ten;
  fmpz_set_str(fmpq_numref(value.get()), digits.c_str(), 10);
  fmpq_set_si(ten.get(), 10, 1);
  fmpq_pow_si(ten.get(), ten.get(), exponent);
  fmpq_mul(value.get(), value.get(), ten.get());
  const NodeId node = add(Op::kConstant, int(rationals_.size()) - 1);
  numbers_.emplace(text, node);
  return node;
}

NodeId Graph::number(const Rational& value) {
  const std::string text = value.text();
  if (const auto known = numbers_.find(text); known != numbers_.end()) return known->second;
  rationals_.push_back(value);
  const NodeId node = add(Op::kConstant, int(rationals_.size()) - 1);
  numbers_.emplace(text, node);
  return node;
}

NodeId parse(std::string_view text, const Scope& scope, Graph& graph) {
  return Parser(text, scope, graph).all();
}

bool is_name(std::string_view text) noexcept {
  if (text.empty() || text.size() > format::kLongestName || !is_letter(text[0])) return false;
  for (const char c : text)
    if (!is_letter(c) && !is_digit(c) && c != '_') return false;
  return true;
}

bool is_reserved(std::string_view text) noexcept {
  for (const auto& [name, op] : kFunctions)
    if (text == name) return true;
  return text == "pi";
}

Op function_named(std::string_view text) noexcept {
  for (const auto& [name, op] : kFunctions)
    if (text == name) return op;
  return Op::kPi;
}

}  // namespace regulus::verifier
