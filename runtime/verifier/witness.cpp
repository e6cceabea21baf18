// SPDX-License-Identifier: Apache-2.0
// A witness: a point with determinant at most alpha, or two points of opposite signs and the
// segment between them, on which the model is defined and no constraint is violated; or a box that
// has a singular point with a null vector.
#include <algorithm>

#include "runtime/verifier/bordered_matrix.hpp"
#include "runtime/verifier/enclosed_zero.hpp"
#include "runtime/verifier/exact_determinant.hpp"
#include "runtime/verifier/exact_point.hpp"
#include "runtime/verifier/linear_algebra.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/shortage.hpp"
#include "runtime/verifier/singular_claims.hpp"
#include "runtime/verifier/work_clock.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostPieces = 1 << 14;
constexpr double kShortestPiece = 0x1p-40;
constexpr long kBitsOfEnd = 128;

class WitnessChecker {
 public:
  WitnessChecker(Lines& lines, Question& q, const Variety& variety, const Options& options,
                 const Verification& counts)
      : lines_(lines), q_(q), variety_(variety), options_(options), clock_(options, counts) {}

  void check() {
    if (q_.load) return check_shortage();
    if (q_.quantity && is_about_ratio(*q_.quantity)) return check_ratio();
    const std::string reason = next_line();
    if (reason == std::string("reason ") + format::kLostRank) return check_lost_rank();
    if (reason == std::string("reason ") + format::kNullVector) return check_null_vector();
    if (q_.rows != q_.columns)
      throw Rejection("for a matrix with more rows than columns, expected 'reason " +
                      std::string(format::kLostRank) + "' or '" + format::kNullVector + "'");
    if (reason == std::string("reason ") + format::kOppositeSigns) return check_signs();
    if (reason == std::string("reason ") + format::kSmallDeterminant) return check_small();
    if (reason == std::string("reason ") + format::kAlwaysSingular) return check_always();
    throw Rejection("expected 'reason " + std::string(format::kOppositeSigns) + "' or '" +
                    format::kSmallDeterminant + "'");
  }

 private:
  const std::string& next_line() {
    if (!lines_.next()) throw Rejection("the file ends before the line 'end' of the witness");
    return lines_.text();
  }

  /// Reads `point SIGN X …`: X is a number or LO:HI; at a singular point also the end of a range, or
  /// an expression that is its exact value.
  ClaimedPoint read_point(std::string_view sign) {
    const auto words = words_of(next_line());
    if (words.size() != q_.variables.size() + 2 || words[0] != "point" || words[1] != sign)
      throw Rejection("expected 'point " + std::string(sign) + "' and " +
                      std::to_string(q_.variables.size()) + " numbers");
    ClaimedPoint result;
    Box in_ranges;  // has a value of the range in place of each end
    for (std::size_t k = 0; k < q_.variables.size(); ++k) {
      const std::string_view word = words[k + 2];
      const bool is_exact = sign == "0" && word.starts_with(format::kExactValue);
      const NodeId end = sign == "0" && !is_exact ? end_of_range(k, word) : kNoNode;
      const NodeId value = is_exact ? parse(word.substr(1), {}, q_.graph) : end;
      result.values.push_back(value);
      result.box.push_back(is_exact         ? enclosure_of(value)
                           : end == kNoNode ? read_coordinate(word)
                                            : enclosure_of(k, end));
      in_ranges.push_back(end == kNoNode ? result.box.back() : some_value(k));
    }
    if (certain_outside(q_, variety_, in_ranges))
      throw Rejection("the point is outside the ranges or the balls");
    if (!certain_inside(q_, variety_, in_ranges))
      throw Unfinished("the point is not certainly within the ranges");
    return result;
  }

  static Interval read_coordinate(std::string_view word) {
    const std::size_t colon = word.find(':');
    const double lo = read_double(word.substr(0, colon));
    const double hi = colon == std::string_view::npos ? lo : read_double(word.substr(colon + 1));
    if (!(lo <= hi)) throw Rejection("the interval " + std::string(word) + " is empty");
    return {lo, hi};
  }

