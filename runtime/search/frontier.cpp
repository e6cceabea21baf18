// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/frontier.hpp"

#include <algorithm>
#include <new>

namespace regulus::detail {
Frontier::Frontier(std::size_t variables, std::size_t capacity)
    : variables_(variables), slots_(capacity), boxes_(capacity * variables) {}

OpenBox Frontier::in_slot(std::size_t s) const noexcept {
  return {slots_[s].id, slots_[s].depth, {boxes_.data() + s * variables_, variables_}};
}

OpenBox Frontier::top() const noexcept { return in_slot(slot(size_ - 1)); }

void Frontier::pop() noexcept { --size_; }

OpenBox Frontier::end() const noexcept { return in_slot(end_); }

void Frontier::pop_end() noexcept {
  end_ = slot(1);
  --size_;
}

void Frontier::store(std::size_t s, const OpenBox& box, double width) noexcept {
  slots_[s] = {box.id, box.depth, width};
  std::copy(box.box.begin(), box.box.end(), boxes_.begin() + static_cast<long>(s * variables_));
}

bool Frontier::grow() noexcept {
  try {
    std::vector<Slot> slots(2 * slots_.size());
    std::vector<Interval> boxes(2 * boxes_.size());
    for (std::size_t k = 0; k < size_; ++k) {
      const std::size_t s = slot(k);
      slots[k] = slots_[s];
      std::copy_n(boxes_.begin() + static_cast<long>(s * variables_), variables_,
                  boxes.begin() + static_cast<long>(k * variables_));
    }
    slots_.swap(slots);
    boxes_.swap(boxes);
    end_ = 0;
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

bool Frontier::push_top(const OpenBox& box, double width) noexcept {
  if (size_ == slots_.size() && !grow()) return false;
  store(slot(size_), box, width);
  max_size_ = std::max(max_size_, ++size_);
  return true;
}

bool Frontier::push_end(const OpenBox& box, double width) noexcept {
  if (size_ == slots_.size() && !grow()) return false;
  end_ = slot(slots_.size() - 1);
  store(end_, box, width);
  max_size_ = std::max(max_size_, ++size_);
  return true;
}

bool Frontier::push_halves(const OpenBox& first, double first_width, const OpenBox& second,
                           double second_width) noexcept {
  while (size_ + 2 > slots_.size())
    if (!grow()) return false;
  const bool to_end = size_ == 0 || second_width > slots_[end_].width;
  const bool stored = to_end ? push_end(second, second_width) : push_top(second, second_width);
  return stored && push_top(first, first_width);
}

}  // namespace regulus::detail
