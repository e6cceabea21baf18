// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "codegen/engine/symbolic_stages.hpp"
#include "codegen/program/interpreter.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::inline engine {

/// The determinant of a small matrix, multiplied out and nested, in doubles. This single expression
/// may show a margin of 1e-300 if the enclosure of the entries cannot.
class ClosedFormBounds : public ClosedForm {
 public:
  /// Uses the matrix of `stages`, which must outlive this object.
  explicit ClosedFormBounds(SymbolicStages& stages) noexcept : stages_(stages) {}

  void make() noexcept override;
  [[nodiscard]] std::optional<Interval> enclose(
      std::span<const Interval> box) const noexcept override;

 private:
  [[nodiscard]] static std::optional<Interval> enclose(const Form& form,
                                                       std::span<const Interval> box);

  SymbolicStages& stages_;
  /// Without the constants, because these are CLN numbers and only for one thread; `known_` has
  /// their enclosures.
  std::optional<Program> program_;
  KnownValues<Interval> known_;
};

}  // namespace regulus::inline engine
