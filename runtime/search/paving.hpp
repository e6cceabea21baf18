// SPDX-License-Identifier: Apache-2.0
// Computes which parts of a variety an exhaustive search found free, singular, undecided, outside, or
// out of reach.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

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

namespace detail {
class LeafClaims;
}  // namespace detail

/// Some boxes of a paving and the volume of their part of the variety.
struct Share {
  std::uint64_t boxes = 0;
  Interval volume{0.0};
};

/// The parts of a variety that meet the constraints, and that do not, for all values of the
/// uncertain quantities, whatever the matrix is there.
struct Workspace {
  Share inside;     ///< certified: every constraint is ≤ 0
  Share outside;    ///< certified: some constraint is > 0
  Share undecided;  ///< neither was shown
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

  ~Volumes() override;
  Volumes(const Volumes&) = delete;
  Volumes& operator=(const Volumes&) = delete;

  void on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept override;
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
  /// Returns the volume of a box, in the motion parameters that are not single values.
  [[nodiscard]] Interval volume(std::span<const Interval> box) const noexcept;

  void set_workspace(const Workspace& workspace) { workspace_ = workspace; }
  /// Returns nullopt if it was not measured.
  [[nodiscard]] const std::optional<Workspace>& workspace() const noexcept { return workspace_; }
  /// Returns bounds of the part of the whole box that meets the constraints.
  ///
  /// Requires  the workspace was measured.
  [[nodiscard]] Interval workspace_fraction() const noexcept;

  /// Returns the motion parameters that are not single values.
  [[nodiscard]] const std::vector<std::size_t>& axes() const noexcept { return axes_; }

 private:
  const Problem& problem_;
  std::vector<std::size_t> axes_;
  const std::unique_ptr<detail::LeafClaims> claims_;
  std::vector<Interval> unreachable_box_;
  Interval total_;
  std::array<Share, kClaims> shares_;
  Share unfinished_;
  std::optional<Workspace> workspace_;
};

}  // namespace regulus
