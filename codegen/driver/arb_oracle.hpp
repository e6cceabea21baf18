// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

#include "regulus/codegen/program/program.hpp"
#include "regulus/search/problem.hpp"

namespace regulus::codegen {

/// Encloses det A at a point with as many bits as its sign takes: 106, 212, … up to a limit. For
/// points whose rounding errors hide the sign from doubles (Rump's expression, say). May be asked
/// by several threads at once.
class ArbOracle : public DeterminantOracle {
 public:
  /// `matrix`: the program of a square matrix of that size, row-major; it must outlive the oracle.
  ArbOracle(const Program& matrix, int size, long max_bits)
      : matrix_(matrix), size_(size), max_bits_(max_bits) {}

  [[nodiscard]] std::optional<Interval> enclose(std::span<const Interval> point) noexcept override;

  /// The most bits that any answer so far took; 53 if none was asked for.
  [[nodiscard]] long bits() const noexcept { return bits_; }

 private:
  void note_bits(long bits) noexcept;
  [[nodiscard]] std::optional<Interval> enclose_with(std::span<const Interval> point, long bits);

  const Program& matrix_;
  int size_;
  long max_bits_;
  std::atomic<long> bits_ = 53;
};

}  // namespace regulus::codegen
