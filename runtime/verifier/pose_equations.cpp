// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/pose_equations.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/rigid_motion.hpp"
#include "runtime/verifier/rounding.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfLegs = 128;
constexpr std::size_t kSixLegs = 6, kNumbers = 7, kTerms = 17, kRotation = 8, kConstant = 7;
constexpr std::size_t kLeastPivots = 1;
constexpr double kLeastPivot = 0.02;  ///< beside the first

/// The factors of |t|², Rᵀt and t, of 1, and of the nine entries of R, row by row, in a sum that is 0.
using Row = std::array<NodeId, kTerms>;

/// The equations of the legs, solved for as many numbers as they determine.
class Elimination {
 public:
  Elimination(Graph& graph, const std::vector<LegLine>& legs, const Box& places) : a_(graph) {
    for (const Interval x : places) variables_.emplace_back(x, kBitsOfLegs);
    for (const LegLine& leg : legs) {
      base_.push_back(leg.base);
      platform_.push_back(leg.platform);
      squares_.push_back(leg.square);
    }
    base_center_ = move_to_center(base_);
    platform_center_ = move_to_center(platform_);
    for (std::size_t i = 0; i < kSixLegs; ++i) rows_[i] = row(i);
    find_size();
    while (pivots_.size() < kSixLegs && eliminate()) {
    }
    if (pivots_.size() < kLeastPivots)
      throw Unfinished("the legs determine too little of the pose to search for all of them");
  }

  struct Pivot {
    std::size_t row, number;
  };
  [[nodiscard]] const std::vector<Pivot>& pivots() const noexcept { return pivots_; }
  [[nodiscard]] const Row& at(std::size_t row) const { return rows_[row]; }
  [[nodiscard]] bool is_pivot_row(std::size_t row) const {
    return std::ranges::any_of(pivots_, [&](const Pivot& p) { return p.row == row; });
  }
  [[nodiscard]] bool is_determined(std::size_t number) const {
    return std::ranges::any_of(pivots_, [&](const Pivot& p) { return p.number == number; });
  }
  /// The points that are the origins of the base and of the platform here.
  [[nodiscard]] const VectorNodes& base_center() const noexcept { return base_center_; }
  [[nodiscard]] const VectorNodes& platform_center() const noexcept { return platform_center_; }
  /// No place of the platform is farther from the origin.
  [[nodiscard]] double reach() const noexcept { return reach_; }

 private:
  Ball value(NodeId node) {
    auto values = evaluate(a_.graph(), {node}, variables_, kBitsOfLegs);
    if (!values) throw Unfinished("a number of a leg has no certain value");
    return std::move((*values)[0]);
  }
  double approx(NodeId node) { return mid(value(node).enclosure()); }

  VectorNodes move_to_center(std::vector<std::array<NodeId, 3>>& points) {
    VectorNodes center;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (const auto& point : points) sum += approx(point[axis]);
      const double middle = std::isfinite(sum) ? sum / double(kSixLegs) : 0.0;
      center[axis] = a_.graph().number(rational_of(middle));
    }
    for (auto& point : points) point = a_.difference(point, center);
    return center;
  }

  /// |t + Rb − a|² = ρ² is |t|² + 2b·Rᵀt − 2a·t + |a|² + |b|² − ρ² − 2a·Rb = 0.
  Row row(std::size_t leg) {
    const VectorNodes &a = base_[leg], &b = platform_[leg];
    const NodeId two = a_.number(2), minus_two = a_.number(-2);
    Row row{};
    row[0] = a_.number(1);
    for (std::size_t i = 0; i < 3; ++i) {
      row[1 + i] = a_.product(two, b[i]);
      row[4 + i] = a_.product(minus_two, a[i]);
      for (std::size_t j = 0; j < 3; ++j)
        row[kRotation + 3 * i + j] = a_.product(minus_two, a_.product(a[i], b[j]));
    }
    row[kConstant] = a_.difference(a_.sum(a_.dot(a, a), a_.dot(b, b)), squares_[leg]);
    return row;
  }

  /// |t − a| ≤ |t + Rb − a| + |Rb| = ρ + |b|.
  void find_size() {
    reach_ = kInfinity;
    for (std::size_t i = 0; i < kSixLegs; ++i) {
      const NodeId most = a_.sum(
          a_.root(squares_[i]),
          a_.sum(a_.root(a_.dot(platform_[i], platform_[i])), a_.root(a_.dot(base_[i], base_[i]))));
      reach_ = std::min(reach_, value(most).enclosure().hi);
    }
    if (!(reach_ > 0 && reach_ < kInfinity))
      throw Unfinished("the lengths of the legs have no certain values");
  }

  /// Takes the largest coefficient that is left; false: it is nearly 0.
  bool eliminate() {
    Pivot best{};
    double largest = 0;
    for (std::size_t i = 0; i < kSixLegs; ++i)
      for (std::size_t k = 0; k < kNumbers && !is_pivot_row(i); ++k) {
        if (is_determined(k)) continue;
        const double size = std::fabs(approx(rows_[i][k])) * (k == 0 ? reach_ : 1);
        if (size > largest) largest = size, best = {i, k};
      }
    if (pivots_.empty()) first_ = largest;
    if (!(largest > kLeastPivot * first_)) return false;
    const NodeId divisor = rows_[best.row][best.number];
    for (NodeId& term : rows_[best.row])
      if (!a_.is_number(term, 0)) term = a_.quotient(term, divisor);
    rows_[best.row][best.number] = a_.number(1);
    for (std::size_t i = 0; i < kSixLegs; ++i) {
      if (i == best.row) continue;
      const NodeId factor = rows_[i][best.number];
      for (std::size_t k = 0; k < kTerms; ++k)
        rows_[i][k] = k == best.number
                          ? a_.number(0)
                          : a_.difference(rows_[i][k], a_.product(factor, rows_[best.row][k]));
    }
    pivots_.push_back(best);
    return true;
  }

  GraphAlgebra a_;
  std::vector<Ball> variables_;
  std::vector<std::array<NodeId, 3>> base_, platform_;
  std::vector<NodeId> squares_;
  VectorNodes base_center_{}, platform_center_{};
  std::array<Row, kSixLegs> rows_{};
  std::vector<Pivot> pivots_;
  double reach_ = 0, first_ = 0;
};

