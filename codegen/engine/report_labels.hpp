// SPDX-License-Identifier: GPL-3.0-or-later
// What a report calls things: names, units and sizes, and no expression, so that they can be kept
// in a file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "codegen/formulation/formulation.hpp"
#include "codegen/model/request.hpp"

namespace regulus::inline engine {

struct PoseLabel {
  std::string name;
  std::string unit;
};

struct VariableLabel {
  std::string name;
  std::string unit;
  VariableKind kind = VariableKind::kMotion;
};

/// What is searched, as a report speaks of it.
struct ReportLabels {
  std::string model;
  std::string model_sha256;
  std::string motion;
  int rows = 0;
  int columns = 0;
  std::size_t constraints = 0;
  int determinant_exponent = 0;           ///< as in Problem
  FormDetail detail = FormDetail::kFull;  ///< of the functions that are searched
  std::vector<PoseLabel> pose;
  std::vector<TwistComponent> twist;
  std::vector<VariableLabel> variables;  ///< the inputs of every function of the kernel
};

[[nodiscard]] ReportLabels report_labels(const Request& request, const Formulation& formulation);

}  // namespace regulus::inline engine
