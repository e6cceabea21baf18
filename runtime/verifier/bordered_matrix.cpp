// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/bordered_matrix.hpp"

#include <algorithm>

#include "runtime/verifier/determinant_of.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/quantity_lines.hpp"
#include "runtime/verifier/short_terms.hpp"

namespace regulus::verifier {
namespace {

using Nodes = std::vector<NodeId>;

class Border {
 public:
  explicit Border(Question& q) : q_(q), c_(*q.quantity), t_(q.graph) {}

  void build() {
    c_.model_matrix = q_.matrix;
    c_.model_rows = q_.rows;
    c_.model_columns = q_.columns;
    if (c_.kind == format::kDeterminant) return take_threshold();
    A_ = q_.matrix;
    if (c_.kind == format::kCondition2) return is_about_ratio(c_) ? take_ratio() : void();
    sign_ = c_.side == format::kLeast && c_.kind != format::kSigmaMin ? -1 : 1;
    parameters_ =
        std::size_t(std::count_if(q_.variables.begin(), q_.variables.end(), [](const Variable& v) {
          return v.kind == VariableKind::kParameter;
        }));
    errors_ =
        std::size_t(std::count_if(q_.variables.begin(), q_.variables.end(), [](const Variable& v) {
          return v.kind == VariableKind::kError;
        }));
    first_new_ = q_.variables.size();
    add_parameter();
    build_matrix();
    combine_columns();
    order_variables();
    q_.matrix = std::move(B_);
    q_.rows = q_.columns = order_;
    q_.defined.insert(q_.defined.end(), c_.expression_defined.begin(), c_.expression_defined.end());
    take_scales();
  }

 private:
  /// A matrix may have a value where s has none, or is 0.
  void take_scales() {
    for (const NodeId s : q_.scale) {
      q_.defined.push_back(s);
      if (c_.kind != format::kDeterminantMax) q_.defined.push_back(t_.reciprocal(s));
    }
    q_.scale.clear();
  }

  /// X itself.
  void take_ratio() {
    take_one_unit();
    for (std::size_t e = 0; e < A_.size(); ++e)
      q_.matrix[e] = t_.product(scale(e / q_.columns), A_[e]);
    c_.row_scales = q_.scale;
    c_.unscaled = A_;
    take_scales();
  }

  /// The bound of |det J⁻¹| is the threshold. A threshold of 0 is one, too: scales must not be 0.
  void take_threshold() {
    q_.alpha = c_.bound;
    q_.has_threshold = true;
  }

  NodeId add_variable(const std::string& name, VariableKind kind, NodeId lo, NodeId hi) {
    if (q_.variables.size() == format::kMostVariables) throw Rejection("too many variables");
    const NodeId node = q_.graph.add(Op::kVariable, int(q_.variables.size()));
    q_.variables.push_back({name, kind, lo, hi});
    return node;
  }

  NodeId add_uncertain(const std::string& name, NodeId middle, NodeId spread) {
    return add_variable(name, VariableKind::kUncertain, q_.graph.add(Op::kSubtract, middle, spread),
                        q_.graph.add(Op::kAdd, middle, spread));
  }

  /// r is in [0, R], or in [−R, R] for the absolute value of what has a sign.
  void add_parameter() {
    NodeId end = t_.zero;
    if (c_.kind == format::kSigmaMin)
      end = c_.bound;
    else if (c_.bound != kNoNode)
      end = q_.graph.add(Op::kDivide, t_.one,
                         t_.difference(t_.signed_by(sign_, c_.bound), c_.reference));
    const bool has_both_signs =
        c_.kind == format::kDeterminantMax || (c_.set && !is_symmetric(q_.graph, *c_.set));
    is_two_sided_ = c_.side == format::kAbsolute && has_both_signs;
    const NodeId lower = is_two_sided_ ? q_.graph.add(Op::kNegate, end) : t_.zero;
    r_ = add_variable("r", VariableKind::kParameter, lower, end);
  }

