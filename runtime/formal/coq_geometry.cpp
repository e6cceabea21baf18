// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_geometry.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "runtime/formal/coq_arm_theorem.hpp"
#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_matrix.hpp"
#include "runtime/formal/coq_real.hpp"
#include "runtime/formal/written_legs.hpp"
#include "runtime/verifier/model/section_reading.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kPositions = 3, kLine = 90;
constexpr std::string_view kQuaternion = "quaternion";

enum class RobotClaim { kRegular, kAbove, kSingular, kSmall };

RobotClaim claim_of(const Question& q) {
  if (q.is_piecewise)
    throw Unfinished(
        "there is no theorem about the robot of a motion in pieces yet, as way-points and the cut "
        "of "
        "an atan2 make them");
  if (q.load || q.quantity || q.closure || q.solutions)
    throw Unfinished(
        "the theorem about a model file is for the claims NO SINGULARITY and SINGULARITY");
  if (q.singular && !q.constraints.empty())
    throw Unfinished("there is no theorem about SINGULARITY of a motion with constraints yet");
  if (q.singular) return q.has_threshold ? RobotClaim::kSmall : RobotClaim::kSingular;
  return q.has_threshold ? RobotClaim::kAbove : RobotClaim::kRegular;
}

class GeometryWriter {
 public:
  GeometryWriter(const Question& question, const std::vector<std::string>& lines,
                 const CoqModel& model)
      : q_(question),
        claim_(claim_of(question)),
        may_differ_(model.may_differ),
        values_(model.values),
        robot_(read_robot(question, model)) {
    if (robot_.kind == RobotKind::kArm)
      arm_.emplace(question, values_, robot_, values_of_certificate());
    if (robot_.kind == RobotKind::kMatrix)
      matrix_.emplace(question, lines, robot_, write_matrix(question, values_, robot_));
    if (robot_.kind == RobotKind::kLegs)
      matrix_.emplace(question, lines, robot_,
                      write_legs(question, values_, robot_, orientation_of_legs()));
  }

  [[nodiscard]] std::string text() const {
    return "\nFrom Regulus Require Import " + library() + ".\n\n" + parts_text() +
           "(** What the theorem is about: " + std::string(may_differ_ ? kOfOptions : kOfFile) +
           " *)\nDefinition the_set" + (robot_.quantities.empty() ? "" : ' ' + binders()) +
           " : Prop :=\n  " +
           (robot_.conditions.empty() ? "True" : text_of(robot_.conditions, " /\\\n  ")) + ".\n\n" +
           robot_theorem() + point_theorem();
  }

 private:
  [[nodiscard]] std::string library() const {
    return matrix_ ? matrix_->written().library : arm_ ? "Arms" : "Geometry";
  }
  [[nodiscard]] std::string parts_text() const {
    return matrix_ ? matrix_->written().definition : arm_ ? arm_->definition() : legs_text();
  }

  [[nodiscard]] std::string names_of(bool are_points, const char* between) const {
    std::vector<std::string> names;
    for (const CoqQuantity& quantity : robot_.quantities)
      if (quantity.is_point == are_points) names.push_back(quantity.name);
    return text_of(names, between);
  }
  [[nodiscard]] bool has_points() const { return !names_of(true, " ").empty(); }

  /// Returns `(x y : R) (a1 : point)`.
  [[nodiscard]] std::string binders() const {
    std::vector<std::string> groups;
    if (const std::string names = names_of(false, " "); !names.empty())
      groups.push_back('(' + names + " : R)");
    if (has_points()) groups.push_back('(' + names_of(true, " ") + " : point)");
    return text_of(groups, " ");
  }

  /// Returns the set as an application to its quantities.
  [[nodiscard]] std::string set() const {
    std::string text = "the_set";
    for (const bool are_points : {false, true})
      if (const std::string names = names_of(are_points, " "); !names.empty()) text += ' ' + names;
    return text;
  }

