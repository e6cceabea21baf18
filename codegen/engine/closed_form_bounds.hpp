// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "codegen/engine/symbolic_stages.hpp"
#include "codegen/program/interpreter.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::inline engine {

/// The determinant of a small matrix, multiplied out and nested, in doubles: where an enclosure of
/// the entries cannot tell a margin of 1e-300 from 0, its one expression may.
class ClosedFormBounds : public ClosedForm {
 public:
  /// The matrix is that of `stages`, which must outlive this object.
  explicit ClosedFormBounds(SymbolicStages& stages) noexcept : stages_(stages) {}

  void make() noexcept override;
  [[nodiscard]] std::optional<Interval> enclose(
      std::span<const Interval> box) const noexcept override;

 private:
  SymbolicStages& stages_;
  /// Without the constants, which are CLN's and not for all threads: `known_` has their enclosures.
  std::optional<Program> program_;
  KnownValues<Interval> known_;
};

}  // namespace regulus::inline engine
