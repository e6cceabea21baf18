// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/platform_comparison.hpp"

#include <algorithm>

#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/nominal_copy.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

class PlatformComparison {
 public:
  PlatformComparison(QuestionComparer& comparer, SectionReading& section)
      : comparer_(comparer),
        section_(section),
        q_(comparer.question()),
        closure_(*q_.closure),
        algebra_(q_.graph) {}

  void run() {
    if (!is_finite_error(q_))
      comparer_.refuse_model("the certificate has equations, and the robot's section has none");
    const std::vector<SectionLeg> legs = section_.uncertain_legs(comparer_),
                                  nominal = section_.telescopic_legs(comparer_);
    const std::size_t n = legs.size(), poses = section_.pose().size();
    if (closure_.names.size() != n || closure_.poses.size() != poses + n || (n != 3 && n != 6))
      comparer_.refuse_model("its legs are not as many as the equations of the certificate");
    is_planar_ = n == 3;
    require_exact_pose();
    for (std::size_t k = 0; k < n; ++k) {
      compare_error(k, closure_.poses[poses + k]);
      compare_leg(k, legs[k], nominal[k], closure_.poses[poses + k]);
    }
    compare_start();
  }

 private:
  [[nodiscard]] NodeId unknown(std::size_t i) const { return q_.actual.at(closure_.names[i]); }

  /// The equations are about the pose that is commanded.
  void require_exact_pose() const {
    for (const SectionPose& pose : section_.pose()) {
      const auto error = q_.stated.find("error " + pose.name);
      if (error != q_.stated.end() && !is_zero_number(q_.graph, error->second.node))
        throw Unfinished("the pose has errors of its own");
    }
  }

  /// The motor of a leg is commanded to have no error.
  void compare_error(std::size_t leg, const std::string& name) {
    const NodeId zero = q_.graph.number("0");
    comparer_.compare({"leg " + std::to_string(leg + 1), 0, "no error"}, zero, "pose " + name, "");
    const std::string all = "actuators.error", own = all + '[' + std::to_string(leg) + ']';
    comparer_.compare_or_zero(comparer_.values().contains(own) ? own : all, "error " + name);
  }

  /// Returns Eᵀv, with E = Rz·Ry·Rx of the last unknowns.
  [[nodiscard]] VectorNodes turned_back(const VectorNodes& v) {
    const MatrixNodes E =
        is_planar_ ? algebra_.turn(2, unknown(2))
                   : algebra_.turn_of_roll_pitch_yaw({unknown(3), unknown(4), unknown(5)});
    return algebra_.product(algebra_.transposed(E), v);
  }

  /// The squared length |X + e − a + ERb|² is |X − a′ + Rb|² with X − a′ = Eᵀ(X + e − a).
  void compare_leg(std::size_t k, SectionLeg leg, const SectionLeg& nominal,
                   const std::string& error) {
    VectorNodes X = algebra_.zero(), moved = X;
    for (std::size_t i = 0; i < (is_planar_ ? 2 : 3); ++i) {
      const auto pose = q_.actual.find(std::string_view("xyz").substr(i, 1));
      if (pose == q_.actual.end()) throw Unfinished("the certificate has no position");
      X[i] = pose->second;
      moved[i] = algebra_.difference(algebra_.sum(X[i], unknown(i)), leg.base.value[i]);
    }
    leg.base.value = algebra_.difference(X, turned_back(moved));
    const NodeId square = section_.squared_length(leg, q_.actual, comparer_);
    const NodeId commanded =
        replaced(q_.graph, section_.squared_length(nominal, q_.actual, comparer_),
                 values_without_errors(q_));
    const NodeId length = algebra_.sum(algebra_.root(commanded), q_.actual.at(error));
    comparer_.compare({"the platform", 0, "the equation of leg " + std::to_string(k + 1)},
                      algebra_.difference(square, algebra_.square(length)),
                      "equation " + std::to_string(k), "");
  }

  /// Without errors the platform is where it should be, wherever the branch starts: in the middle of
  /// the ranges of the pose, and at the lower ends of other parameters, such as that of a piece. On the
  /// pieces after the first one nothing starts.
  void compare_start() {
    const FilePlace from{"the start", 0, "no error in the middle of the ranges"};
    const NodeId zero = algebra_.number(0), two = algebra_.number(2),
                 radius = algebra_.quotient(algebra_.number(1), algebra_.number(1 << 20));
    for (const std::string& name : closure_.names) {
      comparer_.compare(from, zero, "unknown " + name, "");
      comparer_.compare(from, radius, "unknown-radius " + name, "");
    }
    for (std::size_t k = 0; k < closure_.start.size(); ++k) {
      const std::string& name = q_.variables[k].name;
      if (q_.continues) {
        comparer_.note_compared("start " + name);
        continue;
      }
      const NodeId lo = q_.variables[k].lo, hi = q_.variables[k].hi;
      const bool is_pose = std::ranges::any_of(
          section_.pose(), [&](const SectionPose& pose) { return pose.name == name; });
      comparer_.compare(from, is_pose ? algebra_.quotient(algebra_.sum(lo, hi), two) : lo,
                        "start " + name, "");
    }
  }

  QuestionComparer& comparer_;
  SectionReading& section_;
  Question& q_;
  const ClosureLines& closure_;
  GraphAlgebra algebra_;
  bool is_planar_ = false;
};

}  // namespace

void compare_platform(QuestionComparer& comparer, SectionReading& section) {
  PlatformComparison(comparer, section).run();
}

}  // namespace regulus::verifier
