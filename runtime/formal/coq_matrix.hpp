// SPDX-License-Identifier: Apache-2.0
// The theorem about a robot whose proof names the parts of its matrix, in the words of Matrices.v and
// Legs.v: its definition, and how it is proved.
#pragma once

#include <string>
#include <vector>

#include "runtime/formal/named_matrix.hpp"

namespace regulus::verifier {

/// Holds the words of a theorem about a matrix, and the tactics that name its parts.
struct WrittenMatrix {
  NamedMatrix named;
  std::string library;     ///< whose words these are
  std::string definition;  ///< sentences before the theorem
  std::string matrix;      ///< at the pose of the theorem, in parentheses
  std::string naming;      ///< sentences that name the arguments and the parts
};

/// The matrix of a model file, [matrix]. `robot` gets its names.
[[nodiscard]] WrittenMatrix write_matrix(const Question& question, const WrittenValues& values,
                                         RobotOfModel& robot);

class MatrixWriter {
 public:
  /// `lines`: of the question. Throws Unfinished if the matrix has no theorem.
  MatrixWriter(const Question& question, const std::vector<std::string>& lines, RobotOfModel& robot,
               WrittenMatrix written);

  [[nodiscard]] const WrittenMatrix& written() const { return written_; }
  /// Returns "3 3".
  [[nodiscard]] std::string shape() const;
  /// Returns "3", for a determinant.
  [[nodiscard]] std::string size() const { return std::to_string(written_.named.columns); }

  /// Returns the names that a proof gives the quantities of a pose of the certificate.
  [[nodiscard]] std::string naming_of_quantities() const;
  /// Returns what the last tactic compares: the names of the definitions, and which names give way in
  /// the entries, and with a threshold in the scales.
  [[nodiscard]] std::string hints() const { return hints_; }

 private:
  const Question& q_;
  const RobotOfModel& robot_;
  const WrittenMatrix written_;
  std::string hints_;
};

}  // namespace regulus::verifier
