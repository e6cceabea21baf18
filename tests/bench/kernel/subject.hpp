// SPDX-License-Identifier: GPL-3.0-or-later
// The subject of the kernel benchmarks: K·M of robot 1 over wide_15, 36 entries from a box and a K.
#pragma once

#include <vector>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/program/module.hpp"
#include "runtime/interval/interval.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus::detail::bench {

/// Returns only A and K·A, formed and rewritten as for `regulus check --method kj`.
[[nodiscard]] Module kernel_subject();

/// Returns K·A of a module. All contenders are made from this one program.
[[nodiscard]] const Program& left_product_of(const Module& module);

/// The problem of a whole search, as in `regulus check models/robot_1.toml wide_15`.
struct SearchSubject {
  Module module;
  Variety variety;
};
[[nodiscard]] SearchSubject search_subject();

/// Boxes like those of a search, each with its K ≈ A(mid)⁻¹. They are few enough to stay in the
/// first level cache with the outputs, since a search reuses its buffers, too.
struct Sample {
  static constexpr std::size_t kBoxes = 32;
  static_assert(kBoxes % REGULUS_LANES == 0);

  std::size_t variables = 0;
  std::size_t points = 0;  ///< entries of K
  std::size_t outputs = 0;
  std::vector<Interval> boxes;  ///< kBoxes·variables
  std::vector<double> K;        ///< kBoxes·points, row-major each
};

/// Returns parts of wide_15: a random whole, half or quarter of each range, from a fixed seed.
[[nodiscard]] Sample make_sample(const Module& module);

}  // namespace regulus::detail::bench
