// SPDX-License-Identifier: Apache-2.0
// Computes which parts of a variety an exhaustive search found free, singular, undecided, outside, or
// out of reach.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/evaluation/box_lanes.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus {

/// The claim of a paving about a box.
enum class Claim : std::uint8_t {
  kFree,       ///< certified: the box holds no singularity
  kSingular,   ///< certified: the box holds one
  kUndecided,  ///< neither was shown
  kOutside,    ///< certified: a constraint excludes the box
  /// Certified: at every pose of the box, a root is negative that the robot needs to reach the pose.
  kUnreachable,
};
inline constexpr std::size_t kClaims = 5;

[[nodiscard]] Claim claim_of(Rule rule) noexcept;
[[nodiscard]] const char* name(Claim claim) noexcept;

/// Tells the boxes out of reach from those that another constraint excludes.
class LeafClaims {
 public:
  /// The first `reach` constraints of the kernel are those of reach. The kernel must outlive this.
  ///
  /// Requires  boxes have at most as many ranges as the problem; the others are those of the problem.
  LeafClaims(const Problem& problem, std::size_t reach);

  [[nodiscard]] Claim of(std::span<const Interval> box, Rule rule) noexcept;

 private:
  const Problem problem_;
  const std::size_t reach_;
  std::vector<Interval> box_;
  BoxLanes lanes_;
  AlignedBuffer outputs_;
};

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
  /// `reach`: the number of constraints of reach, the first ones of the kernel.
  explicit Volumes(const Problem& problem, std::size_t reach = 0);

  void on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept override {
    add(claims_.of(box.box, rule), box.box);
  }
  void on_open(const OpenBox& box) noexcept override;
  void add(Claim claim, std::span<const Interval> box) noexcept;

  [[nodiscard]] const Share& of(Claim claim) const noexcept {
    return shares_[static_cast<std::size_t>(claim)];
  }
  /// The undecided boxes that the search had not reached when it was stopped.
  [[nodiscard]] const Share& unfinished() const noexcept { return unfinished_; }
  [[nodiscard]] Interval total() const noexcept { return total_; }
  /// Returns a box out of reach; empty if there is none.
  [[nodiscard]] const std::vector<Interval>& unreachable_box() const noexcept {
    return unreachable_box_;
  }
  /// Returns the part of the motion parameters' whole box, in [0, 1].
  [[nodiscard]] Interval fraction(const Share& share) const noexcept;
  /// Returns the motion parameters that are not single values.
  [[nodiscard]] const std::vector<std::size_t>& axes() const noexcept { return axes_; }

 private:
  [[nodiscard]] Interval volume(std::span<const Interval> box) const noexcept;

  const Problem& problem_;
  std::vector<std::size_t> axes_;
  LeafClaims claims_;
  std::vector<Interval> unreachable_box_;
  Interval total_;
  std::array<Share, kClaims> shares_;
  Share unfinished_;
};

}  // namespace regulus
