// SPDX-License-Identifier: GPL-3.0-or-later
// A search of a condition number that has stopped between two rounds, as text.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus {

/// The words of `steps` and `open` are separated by spaces; numbers are those of boxes:
///
///     12:3             box 12 was halved in variable 3, into the next two numbers
///     13=0x1.8p+2      box 13 is not split any more; κ < 6 there
///     14-              the constraints exclude box 14
///
/// The numbers after = are no facts: a search that continues bounds κ over these boxes by itself,
/// and asks again what it was told.
struct ConditionState {
  std::string steps{};              ///< in the order in which they were made
  std::string open{};               ///< the other boxes, with their bounds
  std::optional<BoxId> attained{};  ///< the box that showed the attained end
  bool was_told = false;            ///< ConditionSettings::ask gave a bound, or a singular pose

  void add_split(BoxId box, std::size_t variable);
  void add_settled(BoxId box, double upper);
  void add_outside(BoxId box);
  void add_open(BoxId box, double upper);
};

/// A text is not the state of a search; the message says where.
class ConditionStateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The boxes of a state. They tile the variety, whatever the text is, because each is one half of
/// another.
class ConditionTree {
 public:
  struct Step {
    BoxId box;
    std::optional<std::uint32_t> variable;  ///< split in it; nullopt: the next of leaves()
  };
  struct Leaf {
    BoxId box;
    double upper;  ///< of the text; infinite for a box that constraints exclude
  };

  /// Accepts any text. Throws ConditionStateError.
  ConditionTree(const ConditionState& state, std::vector<Interval> root);

  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  /// Those of steps(), in their order, then the open boxes.
  [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
  /// Returns the number of all boxes.
  [[nodiscard]] BoxId size() const { return 1 + 2 * splits_.size(); }
  /// Requires  0 < box < size().
  [[nodiscard]] BoxId parent(BoxId box) const { return splits_[(box - 1) / 2].box; }
  /// Requires  box < size().
  /// Throws    ConditionStateError if the text halves an interval that has no double inside.
  [[nodiscard]] std::vector<Interval> box(BoxId box) const;

 private:
  struct Split {
    BoxId box;
    std::uint32_t variable;
  };
  void read_step(std::string_view word);
  void read_open(std::string_view word);
  void close(BoxId box, std::string_view word);

  std::vector<Interval> root_;
  std::vector<Split> splits_;  ///< the k-th makes the boxes 2k + 1 and 2k + 2
  std::vector<Step> steps_;
  std::vector<Leaf> leaves_;
  std::vector<bool> is_closed_;  ///< by box: a word says what became of it
};

}  // namespace regulus