  /// The new variables get the places that they have in a search; the others keep their order.
  void order_variables() {
    std::vector<int> numbers;
    std::vector<Variable> ordered(q_.variables.size());
    const std::size_t added = q_.variables.size() - first_new_,
                      before_errors = first_new_ - errors_;
    for (std::size_t k = 0; k < q_.variables.size(); ++k) {
      std::size_t number = k;
      if (k == first_new_)
        number = parameters_;
      else if (k > first_new_)
        number = k - errors_;
      else if (k >= before_errors)
        number = k + added;
      else if (k >= parameters_)
        number = k + 1;
      numbers.push_back(int(number));
      ordered[number] = q_.variables[k];
    }
    q_.graph.renumber_variables(numbers);
    q_.variables = std::move(ordered);
    for (BallOfVariables& ball : q_.balls)
      for (std::size_t& member : ball.members) member = std::size_t(numbers[member]);
  }

  void build_matrix() {
    if (c_.kind == format::kForce)
      force();
    else if (c_.kind == format::kSpeed)
      speed();
    else if (c_.kind == format::kError)
      c_.columns.size() == 1 ? error() : norm_of_error();
    else if (c_.kind == format::kDeflection)
      deflection();
    else if (c_.kind == format::kCondition)
      condition();
    else if (c_.kind == format::kExpression)
      value(c_.expression);
    else if (c_.kind == format::kDeterminantMax)
      value(determinant());
    else
      singular_values();
  }

  void set_order(std::size_t order) {
    order_ = order;
    B_.assign(order * order, t_.zero);
  }
  NodeId& B(std::size_t i, std::size_t j) { return B_[i * order_ + j]; }
  [[nodiscard]] NodeId A(std::size_t i, std::size_t j) const {
    return A_[i * c_.model_columns + j];
  }
  [[nodiscard]] NodeId scale(std::size_t i) const {
    return q_.scale.empty() ? t_.one : q_.scale[i];
  }
  /// Returns (1 + ry)·x.
  [[nodiscard]] NodeId nominal(NodeId x) const {
    return t_.product(t_.sum(t_.one, t_.product(r_, c_.reference)), x);
  }
  void single(NodeId entry) {
    set_order(1);
    B(0, 0) = entry;
  }
  /// 1 + ry − r·f.
  void value(NodeId f) {
    single(t_.difference(nominal(t_.one), t_.product(r_, t_.signed_by(sign_, f))));
  }
  void copy_matrix() {
    for (std::size_t i = 0; i < c_.model_rows; ++i)
      for (std::size_t j = 0; j < c_.model_columns; ++j) B(i, j) = A(i, j);
  }

  /// Returns det D·M. All entries must be defined, also one whose minor is 0.
  [[nodiscard]] NodeId determinant() {
    q_.defined.insert(q_.defined.end(), A_.begin(), A_.end());
    return determinant_of(q_);
  }

  /// Returns the components of the load or the twist: numbers, or new variables.
  Nodes vector_of_set() {
    const VectorSetLines& set = *c_.set;
    Nodes spread = set.spread, result;
    if (!c_.has_norms)
      for (const WrenchBall& ball : set.balls)
        for (const std::size_t j : ball.members) spread[j] = ball.radius;
    std::vector<std::size_t> variable(set.middle.size());
    for (std::size_t j = 0; j < set.middle.size(); ++j) {
      variable[j] = q_.variables.size();
      result.push_back(
          t_.is_zero(spread[j])
              ? set.middle[j]
              : add_uncertain(c_.set_kind + ' ' + std::to_string(j + 1), set.middle[j], spread[j]));
    }
    for (const WrenchBall& ball : set.balls) {
      if (c_.has_norms || t_.is_zero(ball.radius)) continue;
      BallOfVariables balls;
      balls.radius = ball.radius;
      for (const std::size_t j : ball.members) {
        balls.members.push_back(variable[j]);
        balls.middles.push_back(set.middle[j]);
      }
      q_.balls.push_back(std::move(balls));
    }
    return result;
  }

  /// M with row i replaced by (1 + ry)·m_i − r·wᵀ/s_i.
  void force() {
    const Nodes w = vector_of_set();
    set_order(c_.model_rows);
    copy_matrix();
    const std::size_t i = c_.row;
    for (std::size_t k = 0; k < order_; ++k)
      B(i, k) = t_.difference(nominal(A(i, k)),
                              t_.product(r_, t_.quotient(t_.signed_by(sign_, w[k]), scale(i))));
  }

