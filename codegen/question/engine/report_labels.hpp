// SPDX-License-Identifier: GPL-3.0-or-later
// The labels of a report: names, units and sizes, without expressions. Ranges and
// forms are kept elsewhere.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/model/request.hpp"

namespace regulus::detail {

struct PoseLabel {
  std::string name;
  std::string unit;
};

struct VariableLabel {
  std::string name;
  std::string unit;
  VariableKind kind = VariableKind::kMotion;
  bool is_idle = false;  ///< neither the matrix nor a constraint depends on it
  std::string group{};   ///< of a constant of the geometry; empty: none
  bool in_ball = false;  ///< its point varies in a ball
};

/// The labels of the search in a report.
struct ReportLabels {
  std::string model;
  std::string model_sha256;
  std::string motion;
  MatrixKind matrix_kind = MatrixKind::kInverse;
  std::vector<std::string> matrix_notes;  ///< as in Model
  std::vector<std::string> notes;         ///< as in Request
  bool is_branch = false;                 ///< of a closure: a claim is about its branch, too
  int rows = 0;
  int columns = 0;
  std::string where;                      ///< as name(Motion::where)
  std::size_t constraints = 0;            ///< of the kernel
  std::size_t reach = 0;                  ///< the first constraints: those of Motion::reach
  int determinant_exponent = 0;           ///< as in Problem
  FormDetail detail = FormDetail::kFull;  ///< of the functions that are searched
  std::vector<PoseLabel> pose;
  std::vector<TwistComponent> twist;
  std::vector<VariableLabel> variables;  ///< the inputs of every function of the kernel
};

[[nodiscard]] ReportLabels report_labels(const Request& request, const Formulation& formulation);

}  // namespace regulus::detail
