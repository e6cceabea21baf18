// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/cpp/names.hpp"
#include "codegen/kernel/program/program.hpp"

namespace regulus::detail {

/// The names of a function's values; they are the same in all its parts.
class ValueNames {
 public:
  explicit ValueNames(const Program& program);

  /// t_3 depends on the variables; c_3 on K and constants alone; also sin_psi, k_1_1, v_x.
  [[nodiscard]] const std::string& of(NodeId id);

  /// Returns a new name for a value that is not a node.
  [[nodiscard]] std::string temporary() { return table_.take("t_" + std::to_string(++last_)); }

 private:
  [[nodiscard]] std::string wanted(NodeId id);

  const Program& program_;
  std::vector<bool> depends_on_inputs_;
  std::vector<std::string> inputs_;
  std::vector<std::string> points_;
  std::vector<std::string> names_;
  NameTable table_;
  int last_ = 0;
  int last_constant_ = 0;
};

}  // namespace regulus::detail
