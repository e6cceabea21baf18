// SPDX-License-Identifier: Apache-2.0
// Tests the cells of orthants.hpp.
#include "runtime/regularity/orthants.hpp"

#include <algorithm>

#include "runtime/regularity/backend.hpp"

namespace regulus {
namespace {

constexpr unsigned kMaxOrthantCells = kMaxOrthantRows << (kMaxOrthantRows - 1);

/// Tests cells by halves.
class PartsOfCells {
 public:
  PartsOfCells(const OrthantProblem& problem, unsigned halvings) noexcept
      : p_(problem), halvings_(halvings) {}

  /// Tests up to eight cells. `remaining` becomes one of them if it may contain a ρ.
  [[nodiscard]] bool certain_empty(const OrthantCell* cells, unsigned count,
                                   OrthantCell& remaining) noexcept {
    count_ = 0;
    for (unsigned c = 0; c < count; ++c) push_whole(cells[c]);
    while (count_ > 0) {
      const unsigned alive = test_last();
      for (unsigned lane = 0; lane < kLanes; ++lane) {
        if ((alive >> lane & 1U) == 0 || push_halves(eight_[lane])) continue;
        remaining = {eight_[lane].orthant, fixed_row(eight_[lane])};
        return false;
      }
    }
    return true;
  }

 private:
  static constexpr unsigned kMostWaiting = 512;
  static constexpr double kNarrowest = 0x1p-20;  ///< of ζ

  void push_whole(const OrthantCell& cell) noexcept {
    OrthantPart& part = waiting_[count_++];
    part.orthant = cell.orthant;
    for (unsigned j = 0; j < p_.rows; ++j) {
      part.low[j] = cell.fixed == j ? p_.scale[j] : 0.0;
      part.high[j] = p_.scale[j];
    }
  }

  /// Takes up to eight parts from the end, and reduces them. Returns those that may contain a ρ.
  unsigned test_last() noexcept {
    const unsigned taken = std::min(count_, unsigned{kLanes});
    count_ -= taken;
    for (unsigned lane = 0; lane < kLanes; ++lane)
      eight_[lane] = waiting_[count_ + (lane < taken ? lane : 0)];
    return regularity_backend().remaining_parts(p_, eight_) & ((1U << taken) - 1);
  }

  /// Returns false if the part must not be halved.
  bool push_halves(const OrthantPart& part) noexcept {
    unsigned widest = 0;
    for (unsigned j = 1; j < p_.rows; ++j)
      if (width(part, j) > width(part, widest)) widest = j;
    if (halvings_ == 0 || count_ + 2 > kMostWaiting || !(width(part, widest) > kNarrowest))
      return false;
    --halvings_;
    const double middle = 0.5 * part.low[widest] + 0.5 * part.high[widest];
    waiting_[count_] = waiting_[count_ + 1] = part;
    waiting_[count_++].high[widest] = middle;
    waiting_[count_++].low[widest] = middle;
    return true;
  }

  [[nodiscard]] double width(const OrthantPart& part, unsigned j) const noexcept {
    return (part.high[j] - part.low[j]) / p_.scale[j];
  }

  [[nodiscard]] unsigned fixed_row(const OrthantPart& part) const noexcept {
    unsigned row = 0;
    while (row + 1 < p_.rows && part.low[row] < p_.scale[row]) ++row;
    return row;
  }

  const OrthantProblem& p_;
  unsigned halvings_, count_ = 0;
  OrthantPart waiting_[kMostWaiting], eight_[kLanes];
};

}  // namespace

bool certain_orthants_empty(const OrthantProblem& problem, OrthantCell& hint,
                            unsigned halvings) noexcept {
  const RegularityBackend& backend = regularity_backend();
  OrthantCell cells[kMaxOrthantCells];
  unsigned count = 0;
  for (unsigned first = 0; first < 1U << (problem.rows - 1); first += kLanes) {
    unsigned possible[kMaxOrthantRows];
    backend.possible_rows(problem, first, possible);
    for (unsigned lane = 0; lane < kLanes && first + lane < 1U << (problem.rows - 1); ++lane)
      for (unsigned row = 0; row < problem.rows; ++row)
        if ((possible[row] >> lane & 1U) != 0) cells[count++] = {first + lane, row};
  }
  const auto is_hint = [&hint](const OrthantCell& cell) {
    return cell.orthant == hint.orthant && cell.fixed == hint.fixed;
  };
  if (count == 0) return true;
  std::iter_swap(cells, std::find_if(cells, cells + count - 1, is_hint));
  PartsOfCells parts(problem, halvings);
  for (unsigned first = 0; first < count; first += kLanes)
    if (!parts.certain_empty(cells + first, std::min(count - first, unsigned{kLanes}), hint))
      return false;
  return true;
}

}  // namespace regulus
