// SPDX-License-Identifier: Apache-2.0
// Makes all decisions about a batch of boxes that do not depend on other batches: which boxes are
// outside, which ones a test certifies, where the others are split or why they are blocked. Each
// thread has its own decider.
#pragma once

#include "runtime/evaluation/batch.hpp"
#include "runtime/evaluation/bisector.hpp"
#include "runtime/evaluation/decisions.hpp"
#include "runtime/evaluation/regularity_tests.hpp"
#include "runtime/problem/row_structure.hpp"
#include "runtime/witness/box_witness.hpp"

namespace regulus::detail {

class Decider {
 public:
  /// All three must outlive this object. tries_easy_tests: uses the lanes that `decisions` marks
  /// as easy.
  Decider(const Problem& problem, const Settings& settings, const RowStructure& structure,
          bool tries_easy_tests = false);

  /// Becomes the decider of the problem whose ranges have changed.
  void take_ranges();

  /// Decides the boxes of `decisions`, 1…8. Their proofs refer to this object until its next call,
  /// unless `keep_proofs` is true.
  ///
  /// Rounding  to nearest.
  /// Errors    std::bad_alloc, in an exhaustive search only, which copies witnesses: the batch is
  ///           then undecided and may be decided again. Other searches allocate nothing.
  void decide(Decisions& decisions, bool keep_proofs);

  [[nodiscard]] const Bisector& bisector() const noexcept { return bisector_; }
  /// Returns the number of tests for easy boxes.
  [[nodiscard]] std::size_t easy_tests() const noexcept { return easy_tests_.size(); }
  /// Returns true if this test for easy boxes certifies all of these.
  [[nodiscard]] bool all_easy(std::size_t test, Decisions& decisions) noexcept;
  /// Returns the entries of v.
  [[nodiscard]] std::size_t order() const noexcept { return batch_.order(); }

 private:
  void learn_from_root() noexcept;
  void load(Decisions& decisions) noexcept;
  void leave(std::size_t lane, Rule rule, std::size_t order = 0) noexcept;
  void leave_with_witness(std::size_t lane);
  [[nodiscard]] LaneMask leave_outside(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_by(RegularityTest& test, LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_easy(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_certified(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_by_every_test(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_by_closed_form(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_by_products(LaneMask lanes) noexcept;
  [[nodiscard]] LaneMask leave_small(LaneMask lanes);
  [[nodiscard]] LaneMask at_minimum_width(LaneMask lanes) noexcept;
  [[nodiscard]] std::size_t vector_order(Rule rule) const noexcept;
  void split_or_block(std::size_t lane, bool hopeless) noexcept;
  void split_or_look_inside(std::size_t lane);
  void split(std::size_t lane, std::size_t variable) noexcept;
  void block(std::size_t lane, Reason reason) noexcept;
  void load_center(std::size_t lane, std::size_t thin_variables, std::size_t center) noexcept;
  [[nodiscard]] Reason reason_at_minimum_width(std::size_t lane) noexcept;
  [[nodiscard]] bool undefined_at_middle(std::size_t lane) noexcept;
  [[nodiscard]] bool certified_by_determinant(std::size_t lane) noexcept;
  [[nodiscard]] bool certified_by_oracle(std::size_t lane) noexcept;
  [[nodiscard]] LaneMask leave_where_poses_stall(LaneMask lanes, LaneMask& hopeless) noexcept;
  [[nodiscard]] LaneMask left_at_centers(LaneMask centers, bool longest) noexcept;

  const Problem& problem_;
  const Settings& settings_;
  const bool keeps_uncertainty_whole_, looks_at_midpoints_, scaled_, tries_products_;
  const RowStructure no_structure_;
  Batch batch_;
  Batch center_;  ///< asked for regularity only if uncertain quantities are kept whole
  TestSequence tests_, easy_tests_;
  Bisector bisector_;
  std::optional<BoxWitness> box_witness_;  ///< for an exhaustive search
  std::vector<Interval> middle_;
  Decisions* out_ = nullptr;
};

}  // namespace regulus::detail
