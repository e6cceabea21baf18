// SPDX-License-Identifier: Apache-2.0
// The events of a search. Certificates, checkpoints, progress displays and pavings are observers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/problem/adaptive_threshold.hpp"
#include "runtime/problem/headway.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

/// The root is 0. The lower half of a split gets the next free number; the upper half gets the
/// number after it.
using BoxId = std::uint64_t;

struct OpenBox {
  BoxId id = 0;
  std::uint32_t depth = 0;  ///< splits above it
  std::span<const Interval> box;
};

struct Split {
  BoxId parent;
  std::uint32_t variable;
  double at;
  BoxId lower;  ///< lower + 1 is the upper half
};

/// The proof of a leaf. For the test that certified it: entry p of K is preconditioner[p·8], entry
/// i of v is vector[i·8], i < order (0 if the rule has no v; for kSecondOrder more than the
/// columns). Both are null for a box that was decided in a unit (SearchState::units).
struct Proof {
  const double* preconditioner = nullptr;
  const double* vector = nullptr;
  std::size_t order = 0;
  const Witness* witness = nullptr;            ///< kWitness: valid during the call
  Reason reason = Reason::kAllBoxesCertified;  ///< kWitness: which proof; kBlocked: the reason
  /// Encloses det over the box, if Settings::enclose_determinants is set and det is defined.
  std::optional<Interval> determinant{};
};

/// The boxes that a search has not decided yet.
class OpenBoxes {
 public:
  OpenBoxes() = default;
  OpenBoxes(const OpenBoxes&) = delete;
  OpenBoxes& operator=(const OpenBoxes&) = delete;
  virtual ~OpenBoxes() = default;

  [[nodiscard]] virtual std::size_t size() const noexcept = 0;
  /// In the order in which they would be decided.
  [[nodiscard]] virtual OpenBox at(std::size_t index) const noexcept = 0;
};

/// The points from which a search for a singularity continues: those of the largest determinants of
/// either sign that it saw, and of the smallest one below α. Heuristics: no proof depends on them.
struct WitnessCandidates {
  struct Candidate {
    std::vector<double> point;  ///< an entry for each variable
    double approx = 0.0;        ///< determinant, to nearest; 0 = no candidate, but for `small`
    double tried = 0.0;         ///< magnitude at which a proof last failed
  };
  Candidate positive, negative, small;
  bool small_known = false, small_fresh = false;
  unsigned small_tries = 0;
};

/// What a search knows besides its open boxes. With both it can continue as if it had not stopped.
struct SearchState {
  BoxId next_id = 1;  ///< of the next box
  Statistics statistics;
  std::vector<std::uint64_t> filter_boxes;  ///< how many rest on each of Settings::filters
  std::uint64_t next_descent = 1;           ///< boxes at which to search for a singularity again
  AdaptiveThreshold threshold;
  WitnessCandidates candidates;
  Headway headway;
  /// After its first boxes a long search is cut into units (runtime/cluster/unit.hpp): the numbers
  /// of open boxes in each, in their order. Empty: there are no units yet.
  std::vector<std::uint32_t> units;
  /// A box could not be decided: NO SINGULARITY is not possible any more.
  bool blocked = false;
  Reason blocked_reason = Reason::kAllBoxesCertified;
  std::uint64_t boxes_when_blocked = 0;
  std::vector<Interval> blocking_box;  ///< the first of them, or the one that is undefined
  std::optional<Witness> witness;      ///< the first of an exhaustive search
  Reason witness_reason = Reason::kOppositeSigns;
};

class Observer {
 public:
  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer() = default;

  virtual void on_start(const Problem&, const Settings&) noexcept {}
  virtual void on_split(const OpenBox&, const Split&) noexcept {}
  virtual void on_leaf(const OpenBox&, Rule, const Proof&) noexcept {}
  /// Called for each undecided box if a budget, an interrupt or memory ends the search.
  virtual void on_open(const OpenBox&) noexcept {}
  /// Called after each batch of boxes.
  virtual void on_progress(const Statistics&, std::uint64_t /*frontier*/) noexcept {}
  /// Called after each round of batches. If it returns true, on_pause follows.
  [[nodiscard]] virtual bool wants_pause() noexcept { return false; }
  /// Receives everything reported so far and everything left; no box is being decided. Also called
  /// if a budget or an interrupt ends the search, before on_open.
  virtual void on_pause(const SearchState&, const OpenBoxes&) noexcept {}
  virtual void on_finish(const Result&) noexcept {}
};

}  // namespace regulus
