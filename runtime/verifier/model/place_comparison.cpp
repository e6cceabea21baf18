// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/place_comparison.hpp"

#include <algorithm>
#include <utility>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/place_reading.hpp"
#include "runtime/verifier/model/posture_comparison.hpp"
#include "runtime/verifier/planar_platform.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBits = 1024;

class PlaceComparison : private PlaceReading {
 public:
  PlaceComparison(QuestionComparer& comparer, SectionReading* section)
      : PlaceReading(comparer, section) {}

  void run() {
    const Scope stated = std::exchange(q_.actual, {});
    name_constants();
    const std::vector<SectionLeg> legs = section_->telescopic_legs(comparer_);
    if (legs.size() != q_.solutions->legs.size())
      comparer_.refuse_model("it has " + std::to_string(legs.size()) + " legs, and not " +
                             std::to_string(q_.solutions->legs.size()));
    q_.variables.empty() ? compare_anchors(legs) : compare_uncertain_anchors(stated);
    compare_lengths(legs);
  }

 private:
  void compare_anchors(const std::vector<SectionLeg>& legs) {
    for (std::size_t i = 0; i < legs.size(); ++i) {
      compare_point(legs[i].base, "base", i);
      compare_point(legs[i].platform, "platform", i);
    }
  }

  /// The certificate has the constants with their tolerances: anchors are expressions of these.
  void compare_uncertain_anchors(Scope stated) {
    std::swap(q_.actual, stated);
    compare_anchors(section_->uncertain_legs(comparer_));
    std::swap(q_.actual, stated);
  }

  void compare_point(const SectionPoint& point, const char* kind, std::size_t leg) {
    const std::size_t axes = q_.solutions->legs.size() == kLegsInPlane ? 2 : 3;
    for (std::size_t axis = 0; axis < axes; ++axis)
      comparer_.compare(comparer_.place_of(point.place + '[' + std::to_string(axis) + ']'),
                        point.value[axis],
                        std::string(kind) + ' ' + std::to_string(leg) + '_' + "xyz"[axis]);
  }

  // A platform.

