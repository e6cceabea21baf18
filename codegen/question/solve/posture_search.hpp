// SPDX-License-Identifier: GPL-3.0-or-later
// The search for all postures of an arm at a place, in joints that turn in radians.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/solve/arm_following.hpp"
#include "codegen/question/solve/arm_tubes.hpp"
#include "codegen/question/solve/root_search.hpp"

namespace regulus::detail {

struct FoundPostures {
  std::vector<Root> postures;               ///< of all unknowns
  std::vector<std::vector<Interval>> open;  ///< the same: boxes that may hold others
  std::string obstacle;                     ///< empty: these are all
  bool may_meet = false;                    ///< the obstacle is that of some box that is open
  std::optional<Reason> stopped_by{};
  std::size_t system = 0;  ///< by which they were found: arm_place.hpp
  /// A count has certified so many complex ones; nullopt: they were searched for.
  std::optional<std::uint64_t> complex_found{};
  std::uint64_t boxes = 0;
  double seconds = 0;
};

/// How much a search tries.
enum class PostureEffort : std::uint8_t {
  kAll,    ///< each system in turn, and then a count
  kFirst,  ///< the first system, with few boxes: postures can be followed otherwise
};

class PostureSearch {
 public:
  /// `number`: added to the numbers of the systems.
  /// All but the settings must outlive this object.
  PostureSearch(const ArmAtPlace& at, const std::map<std::size_t, SlideRange>& slides,
                std::size_t number, RootSettings settings, Observer* progress);

  /// Rounding  MXCSR at nearest.
  [[nodiscard]] FoundPostures find(PostureEffort effort);

 private:
  [[nodiscard]] bool varies() const { return at_.geometry != ArmGeometry::kNominal; }
  [[nodiscard]] RootJudge judge_of_arm() const;
  [[nodiscard]] Interval trace_gap(const Root& root) const;
  [[nodiscard]] bool is_posture(const Root& root) const;
  [[nodiscard]] std::optional<FoundPostures> by_counting();
  [[nodiscard]] FoundPostures by_opposite_axes();
  [[nodiscard]] FoundPostures by_opposite_axes(std::size_t system);
  [[nodiscard]] FoundPostures by_all_joints();
  [[nodiscard]] RootList search(const RootSystems& systems, const FollowedRanges& ranges);
  bool add_posture(FoundPostures& found, const Root& four, RootJudge& judge,
                   const RootSystems& systems) const;
  [[nodiscard]] FoundPostures found_by(std::size_t system, const RootList& list) const;

  const ArmAtPlace& at_;
  const std::map<std::size_t, SlideRange>& slides_;
  const std::size_t number_;
  RootSettings settings_;
  Observer* const progress_;
  const std::vector<std::size_t> systems_;  ///< without two unknowns
  const Problem problem_{};
  std::uint64_t boxes_ = 0;
  double seconds_ = 0;
};

}  // namespace regulus::detail