  /// Returns kNoNode for another word. A ball does not contain all ends of its axes.
  NodeId end_of_range(std::size_t k, std::string_view word) const {
    if (word != format::kLowerEnd && word != format::kUpperEnd) return kNoNode;
    for (const BallOfVariables& ball : q_.balls)
      if (std::find(ball.members.begin(), ball.members.end(), k) != ball.members.end())
        throw Rejection("a coordinate of a ball has no end");
    const Variable& v = q_.variables[k];
    return word == format::kLowerEnd ? v.lo : v.hi;
  }

  [[nodiscard]] Interval enclosure_of(std::size_t k, NodeId end) const {
    const auto value = evaluate(q_.graph, {end}, {}, kBitsOfEnd);
    return value ? (*value)[0].enclosure() : variety_.outer[k];
  }

  [[nodiscard]] Interval enclosure_of(NodeId number) const {
    const auto value = evaluate(q_.graph, {number}, {}, kBitsOfEnd);
    if (!value) throw Rejection("a coordinate has no value");
    return (*value)[0].enclosure();
  }

  [[nodiscard]] Interval some_value(std::size_t k) const {
    return variety_.inner[k] ? point(variety_.inner[k]->lo) : variety_.outer[k];
  }

  void read_end() {
    if (next_line() != "end") throw Rejection("expected 'end'");
    if (lines_.next()) throw Rejection("there is text after the line 'end'");
  }

  void check_signs() {
    const Box positive = read_point("+").box;
    require_sign(positive, 1);
    const Box negative = read_point("-").box;
    require_sign(negative, -1);
    if (next_line() != "path segment") throw Rejection("expected 'path segment'");
    check_segment(positive, negative);
    read_end();
    require_value(positive, negative);
  }

  /// The quantity of a bound must have a value where the matrix of the bound is singular.
  void require_value(const Box& from, const Box& to) {
    if (q_.quantity && needs_regular_model(*q_.quantity))
      require_regular_model(q_, variety_, from, to, clock_);
  }

  void require_sign(const Box& point, int sign) {
    for (long bits = 64; bits <= options_.max_bits; bits *= 2) {
      const auto values = values_over(q_, point, bits);
      if (!values) continue;
      if (sign > 0 ? arb_is_positive(values->determinant.get())
                   : arb_is_negative(values->determinant.get()))
        return;
      if (arb_is_nonzero(values->determinant.get()))
        throw Rejection("the determinant has the other sign at this point");
    }
    throw Unfinished("the determinant at this point has no certain sign");
  }

  void check_small() {
    const ClaimedPoint point = read_point("0");
    read_end();
    require_value(point.box, point.box);
    if (is_singular_exactly(point)) return;
    for (long bits = 64; bits <= options_.max_bits; bits *= 2) {
      clock_.tick();
      const auto values = values_over(q_, point.box, bits);
      if (!values) continue;
      const Interval size = values->determinant.enclosure();
      if (mig(size) > variety_.alpha.hi) throw Rejection("the determinant is greater than alpha");
      if (mag(size) <= variety_.alpha.lo && is_within_constraints(point, *values)) return;
    }
    throw Unfinished("the determinant at the point is not certainly at most alpha");
  }

  void check_lost_rank() {
    if (q_.has_threshold) throw Rejection("a lost rank is no proof about a threshold");
    const ClaimedPoint point = read_point("0");
    read_end();
    require_value(point.box, point.box);
    if (!is_defined_within_constraints(point))
      throw Unfinished("the matrix is not certainly defined at the point, within the constraints");
    if (!ExactPoint(q_, point).has_lost_rank())
      throw Unfinished("exact algebra does not find the rank to be lost at the point");
  }

  /// `chosen K …`: variables from 0, rising, whose values are in an interval within their range.
  std::vector<std::size_t> read_chosen(const ClaimedPoint& point) {
    const auto words = words_of(next_line());
    if (words.size() < 2 || words[0] != format::kChosen)
      throw Rejection("expected '" + std::string(format::kChosen) + "' and numbers of variables");
    std::vector<std::size_t> chosen;
    for (std::size_t i = 1; i < words.size(); ++i) {
      const std::size_t k = read_count(words[i], format::kMostVariables);
      if (k >= q_.variables.size() || (i > 1 && chosen.back() >= k))
        throw Rejection("expected rising numbers of variables, from 0");
      // The one value of a range without a double, or an end, is no unknown.
      if (point.values[k] != kNoNode || !variety_.inner[k])
        throw Rejection("a chosen variable has an interval inside its range");
      chosen.push_back(k);
    }
    return chosen;
  }

