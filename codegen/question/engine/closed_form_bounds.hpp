// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/question/engine/symbolic_stages.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// The determinant of a small matrix, multiplied out and nested, in doubles: where an enclosure of
/// the entries cannot tell a margin of 1e-300 from 0, its one expression may. There are two of
/// them: powers of sums are multiplied out in one and kept in the other, with some relations
/// between functions (kept_powers.hpp). Both enclose the determinant, and so does what they have in
/// common. Where a constraint h ≤ 0 shares terms with it, det + λh is a third: without those terms,
/// a bound from below for λ > 0 and from above for λ < 0.
class ClosedFormBounds : public ClosedForm {
 public:
  /// Without the constants, which are CLN's and not for all threads: `known` has their enclosures.
  struct Form {
    explicit Form(Program made);
    Program program;
    KnownValues<Interval> known;
    bool bounds_below = true, bounds_above = true;
  };

  /// The matrix is that of `stages`, which must outlive this object.
  explicit ClosedFormBounds(SymbolicStages& stages) noexcept : stages_(stages) {}

  void make() noexcept override;
  [[nodiscard]] std::optional<Interval> enclose(
      std::span<const Interval> box) const noexcept override;

 private:
  [[nodiscard]] static std::optional<Interval> enclose(const Form& form,
                                                       std::span<const Interval> box);

  SymbolicStages& stages_;
  std::vector<Form> forms_;
};

}  // namespace regulus::detail
