// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_way.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/verifier/expression.hpp"
#include "runtime/verifier/infix_reader.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/rational.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostDecimals = 30;  ///< after the point

/// a + b·π
struct Number {
  Rational a, b;
};

Number operator+(const Number& x, const Number& y) { return {x.a + y.a, x.b + y.b}; }
bool operator==(const Number& x, const Number& y) { return x.a == y.a && x.b == y.b; }

/// Returns the value of an expression; nullopt if it is not such a number.
std::optional<Number> number_of(const Graph& graph, NodeId id) {
  const Node& node = graph.nodes()[std::size_t(id)];
  if (node.op == Op::kConstant) return Number{graph.rational(node.a), Rational(0)};
  if (node.op == Op::kPi) return Number{Rational(0), Rational(1)};
  if (node.op != Op::kNegate && node.op != Op::kMultiply && node.op != Op::kDivide)
    return std::nullopt;
  const auto x = number_of(graph, node.a);
  if (!x) return std::nullopt;
  if (node.op == Op::kNegate) return Number{Rational(0) - x->a, Rational(0) - x->b};
  const auto y = number_of(graph, node.b);
  if (!y) return std::nullopt;
  if (node.op == Op::kDivide) {
    if (!y->b.is_zero() || y->a.is_zero()) return std::nullopt;
    return Number{x->a / y->a, x->b / y->a};
  }
  if (!x->b.is_zero() && !y->b.is_zero()) return std::nullopt;
  return Number{x->a * y->a, x->a * y->b + x->b * y->a};
}

/// Returns the number as a decimal, or as a quotient if it is none with few digits.
std::string decimal(const Rational& value) {
  const bool is_negative = value.sign() < 0;
  Rational whole = is_negative ? Rational(0) - value : value;
  std::size_t digits = 0;
  for (; !whole.is_integer() && digits < kMostDecimals; ++digits) whole = whole * Rational(10);
  if (!whole.is_integer()) return value.text();
  std::string text = whole.text();
  if (text.size() <= digits) text.insert(0, digits + 1 - text.size(), '0');
  if (digits > 0) text.insert(text.size() - digits, ".");
  return (is_negative ? "- " : "") + text;
}

/// Returns nullopt for a sum of a number and a multiple of π.
std::optional<std::string> text_of_number(const Number& number) {
  if (number.b.is_zero()) return decimal(number.a);
  if (!number.a.is_zero()) return std::nullopt;
  return decimal(number.b * Rational(180)) + " * deg";
}

class WayWriter {
 public:
  WayWriter(const Pieces& pieces, const Question& question)
      : pieces_(pieces), along_(question.variables.at(0).name) {
    for (const std::string& line : lines_of(pieces.question_of(0)))
      if (line.starts_with("pose ")) add_pose(line);
    for (std::size_t k = 0; k < pieces.values.size(); ++k) add_piece(k);
  }

  [[nodiscard]] std::string text() const {
    if (const auto points = way_points()) {
      std::string names;
      for (const std::string& pose : poses_) names += (names.empty() ? "" : ", ") + pose;
      return "\n(** The way-points; at each the values of " + coq_comment(names) +
             ". The pieces are the segments between them. *)\nDefinition pieces : list (list "
             "expression) := segments\n  " +
             coq_list(*points, "   ") + ".\n";
    }
    std::vector<CoqItem> items;
    for (std::size_t k = 0; k < texts_.size(); ++k)
      items.push_back({"piece " + std::to_string(k + 1), texts_[k]});
    return "\n(** The pieces of the way, each with its values of " + coq_comment(of_names()) +
           ". *)\nDefinition pieces : list (list expression) :=\n  " + coq_list(items, "   ") +
           ".\n";
  }

 private:
  /// On a straight way each pose parameter moves from its first number by the second one.
  void add_pose(std::string_view line) {
    line.remove_prefix(5);
    const std::string name(take_until(line, " = "));
    const std::string_view expression = take_until(line, " +- ");
    require_no_function(expression);
    const std::size_t next = 2 * poses_.size();
    is_straight_ &=
        next + 1 < pieces_.names.size() &&
        expression == pieces_.names[next] + " + " + along_ + "*" + pieces_.names[next + 1];
    poses_.push_back(name);
  }

  static void require_no_function(std::string_view text) {
    for (std::size_t i = 1; i < text.size(); ++i)
      if (text[i] == '(' && (is_letter(text[i - 1]) || is_digit(text[i - 1])))
        throw Unfinished("there is no theorem about a branch along arcs yet");
  }

  void add_piece(std::size_t k) {
    std::string text;
    std::vector<Number>& numbers = numbers_.emplace_back();
    for (const std::string& value : pieces_.values_of(k)) {
      require_no_function(value);
      const auto number = number_of(graph_, parse(value, {}, graph_));
      if (number) numbers.push_back(*number);
      is_straight_ &= number.has_value();
      text += (text.empty() ? "[" : "; ") + coq_expression(value, {});
    }
    texts_.push_back(text + "]");
  }

  [[nodiscard]] std::string of_names() const {
    std::string text;
    for (const std::string& name : pieces_.names) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  /// Returns nullopt if the way is not straight, or its pieces are not one way.
  [[nodiscard]] std::optional<std::vector<CoqItem>> way_points() const {
    if (!is_straight_ || pieces_.names.size() != 2 * poses_.size()) return std::nullopt;
    std::vector<CoqItem> points;
    for (std::size_t k = 0; k <= numbers_.size(); ++k) {
      std::string point;
      for (std::size_t i = 0; i < poses_.size(); ++i) {
        const auto end = [&](std::size_t piece) {
          return numbers_[piece][2 * i] + numbers_[piece][2 * i + 1];
        };
        const Number number = k < numbers_.size() ? numbers_[k][2 * i] : end(k - 1);
        if (k > 0 && !(end(k - 1) == number)) return std::nullopt;
        const auto text = text_of_number(number);
        if (!text) return std::nullopt;
        point += (i == 0 ? "[" : "; ") + *text;
      }
      points.push_back({"", point + "]"});
    }
    return points;
  }

  const Pieces& pieces_;
  const std::string along_;  ///< the parameter that goes from 0 to 1
  bool is_straight_ = true;
  std::vector<std::string> poses_, texts_;
  std::vector<std::vector<Number>> numbers_;  ///< of each piece, if it is straight
  Graph graph_;
};

}  // namespace

std::string coq_way(const Pieces& pieces, const Question& question) {
  return WayWriter(pieces, question).text();
}

}  // namespace regulus::verifier
