// SPDX-License-Identifier: Apache-2.0
// Tests the cells of orthants.hpp.
#include "runtime/regularity/orthants.hpp"

#include <algorithm>

#include "runtime/regularity/backend.hpp"

namespace regulus::detail {
namespace {

constexpr unsigned kMaxOrthantCells = kMaxOrthantRows << (kMaxOrthantRows - 1);

/// Tests cells by halves. How many it takes for a cell does not depend on the other cells.
class PartsOfCells {
 public:
  PartsOfCells(const OrthantProblem& problem, unsigned halvings) noexcept
      : p_(problem), halvings_(halvings) {}

  /// Tests up to eight cells. `remaining` becomes one of them if it may contain a ρ.
  [[nodiscard]] bool certain_empty(const OrthantCell* cells, unsigned count,
                                   OrthantCell& remaining) noexcept {
    OrthantPart parts[kLanes];
    for (unsigned lane = 0; lane < kLanes; ++lane)
      parts[lane] = whole(cells[lane < count ? lane : 0]);
    const unsigned alive = test(parts, count);
    for (unsigned lane = 0; lane < count; ++lane) {
      if ((alive >> lane & 1U) == 0 || certain_empty(parts[lane])) continue;
      remaining = cells[lane];
      return false;
    }
    return true;
  }

 private:
  static constexpr unsigned kMostWaiting = 512;
  static constexpr double kNarrowest = 0x1p-20;  ///< of ζ

  [[nodiscard]] OrthantPart whole(const OrthantCell& cell) const noexcept {
    OrthantPart part;
    part.orthant = cell.orthant;
    for (unsigned j = 0; j < p_.rows; ++j) {
      part.low[j] = cell.fixed == j ? p_.scale[j] : 0.0;
      part.high[j] = p_.scale[j];
    }
    return part;
  }

  /// Reduces eight parts. Returns those of the first `count` that may contain a ρ.
  [[nodiscard]] unsigned test(OrthantPart* parts, unsigned count) const noexcept {
    return regularity_backend().remaining_parts(p_, parts) & ((1U << count) - 1);
  }

  [[nodiscard]] bool certain_empty(const OrthantPart& part) noexcept {
    count_ = 0;
    bool halved = push_halves(part);
    while (halved && count_ > 0) {
      OrthantPart parts[kLanes];
      const unsigned taken = std::min(count_, unsigned{kLanes});
      count_ -= taken;
      for (unsigned lane = 0; lane < kLanes; ++lane)
        parts[lane] = waiting_[count_ + (lane < taken ? lane : 0)];
      for_each_lane(static_cast<LaneMask>(test(parts, taken)),
                    [&](std::size_t lane) { halved = halved && push_halves(parts[lane]); });
    }
    return halved;
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

  const OrthantProblem& p_;
  unsigned halvings_, count_ = 0;
  OrthantPart waiting_[kMostWaiting];
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

}  // namespace regulus::detail
