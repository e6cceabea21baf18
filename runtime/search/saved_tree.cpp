// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/saved_tree.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace regulus::detail {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

void add_number(std::string& text, char before, double number) {
  char digits[40];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, std::fabs(number), std::chars_format::hex).ptr;
  (text += before) += std::signbit(number) ? "-0x" : "0x";
  text.append(digits, end) += ' ';
}

void add_bounded(std::string& text, BoxId box, double bound) {
  text += std::to_string(box);
  if (bound < kNoBound)
    add_number(text, '=', bound);
  else
    text += "- ";
}

[[noreturn]] void refuse_word(std::string_view word, const char* expected) {
  throw SavedTreeError("found '" + std::string(word) + "', expected " + expected);
}

/// Takes a number from the start of `rest`.
std::uint64_t take_number(std::string_view& rest, std::string_view word) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc{}) refuse_word(word, "a number");
  rest.remove_prefix(std::size_t(end - rest.data()));
  return number;
}

double read_real(std::string_view digits, std::string_view word) {
  double bound = 0;
  const bool is_negative = digits.starts_with('-');
  digits.remove_prefix(is_negative ? 1 : 0);
  if (!digits.starts_with("0x")) refuse_word(word, "a hexadecimal number");
  digits.remove_prefix(2);
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), bound, std::chars_format::hex);
  if (error != std::errc{} || end != digits.data() + digits.size() || !(bound >= 0))
    refuse_word(word, "a hexadecimal number");
  return is_negative ? -bound : bound;
}

/// Calls read(word) for each word.
template <class Read>
void read_words(std::string_view text, Read read) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) read(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

void SavedTree::add_split(BoxId box, std::size_t variable, std::optional<double> at) {
  steps += std::to_string(box) + ':' + std::to_string(variable);
  if (at)
    add_number(steps, '@', *at);
  else
    steps += ' ';
}
void SavedTree::add_leaf(BoxId box, double bound) { add_bounded(steps, box, bound); }
void SavedTree::add_open(BoxId box, double bound) { add_bounded(open, box, bound); }

RestoredTree::RestoredTree(const SavedTree& saved, std::vector<Interval> root,
                           std::size_t splittable, Splits splits)
    : root_(std::move(root)), splittable_(splittable), way_(splits), is_closed_{false} {
  read_words(saved.steps, [this](std::string_view word) { read_step(word); });
  const std::size_t closed = leaves_.size();
  read_words(saved.open, [this](std::string_view word) {
    std::string_view rest = word;
    const BoxId box = take_number(rest, word);
    close(box, word);
    read_leaf(rest, box, word);
  });
  open_ = leaves_.size() - closed;
  const auto forgotten = std::ranges::find(is_closed_, false);
  if (forgotten != is_closed_.end())
    throw SavedTreeError("box " + std::to_string(forgotten - is_closed_.begin()) + " is missing");
  for (const BoxId box : saved.shown)
    if (box >= size()) throw SavedTreeError("there is no box " + std::to_string(box));
}

void RestoredTree::read_step(std::string_view word) {
  std::string_view rest = word;
  const BoxId box = take_number(rest, word);
  close(box, word);
  if (!rest.starts_with(':')) {
    read_leaf(rest, box, word);
    steps_.push_back({box});
    return;
  }
  rest.remove_prefix(1);
  const std::uint64_t variable = take_number(rest, word);
  const bool is_cut = rest.starts_with('@');
  if (!(rest.empty() || is_cut) || variable >= splittable_)
    refuse_word(word, "the number of a variable");
  if (is_cut != (way_ == Splits::kByCuts)) refuse_word(word, "another kind of split");
  const double at = is_cut ? read_real(rest.substr(1), word) : 0;
  splits_.push_back({box, std::uint32_t(variable), at});
  steps_.push_back({box, std::uint32_t(variable), at});
  is_closed_.insert(is_closed_.end(), 2, false);
}

void RestoredTree::read_leaf(std::string_view rest, BoxId box, std::string_view word) {
  if (rest.starts_with('='))
    leaves_.push_back({box, read_real(rest.substr(1), word)});
  else if (rest == "-")
    leaves_.push_back({box, kNoBound});
  else
    refuse_word(word, "one of : = -");
}

void RestoredTree::close(BoxId box, std::string_view word) {
  if (box >= is_closed_.size()) refuse_word(word, "a box that was made before");
  if (is_closed_[box]) refuse_word(word, "each box once");
  is_closed_[box] = true;
}

std::optional<Halves> RestoredTree::halves_of(const Interval& range, const Split& split) const {
  return way_ == Splits::kByCuts ? cut(range, split.at) : bisect(range);
}

/// Lower halves have odd numbers.
std::vector<Interval> RestoredTree::box(BoxId box) const {
  std::vector<BoxId> path;
  for (; box != 0; box = parent(box)) path.push_back(box);
  std::vector<Interval> result = root_;
  for (auto child = path.rbegin(); child != path.rend(); ++child) {
    const Split& split = splits_[(*child - 1) / 2];
    const std::optional<Halves> halves = halves_of(result[split.variable], split);
    if (!halves)
      throw SavedTreeError("box " + std::to_string(split.box) + " cannot be halved in variable " +
                           std::to_string(split.variable));
    result[split.variable] = *child % 2 == 1 ? halves->left : halves->right;
  }
  return result;
}

std::uint32_t RestoredTree::depth(BoxId box) const {
  std::uint32_t depth = 0;
  for (; box != 0; box = parent(box)) ++depth;
  return depth;
}

}  // namespace regulus::detail
