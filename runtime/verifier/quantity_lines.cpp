// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/quantity_lines.hpp"

#include <fmpq_mat.h>

#include <algorithm>
#include <cstdio>

#include "runtime/verifier/constant_lines.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfDecimal = 128;

bool is_word_of(std::string_view word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Returns det ≠ 0 of a square matrix.
bool is_regular(const std::vector<Rational>& matrix, std::size_t order) {
  fmpq_mat_t entries;
  fmpq_t determinant;
  fmpq_mat_init(entries, slong(order), slong(order));
  fmpq_init(determinant);
  for (std::size_t e = 0; e < matrix.size(); ++e)
    fmpq_set(fmpq_mat_entry(entries, slong(e / order), slong(e % order)), matrix[e].get());
  fmpq_mat_det(determinant, entries);
  const bool result = fmpq_is_zero(determinant) == 0;
  fmpq_clear(determinant);
  fmpq_mat_clear(entries);
  return result;
}

/// True if the last parameter has the name r and is a pose parameter, and its range begins at 0 or is
/// its own mirror image: earlier versions wrote the matrix of a bound in this way.
bool is_bound_without_claim(const Question& q) {
  const Variable* last = nullptr;
  for (const Variable& v : q.variables)
    if (v.kind == VariableKind::kParameter) last = &v;
  if (q.load || last == nullptr || last->name.find_first_not_of('_', 1) != std::string::npos ||
      last->name.front() != 'r')
    return false;
  const auto pose = q.stated.find("pose " + last->name);
  return pose != q.stated.end() && pose->second.text == last->name &&
         (is_zero_number(q.graph, last->lo) ||
          q.stated.at("lower " + last->name).text == '-' + q.stated.at("upper " + last->name).text);
}

class QuantityReader {
 public:
  QuantityReader(Lines& lines, Question& q)
      : lines_(lines, q), q_(q), quantity_(q.quantity.emplace()) {}

  void read() {
    if (q_.has_threshold) throw Rejection("a bound of a quantity has no threshold");
    quantity_.kind = lines_.take("quantity");
    words_.quantity = quantity_.kind;
    read_side();
    if (is_of({format::kForce, format::kSpeed, format::kCondition})) read_row();
    if (is_of({format::kError, format::kDeflection, format::kCondition})) read_columns();
    if (is_of({format::kForce, format::kSpeed, format::kDeflection})) read_set();
    if (is_of({format::kError})) quantity_.errors = lines_.list("motor-error", q_.rows);
    if (is_of({format::kDeflection})) read_stiffness();
    if (is_of({format::kSigmaMin, format::kSigmaMax, format::kCondition, format::kCondition2}))
      quantity_.factors = lines_.list("factor", q_.columns);
    if (is_of({format::kSigmaMin, format::kDeflection}) && lines_.is("combined")) read_combined();
    if (is_of({format::kExpression})) read_expression();
    read_bound();
    require_shape();
    quantity_.claim = format::describe_bound_claim(q_.claimed_set(), words_, q_.singular);
  }

 private:
  [[nodiscard]] bool is_of(std::initializer_list<const char*> kinds) const {
    return is_word_of(quantity_.kind, kinds);
  }

  /// Only some sides of a quantity have a meaning.
  void read_side() {
    quantity_.side = words_.side = lines_.take("side");
    const bool is_signed =
        is_of({format::kForce, format::kSpeed, format::kDeflection, format::kDeterminantMax});
    bool is_known = false;
    if (quantity_.side == format::kAbsolute)
      is_known = is_signed || is_of({format::kError});
    else if (quantity_.side == format::kLargest)
      is_known = is_signed || is_of({format::kError, format::kSigmaMax, format::kCondition,
                                     format::kCondition2, format::kExpression});
    else if (quantity_.side == format::kLeast)
      is_known = is_signed || is_of({format::kSigmaMin, format::kDeterminant, format::kExpression});
    if (!is_known)
      throw Rejection("there is no quantity '" + quantity_.kind.substr(0, 40) +
                      "' with the side '" + quantity_.side.substr(0, 40) + "'");
  }

  static std::size_t number_from_one(std::string_view word, std::size_t most) {
    const std::size_t number = read_count(word, most);
    if (number == 0) throw Rejection("rows and columns have numbers from 1");
    return number - 1;
  }

  void read_row() {
    words_.row = lines_.take("row");
    quantity_.row = number_from_one(words_.row, q_.rows);
  }

  /// Several columns are those of a norm.
  void read_columns() {
    words_.columns = lines_.take("column");
    for (const std::string_view word : words_of(words_.columns)) {
      const std::size_t column = number_from_one(word, q_.columns);
      if (!quantity_.columns.empty() && quantity_.columns.back() >= column)
        throw Rejection("the columns have rising numbers");
      quantity_.columns.push_back(column);
    }
    if (is_of({format::kError}) != (quantity_.columns.size() > 1) && quantity_.columns.size() > 1)
      throw Rejection("only an error has several components");
    if (is_of({format::kError}) &&
        (quantity_.columns.size() > 1) != (quantity_.side == format::kLargest))
      throw Rejection("an error is a norm with the side 'largest', or a component with 'absolute'");
  }

  void read_set() {
    const bool is_speed = is_of({format::kSpeed});
    const std::string_view key = is_speed ? "twist" : "load";
    quantity_.set_kind = key;
    VectorSetLines& set = quantity_.set.emplace();
    set.name = words_.set = lines_.take(key);
    if (!is_label(set.name)) throw Rejection("the name of the load or the twist is not a name");
    lines_.read_set(set);
    require_one_spread(set);
    if (is_speed && lines_.is("norms")) {
      quantity_.has_norms = true;
      lines_.advance();
    }
  }

  void read_stiffness() {
    for (std::size_t i = 0; i < q_.rows; ++i) {
      const std::string_view text = lines_.rest_of("stiffness");
      const bool is_rigid = text == format::kRigid;
      quantity_.stiffness.push_back(is_rigid ? kNoNode : lines_.constant("stiffness", i, text));
      lines_.advance();
    }
  }

  /// A component has a spread, or is in one ball, or neither.
  void require_one_spread(const VectorSetLines& set) const {
    std::vector<bool> is_used(q_.columns);
    for (std::size_t j = 0; j < q_.columns; ++j) is_used[j] = !is_zero(set.spread[j]);
    for (const WrenchBall& ball : set.balls)
      for (const std::size_t j : ball.members) {
        if (is_used[j]) throw Rejection("a component has two spreads");
        is_used[j] = true;
      }
  }

  /// Reads the rows of a regular matrix of rational numbers.
  void read_combined() {
    for (std::size_t i = 0; i < q_.rows; ++i) {
      const std::string line = lines_.take("combined");
      const auto words = words_of(line);
      if (words.size() != q_.rows)
        throw Rejection("expected " + std::to_string(q_.rows) + " numbers after 'combined'");
      for (const std::string_view word : words) {
        const Node node = q_.graph.nodes()[std::size_t(parse(word, {}, q_.graph))];
        if (node.op != Op::kConstant) throw Rejection("a combination has rational numbers");
        quantity_.combined.push_back(q_.graph.rational(node.a));
      }
    }
    if (!is_regular(quantity_.combined, q_.rows))
      throw Rejection("the combination of columns is singular");
  }

  void read_expression() {
    words_.expression = lines_.take("expression");
    quantity_.expression = parse(words_.expression, q_.actual, q_.graph);
    while (lines_.is("expression-defined"))
      quantity_.expression_defined.push_back(
          parse(lines_.take("expression-defined"), q_.actual, q_.graph));
  }

  void read_bound() {
    const std::string reference = lines_.take("reference");
    quantity_.reference = parse(reference, {}, q_.graph);
    const bool is_free = quantity_.side != format::kAbsolute &&
                         is_of({format::kForce, format::kSpeed, format::kDeflection,
                                format::kDeterminantMax, format::kExpression});
    if (!is_free && !is_zero(quantity_.reference))
      throw Rejection("this quantity has the reference 0");
    if (lines_.is("unbounded") && q_.singular) {
      const bool needs_inverse = is_of({format::kForce, format::kError, format::kDeflection,
                                        format::kCondition, format::kCondition2});
      if (!needs_inverse) throw Rejection("this quantity has a value where the matrix is singular");
      return lines_.advance();
    }
    words_.bound = lines_.take("bound");
    quantity_.bound = parse(words_.bound, {}, q_.graph);
  }

  /// Only the speed of a motor, singular values, their ratio and expressions need no inverse.
  void require_shape() const {
    const bool any_shape = is_of({format::kSpeed, format::kSigmaMin, format::kSigmaMax,
                                  format::kCondition2, format::kExpression});
    if (!any_shape && q_.rows != q_.columns)
      throw Rejection("the matrix is not square, so it has no inverse");
  }

  [[nodiscard]] bool is_zero(NodeId node) const { return is_zero_number(q_.graph, node); }

  ConstantLines lines_;
  Question& q_;
  QuantityLines& quantity_;
  format::ClaimedBound words_;
};

}  // namespace

