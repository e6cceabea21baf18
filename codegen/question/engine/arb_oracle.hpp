// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

#include "codegen/kernel/program/ball_program.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

/// Encloses det A at a point with as many bits as its sign needs: 106, 212, … up to a limit. For
/// points at which rounding errors hide the sign from doubles (for example, Rump's expression).
/// Several threads may call it at once: it does not use CLN, whose numbers belong to one thread.
class ArbOracle : public DeterminantOracle {
 public:
  /// `matrix`: the program of a square matrix of that size, row-major.
  ArbOracle(BallProgram matrix, int size, long max_bits);
  /// Converts the program; only for the thread that owns it.
  ArbOracle(const Program& matrix, int size, long max_bits)
      : ArbOracle(BallProgram(matrix), size, max_bits) {}

  [[nodiscard]] std::optional<Interval> enclose(std::span<const Interval> point) noexcept override;

  /// Returns the most bits of any answer so far; 53 if there was none.
  [[nodiscard]] long bits() const noexcept { return bits_; }

 private:
  void note_bits(long bits) noexcept;
  [[nodiscard]] std::optional<Interval> enclose_with(std::span<const Interval> point,
                                                     long bits) const;

  const BallProgram matrix_;
  const int size_;
  const long max_bits_;
  std::atomic<long> bits_ = 53;
};

}  // namespace regulus::detail
