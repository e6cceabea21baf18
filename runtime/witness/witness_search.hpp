// SPDX-License-Identifier: Apache-2.0
// Searches for a proof of SINGULARITY. Determinants in plain doubles show where to search. A claim
// needs certified enclosures at the points and, for two points of opposite signs, a segment between
// them that is certified to stay in the variety, with the matrix defined throughout: then A is
// continuous along it and det A vanishes on it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "runtime/evaluation/batch.hpp"
#include "runtime/evaluation/decisions.hpp"
#include "runtime/problem/observer.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/witness/tolerance_balls.hpp"

namespace regulus::detail {

class ApproxZero;

class WitnessSearch {
 public:
  /// `closes_in`: a proof by two points is refined to the zero between them as far as possible.
  WitnessSearch(const Problem& problem, const Settings& settings, bool closes_in = true);

  /// Becomes the search of the problem whose ranges have changed.
  ///
  /// Requires  restart() before anything else.
  void take_ranges();

  /// Returns to the initial state, with the oracles that the settings name now.
  void restart() noexcept;
  /// Forgets the candidates and the proof.
  void forget() noexcept;

  /// Copies the data from which a later search continues; and back. A point of another length than
  /// the variables counts as none. Does not allocate if `into` had such candidates before.
  void copy_candidates(WitnessCandidates& into) const;
  void look_on_from(const WitnessCandidates& candidates);

  /// Returns true if a proof was found.
  [[nodiscard]] bool found() const noexcept { return found_; }
  [[nodiscard]] Reason reason() const noexcept { return reason_; }
  [[nodiscard]] std::uint64_t probes() const noexcept { return probes_; }

  /// Looks at the middles of decided boxes, by the determinants that were computed there.
  void look_at_midpoints(Decisions& batch) noexcept;

  /// Looks at these points, each moved into the inner ranges: the first with each of the others.
  void look_at(std::span<const std::vector<double>> points) noexcept;

  /// Looks at the corners of the variety; if there are more than 64, at 64 of them.
  void look_at_corners() noexcept { look_at_corners(kMaxCorners); }
  /// The same for eight of them, which differ in half of the variables.
  void look_at_some_corners() noexcept { look_at_corners(kLanes); }

  /// Descends from the middle of `box`, one variable at a time, towards the other sign or towards
  /// determinant 0, moving the uncertain quantities too.
  /// `most_starts`: places of the uncertain quantities from which to start, up to nine.
  void descend(std::span<const Interval> box, std::size_t most_starts = 1) noexcept;

  /// Looks at the corners of the variety itself, whose coordinates need not be doubles.
  void look_at_exact_corners() noexcept;

  /// Looks at the point with the ends of ranges that `box` reaches; elsewhere at its middle.
  void look_at_ends(std::span<const Interval> box) noexcept;

  /// Looks for a point whose coordinates are known exactly and where exact algebra shows that the
  /// matrix is singular, first near the middle of `box`. Takes up to a second; without a threshold
  /// only.
  void look_for_exact_place(std::span<const Interval> box) noexcept;

  /// Looks for a small box in the variety that certainly has a singular point, as the algebra encloses
  /// it. Takes as long; without a threshold only.
  void look_for_null_vector(std::span<const Interval> box) noexcept;

  /// Forgets all results and searches inside `box` alone: in its middle, downhill, at its corners.
  /// Returns found().
  bool look_inside(std::span<const Interval> box) noexcept;

  /// Returns the proof, complete with poses, valid until the next search. Requires found().
  /// Errors    std::bad_alloc: the proof may be requested again.
  [[nodiscard]] const Witness& witness();

  /// Returns how many points the proof has, and where one of them is. Requires found(); n entries.
  [[nodiscard]] std::size_t points() const noexcept {
    return reason_ == Reason::kOppositeSigns ? 2 : 1;
  }
  void copy_point(std::size_t index, std::span<Interval> variables) const noexcept;

 private:
  static constexpr std::size_t kMaxCorners = 64;
  void look_at_corners(std::size_t most) noexcept;

  struct Candidate : WitnessCandidates::Candidate {
    Interval determinant;
  };

  [[nodiscard]] double inner_lo(std::size_t variable) const noexcept;
  [[nodiscard]] double inner_hi(std::size_t variable) const noexcept;
  [[nodiscard]] Interval within_inner(std::size_t variable, double x) const noexcept;
  void load_point(std::size_t lane, const double* point) noexcept;
  void load_claim(std::size_t lane, const std::vector<double>& point) noexcept;
  void evaluate_points(std::size_t count) noexcept;
  [[nodiscard]] double approx_objective(std::size_t lane) noexcept;

  void look_at_points(LaneMask lanes) noexcept;
  template <typename Middle>
  void offer(double approx, Middle middle) noexcept;
  template <typename Middle>
  void copy_middle(Middle middle, Candidate& candidate) noexcept;
  void try_opposite_signs() noexcept;
  void try_small() noexcept;