void read_quantity_lines(Lines& lines, Question& question) {
  QuantityReader(lines, question).read();
}

bool is_label(std::string_view text) {
  const auto is_part = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  return !text.empty() && text.size() <= format::kLongestName &&
         std::all_of(text.begin(), text.end(), is_part);
}

void describe_bound(const Question& q, Verification& result) {
  if (!q.quantity) {
    if (is_bound_without_claim(q))
      result.bound = "no number is proved: the claim is about the matrix of the file alone";
    return;
  }
  if (q.quantity->bound == kNoNode) return;
  const auto value = evaluate(q.graph, {q.quantity->bound}, {}, kBitsOfDecimal);
  if (!value) return;
  char text[64];
  std::snprintf(text, sizeof text, "about %.9g", mid((*value)[0].enclosure()));
  result.bound = text;
}

bool is_zero_number(const Graph& graph, NodeId node) {
  const Node& n = graph.nodes()[std::size_t(node)];
  return n.op == Op::kConstant && graph.rational(n.a).is_zero();
}

bool is_symmetric(const Graph& graph, const VectorSetLines& set) {
  return std::all_of(set.middle.begin(), set.middle.end(),
                     [&](NodeId middle) { return is_zero_number(graph, middle); });
}

}  // namespace regulus::verifier
