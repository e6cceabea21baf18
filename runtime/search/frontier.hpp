// SPDX-License-Identifier: Apache-2.0
// The undecided boxes, in the order of Algorithm 1, lines 20–28.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::detail {

/// A list whose top is the narrowest box. Of the two halves of a box, the first takes its place on
/// top. The second goes to the far end if it is wider than the box there, else just below the
/// first. The boxes on the path from the root to the top have at most one sibling each in the list.
/// So with ranges of width 1 that are decided at width ε it never holds more than m·⌈log₂(1/ε)⌉ + 1
/// boxes; b times that if b boxes are taken at once.
class Frontier final : public OpenBoxes {
 public:
  /// Has room for `capacity` boxes, at least one, without allocation.
  explicit Frontier(std::size_t variables, std::size_t capacity = 64);

  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept override { return size_; }
  /// Counts from the top.
  [[nodiscard]] OpenBox at(std::size_t index) const noexcept override {
    return in_slot(slot(size_ - 1 - index));
  }
  [[nodiscard]] std::size_t max_size() const noexcept { return max_size_; }

  void clear() noexcept { end_ = size_ = max_size_ = 0; }

  /// Returns the box on top. The span is valid until the next insertion.
  [[nodiscard]] OpenBox top() const noexcept;
  void pop() noexcept;

  /// Returns the box at the far end.
  [[nodiscard]] OpenBox end() const noexcept;
  void pop_end() noexcept;

  /// Returns false if memory is exhausted; the list is then unchanged.
  [[nodiscard]] bool push_top(const OpenBox& box, double width) noexcept;
  [[nodiscard]] bool push_end(const OpenBox& box, double width) noexcept;

  /// Adds both halves of a box that was on top.
  [[nodiscard]] bool push_halves(const OpenBox& first, double first_width, const OpenBox& second,
                                 double second_width) noexcept;

 private:
  struct Slot {
    BoxId id;
    std::uint32_t depth;
    double width;
  };
  [[nodiscard]] OpenBox in_slot(std::size_t slot) const noexcept;
  [[nodiscard]] bool grow() noexcept;
  [[nodiscard]] std::size_t slot(std::size_t from_end) const noexcept {
    return (end_ + from_end) % slots_.size();
  }
  void store(std::size_t slot, const OpenBox& box, double width) noexcept;

  // A ring: the far end is at end_, the top at end_ + size_ − 1.
  std::size_t variables_;
  std::size_t end_ = 0;
  std::size_t size_ = 0;
  std::size_t max_size_ = 0;
  std::vector<Slot> slots_;
  std::vector<Interval> boxes_;
};

}  // namespace regulus::detail