constexpr double kWider = 1 + 0x1p-20;

/// The rotation of a chart, whose quaternion has the first three unknowns of a question.
class RotationParts {
 public:
  RotationParts(GraphAlgebra& a, Question& question, Box& range, std::size_t chart)
      : question_(question), range_(range) {
    static constexpr std::array<const char*, 4> kParts = {"qw", "qx", "qy", "qz"};
    question.closure.emplace();
    question.alpha = a.number(0);
    for (std::size_t part = 0; part < 4; ++part)
      quaternion[part] = part == chart ? a.number(1) : unknown(kParts[part], 1);
    squared = a.squared_norm(quaternion);
    const NodeId factor = a.quotient(a.number(1), squared);
    R = a.scaled_turn(quaternion);
    for (VectorNodes& row : R) row = a.scaled(factor, row);
  }

  NodeId unknown(const char* name, double radius) {
    question_.closure->names.emplace_back(name);
    const double wider = up(radius * kWider);
    range_.push_back({-wider, wider});
    const std::size_t number = question_.variables.size() + question_.closure->names.size();
    return question_.graph.add(Op::kVariable, int(number) - 1);
  }

  std::array<NodeId, 4> quaternion{};
  NodeId squared = kNoNode;  ///< |quaternion|²
  MatrixNodes R{};

 private:
  Question& question_;
  Box& range_;
};

/// The equations in one chart.
class ChartEquations {
 public:
  ChartEquations(const Question& question, const Box& places, const Elimination& legs,
                 std::size_t chart)
      : result_{question, places, {}, {}, {}, {}, {}},
        a_(result_.question.graph),
        legs_(legs),
        parts_(a_, result_.question, result_.range, chart) {}

  PoseChart form() && {
    name_numbers();
    const std::array<NodeId, kNumbers>& number = numbers_;
    ClosureLines& closure = *result_.question.closure;
    for (std::size_t i = 0; i < kSixLegs; ++i)
      if (!legs_.is_pivot_row(i)) closure.equations.push_back(rest_of(legs_.at(i), kTerms));
    const VectorNodes s = {number[1], number[2], number[3]}, t = {number[4], number[5], number[6]};
    for (std::size_t i = 0; i < 3; ++i)
      closure.equations.push_back(a_.difference(s[i], a_.dot(a_.transposed(parts_.R)[i], t)));
    closure.equations.push_back(a_.difference(number[0], a_.dot(t, t)));
    result_.place = a_.difference(a_.sum(t, legs_.base_center()),
                                  a_.product(parts_.R, legs_.platform_center()));
    return std::move(result_);
  }

 private:
  void name_numbers() {
    static constexpr std::array<const char*, kNumbers> kNames = {"|t|^2", "s_x", "s_y", "s_z",
                                                                 "t_x",   "t_y", "t_z"};
    const double reach = up(legs_.reach() * kWider);
    for (std::size_t k = 0; k < kNumbers; ++k) {
      if (legs_.is_determined(k)) continue;
      free_.push_back(k);
      numbers_[k] = parts_.unknown(kNames[k], k == 0 ? up(reach * reach) : reach);
    }
    for (const Elimination::Pivot& pivot : legs_.pivots())
      numbers_[pivot.number] = a_.negative(rest_of(legs_.at(pivot.row), pivot.number));
  }

