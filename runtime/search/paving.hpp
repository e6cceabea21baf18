// SPDX-License-Identifier: Apache-2.0
// Computes which parts of a variety an exhaustive search found free, singular, undecided, outside.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/problem/observer.hpp"

namespace regulus {

/// The claim of a paving about a box.
enum class Claim : std::uint8_t {
  kFree,       ///< certified: the box holds no singularity
  kSingular,   ///< certified: the box holds one
  kUndecided,  ///< neither was shown
  kOutside,    ///< certified: a constraint excludes the box
};
inline constexpr std::size_t kClaims = 4;

[[nodiscard]] Claim claim_of(Rule rule) noexcept;
[[nodiscard]] const char* name(Claim claim) noexcept;

/// Some boxes of a paving and the volume of their part of the variety.
struct Share {
  std::uint64_t boxes = 0;
  Interval volume{0.0};
};

/// Adds up volumes: the product of the ranges of the motion parameters that are not single values.
///
/// Ensures   every volume encloses that of the true ranges: upper bounds from the boxes, lower
///           bounds from their part within the inner ranges.
/// Rounding  outward.
class Volumes final : public Observer {
 public:
  explicit Volumes(const Problem& problem);

  void on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept override {
    add(claim_of(rule), box.box);
  }
  void on_open(const OpenBox& box) noexcept override;
  void add(Claim claim, std::span<const Interval> box) noexcept;

  [[nodiscard]] const Share& of(Claim claim) const noexcept {
    return shares_[static_cast<std::size_t>(claim)];
  }
  /// The undecided boxes that the search had not reached when it was stopped.
  [[nodiscard]] const Share& unfinished() const noexcept { return unfinished_; }
  [[nodiscard]] Interval total() const noexcept { return total_; }
  /// Returns the part of the motion parameters' whole box, in [0, 1].
  [[nodiscard]] Interval fraction(const Share& share) const noexcept;
  /// Returns the motion parameters that are not single values.
  [[nodiscard]] const std::vector<std::size_t>& axes() const noexcept { return axes_; }

 private:
  [[nodiscard]] Interval volume(std::span<const Interval> box) const noexcept;

  const Problem& problem_;
  std::vector<std::size_t> axes_;
  Interval total_;
  std::array<Share, kClaims> shares_;
  Share unfinished_;
};

}  // namespace regulus
