// SPDX-License-Identifier: Apache-2.0
// The theorem about an arm: its parts, its Jacobian, and a proof by a view from one of its links.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/formal/arm_view.hpp"
#include "runtime/formal/coq_robot.hpp"

namespace regulus::verifier {

class ArmWriter {
 public:
  /// `point`: the values of the certificate's variables by the quantities of the theorem. The others must
  /// outlive this object. Throws Unfinished if the arm has no theorem.
  ArmWriter(const Question& question, const WrittenValues& values, const RobotOfModel& robot,
            std::vector<std::string> point);

  /// Returns the definition of the parts. An arm with tolerances has none.
  [[nodiscard]] std::string definition() const;
  /// Returns "full_column_rank 6 6 …", or that columns depend on each other.
  [[nodiscard]] std::string rank() const;
  /// Returns "determinant 6 …", of the Jacobian, or of some rows as seen from a link.
  [[nodiscard]] std::string determinant() const;
  /// Returns true if the claim is that columns depend on each other: the Jacobian has no determinant.
  [[nodiscard]] bool is_about_columns() const;
  /// Returns the sentence of a proof about all poses, or about the pose of a certificate.
  [[nodiscard]] std::string regular_proof() const;
  [[nodiscard]] std::string singular_proof() const;

 private:
  [[nodiscard]] std::string parts(const std::vector<std::string>& joints,
                                  const std::string& margin) const;
  [[nodiscard]] std::string arm() const;
  [[nodiscard]] std::string jacobian() const;
  [[nodiscard]] std::string list_of_words(const std::vector<std::string>& poses) const;
  [[nodiscard]] std::vector<std::string> values_at_pose() const;
  [[nodiscard]] std::size_t parts_before(std::size_t link) const;
  [[nodiscard]] std::string place_of(const ArmView& view) const;
  [[nodiscard]] std::string rows_of(const ArmView& view) const;

  const Question& q_;
  const WrittenValues& values_;
  const RobotOfModel& robot_;
  const std::vector<std::string> point_;
  std::vector<SectionPose> poses_;
  ArmView view_;
};

}  // namespace regulus::verifier
