// SPDX-License-Identifier: Apache-2.0
// The boxes that a search took last time, decided before it asks for them.
//
// The first rounds of a search have fewer boxes than a batch has lanes, and a batch takes as long
// with one box as with eight. So the next search of the same robot decides eight boxes together in
// the order in which the last one took them. Each box is derived by halving from the root of the
// new search. A decision is used only for the very box that it is about, and decisions do not
// depend on their neighbours (decisions.hpp). So a search with foresight has the same result as one
// without; a wrong guess costs time only.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/search/decider.hpp"

namespace regulus {

class Foresight {
 public:
  /// A search that takes no more than so many boxes is foreseen to its end.
  static constexpr std::size_t kMost = 64;

  /// `order`: of the vectors that prove regularity. The problem must outlive this object.
  Foresight(const Problem& problem, const Settings& settings, const RowStructure& structure,
            std::size_t order);

  /// Starts a search of these boxes, with what the last one from a root has taught.
  void begin(std::span<const OpenBox> open, const SearchState& state) noexcept;

  /// Notes that the search takes a box, and that it has split one.
  void note_box(const OpenBox& box) noexcept;
  void note_split(const OpenBox& parent, std::uint32_t variable, BoxId first) noexcept;

  /// Decides a batch of boxes that were noted last, if they were foreseen; false: it is undecided.
  ///
  /// Rounding  to nearest.
  [[nodiscard]] bool decide(Decisions& asked, Decider& decider) noexcept;

 private:
  /// One box: a half of an earlier one.
  struct Step {
    std::uint32_t parent = 0;  ///< its place in the order
    std::uint32_t variable = 0;
    bool second = false;
    friend bool operator==(const Step&, const Step&) = default;
  };
  /// Boxes in the order in which a search took them. The first is its root.
  struct Course {
    std::array<Step, kMost> step;
    std::size_t size = 0;
  };

  [[nodiscard]] bool decide_ahead(Decider& decider) noexcept;
  [[nodiscard]] Decisions* room_for_batch(std::size_t batch) noexcept;
  [[nodiscard]] bool add(const Step& step, Decisions& batch) noexcept;

  const Problem& problem_;
  const std::size_t order_;
  const bool applies_;
  Course last_, now_;
  bool notes_ = false;                ///< the search began at a root
  bool foresees_ = false;             ///< as long as it goes the way of the last one
  std::size_t ahead_ = 0;             ///< boxes of last_ that are decided
  std::vector<Step> of_id_;           ///< by the number of the box
  std::vector<std::uint32_t> place_;  ///< in now_, by the number of the box
  std::vector<Interval> box_;
  std::vector<std::unique_ptr<Decisions>> batches_;  ///< eight boxes of last_ each
};

}  // namespace regulus