  /// `vector X …`: as coordinates; one of them is the number 1.
  std::vector<Interval> read_vector() {
    const auto words = words_of(next_line());
    if (words.size() != q_.columns + 1 || words[0] != format::kVector)
      throw Rejection("expected '" + std::string(format::kVector) + "' and " +
                      std::to_string(q_.columns) + " numbers");
    std::vector<Interval> components;
    for (std::size_t j = 0; j < q_.columns; ++j)
      components.push_back(read_coordinate(words[j + 1]));
    if (std::none_of(components.begin(), components.end(), is_one))
      throw Rejection("no component of the vector is the number 1");
    return components;
  }

  void check_null_vector() {
    if (q_.has_threshold) throw Rejection("a null vector is no proof about a threshold");
    const ClaimedPoint point = read_point("0");
    NullVector vector;
    vector.chosen = read_chosen(point);
    vector.components = read_vector();
    read_end();
    require_value(point.box, point.box);
    if (!is_defined_within_constraints(point))
      throw Unfinished("the matrix is not certainly defined in the box, within the constraints");
    if (has_null_vector(q_, point.box, vector)) return;
    const auto values = values_over(q_, point.box, options_.max_bits);
    if (values && independent_rows(values->matrix, q_.rows, q_.columns, options_.max_bits).size() ==
                      q_.columns)
      throw Rejection("the matrix has full rank all over the box");
    throw Unfinished("Krawczyk's test does not show a null vector in the box");
  }

  /// One point at which the determinant is 0 is enough for the claim.
  void check_always() {
    const ClaimedPoint point = read_point("0");
    read_end();
    require_value(point.box, point.box);
    if (is_singular_exactly(point)) return;
    throw Unfinished(
        obstacle_.empty()
            ? "exact algebra does not find the determinant to be 0 where the matrix is defined"
            : obstacle_);
  }

  /// Exact algebra at the point comes first, because it has less to multiply out.
  bool is_singular_exactly(const ClaimedPoint& point) {
    if (!is_defined_within_constraints(point)) {
      obstacle_ = "the matrix is not certainly defined at the point, within the constraints";
      return false;
    }
    if (ExactPoint(q_, point).is_singular()) return true;
    const ExactDeterminant determinant(q_, variety_, options_.max_bits);
    obstacle_ = determinant.obstacle();
    return determinant.vanishes();
  }

  bool is_defined_within_constraints(const ClaimedPoint& point) {
    for (long bits = 64; bits <= options_.max_bits; bits *= 2) {
      clock_.tick();
      const auto values = values_over(q_, point.box, bits);
      if (values && is_within_constraints(point, *values)) return true;
    }
    return false;
  }

  bool is_within_constraints(const ClaimedPoint& point, const PointValues& values) {
    std::optional<ExactPoint> exact;
    for (std::size_t i = 0; i < q_.constraints.size(); ++i) {
      if (arb_is_nonpositive(values.constraints[i].get()) != 0) continue;
      if (!exact) exact.emplace(q_, point);
      if (!exact->is_nonpositive(q_.constraints[i])) return false;
    }
    return true;
  }