  /// Returns D⁻¹δ.
  Nodes errors() {
    Nodes result;
    for (std::size_t i = 0; i < c_.errors.size(); ++i)
      result.push_back(t_.is_zero(c_.errors[i])
                           ? t_.zero
                           : t_.quotient(add_uncertain("error of motor " + std::to_string(i + 1),
                                                       t_.zero, c_.errors[i]),
                                         scale(i)));
    return result;
  }

  /// M with column k replaced by (1 + ry)·m_k − r·D⁻¹δ.
  void error() {
    const Nodes delta = errors();
    set_order(c_.model_rows);
    copy_matrix();
    const std::size_t k = c_.columns.front();
    for (std::size_t i = 0; i < order_; ++i)
      B(i, k) = t_.difference(nominal(A(i, k)), t_.product(r_, delta[i]));
  }

  /// [ M  −r·D⁻¹δ ; nᵀ  1 ] with n in the unit ball.
  void norm_of_error() {
    const Nodes delta = errors();
    const std::size_t n = c_.model_rows;
    set_order(n + 1);
    copy_matrix();
    BallOfVariables ball;
    ball.radius = t_.one;
    for (const std::size_t j : c_.columns) {
      ball.members.push_back(q_.variables.size());
      ball.middles.push_back(t_.zero);
      B(n, j) = add_uncertain("direction " + std::to_string(j + 1), t_.zero, t_.one);
    }
    q_.balls.push_back(std::move(ball));
    for (std::size_t i = 0; i < n; ++i) B(i, n) = t_.signed_by(-1, t_.product(r_, delta[i]));
    B(n, n) = t_.one;
  }

  /// (1 + ry)/s_i − r·(m_i·ẋ + ρ|m_i|·|s_i|/s_i).
  void speed() {
    if (c_.has_norms && is_two_sided_)
      throw Rejection("norms have a meaning only if r has one sign");
    const Nodes v = vector_of_set();
    const std::size_t i = c_.row;
    NodeId along = t_.zero;
    for (std::size_t k = 0; k < c_.model_columns; ++k)
      along = t_.sum(along, t_.product(A(i, k), v[k]));
    NodeId spread = t_.zero;
    for (const WrenchBall& ball : c_.set->balls) {
      if (!c_.has_norms) break;
      require_nonnegative(ball.radius);
      spread = t_.sum(spread, t_.product(ball.radius, norm_of_row(i, ball)));
    }
    const NodeId s = scale(i);
    if (!t_.is_positive(s)) spread = t_.quotient(t_.product(spread, t_.add(Op::kAbs, s)), s);
    single(t_.difference(nominal(t_.reciprocal(s)),
                         t_.product(r_, t_.sum(t_.signed_by(sign_, along), spread))));
  }

  /// The radius of a ball without variables is in no range that could be empty.
  void require_nonnegative(NodeId radius) const {
    constexpr long kBitsOfBorder = 128;
    const auto value = evaluate(q_.graph, {radius}, {}, kBitsOfBorder);
    if (!value || arb_is_nonnegative((*value)[0].get()) == 0)
      throw Rejection("the radius of a ball is not certainly positive or 0");
  }

  NodeId norm_of_row(std::size_t i, const WrenchBall& ball) {
    NodeId sum = t_.zero;
    // Entries may have no value for another reason: √x² stays as it is.
    for (const std::size_t k : ball.members)
      if (!t_.is_zero(A(i, k))) sum = t_.sum(sum, q_.graph.add(Op::kPower, A(i, k), 2));
    return t_.is_zero(sum) ? sum : t_.add(Op::kSqrt, sum);
  }

  /// [ M  −D⁻²/c ; 0  Mᵀ ] with row k of the second half replaced by (−r·wᵀ, (1 + ry)·it).
  void deflection() {
    const Nodes w = vector_of_set();
    const std::size_t n = c_.model_rows, k = c_.columns.front();
    set_order(2 * n);
    for (const NodeId stiffness : c_.stiffness)
      if (stiffness != kNoNode) q_.defined.push_back(stiffness);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        B(i, j) = A(i, j);
        B(n + i, n + j) = i == k ? nominal(A(j, i)) : A(j, i);
      }
      if (c_.stiffness[i] != kNoNode)
        B(i, n + i) =
            t_.signed_by(-1, t_.quotient(t_.square(t_.reciprocal(scale(i))), c_.stiffness[i]));
      B(n + k, i) = t_.signed_by(-sign_, t_.product(r_, w[i]));
    }
  }