  [[nodiscard]] std::optional<Interval> certify_point(const std::vector<double>& point,
                                                      bool scaled) noexcept;
  enum class Effort : std::uint8_t { kElimination, kAll };
  [[nodiscard]] std::optional<Interval> certify_lane(std::size_t lane,
                                                     const std::vector<double>& point, bool scaled,
                                                     Effort effort) noexcept;
  [[nodiscard]] Interval enclose_at(std::size_t lane, bool scaled, Effort effort) noexcept;
  [[nodiscard]] bool certain_segment(const std::vector<double>& from,
                                     const std::vector<double>& to) noexcept;
  void place_at(std::size_t variable, PlaceInRange place) noexcept;
  void try_exactly() noexcept;
  [[nodiscard]] bool holds_box() noexcept;
  [[nodiscard]] bool is_in_ranges(std::span<const Interval> box) const noexcept;

  void note_balls();
  void load_piece(std::size_t lane, const std::vector<double>& from, const std::vector<double>& to,
                  Interval part) noexcept;
  void close_in() noexcept;
  [[nodiscard]] std::size_t leap_to_zero() noexcept;
  [[nodiscard]] std::size_t give_up_leap() noexcept;
  [[nodiscard]] bool narrow_by_signs(ApproxZero& zero) noexcept;
  [[nodiscard]] bool move_to_middles() noexcept;
  void find_middles(std::size_t place, const std::vector<double>& a, const std::vector<double>& b,
                    LaneMask& between) noexcept;
  [[nodiscard]] bool find_between(const std::vector<double>& a, const std::vector<double>& b,
                                  double part, std::vector<double>& into) noexcept;
  void load_along(std::size_t count) noexcept;
  void approach_nearest(Candidate& side) noexcept;
  void leave_nearest(Candidate& side) noexcept;
  void return_to_nearest(Candidate& side) noexcept;
  [[nodiscard]] bool move_if_certain(Candidate& side, std::size_t lane) noexcept;

  void add_start(std::size_t lane, double sign) noexcept;
  void find_starts(std::span<const Interval> box, double sign) noexcept;
  void go_downhill(std::span<const Interval> box, double sign, double best) noexcept;
  [[nodiscard]] double target(std::size_t variable, double end, Interval range) const noexcept;
  bool step(std::span<const Interval> box, std::size_t first, double sign, double& best) noexcept;
  bool step_ball(std::span<const Interval> box, const ToleranceBalls::Ball& ball, double sign,
                 double& best) noexcept;
  void report(WitnessPoint& into, const Candidate& candidate);
  void report_ends(WitnessPoint& into);
  [[nodiscard]] const Candidate& closest_to_zero() const noexcept;
  void copy_pose(const std::vector<Interval>& point, std::vector<Interval>& pose);

  const Problem& problem_;
  const Settings& settings_;
  DeterminantOracle* oracle_;
  AlgebraOracle* algebra_;
  std::size_t variables_;
  bool square_, scaled_;
  const bool uses_corners_, uses_descents_;
  bool closes_in_;
  ToleranceBalls balls_;
  std::vector<std::optional<Interval>> reach_;  ///< where points may lie, with the balls' axes
  std::vector<std::optional<Interval>> inner_;  ///< the same, or the part of one box
  RowStructure no_structure_;
  Batch points_;
  AlignedBuffer pose_;
  std::vector<Interval> box_;
  Candidate positive_, negative_, small_;
  Candidate nearest_;                      ///< between the two, where the sign is not known
  Candidate far_positive_, far_negative_;  ///< the two before refinement
  struct Start {
    double value = 0;  ///< |det| with the sign of the middle, approximately
    std::vector<double> point;
  };
  std::array<Start, kLanes + 1> starts_;
  std::size_t start_count_ = 0;
  std::vector<bool> in_ball_;  ///< the variables that move with their balls
  std::vector<double> current_, moved_, downhill_;
  std::array<std::vector<double>, kLanes> along_;  ///< points of a segment that are loaded together
  LaneMask claimable_ = 0;  ///< the loaded points that were not moved when they were loaded
  std::uint64_t probes_ = 0;
  bool small_known_ = false, small_fresh_ = false;
  unsigned small_tries_ = 0;
  std::vector<PlaceInRange> places_;  ///< of box_, if it was made for exact algebra
  std::vector<ExactNumber> numbers_;  ///< the same; empty: there are none
  std::vector<Interval> at_ends_;     ///< the point that was found there
  Interval determinant_at_ends_;
  EnclosedPlace enclosed_;  ///< for Reason::kNullVector, in the place of these
  bool found_ = false, found_at_ends_ = false;
  Reason reason_ = Reason::kOppositeSigns;
  Witness witness_;
};

}  // namespace regulus::detail