  /// Shows that along some direction the load needs more than forces within the limits can give.
  void check_shortage() {
    const std::string reason = next_line();
    if (reason != std::string("reason ") + format::kShortage)
      throw Rejection("expected 'reason " + std::string(format::kShortage) + "'");
    static_cast<void>(enclose_load(q_));  // refuses wrong limits
    const ClaimedPoint point = read_point("0");
    const std::vector<double> direction = read_direction();
    read_end();
    if (!is_defined_within_constraints(point))
      throw Unfinished("the matrix is not certainly defined at the point, within the constraints");
    for (long bits = 64; bits <= options_.max_bits; bits *= 2) {
      clock_.tick();
      const auto values = values_over(q_, point.box, bits);
      const auto y =
          values ? without_free_forces(q_, values->matrix, direction, bits) : std::nullopt;
      const auto need = y ? need_along(q_, *y, bits) : std::nullopt;
      const auto gift = need ? gift_along(q_, values->matrix, *y, bits) : std::nullopt;
      if (!gift) continue;
      if (arb_gt(need->get(), gift->get()) != 0) return;
      if (arb_le(need->get(), gift->get()) != 0)
        throw Rejection("along this direction, forces within the limits give what the load needs");
    }
    throw Unfinished("it is not certain that the load needs more than the forces can give");
  }

  /// Shows with two vectors that the condition number at a point is at least the bound.
  void check_ratio() {
    const std::string reason = next_line();
    if (reason != std::string("reason ") + format::kRatio)
      throw Rejection("expected 'reason " + std::string(format::kRatio) + "'");
    const ClaimedPoint point = read_point("0");
    read_end();
    if (!is_defined_within_constraints(point))
      throw Unfinished("the matrix is not certainly defined at the point, within the constraints");
    for (long bits = 64; bits <= options_.max_bits; bits *= 2) {
      clock_.tick();
      const auto values = values_over(q_, point.box, bits);
      if (values && has_ratio(q_, values->matrix, bits)) return;
    }
    throw Unfinished("the condition number at the point is not certainly as large as the bound");
  }

  std::vector<double> read_direction() {
    const auto words = words_of(next_line());
    if (words.size() != q_.columns + 1 || words[0] != "direction")
      throw Rejection("expected 'direction' and " + std::to_string(q_.columns) + " numbers");
    std::vector<double> direction;
    for (std::size_t j = 0; j < q_.columns; ++j) direction.push_back(read_double(words[j + 1]));
    return direction;
  }

  /// Proves the segment piece by piece, each in the box around it.
  void check_segment(const Box& from, const Box& to) {
    std::vector<NodeId> roots = q_.matrix;
    for (const auto* list : {&q_.constraints, &q_.defined, &q_.motion_defined})
      roots.insert(roots.end(), list->begin(), list->end());
    if (q_.has_threshold) roots.insert(roots.end(), q_.scale.begin(), q_.scale.end());
    Evaluation evaluation(q_, roots);
    std::vector<NodeId> constraints;
    for (const NodeId h : q_.constraints)
      if (!is_nonpositive_between(q_, from, to, h)) constraints.push_back(h);
    std::vector<Interval> waiting{{0.0, 1.0}};
    for (std::size_t pieces = 0; !waiting.empty(); ++pieces) {
      const Interval part = waiting.back();
      waiting.pop_back();
      clock_.tick();
      if (is_clear(evaluation, constraints, from, to, part)) continue;
      if (pieces == kMostPieces || part.hi - part.lo < kShortestPiece)
        throw Unfinished("the segment is not certainly within the variety, with the model defined");
      waiting.push_back({mid(part), part.hi});
      waiting.push_back({part.lo, mid(part)});
    }
  }

  static bool is_clear(Evaluation& evaluation, const std::vector<NodeId>& constraints,
                       const Box& from, const Box& to, Interval part) {
    Box box(from.size());
    for (std::size_t k = 0; k < box.size(); ++k)
      box[k] = from[k].lo == to[k].lo && from[k].hi == to[k].hi
                   ? from[k]
                   : from[k] + (to[k] - from[k]) * part;
    if (!evaluation.run(box)) return false;
    for (const NodeId h : constraints)
      if (!(evaluation.value(h).hi <= 0.0)) return false;
    return true;
  }

  Lines& lines_;
  Question& q_;
  const Variety& variety_;
  const Options& options_;
  WorkClock clock_;
  std::string obstacle_;  ///< why exact algebra failed
};

}  // namespace

void check_witness(Lines& lines, Question& question, const Variety& variety, const Options& options,
                   const Verification& counts) {
  WitnessChecker(lines, question, variety, options, counts).check();
}

}  // namespace regulus::verifier
