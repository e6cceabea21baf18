// SPDX-License-Identifier: Apache-2.0
// A search uses what the last one has taught.
//
// The first rounds of a search have fewer boxes than a batch has lanes, and a batch takes as long
// with one box as with eight. So the next search of the same robot decides eight boxes together, in
// the order in which the last one took them. Each box is derived by halving from the root of the
// new search. A decision is used only for the very box that it is about, and decisions do not
// depend on their neighbours (decisions.hpp). So a search with foresight has the same result as one
// without; a wrong guess costs time only.
//
// If the problem is the same, too, boxes that were split will be split again, as nothing that they
// depend on has changed. Only leaves are decided then: all that a verdict rests on is proved anew.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/search/decider.hpp"

namespace regulus::detail {

/// Boxes in the order in which a search took them: a root, and halves of earlier ones.
struct Course {
  /// A search that takes no more boxes is foreseen to its end.
  static constexpr std::size_t kMost = 64;

  struct Step {
    std::uint32_t parent = 0;  ///< its place in the order
    std::uint32_t variable = 0;
    bool second = false;
    friend bool operator==(const Step&, const Step&) = default;
  };
  std::array<Step, kMost> step;
  std::array<std::optional<Recollection>, kMost> split;  ///< of boxes that were split
  std::size_t size = 0;

  /// Keeps the order alone, for another problem.
  void forget_splits() noexcept { split.fill(std::nullopt); }
};

class Foresight {
 public:
  /// `order`: of the vectors that prove regularity. Problem and settings must outlive this object.
  Foresight(const Problem& problem, const Settings& settings, const RowStructure& structure,
            std::size_t order);
  Foresight(const Foresight&) = delete;
  Foresight& operator=(const Foresight&) = delete;

  /// Takes what a search of another problem has taught, with as many variables.
  void learn_from(const Foresight& other) noexcept;
  /// Takes what the last search has taught for the problem whose ranges have changed.
  void take_ranges() noexcept { learn_from(*this); }

  /// Starts a search of these boxes, with what the last one from a root has taught.
  void begin(std::span<const OpenBox> open, const SearchState& state) noexcept;

  /// Notes that the search takes a box, and that it has split one.
  void note_box(const OpenBox& box) noexcept;
  void note_split(const OpenBox& parent, std::uint32_t variable, BoxId first) noexcept;

  /// Decides a batch of boxes that were noted last, if they were foreseen; false: it is undecided.
  ///
  /// Rounding  to nearest.
  [[nodiscard]] bool decide(Decisions& asked, Decider& decider) noexcept;

  /// Learns from decisions about boxes that were noted.
  void learn(const Decisions& batch) noexcept;

 private:
  /// A foreseen box, and where its decision is; in no batch if it was split last time.
  struct Foreseen {
    std::vector<Interval> box;
    std::uint32_t depth = 0;
    const Decisions* batch = nullptr;
    std::size_t lane = 0;
  };

  [[nodiscard]] std::optional<std::size_t> place_of(const OpenBox& box) const noexcept;
  [[nodiscard]] bool foresee(Decider& decider) noexcept;
  [[nodiscard]] bool derive_box(std::size_t place) noexcept;
  [[nodiscard]] bool take(Decisions& asked, std::size_t lane, std::size_t place) noexcept;
  [[nodiscard]] Decisions* room_for_batch() noexcept;

  const Problem& problem_;
  const Settings& settings_;
  const std::size_t order_;
  const bool applies_;
  bool notes_ = false;     ///< the search began at a root
  bool foresees_ = false;  ///< as long as it goes the way of the last one
  bool had_closed_form_ = false;
  std::array<Course, 2> courses_;
  Course* last_ = &courses_[0];
  Course* now_ = &courses_[1];
  std::vector<Course::Step> of_id_;        ///< by the number of a box
  std::vector<std::uint32_t> place_;       ///< in now_, by the number of a box
  std::array<BoxId, Course::kMost> id_{};  ///< by the place in now_
  std::vector<Foreseen> foreseen_;         ///< the first ahead_ boxes of last_
  std::size_t ahead_ = 0;
  std::vector<std::unique_ptr<Decisions>> batches_;
  std::size_t used_batches_ = 0;
};

}  // namespace regulus::detail
