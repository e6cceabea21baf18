// SPDX-License-Identifier: Apache-2.0
// The theorem about the matrix of a model file, in the words of Matrices.v: its definition, and how it is
// proved.
#pragma once

#include <string>
#include <vector>

#include "runtime/formal/named_matrix.hpp"

namespace regulus::verifier {

class MatrixWriter {
 public:
  /// `lines`: of the question. `robot` gets the names of the matrix. Throws Unfinished if it has no
  /// theorem.
  MatrixWriter(const Question& question, const std::vector<std::string>& lines,
               const WrittenValues& values, RobotOfModel& robot);

  /// Returns the definition of the matrix.
  [[nodiscard]] std::string definition() const;
  /// Returns the matrix at the pose of the theorem, in parentheses.
  [[nodiscard]] std::string matrix() const;
  /// Returns "3 3", or "3" for a determinant.
  [[nodiscard]] std::string shape() const;
  [[nodiscard]] std::string size() const { return std::to_string(matrix_.columns); }

  /// Returns the sentences that name the arguments and the parts of the matrix.
  [[nodiscard]] std::string naming() const;
  /// Returns the names that a proof gives the quantities of a pose of the certificate.
  [[nodiscard]] std::string naming_of_quantities() const;
  /// Returns what the last tactic compares: the names of the definitions, and which names give way in
  /// the entries, and with a threshold in the scales.
  [[nodiscard]] std::string hints() const;

 private:
  [[nodiscard]] std::string list_of_rows(const std::vector<std::string>& items,
                                         const std::string& margin) const;
  [[nodiscard]] const char* name() const;

  const Question& q_;
  RobotOfModel& robot_;
  NamedMatrix matrix_;
  std::string hints_;
};

}  // namespace regulus::verifier