  /// Returns the sum of a row without the number `left_out` and those that are determined.
  NodeId rest_of(const Row& row, std::size_t left_out) {
    NodeId sum = row[kConstant];
    for (std::size_t i = 0; i < 9; ++i)
      sum = a_.sum(sum, a_.product(row[kRotation + i], parts_.R[i / 3][i % 3]));
    for (const std::size_t k : free_)
      if (k != left_out) sum = a_.sum(sum, a_.product(row[k], numbers_[k]));
    return sum;
  }

  PoseChart result_;
  GraphAlgebra a_;
  const Elimination& legs_;
  RotationParts parts_;
  std::vector<std::size_t> free_;           ///< unknowns beside the rotation
  std::array<NodeId, kNumbers> numbers_{};  ///< |t|², Rᵀt and t
};

/// |p + Rb − a|² = ρ² for each leg.
void form_legs(PoseChart& result, const Question& question, double reach, std::size_t chart) {
  result.legs = question;
  GraphAlgebra a(result.legs.graph);
  RotationParts parts(a, result.legs, result.range_of_legs, chart);
  const VectorNodes p = {parts.unknown("x", reach), parts.unknown("y", reach),
                         parts.unknown("z", reach)};
  for (const LegLine& leg : question.solutions->legs) {
    const VectorNodes gap = a.difference(a.sum(p, a.product(parts.R, leg.platform)), leg.base);
    result.legs.closure->equations.push_back(a.difference(a.dot(gap, gap), leg.square));
  }
  std::copy(p.begin(), p.end(), result.pose.begin());
  const NodeId norm = a.root(parts.squared);
  for (std::size_t part = 0; part < 4; ++part)
    result.pose[3 + part] = a.quotient(parts.quaternion[part], norm);
}

/// A pose of some legs, with anchors a and b, is one at which a leg between two other anchors has a length within
/// |a − a₀| + |b − b₀| of theirs. Returns the question about legs between points, whose squares vary.
Question with_other_anchors(const Question& question, const Box& places, Box& squares) {
  Question result = question;
  if (places.empty()) return result;
  std::vector<Ball> variables;
  for (const Interval x : places) variables.emplace_back(x, kBitsOfLegs);
  result.variables.clear();
  result.ends.clear();
  result.balls.clear();
  result.defined.clear();
  for (LegLine& leg : result.solutions->legs) {
    const std::vector<NodeId> numbers = {leg.base[0],     leg.base[1],     leg.base[2],
                                         leg.platform[0], leg.platform[1], leg.platform[2],
                                         leg.square};
    const auto values = evaluate(result.graph, numbers, variables, kBitsOfLegs);
    if (!values) throw Unfinished("a number of a leg has no certain value");
    const auto moved = [&](std::array<NodeId, 3>& anchor, std::size_t first) {
      Interval squared;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Interval all = (*values)[first + axis].enclosure();
        const double at = mid(all);
        if (!std::isfinite(at)) throw Unfinished("an anchor has no certain value");
        squared = squared + square(all - point(at));
        anchor[axis] = result.graph.number(rational_of(at));
      }
      return sqrt(squared).hi;
    };
    const Interval all = values->back().enclosure();
    const double room = up(moved(leg.base, 0) + moved(leg.platform, 3));
    const Interval length = sqrt({std::max(all.lo, 0.0), std::max(all.hi, 0.0)});
    const Interval near = square({std::max(0.0, down(length.lo - room)), up(length.hi + room)});
    if (!is_bounded(near)) throw Unfinished("a length has no certain value");
    leg.square = result.graph.add(Op::kVariable, int(result.variables.size()));
    result.variables.push_back({"square of leg " + std::to_string(result.variables.size() + 1),
                                VariableKind::kError, result.graph.number(rational_of(near.lo)),
                                result.graph.number(rational_of(near.hi))});
    result.ends.emplace_back();
    squares.push_back(near);
  }
  return result;
}

}  // namespace

std::vector<PoseChart> form_pose_equations(const Question& question, const Box& places) {
  Box squares;
  Question with_legs = with_other_anchors(question, places, squares);
  const Elimination legs(with_legs.graph, with_legs.solutions->legs, squares);
  std::vector<PoseChart> charts;
  for (std::size_t chart = 0; chart < kCharts; ++chart) {
    charts.push_back(ChartEquations(with_legs, squares, legs, chart).form());
    form_legs(charts.back(), question, legs.reach(), chart);
  }
  return charts;
}

}  // namespace regulus::verifier
