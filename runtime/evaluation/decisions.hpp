// SPDX-License-Identifier: Apache-2.0
// Up to eight boxes on their way from the frontier through the tests and back, and the decision
// about each. All of it depends only on the boxes and on the threshold of costly tests. It does not
// depend on which thread decided them, or when.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "runtime/evaluation/batch.hpp"
#include "runtime/problem/adaptive_threshold.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::detail {

/// Tests for boxes that are probably decided by less than the usual tests (regularity_tests.hpp).
inline constexpr std::size_t kMaxEasyTests = 2;

/// The decision about one box.
struct Decision {
  enum class Kind : std::uint8_t { kLeaf, kSplit };
  Kind kind = Kind::kLeaf;
  Rule rule = Rule::kBlocked;           ///< if it is a leaf
  Reason reason = Reason::kWidth;       ///< kWitness: which proof; kBlocked: the reason
  std::uint32_t variable = 0;           ///< to split
  std::size_t order = 0;                ///< entries of v
  std::size_t filter = 0;               ///< kFilter: which of Settings::filters
  std::optional<Interval> determinant;  ///< if the settings ask for it
  std::optional<Witness> witness;       ///< kWitness
};

/// det A, or det J⁻¹ if α > 0, at the middle of each box, to nearest. A lane has none if its middle
/// is outside a constraint, or if A is not defined there.
struct MidpointDeterminants {
  LaneMask lanes = 0;
  double approx[kLanes];
};

/// Requires  Batch::approx_row_scale, if `scaled` is true.
[[nodiscard]] MidpointDeterminants approx_midpoint_determinants(Batch& batch, LaneMask lanes,
                                                                bool scaled) noexcept;

/// Keeps what an earlier search found out about a box that must be split. It proves nothing.
struct Recollection {
  std::uint32_t variable = 0;       ///< to split
  bool inside = false;              ///< certainly inside all constraints
  std::optional<double> at_middle;  ///< of MidpointDeterminants
};

class Decisions {
 public:
  /// Makes room for a problem of that size, and for v of that order.
  Decisions(const regulus_kernel& kernel, std::size_t order)
      : variables_(kernel.variables),
        points_(std::size_t{kernel.rows} * kernel.columns * kLanes),
        order_(order * kLanes),
        boxes_(kLanes * variables_),
        preconditioner_(points_),
        vector_(order_) {}

  void clear() noexcept {
    count_ = 0;
    budget = {};
    easy = {};
    uncertified = inside = 0;
    forget_attempt();
  }
  /// Keeps the boxes, which of them are easy, and the threshold of their budget.
  void forget_attempt() noexcept {
    decided = false;
    budget.anyway = budget.last = 0;
    budget.trials = 0;
    midpoint_determinants.lanes = 0;
    probes = 0;
  }
  /// Copies a box to the next lane.
  void add(const OpenBox& box) noexcept {
    std::copy(box.box.begin(), box.box.end(), box_of(count_).begin());
    open_[count_] = {box.id, box.depth, box_of(count_)};
    ++count_;
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] const OpenBox& open(std::size_t lane) const noexcept { return open_[lane]; }
  [[nodiscard]] std::span<Interval> box_of(std::size_t lane) noexcept {
    return {boxes_.data() + lane * variables_, variables_};
  }

  /// Copies the proofs of a batch that will be used again.
  void keep_proofs(Batch& batch) noexcept {
    std::copy_n(batch.preconditioner().data(), points_, preconditioner_.get());
    std::copy_n(batch.vector().data(), order_, vector_.get());
    refer_to(preconditioner_.get(), vector_.get());
  }
  /// Takes the proofs from there, where entries lie as in Proof; the arguments are of lane 0.
  void refer_to(const double* preconditioner, const double* vector) noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      preconditioner_of_[lane] = preconditioner + lane;
      vector_of_[lane] = vector + lane;
    }
  }
  /// Copies the decision about the same box in a lane of another object, which must have kept its
  /// proofs, and must keep them as long as this object needs them.
  void take(std::size_t lane, const Decisions& from, std::size_t there) noexcept {
    decision[lane] = from.decision[there];
    copy_lane(from.uncertified, there, uncertified, lane);
    copy_lane(from.inside, there, inside, lane);
    copy_lane(from.midpoint_determinants.lanes, there, midpoint_determinants.lanes, lane);
    midpoint_determinants.approx[lane] = from.midpoint_determinants.approx[there];
    preconditioner_of_[lane] = from.preconditioner_of_[there];
    vector_of_[lane] = from.vector_of_[there];
  }
  /// Requires  the box must be split.
  [[nodiscard]] Recollection recollection(std::size_t lane) const noexcept {
    Recollection seen{decision[lane].variable, has_lane(inside, lane), std::nullopt};
    if (has_lane(midpoint_determinants.lanes, lane))
      seen.at_middle = midpoint_determinants.approx[lane];
    return seen;
  }
  void recall(std::size_t lane, const Recollection& seen) noexcept {
    decision[lane] = {};
    decision[lane].kind = Decision::Kind::kSplit;
    decision[lane].variable = seen.variable;
    copy_lane(1, 0, uncertified, lane);
    copy_lane(seen.inside, 0, inside, lane);
    copy_lane(seen.at_middle.has_value(), 0, midpoint_determinants.lanes, lane);
    midpoint_determinants.approx[lane] = seen.at_middle.value_or(0.0);
  }
  [[nodiscard]] Proof proof(std::size_t lane) const noexcept {
    const Decision& d = decision[lane];
    Proof proof;
    proof.preconditioner = preconditioner_of_[lane];
    if (d.order > 0) proof.vector = vector_of_[lane], proof.order = d.order;
    if (d.witness) proof.witness = &*d.witness;
    proof.reason = d.reason;
    proof.determinant = d.determinant;
    return proof;
  }

  bool decided = false;
  std::array<LaneMask, kMaxEasyTests> easy{};  ///< where make_easy_tests()[i] probably suffices
  TestBudget budget;
  Decision decision[kLanes];
  LaneMask uncertified = 0;  ///< neither outside nor certified by a test
  LaneMask inside = 0;       ///< certainly inside all constraints
  MidpointDeterminants midpoint_determinants;
  std::uint64_t probes = 0;  ///< determinants computed in search of a witness

 private:
  static void copy_lane(LaneMask from, std::size_t there, LaneMask& to, std::size_t lane) noexcept {
    to = (to & ~(1U << lane)) | (from >> there & 1U) << lane;
  }

  std::size_t variables_, points_, order_, count_ = 0;
  std::vector<Interval> boxes_;
  OpenBox open_[kLanes];
  AlignedBuffer preconditioner_, vector_;
  const double* preconditioner_of_[kLanes] = {};
  const double* vector_of_[kLanes] = {};
};

}  // namespace regulus::detail
