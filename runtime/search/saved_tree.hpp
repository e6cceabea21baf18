// SPDX-License-Identifier: Apache-2.0
// The tree of a search of boxes (box_search.hpp) that has stopped between two rounds, as text.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/problem/observer.hpp"

namespace regulus::detail {

/// The words of `steps` and `open` are separated by spaces; numbers are those of boxes:
///
///     12:3             box 12 was halved in variable 3, into the next two numbers
///     12:3@0x1.8p+2    box 12 was cut there: a search that narrows boxes halves what is left of them
///     13=0x1.8p+2      box 13 is not split any more, and has this bound
///     14-              box 14 is not split any more, and has no bound; before 0x there may be a sign
///
/// Nothing but the splits is a fact: a search that continues judges these boxes again.
struct SavedTree {
  std::string steps{};               ///< in the order in which they were made
  std::string open{};                ///< the other boxes, as the goal orders them
  std::vector<BoxId> shown{};        ///< the boxes that showed more than what is in their subtrees
  std::vector<std::uint64_t> own{};  ///< numbers of the goal's own

  /// `at`: where it was cut; nullopt: in the middle.
  void add_split(BoxId box, std::size_t variable, std::optional<double> at = {});
  /// An infinite bound is none.
  void add_leaf(BoxId box, double bound);
  void add_open(BoxId box, double bound);

  friend bool operator==(const SavedTree&, const SavedTree&) = default;
};

/// A text is not the tree of a search; the message says where.
class SavedTreeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ensures   left ∪ right = x, both strictly narrower; nullopt iff x has no such number inside.
[[nodiscard]] inline std::optional<Halves> cut(const Interval& x, double at) noexcept {
  if (!(x.lo < at && at < x.hi)) return std::nullopt;
  return Halves{{x.lo, at}, {at, x.hi}};
}

/// How the boxes of a search are split.
enum class Splits : std::uint8_t { kInHalves, kByCuts };

/// The boxes of a saved tree. They tile the variety, whatever the text is, because each is one part
/// of another.
class RestoredTree {
 public:
  struct Step {
    BoxId box;
    std::optional<std::uint32_t> variable{};  ///< split in it; nullopt: the next of leaves()
    double at = 0;                            ///< of Splits::kByCuts: where
  };
  struct Leaf {
    BoxId box;
    double bound;  ///< of the text; infinite: it has none
  };

  /// Accepts any text. `splittable`: the number of variables, from the first, that may be halved.
  /// Throws SavedTreeError.
  RestoredTree(const SavedTree& saved, std::vector<Interval> root, std::size_t splittable,
               Splits splits = Splits::kInHalves);

  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  /// Those of steps(), in their order, then the open boxes.
  [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
  /// Returns the number of all boxes.
  [[nodiscard]] BoxId size() const { return 1 + 2 * splits_.size(); }
  /// Returns the number of leaves that are open boxes.
  [[nodiscard]] std::size_t open() const { return open_; }
  /// Requires  0 < box < size().
  [[nodiscard]] BoxId parent(BoxId box) const { return splits_[(box - 1) / 2].box; }
  /// Requires  box < size().
  /// Throws    SavedTreeError if the text halves an interval that has no double inside, or cuts one
  ///           that does not have that number inside.
  [[nodiscard]] std::vector<Interval> box(BoxId box) const;
  /// Returns the number of splits above a box.
  [[nodiscard]] std::uint32_t depth(BoxId box) const;

 private:
  struct Split {
    BoxId box;
    std::uint32_t variable;
    double at;
  };
  [[nodiscard]] std::optional<Halves> halves_of(const Interval& range, const Split& split) const;
  void read_step(std::string_view word);
  void read_leaf(std::string_view rest, BoxId box, std::string_view word);
  void close(BoxId box, std::string_view word);

  std::vector<Interval> root_;
  std::size_t splittable_;
  Splits way_;
  std::vector<Split> splits_;  ///< the k-th makes the boxes 2k + 1 and 2k + 2
  std::vector<Step> steps_;
  std::vector<Leaf> leaves_;
  std::size_t open_ = 0;
  std::vector<bool> is_closed_;  ///< by box: a word says what became of it
};

}  // namespace regulus::detail
