// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace regulus {
namespace {

void add_bounded(std::string& text, BoxId box, double upper) {
  fmt::format_to(std::back_inserter(text), "{}={:a} ", box, upper);
}

[[noreturn]] void refuse_word(std::string_view word, const char* expected) {
  throw ConditionStateError(fmt::format("found '{}', expected {}", word, expected));
}

/// Takes a number from the start of `rest`.
std::uint64_t take_number(std::string_view& rest, std::string_view word) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc{}) refuse_word(word, "a number");
  rest.remove_prefix(std::size_t(end - rest.data()));
  return number;
}

double read_upper(std::string_view digits, std::string_view word) {
  if (digits == "inf") return kInfinity;
  double upper = 0;
  if (!digits.starts_with("0x")) refuse_word(word, "a hexadecimal number");
  digits.remove_prefix(2);
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), upper, std::chars_format::hex);
  if (error != std::errc{} || end != digits.data() + digits.size() || !(upper >= 0))
    refuse_word(word, "a hexadecimal number");
  return upper;
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

void ConditionState::add_split(BoxId box, std::size_t variable) {
  fmt::format_to(std::back_inserter(steps), "{}:{} ", box, variable);
}
void ConditionState::add_settled(BoxId box, double upper) { add_bounded(steps, box, upper); }
void ConditionState::add_outside(BoxId box) {
  fmt::format_to(std::back_inserter(steps), "{}- ", box);
}
void ConditionState::add_open(BoxId box, double upper) { add_bounded(open, box, upper); }

ConditionTree::ConditionTree(const ConditionState& state, std::vector<Interval> root)
    : root_(std::move(root)), is_closed_{false} {
  read_words(state.steps, [this](std::string_view word) { read_step(word); });
  read_words(state.open, [this](std::string_view word) { read_open(word); });
  const auto forgotten = std::ranges::find(is_closed_, false);
  if (forgotten != is_closed_.end())
    throw ConditionStateError(
        fmt::format("box {} is missing", std::distance(is_closed_.begin(), forgotten)));
  if (state.attained && *state.attained >= size())
    throw ConditionStateError(fmt::format("there is no box {}", *state.attained));
}

void ConditionTree::read_step(std::string_view word) {
  std::string_view rest = word;
  const BoxId box = take_number(rest, word);
  close(box, word);
  if (rest.starts_with(':')) {
    rest.remove_prefix(1);
    const std::uint64_t variable = take_number(rest, word);
    if (!rest.empty() || variable >= root_.size()) refuse_word(word, "the number of a variable");
    splits_.push_back({box, std::uint32_t(variable)});
    steps_.push_back({box, std::uint32_t(variable)});
    is_closed_.insert(is_closed_.end(), 2, false);
    return;
  }
  if (rest.starts_with('='))
    leaves_.push_back({box, read_upper(rest.substr(1), word)});
  else if (rest == "-")
    leaves_.push_back({box, kInfinity});
  else
    refuse_word(word, "one of : = -");
  steps_.push_back({box, std::nullopt});
}

void ConditionTree::read_open(std::string_view word) {
  std::string_view rest = word;
  const BoxId box = take_number(rest, word);
  close(box, word);
  if (!rest.starts_with('=')) refuse_word(word, "'='");
  leaves_.push_back({box, read_upper(rest.substr(1), word)});
}

void ConditionTree::close(BoxId box, std::string_view word) {
  if (box >= is_closed_.size()) refuse_word(word, "a box that was made before");
  if (is_closed_[box]) refuse_word(word, "each box once");
  is_closed_[box] = true;
}

/// Lower halves have odd numbers.
std::vector<Interval> ConditionTree::box(BoxId box) const {
  std::vector<BoxId> path;
  for (; box != 0; box = parent(box)) path.push_back(box);
  std::vector<Interval> result = root_;
  for (auto child = path.rbegin(); child != path.rend(); ++child) {
    const Split& split = splits_[(*child - 1) / 2];
    const std::optional<Halves> halves = bisect(result[split.variable]);
    if (!halves)
      throw ConditionStateError(
          fmt::format("box {} cannot be halved in variable {}", split.box, split.variable));
    result[split.variable] = *child % 2 == 1 ? halves->left : halves->right;
  }
  return result;
}

}  // namespace regulus
