// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/model_expression.hpp"

#include <cstdlib>

#include "runtime/proof/format.hpp"
#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/infix_reader.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostRoots = 13;

class ModelParser final : InfixReader {
 public:
  ModelParser(std::string_view text, const NameMeaning& meaning, Graph& graph, int& depth,
              const std::set<std::string, std::less<>>& degrees, bool is_in_degrees)
      : InfixReader(text, graph),
        meaning_(meaning),
        depth_(depth),
        degrees_(degrees),
        is_in_degrees_(is_in_degrees) {}

  NodeId whole() {
    skip_space();
    return all();
  }

 private:
  NodeId factor() override {
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

  /// Uses multiplication and roots of roots if the denominator is a power of two, exp and log for
  /// other exponents.
  NodeId raised(NodeId base, NodeId exponent) {
    const auto value = exact_value(graph_, exponent);
    Rational times = value ? *value : Rational();
    int roots = 0;
    for (; !times.is_integer() && roots < kMostRoots; ++roots) times = times * Rational(2);
    if (!value || !times.is_integer() ||
        fmpz_cmpabs(fmpq_numref(times.get()), fmpq_numref(Rational(format::kMostPower).get())) > 0)
      return graph_.add(Op::kExp, graph_.add(Op::kMultiply, exponent, graph_.add(Op::kLog, base)));
    const long power = fmpz_get_si(fmpq_numref(times.get()));
    if (power == 0) return graph_.number("1");
    NodeId result = base;
    for (int i = 0; i < roots; ++i) result = graph_.add(Op::kSqrt, result);
    if (std::labs(power) > 1) result = graph_.add(Op::kPower, result, int(std::labs(power)));
    return power < 0 ? graph_.add(Op::kDivide, graph_.number("1"), result) : result;
  }

  NodeId primary() {
    if (take('(')) {
      const NodeId result = sum();
      expect(')');
      return result;
    }
    if (is_at_number()) return number();
    return named();
  }

  NodeId number() {
    const std::size_t begin = at_;
    skip_digits();
    if (at_ < text_.size() && text_[at_] == '.') ++at_, skip_digits();
    std::string digits(text_.substr(begin, at_ - begin));
    const std::size_t end = at_;
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      ++at_;
      if (at_ < text_.size() && (text_[at_] == '-' || text_[at_] == '+')) ++at_;
      const std::size_t first = at_;
      skip_digits();
      // "2e" is the number 2 and a name, which is refused.
      if (at_ == first)
        at_ = end;
      else
        digits.append("e").append(text_.substr(end + 1, at_ - end - 1));
    }
    skip_space();
    const NodeId value = graph_.number(digits);
    if (!take_degree_sign()) return value;
    return graph_.add(Op::kMultiply, value, degree());
  }

  /// Takes `deg` or the degree sign after a number.
  bool take_degree_sign() {
    constexpr std::string_view kSign = "°", kWord = "deg";
    const std::string_view rest = text_.substr(at_);
    const std::size_t end = at_ + kWord.size();
    const bool is_word = rest.starts_with(kWord) &&
                         (end == text_.size() ||
                          !(is_letter(text_[end]) || is_digit(text_[end]) || text_[end] == '_'));
    if (!is_word && !rest.starts_with(kSign)) return false;
    at_ += is_word ? kWord.size() : kSign.size();
    skip_space();
    return true;
  }

  [[nodiscard]] bool is_among_degrees() const { return is_in_degrees_ && circular_calls_ == 0; }
  NodeId angle_of_one_degree() {
    return graph_.add(Op::kDivide, graph_.add(Op::kPi), graph_.number("180"));
  }
  NodeId degree() { return is_among_degrees() ? graph_.number("1") : angle_of_one_degree(); }

  NodeId named() {
    std::size_t end = at_;
    while (end < text_.size() &&
           (is_letter(text_[end]) || (end > at_ && (is_digit(text_[end]) || text_[end] == '_'))))
      ++end;
    const std::string_view name = text_.substr(at_, end - at_);
    if (name.empty()) fail("a number, a name or a parenthesis");
    at_ = end;
    skip_space();
    if (name == "pi") return graph_.add(Op::kPi);
    if (name == "deg") return degree();
    if (is_reserved(name)) {
      expect('(');
      const bool is_circular = name == "sin" || name == "cos" || name == "tan";
      circular_calls_ += is_circular;
      const NodeId result = call(function_named(name));
      circular_calls_ -= is_circular;
      return result;
    }
    const NodeId value = meaning_(name);
    if (!degrees_.contains(name) || is_among_degrees()) return value;
    return graph_.add(Op::kMultiply, value, angle_of_one_degree());
  }

  bool is_space(char c) const override { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  [[noreturn]] void fail(const std::string& expected) const override {
    throw Unfinished("at character " + std::to_string(at_ + 1) + " of '" +
                     std::string(text_.substr(0, 200)) + "': expected " + expected);
  }

  const NameMeaning& meaning_;
  int& depth_;
  const std::set<std::string, std::less<>>& degrees_;
  const bool is_in_degrees_;
  int circular_calls_ = 0;  ///< of sin, cos or tan around the current character
};

}  // namespace

NodeId parse_model_expression(std::string_view text, const NameMeaning& meaning, Graph& graph,
                              int& depth, const std::set<std::string, std::less<>>& degrees,
                              bool is_in_degrees) {
  const int before = depth;
  const NodeId result = ModelParser(text, meaning, graph, depth, degrees, is_in_degrees).whole();
  depth = before;
  return result;
}

}  // namespace regulus::verifier
