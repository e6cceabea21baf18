// SPDX-License-Identifier: Apache-2.0
#include "regulus/certificate/verifier/model_expression.hpp"

#include <cstdlib>

#include "regulus/certificate/format.hpp"
#include "regulus/certificate/verifier/algebra.hpp"

namespace regulus::verifier {
namespace {

bool is_digit(char c) noexcept { return '0' <= c && c <= '9'; }
bool is_letter(char c) noexcept { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }
bool is_space(char c) noexcept { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class ModelParser {
 public:
  ModelParser(std::string_view text, const NameMeaning& meaning, Graph& graph, int& depth)
      : text_(text), meaning_(meaning), graph_(graph), depth_(depth) {}

  NodeId whole() {
    skip();
    const NodeId result = sum();
    if (at_ != text_.size()) fail("an operator or the end");
    return result;
  }

 private:
  NodeId sum() {
    NodeId left = product();
    for (;;) {
      if (take('+'))
        left = graph_.add(Op::kAdd, left, product());
      else if (take('-'))
        left = graph_.add(Op::kSubtract, left, product());
      else
        return left;
    }
  }

  NodeId product() {
    NodeId left = factor();
    for (;;) {
      if (take('*'))
        left = graph_.add(Op::kMultiply, left, factor());
      else if (take('/'))
        left = graph_.add(Op::kDivide, left, factor());
      else
        return left;
    }
  }

  NodeId factor() {
    if (++depth_ > format::kMostNesting) fail("fewer levels");
    NodeId result;
    if (take('-'))
      result = graph_.add(Op::kNegate, factor());
    else if (take('+'))
      result = factor();
    else
      result = power();
    --depth_;
    return result;
  }

  NodeId power() {
    const NodeId base = primary();
    return take('^') ? raised(base, factor()) : base;
  }

  /// Whole and half exponents by multiplication and roots, others by exponential and logarithm.
  NodeId raised(NodeId base, NodeId exponent) {
    const auto value = exact_value(graph_, exponent);
    const Rational twice = value ? *value * Rational(2) : Rational();
    if (!value || !twice.is_integer() ||
        fmpz_cmpabs(fmpq_numref(twice.get()), fmpq_numref(Rational(format::kMostPower).get())) > 0)
      return graph_.add(Op::kExp, graph_.add(Op::kMultiply, exponent, graph_.add(Op::kLog, base)));
    const long halves = fmpz_get_si(fmpq_numref(twice.get()));
    if (halves == 0) return graph_.number("1");
    const bool is_whole = halves % 2 == 0;
    const long times = std::labs(is_whole ? halves / 2 : halves);
    NodeId result = is_whole ? base : graph_.add(Op::kSqrt, base);
    if (times > 1) result = graph_.add(Op::kPower, result, int(times));
    return halves < 0 ? graph_.add(Op::kDivide, graph_.number("1"), result) : result;
  }

  NodeId primary() {
    if (take('(')) {
      const NodeId result = sum();
      expect(')');
      return result;
    }
    if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return number();
    return named();
  }

  NodeId number() {
    std::string digits;
    const auto copy_digits = [&] {
      while (at_ < text_.size() && is_digit(text_[at_])) digits += text_[at_++];
    };
    copy_digits();
    if (at_ < text_.size() && text_[at_] == '.') digits += text_[at_++];
    copy_digits();
    const std::size_t end = at_;
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      std::string exponent(1, 'e');
      ++at_;
      if (at_ < text_.size() && (text_[at_] == '-' || text_[at_] == '+')) exponent += text_[at_++];
      const std::size_t first = at_;
      while (at_ < text_.size() && is_digit(text_[at_])) exponent += text_[at_++];
      // "2e" is 2 and a name that is refused.
      if (at_ == first)
        at_ = end;
      else
        digits += exponent;
    }
    skip();
    return graph_.number(digits);
  }

  NodeId named() {
    std::size_t end = at_;
    while (end < text_.size() &&
           (is_letter(text_[end]) || (end > at_ && (is_digit(text_[end]) || text_[end] == '_'))))
      ++end;
    const std::string_view name = text_.substr(at_, end - at_);
    if (name.empty()) fail("a number, a name or a parenthesis");
    at_ = end;
    skip();
    if (name == "pi") return graph_.add(Op::kPi);
    if (name == "deg") return graph_.add(Op::kDivide, graph_.add(Op::kPi), graph_.number("180"));
    if (is_reserved(name)) return call(name);
    return meaning_(name);
  }

  NodeId call(std::string_view name) {
    expect('(');
    const NodeId first = sum();
    NodeId second = 0;
    const Op op = function_named(name);
    if (op == Op::kAtan2) {
      expect(',');
      second = sum();
    }
    expect(')');
    return graph_.add(op, first, second);
  }

  bool take(char c) {
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    skip();
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail(std::string(1, c));
  }
  void skip() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }
  [[noreturn]] void fail(const std::string& expected) const {
    throw Unfinished("at character " + std::to_string(at_ + 1) + " of '" +
                     std::string(text_.substr(0, 200)) + "': expected " + expected);
  }

  std::string_view text_;
  const NameMeaning& meaning_;
  Graph& graph_;
  std::size_t at_ = 0;
  int& depth_;
};

}  // namespace

NodeId parse_model_expression(std::string_view text, const NameMeaning& meaning, Graph& graph,
                              int& depth) {
  const int before = depth;
  const NodeId result = ModelParser(text, meaning, graph, depth).whole();
  depth = before;
  return result;
}

}  // namespace regulus::verifier
