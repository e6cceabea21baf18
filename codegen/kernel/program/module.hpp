// SPDX-License-Identifier: GPL-3.0-or-later
// All functions of one model over one motion variety, from which a kernel is made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/program/program.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// A derivative of a matrix entry by variables, counted from 0; `second` is kNone for a first
/// derivative.
struct DerivativeIndex {
  static constexpr int kNone = -1;
  int row = 0;
  int column = 0;
  int first = 0;
  int second = kNone;
};

/// One function of a kernel. `name` is its field in regulus_kernel (runtime/kernel/abi.hpp).
struct Function {
  std::string name;
  std::string title;  ///< one line for readers, e.g. "K·M, §III-B1 form 2, greedy Horner"
  Program program;
  int rows = 1;  ///< shape of the outputs, row-major
  int columns = 1;
  std::vector<std::string> output_comments;       ///< per output, or empty: occurrences, form
  std::vector<DerivativeIndex> derivatives = {};  ///< per output, if outputs are derivatives
};

/// The fields of regulus_expansion other than its functions expansion_second, row_first,
/// row_second.
struct Expansion {
  static constexpr int kNoRow = -1;
  std::string product;                ///< name of the function that is K·A at ū
  std::string first;                  ///< of the function that is its derivatives
  std::vector<int> row_of_variable;   ///< or kNoRow
  std::vector<int> ball_of_variable;  ///< or −1; empty if there are no balls
  std::vector<Interval> nominal;      ///< per variable, or empty
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
  std::optional<Expansion> expansion = {};

  [[nodiscard]] const Function* find(const std::string& name) const {
    for (const Function& f : functions)
      if (f.name == name) return &f;
    return nullptr;
  }
};

}  // namespace regulus::detail
