// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "runtime/formal/coq_question.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::verifier {
namespace {

/// A part: one that is kept, left out, or beside the set; or one that is parted.
struct Part {
  enum class Fate { kKept, kLeftOut, kBeside, kParted } fate = Fate::kBeside;
  std::size_t variable = 0;
  std::string place;
  std::vector<Part> sides;  ///< of a parted one: the lower and the upper one

  bool operator==(const Part&) const = default;
};

using Fate = Part::Fate;

bool is_whole(const Part& part) { return part.fate != Fate::kParted; }

bool is_cut_by(const Part& part, std::size_t variable) {
  return !is_whole(part) && part.variable == variable;
}

/// Are they one part? What is beside the set has any fate.
bool are_one(const Part& a, const Part& b) {
  return a == b ||
         (is_whole(a) && is_whole(b) && (a.fate == Fate::kBeside || b.fate == Fate::kBeside));
}

/// Returns what a box is whose parts are these. A cut with the same part on both of its sides is left
/// out; of two cuts of one variable also the one that has the other's fate on both sides.
Part part_of_sides(const BoxOfTree& box, Part lower, Part upper) {
  if (are_one(lower, upper) && lower.fate == Fate::kBeside) return upper;
  if (are_one(lower, upper)) return lower;
  const std::size_t k = box.variable;
  if (is_cut_by(lower, k) && is_whole(upper) && are_one(lower.sides[1], upper)) return lower;
  if (is_cut_by(upper, k) && is_whole(lower) && are_one(upper.sides[0], lower)) return upper;
  return {Fate::kParted, k, box.place, {std::move(lower), std::move(upper)}};
}

Part part_of(const TreeOfBoxes& boxes, std::size_t number, const IsKept& is_kept) {
  const BoxOfTree& box = boxes[number];
  if (box.lower == 0) {
    const Fate fate = box.word == format::kOutsideLeaf ? Fate::kBeside
                      : is_kept(box.word)              ? Fate::kKept
                                                       : Fate::kLeftOut;
    return {fate, 0, "", {}};
  }
  return part_of_sides(box, part_of(boxes, box.lower, is_kept),
                       part_of(boxes, box.lower + 1, is_kept));
}

/// Returns the double of a word as a decimal, if that has few digits, or the word.
std::string readable(const std::string& word) {
  constexpr double kMost = 0x1p+20, kParts = 0x1p+10;  // of 1: ten digits after the point
  const double x = std::strtod(word.c_str() + (word.starts_with('(') ? 1 : 0), nullptr);
  if (!(std::fabs(x) < kMost) || std::nearbyint(x * kParts) != x * kParts) return word;
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.10f", std::fabs(x));
  std::string decimal = digits;
  while (decimal.ends_with('0')) decimal.pop_back();
  if (decimal.ends_with('.')) decimal.pop_back();
  return x < 0 ? "(-" + decimal + ')' : decimal;
}

constexpr std::size_t kDeepestMargin = 30;

void print(const Part& part, std::size_t depth, std::string& text) {
  if (is_whole(part)) {
    text += part.fate == Fate::kKept ? "Kept" : "LeftOut";
    return;
  }
  text += "Parted " + std::to_string(part.variable) + ' ' + readable(part.place);
  for (const Part& side : part.sides) {
    text += is_whole(side) ? " " : '\n' + std::string(std::min(depth, kDeepestMargin), ' ') + '(';
    print(side, depth + 1, text);
    if (!is_whole(side)) text += ')';
  }
}

}  // namespace

std::string coq_parts(const TreeOfBoxes& boxes, const IsKept& is_kept) {
  std::string text;
  print(part_of(boxes, 0, is_kept), 3, text);
  return text;
}

std::string coq_parts_definition(const std::string& comment, const std::string& name,
                                 const std::vector<TreeOfBoxes>& trees, bool has_pieces,
                                 const IsKept& is_kept) {
  std::vector<CoqItem> items;
  for (const TreeOfBoxes& tree : trees)
    items.push_back(
        {has_pieces ? "piece " + std::to_string(items.size() + 1) : "", coq_parts(tree, is_kept)});
  return "\n(** " + comment + " *)\nDefinition " + name +
         (has_pieces ? " : list parts := (\n  " + coq_list(items, "   ")
                     : " : parts := (\n  " + items.at(0).text) +
         ")%float.\n";
}

}  // namespace regulus::verifier