  /// Multiplies the columns of M by C = diag(factors), which must be regular.
  void take_one_unit() {
    for (const NodeId factor : c_.factors)
      q_.defined.push_back(q_.graph.add(Op::kDivide, t_.one, factor));
    for (std::size_t e = 0; e < A_.size(); ++e)
      A_[e] = t_.product(A_[e], c_.factors[e % c_.model_columns]);
  }

  /// MC with column k replaced by its own − r·h_i·D⁻¹y, |y_l| ≤ 1, h_i = s_i·Σ_j |m_ij c_j|.
  void condition() {
    take_one_unit();
    set_order(c_.model_rows);
    copy_matrix();
    NodeId sum = t_.zero;
    for (std::size_t j = 0; j < order_; ++j)
      if (!t_.is_zero(A(c_.row, j))) sum = t_.sum(sum, t_.add(Op::kAbs, A(c_.row, j)));
    const NodeId norm = t_.product(sum, scale(c_.row));
    const std::size_t k = c_.columns.front();
    for (std::size_t l = 0; l < order_; ++l) {
      const NodeId y = add_uncertain("y " + std::to_string(l + 1), t_.zero, t_.one);
      B(l, k) = t_.difference(A(l, k), t_.product(r_, t_.quotient(t_.product(norm, y), scale(l))));
    }
  }

  /// [ D⁻²  rMC ; rCMᵀ  I ] of the largest one, [ D⁻²  MC ; CMᵀ  r²I ] of the least one.
  void singular_values() {
    const bool is_largest = c_.kind == format::kSigmaMax;
    take_one_unit();
    const std::size_t m = c_.model_rows, n = c_.model_columns;
    set_order(m + n);
    for (std::size_t i = 0; i < m; ++i) {
      B(i, i) = t_.square(t_.reciprocal(scale(i)));
      for (std::size_t j = 0; j < n; ++j)
        B(i, m + j) = B(m + j, i) = is_largest ? t_.product(r_, A(i, j)) : A(i, j);
    }
    for (std::size_t j = 0; j < n; ++j) B(m + j, m + j) = is_largest ? t_.one : t_.square(r_);
  }

  /// Multiplies the columns that have a transposed matrix by the regular matrix of the file.
  void combine_columns() {
    if (c_.combined.empty()) return;
    const std::size_t m = c_.model_rows, first = c_.kind == format::kDeflection ? m : 0;
    Nodes row(m);
    for (std::size_t i = 0; i < order_; ++i) {
      for (std::size_t k = 0; k < m; ++k) {
        row[k] = t_.zero;
        for (std::size_t j = 0; j < m; ++j)
          row[k] =
              t_.sum(row[k], t_.product(B(i, first + j), q_.graph.number(c_.combined[j * m + k])));
      }
      for (std::size_t k = 0; k < m; ++k) B(i, first + k) = row[k];
    }
  }

  Question& q_;
  QuantityLines& c_;
  ShortTerms t_;
  Nodes A_;  ///< M, or MC
  Nodes B_;
  std::size_t order_ = 0;                    ///< of B
  std::size_t parameters_ = 0, errors_ = 0;  ///< variables of the model's question
  std::size_t first_new_ = 0;                ///< the number of r before the variables are ordered
  int sign_ = 1;
  bool is_two_sided_ = false;
  NodeId r_ = kNoNode;
};

}  // namespace

bool is_about_ratio(const QuantityLines& quantity) {
  return quantity.kind == format::kCondition2 && quantity.bound != kNoNode;
}

void border(Question& question) { Border(question).build(); }

bool needs_regular_model(const QuantityLines& quantity) {
  const std::string& kind = quantity.kind;
  return quantity.bound != kNoNode && (kind == format::kForce || kind == format::kError ||
                                       kind == format::kDeflection || kind == format::kCondition);
}

}  // namespace regulus::verifier
