// SPDX-License-Identifier: Apache-2.0
// The claim of a search, and its reason.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus {

enum class Verdict : std::uint8_t { kNoSingularity, kSingularity, kPossibleProblem };

/// The reason for a verdict, or for the lack of one.
enum class Reason : std::uint8_t {
  kAllBoxesCertified,
  kOppositeSigns,     ///< two points, det of opposite signs, joined within the variety
  kSmallDeterminant,  ///< a point with |det| ≤ α
  kAlwaysSingular,    ///< the determinant is the zero function, by exact algebra
  kWidth,             ///< a box at the minimum width could not be decided
  kUncertainty,       ///< at one pose the uncertain quantities alone defeat the test
  kUndefined,         ///< an expression is undefined at, or near, a pose
  kBoxBudget,
  kTimeBudget,
  kInterrupted,
  kMemory,
  kBadProblem,
  // Checkpoints store the reasons above by number, so new reasons must come here.
  kEmptyVariety,   ///< the constraints exclude every pose: there is nothing to claim
  kSeemsSingular,  ///< the determinant seems to vanish at every pose, but nothing proves this
  kStalled,        ///< boxes are certified so slowly that the search would not end
  kLostRank,       ///< a point where a matrix with more rows than columns has not full rank
  kNullVector,     ///< a box with a point where a null vector exists, which is enclosed, too
};

/// Tells if the constraints leave any pose of the variety.
enum class Occupancy : std::uint8_t {
  kUnknown,
  kEmpty,      ///< proved: none
  kInhabited,  ///< proved: at least one
};

/// The decision about a box, and the test that made it.
enum class Rule : std::uint8_t {
  kOutside,         ///< a constraint is positive throughout
  kHMatrix,         ///< Pv < v, natural entries
  kMeanValue,       ///< Pv < v, smaller of natural and mean-value bounds
  kSecondOrder,     ///< Tv < v, second order, uncertain quantities by the row that they touch
  kOrthants,        ///< the same bounds, direction by direction for the uncertain rows
  kDeterminant,     ///< interval determinant, by expansion
  kElimination,     ///< interval determinant, by elimination
  kRohn,            ///< vertex determinants
  kClosedForm,      ///< the determinant in closed form, or its values on faces of the box
  kFilter,          ///< a filter certifies it; Regulus has not checked that
  kMultiprecision,  ///< the determinant, with more bits than doubles have
  kWitness,         ///< a singularity inside the box is certified; exhaustive searches only
  kBlocked,         ///< not decided and not split any more
};
inline constexpr std::size_t kRules = static_cast<std::size_t>(Rule::kBlocked) + 1;

struct WitnessPoint {
  std::vector<Interval> variables;  ///< thin wherever the range holds a double
  /// Empty, or for each variable: if the point is at an end of its range, which is not the double
  /// next to it. The interval in `variables` encloses that end.
  std::vector<PlaceInRange> places{};
  /// Empty, or for each variable: the number that the interval in `variables` encloses.
  std::vector<ExactNumber> numbers{};
  /// This is det A for opposite signs, det J⁻¹ for a small determinant. A lost rank has none.
  Interval determinant;
  std::vector<Interval> pose;
  /// Empty, or an enclosure of v, A·v = 0, in the model's units; its largest component is the number 1.
  /// The singular point is then in the box of `variables`: those of `chosen` have some value of their
  /// intervals there, each other one has its own value.
  std::vector<Interval> null_vector{};
  std::vector<std::uint32_t> chosen{};
};

/// Two points of opposite signs, or one of small determinant, lost rank or with a null vector.
struct Witness {
  std::vector<WitnessPoint> points;
  /// The point with the smallest determinant of all tested on the way to the zero. Exhaustive
  /// searches do not approach the zero, so they have none.
  std::optional<WitnessPoint> near{};
};

struct Statistics {
  std::uint64_t boxes = 0;  ///< evaluated
  std::uint64_t max_frontier = 0;
  std::uint64_t probes = 0;  ///< points at which a determinant was computed to find a witness
  std::array<std::uint64_t, kRules> leaves{};
  double seconds = 0;
};

struct Result {
  Verdict verdict = Verdict::kPossibleProblem;
  Reason reason = Reason::kBadProblem;
  Method method = Method::kAuto;
  Statistics statistics;
  /// The budget, interrupt or lack of memory because of which boxes are left open.
  std::optional<Reason> stopped_by;
  std::vector<std::uint64_t> filter_boxes;  ///< how many rest on each of Settings::filters
  std::optional<Witness> witness;
  std::vector<Interval> blocking_box;  ///< POSSIBLE PROBLEM: the box that could not be decided
  /// NO SINGULARITY with kUnknown may be about no pose at all; with kEmpty it is not claimed.
  Occupancy occupancy = Occupancy::kUnknown;
  /// A pose certainly inside the constraints, if a search for one succeeded: for each variable a
  /// value, or an interval that contains the true one.
  std::vector<Interval> inhabitant;
};

[[nodiscard]] const char* name(Verdict verdict) noexcept;
[[nodiscard]] const char* describe(Reason reason) noexcept;
[[nodiscard]] const char* name(Rule rule) noexcept;

}  // namespace regulus
