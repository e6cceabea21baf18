// SPDX-License-Identifier: Apache-2.0
// A singularity certified within one box of a paving.
#pragma once

#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {

class BoxWitness {
 public:
  BoxWitness(const Problem& problem, const Settings& settings);

  /// Returns true only if |det J⁻¹| ≤ α at every point of the lane's box.
  [[nodiscard]] bool small_throughout(Batch& batch, std::size_t lane) noexcept;

  /// Returns true only if the box has two points of opposite signs that are joined within it, or a
  /// point with |det J⁻¹| ≤ α.
  /// Errors    std::bad_alloc: then nothing is claimed.
  [[nodiscard]] bool somewhere_in(std::span<const Interval> box);

  /// The last proof, valid until the next call. For small_throughout: one point, which is the box.
  [[nodiscard]] const Witness& witness() const noexcept { return *witness_; }
  [[nodiscard]] Reason reason() const noexcept { return reason_; }
  [[nodiscard]] std::uint64_t probes() const noexcept { return search_.probes(); }

 private:
  const Problem& problem_;
  WitnessSearch search_;
  Witness whole_;
  const Witness* witness_ = &whole_;
  Reason reason_ = Reason::kSmallDeterminant;
};

}  // namespace regulus::detail
