// SPDX-License-Identifier: GPL-3.0-or-later
// A program for balls alone. This header and its includes do not use CLN or GiNaC, because a search
// shares these objects between all its threads (runtime/SOUNDNESS.md, "Several threads").
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "codegen/kernel/program/ball.hpp"
#include "codegen/kernel/program/flint_rational.hpp"
#include "codegen/kernel/program/node.hpp"

namespace regulus::detail {

struct Program;

/// A Program whose constants have been converted. Any number of threads may evaluate one object.
struct BallProgram {
  BallProgram() = default;
  /// Requires  a program that reads no entries of K (std::invalid_argument otherwise) and belongs
  ///           to the calling thread.
  explicit BallProgram(const Program& program);

  std::vector<Node> nodes;
  std::vector<FlintRational> constants;
  std::size_t inputs = 0;
  std::vector<NodeId> outputs;
};

/// True if every operand comes before its use, and every index is in range. Check it for a program
/// from a file, before it is evaluated.
[[nodiscard]] bool is_consistent(const BallProgram& program) noexcept;

/// Encloses the outputs at `inputs`, computed with `precision` bits.
///
/// Requires  a consistent program; as many inputs as it has, std::invalid_argument otherwise.
/// Ensures   nullopt unless the program is certainly defined at every point of the inputs.
[[nodiscard]] std::optional<std::vector<Ball>> evaluate(const BallProgram& program,
                                                        std::span<const Ball> inputs, long bits);

}  // namespace regulus::detail
