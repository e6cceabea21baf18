// SPDX-License-Identifier: GPL-3.0-or-later
// The plan of a function, made before any line is printed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/magnitude.hpp"
#include "codegen/kernel/program/program.hpp"
#include "codegen/support/work_meter.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// The type of a node in the text: P, exact doubles, or I, intervals (runtime/kernel/pack.hpp).
enum class Form : std::uint8_t { kPoint, kInterval };

/// One step to print: the value of a node, or the outputs from first_output to last_output.
struct Step {
  enum class Kind : std::uint8_t { kCompute, kStore } kind;
  NodeId node;  ///< to compute, or to store
  std::size_t first_output;
  std::size_t last_output;
  bool opens_group;  ///< the first step for these outputs
};

/// A sequence of steps that becomes one C++ function. The compile time of a function grows faster
/// than its length, so many short functions compile sooner than a long one.
struct Part {
  std::size_t first_step;
  std::size_t last_step;  ///< one past the end
};

inline constexpr int kNoSlot = -1;

struct FunctionPlan {
  KnownValues<Interval> known;  ///< constant nodes, by their enclosures
  Magnitudes magnitudes;
  std::vector<bool> exact;  ///< nodes of K that are computed without rounding, as points
  std::vector<Form> forms;
  std::vector<bool> leaves;                 ///< written at each use: inputs, points, constants
  std::vector<std::uint32_t> uses;          ///< by nodes that are printed and by outputs
  std::vector<std::uint32_t> part_of;       ///< the part that computes a node
  std::vector<std::uint32_t> last_part_of;  ///< the last part that uses it
  std::vector<int> slots;                   ///< of values for a later part, or kNoSlot
  int slot_count = 0;
  std::size_t operations = 0;
  std::vector<Step> steps;
  std::vector<Part> parts;
};

/// Requires  a well formed program; operations_per_part ≥ 1; points row by row, `row_length` in
///           each row of K, or 0 if they are on no grid. `meter`: null, or it counts nodes.
[[nodiscard]] FunctionPlan plan_function(const Program& program, std::size_t operations_per_part,
                                         std::size_t row_length = 0, WorkMeter* meter = nullptr);

}  // namespace regulus::detail
