// SPDX-License-Identifier: GPL-3.0-or-later
// All functions of one model over one motion variety: what becomes a kernel.
#pragma once

#include <string>
#include <vector>

#include "regulus/codegen/program/program.hpp"

namespace regulus::codegen {

/// One function of a kernel. `name` is its field in regulus_kernel (regulus/kernel/abi.hpp).
struct Function {
  std::string name;
  std::string title;  ///< one line for readers, e.g. "K·M, §III-B1 form 2, greedy Horner"
  Program program;
  int rows = 1;  ///< shape of the outputs, row-major
  int columns = 1;
  std::vector<std::string> output_comments;  ///< per output, or empty: occurrences, form
};

struct Module {
  std::string model;
  std::string motion;
  std::vector<std::string> variables;
  int motion_variables = 0;
  int rows = 0;
  int columns = 0;
  int constraints = 0;
  int pose_parameters = 0;
  std::vector<Function> functions;

  [[nodiscard]] const Function* find(const std::string& name) const {
    for (const Function& f : functions)
      if (f.name == name) return &f;
    return nullptr;
  }
};

}  // namespace regulus::codegen
