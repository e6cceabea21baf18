// SPDX-License-Identifier: GPL-3.0-or-later
// What the kernel benchmarks compute: K·M of robot 1 over wide_15, 36 entries from a box and a K.
#pragma once

#include <vector>

#include "regulus/codegen/program/module.hpp"
#include "regulus/codegen/symbolic/variety.hpp"
#include "regulus/interval/interval.hpp"
#include "regulus/kernel/abi.hpp"

namespace regulus::bench {

/// A and K·A, formed and rewritten as `regulus check --method kj` has them, and nothing else.
[[nodiscard]] codegen::Module kernel_subject();

/// K·A of a module. Everyone's code is made from this one program.
[[nodiscard]] const codegen::Program& left_product_of(const codegen::Module& module);

/// A whole search, as `regulus check models/robot_1.toml wide_15` makes it.
struct SearchSubject {
  codegen::Module module;
  codegen::Variety variety;
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
[[nodiscard]] Sample make_sample(const codegen::Module& module);

}  // namespace regulus::bench
