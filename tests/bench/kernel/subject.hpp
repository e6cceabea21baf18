// SPDX-License-Identifier: GPL-3.0-or-later
// What the kernel benchmarks compute: K·M of robot 1 over wide_15, 36 entries from a box and a K.
#pragma once

#include <vector>

#include "codegen/formulation/variety.hpp"
#include "codegen/program/module.hpp"
#include "runtime/interval/interval.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus::bench {

/// A and K·A, formed and rewritten as `regulus check --method kj` has them, and nothing else.
[[nodiscard]] Module kernel_subject();

/// K·A of a module. Everyone's code is made from this one program.
[[nodiscard]] const Program& left_product_of(const Module& module);

/// A whole search, as `regulus check models/robot_1.toml wide_15` makes it.
struct SearchSubject {
  Module module;
  Variety variety;
};
[[nodiscard]] SearchSubject search_subject();

/// Boxes as a search comes by them, each with its K ≈ A(mid)⁻¹. Few enough to stay in the first
/// level cache with the outputs: a search uses the same buffers again and again, too.
struct Sample {
  static constexpr std::size_t kBoxes = 32;
  static_assert(kBoxes % REGULUS_LANES == 0);

  std::size_t variables = 0;
  std::size_t points = 0;  ///< entries of K
  std::size_t outputs = 0;
  std::vector<Interval> boxes;  ///< kBoxes·variables
  std::vector<double> K;        ///< kBoxes·points, row-major each
};

/// Parts of wide_15: each range whole, a half or a quarter, chosen at random from a fixed seed.
[[nodiscard]] Sample make_sample(const Module& module);

}  // namespace regulus::bench