  void compare_lengths(const std::vector<SectionLeg>& legs) {
    require_known_keys();
    if (q_.variables.empty()) require_no_tolerances();
    const std::string lengths = motion_ + "legs";
    if (has(lengths + "[0]")) return compare_given_lengths(lengths, legs.size());
    Scope pose = q_.actual;
    for (const SectionPose& p : section_->pose()) {
      const NodeId value = pose[p.name] = value_of(p.name);
      if (value == kNoNode) return accept_place(p.name, legs.size());
    }
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const NodeId square = section_->squared_length(legs[i], pose, comparer_);
      comparer_.expect_defined({motion_, 0, ""}, square);
      compare_square({q_.motion, 0, "leg " + std::to_string(i + 1)}, square, i);
    }
    compare_errors_of_pose(legs, pose);
  }

  // Errors. A squared length may be stated with a larger one.

  /// Returns what the certificate states; 0 if it has none.
  NodeId error_of_square(std::size_t leg) {
    const std::string key = "square-spread " + std::to_string(leg);
    comparer_.note_compared(key);
    const auto found = q_.stated.find(key);
    return found == q_.stated.end() ? q_.graph.number("0") : found->second.node;
  }

  /// `excess`: of what the certificate states over what the file needs, for the ends of variables.
  void require_error(const FilePlace& from, std::size_t leg, NodeId excess,
                     const std::vector<Ball>& variables) {
    if (is_zero_number(q_.graph, excess)) return;
    const auto value = evaluate(q_.graph, {excess}, variables, kBits);
    if (!value) throw Unfinished("an error of " + q_.motion + " has no certain value");
    if (arb_is_nonnegative((*value)[0].get()) == 0)
      comparer_.refuse(from, "a smaller error of leg " + std::to_string(leg + 1));
  }

  /// With ρ ± e the square is within 2ρe + e² of ρ².
  void compare_errors_of_lengths(std::size_t count) {
    if (q_.variables.empty()) return;
    const Scope none;
    GraphAlgebra algebra(q_.graph);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string all = motion_ + "error.legs", own = all + '[' + std::to_string(i) + ']',
                        place = has(all) ? all : own;
      const NodeId stated = error_of_square(i);
      if (!has(place)) continue;
      const NodeId error = comparer_.expression_at(place, none),
                   square = q_.stated.at("square " + std::to_string(i)).node;
      require_error(comparer_.place_of(place), i, error, {});  // not negative
      const NodeId twice = algebra.product(algebra.number(2), algebra.root(square)),
                   needed = algebra.product(error, algebra.sum(twice, error));
      require_error(comparer_.place_of(place), i, algebra.difference(stated, needed), {});
    }
  }

  /// The squares at all poses within the errors. The errors are variables after those of the question.
  void compare_errors_of_pose(const std::vector<SectionLeg>& legs, Scope pose) {
    if (q_.variables.empty()) return;
    GraphAlgebra algebra(q_.graph);
    std::vector<Ball> variables(q_.variables.size());
    FilePlace from{motion_ + "error", 0, ""};
    for (const SectionPose& p : section_->pose()) {
      const std::string place = motion_ + "error." + p.name;
      if (!has(place)) continue;
      from = comparer_.place_of(place);
      const NodeId variable = q_.graph.add(Op::kVariable, int(variables.size()));
      const auto error = evaluate(q_.graph, {comparer_.number_at(place, p.name)}, variables, kBits);
      if (!error) throw Unfinished(place + " has no certain value");
      const double most = mag((*error)[0].enclosure());
      variables.emplace_back(Interval{-most, most}, kBits);
      NodeId& value = pose.at(p.name);
      value = algebra.sum(value, variable);
    }
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const NodeId stated = error_of_square(i),
                   nominal = q_.stated.at("square " + std::to_string(i)).node;
      if (variables.size() == q_.variables.size()) continue;
      const NodeId change =
          algebra.difference(section_->squared_length(legs[i], pose, comparer_), nominal);
      require_error(from, i, algebra.difference(stated, change), variables);
      require_error(from, i, algebra.sum(stated, change), variables);
    }
  }

  void compare_given_lengths(const std::string& list, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::string place = list + '[' + std::to_string(i) + ']';
      if (!has(place)) comparer_.refuse_model("the motion has fewer lengths than there are legs");
      const NodeId length = comparer_.expression_at(place, {});
      const FilePlace from = comparer_.place_of(place);
      comparer_.expect_defined(from, length);
      comparer_.refuse_negative(from, length);
      compare_square(from, GraphAlgebra(q_.graph).square(length), i);
    }
    compare_errors_of_lengths(count);
    if (has(list + '[' + std::to_string(count) + ']'))
      comparer_.refuse_model("the motion has more lengths than there are legs");
  }

  void compare_square(const FilePlace& from, NodeId square, std::size_t leg) {
    comparer_.compare(from, square, "square " + std::to_string(leg), kPlaceOption);
  }

  /// The file has no such place: an option may have given it.
  void accept_place(const std::string& lacking, std::size_t legs) {
    const bool is_known = starts(values_.lower_bound(motion_), motion_);
    require_place_option(is_known ? "the motion '" + q_.motion + "' gives no value of " + lacking
                                  : "the file has no motion '" + q_.motion + '\'');
    for (std::size_t i = 0; i < legs; ++i) comparer_.note_compared("square " + std::to_string(i));
    // The errors of a pose that an option has given cannot be compared with those of the motion.
    const auto error = values_.lower_bound(motion_ + "error.");
    if (starts(error, motion_ + "error.") && !error->first.starts_with(motion_ + "error.legs"))
      comparer_.leave_out(comparer_.place_of(error->first), "the file does not give the pose");
    compare_errors_of_lengths(legs);
  }
};

}  // namespace

void compare_robot_at_place(QuestionComparer& comparer, SectionReading* section) {
  if (section == nullptr) comparer.refuse_model("it has none of [gough], [legs] and [serial]");
  if (comparer.question().solutions->arm) return compare_postures(comparer, section);
  PlaceComparison(comparer, section).run();
}

}  // namespace regulus::verifier