  [[nodiscard]] std::string orientation() const {
    std::string word = orientation_word();
    for (std::size_t i = kPositions; i < robot_.pose.size(); ++i)
      word += ' ' + coq_argument(robot_.pose[i]);
    return '(' + word + ')';
  }
  [[nodiscard]] std::string orientation_of_legs() const {
    const bool has_angles = robot_.pose.size() > kPositions;
    return has_angles ? orientation() : "fixed";
  }
  [[nodiscard]] std::string orientation_word() const {
    const std::string orientation = robot_.orientation;
    if (orientation == "euler-zxz") return "euler_zxz";
    if (orientation == "roll-pitch-yaw") return "roll_pitch_yaw";
    if (orientation == kQuaternion && claim_ == RobotClaim::kRegular) return orientation;
    if (orientation == kQuaternion)
      throw Unfinished("there is no theorem about a determinant with a quaternion yet");
    throw Unfinished("there is no theorem about the orientation '" + orientation + "' yet");
  }
  /// The rows of the certificate are those of the robot, times the squared norm of a quaternion.
  [[nodiscard]] std::string factor() const {
    if (robot_.orientation != kQuaternion) return "1";
    std::string sum;
    for (std::size_t i = kPositions; i < robot_.pose.size(); ++i)
      sum += (sum.empty() ? "" : " + ") + coq_argument(robot_.pose[i]) + "^2";
    return '(' + sum + ')';
  }
  [[nodiscard]] std::string position() const {
    std::vector<std::string> coordinates(robot_.pose.begin(), robot_.pose.begin() + kPositions);
    return '(' + text_of(coordinates, ", ") + ')';
  }

  /// The quantities of the certificate by those of the theorem.
  [[nodiscard]] std::string point_of_certificate() const {
    const std::vector<std::string> values = values_of_certificate();
    return values.empty() ? "no_quantities" : '[' + text_of(values, "; ") + ']';
  }
  [[nodiscard]] std::vector<std::string> values_of_certificate() const {
    std::vector<std::string> values;
    for (const Variable& variable : q_.variables) {
      const auto value = robot_.of_certificate.find(variable.name);
      if (value == robot_.of_certificate.end())
        throw Unfinished("the model file does not have the quantity '" + variable.name +
                         "' of the certificate");
      values.push_back(value->second);
    }
    return values;
  }

  // Legs.

  [[nodiscard]] std::string legs_text() const {
    if (!robot_.is_geometry_certain) return "";
    return "(** The legs of the model file, each with its anchors on the base and on the platform. "
           "*)\n"
           "Definition legs : list leg :=\n  " +
           coq_list(robot_.legs, "   ") + ".\n\n";
  }

  [[nodiscard]] std::string matrix(const char* word) const {
    const std::string legs =
        !robot_.is_geometry_certain ? "\n    " + coq_list(robot_.legs, "     ") + "\n   " : " legs";
    return std::string(word) + legs + ' ' + position() + ' ' + orientation();
  }

  [[nodiscard]] std::string robot_theorem() const {
    return q_.singular ? singular_theorem() : regular_theorem();
  }
  [[nodiscard]] std::string determinant() const {
    if (matrix_) return "determinant " + matrix_->size() + ' ' + matrix_->written().matrix;
    if (arm_) return arm_->determinant();
    return "determinant 6 (" + matrix(q_.has_threshold ? "inverse_jacobian" : "gough") + ')';
  }
  [[nodiscard]] std::string size_of_determinant() const { return "Rabs (" + determinant() + ')'; }

  [[nodiscard]] std::string regular_conclusion() const {
    if (claim_ == RobotClaim::kAbove)
      return coq_argument(robot_.threshold) + " < " + size_of_determinant();
    if (matrix_) return "full_column_rank " + matrix_->shape() + ' ' + matrix_->written().matrix;
    return arm_ ? arm_->rank()
                : "full_column_rank " + std::to_string(robot_.legs.size()) + " 6 (" +
                      matrix("gough") + ')';
  }
  [[nodiscard]] std::string regular_proof() const {
    const bool is_above = claim_ == RobotClaim::kAbove;
    if (matrix_)
      return "at_point the_claim\n    " + point_of_certificate() + " S.\n" +
             matrix_->written().naming + "  by_" + (is_above ? "large_" : "") +
             "matrix the_claim\n    " + matrix_->hints() + " S";
    if (arm_) return arm_->regular_proof();
    return std::string(is_above ? "by_threshold" : "by_geometry") + " the_claim\n    " +
           point_of_certificate() + (is_above ? "" : ' ' + factor()) + " S";
  }
  [[nodiscard]] std::string regular_theorem() const {
    return "Theorem the_robot :" + (robot_.quantities.empty() ? "" : " forall " + binders() + ',') +
           "\n  " + set() + " ->\n  " + regular_conclusion() + ".\nProof.\n  intros" +
           set().substr(std::string_view("the_set").size()) + " S.\n  " + regular_proof() +
           ".\nQed.\n";
  }

  [[nodiscard]] std::string singular_theorem() const {
    const bool is_small = claim_ == RobotClaim::kSmall;
    const std::string conclusion =
        is_small ? size_of_determinant() + " <= " + coq_argument(robot_.threshold)
        : arm_ && arm_->is_about_columns() ? arm_->rank()
                                           : determinant() + " = 0";
    const std::string question =
        is_small ? "the_question the_scales the_threshold" : "the_question";
    return "Theorem the_robot :" + (robot_.quantities.empty() ? "" : " exists " + binders() + ',') +
           "\n  " + set() + " /\\\n  " + conclusion + ".\nProof.\n" +
           (matrix_ ? singular_matrix_proof(question, is_small)
                    : singular_proof(question, is_small)) +
           "Qed.\n";
  }
  [[nodiscard]] std::string singular_proof(const std::string& question, bool is_small) const {
    return std::string("  destruct (") + (is_small ? "small_of_claim " : "singular_of_claim ") +
           question + " the_claim) as [v S].\n" + exists(&CoqQuantity::of_pose) + "  " +
           (arm_       ? arm_->singular_proof()
            : is_small ? "by_small_determinant S"
                       : "by_singularity S") +
           ".\n";
  }
  [[nodiscard]] std::string singular_matrix_proof(const std::string& question,
                                                  bool is_small) const {
    return std::string("  destruct (") + (is_small ? "pose_of_small " : "pose_of_singularity ") +
           question + " the_claim) as [v [F D]].\n" + matrix_->naming_of_quantities() +
           exists(&CoqQuantity::of_pose) + "  in_ranges F.\n" + matrix_->written().naming +
           "  by_" + (is_small ? "small" : "singular") + "_matrix D\n    " + matrix_->hints() +
           ".\n";
  }

  /// Names a value of each quantity.
  [[nodiscard]] std::string exists(std::string CoqQuantity::*value) const {
    std::vector<std::string> values;
    for (const bool are_points : {false, true})
      for (const CoqQuantity& quantity : robot_.quantities) {
        if (quantity.is_point != are_points) continue;
        if ((quantity.*value).empty())
          throw Unfinished("the certificate has no quantity '" + quantity.name + "' at its pose");
        values.push_back(coq_argument(quantity.*value));
      }
    if (values.empty()) return "";
    const std::string line = text_of(values, ", ");
    return "  exists " + (line.size() < kLine ? line : text_of(values, ",\n    ")) + ".\n";
  }

  [[nodiscard]] std::string point_theorem() const {
    if (q_.singular) return "";
    if (!robot_.is_middle_in_set)
      return "\n(** No point of the set is known that is easy to write: the middle of the ranges "
             "does "
             "not satisfy\n    the constraints. *)\n";
    return "\nTheorem the_set_is_inhabited :" +
           (robot_.quantities.empty() ? "" : " exists " + binders() + ',') + "\n  " + set() +
           ".\nProof.\n" + exists(&CoqQuantity::witness) + "  by_point.\nQed.\n";
  }

  static constexpr const char* kOfFile = "the ranges of the model file.";
  static constexpr const char* kOfOptions =
      "ranges, tolerances and errors are those of the certificate,\n    as options may have "
      "changed those of the model file.";

  const Question& q_;
  const RobotClaim claim_;
  const bool may_differ_;
  const WrittenValues& values_;
  RobotOfModel robot_;
  std::optional<MatrixWriter> matrix_;
  std::optional<ArmWriter> arm_;
};

}  // namespace

std::string coq_geometry(const Question& question, const std::vector<std::string>& lines,
                         const CoqModel& model) {
  return GeometryWriter(question, lines, model).text();
}

}  // namespace regulus::verifier
