// SPDX-License-Identifier: Apache-2.0
// Each box is split or is a leaf, exactly once. A split lies strictly inside its box. At the end no
// box is open. So the leaves tile the box that contains the variety.
#include "runtime/verifier/tree_reader.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <optional>

#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr std::array<std::string_view, 11> kRules = {
    "outside", "h-matrix",    "mean-value", "second-order",   "determinant", "elimination",
    "rohn",    "closed-form", "filter",     "multiprecision", "orthants"};

/// Returns the claim of a leaf of a question; nullopt for a word that it does not have.
std::optional<LeafClaim> claim_of_branch(const Question& question, std::string_view word) {
  if (word == format::kOutsideLeaf) return LeafClaim::kOutside;
  if (word == format::kTubeLeaf) return question.paves ? LeafClaim::kBranch : LeafClaim::kWhole;
  if (!question.paves) return std::nullopt;
  if (word == format::kUndecidedLeaf) return LeafClaim::kUndecided;
  if (question.quantity && word == format::kFeasibleLeaf) return LeafClaim::kWhole;
  if (question.quantity && word == format::kInfeasibleLeaf) return LeafClaim::kInfeasible;
  return std::nullopt;
}

/// The same; throws Rejection for a word that it does not have.
LeafClaim claim_of(const Question& question, std::string_view word) {
  const bool is_about_load = question.load.has_value();
  const bool paves = is_about_load && question.paves;
  const bool is_rule = std::find(kRules.begin(), kRules.end(), word) != kRules.end();
  if (question.closure)
    if (const auto claim = claim_of_branch(question, word)) return *claim;
  if (!is_about_load && !question.closure && is_rule) return LeafClaim::kWhole;
  if (is_about_load && word == format::kFeasibleLeaf) return LeafClaim::kWhole;
  if (is_about_load && word == format::kOutsideLeaf)
    return paves ? LeafClaim::kOutside : LeafClaim::kWhole;
  if (paves && word == format::kInfeasibleLeaf) return LeafClaim::kInfeasible;
  if (paves && word == format::kUndecidedLeaf) return LeafClaim::kUndecided;
  throw Rejection("there is no rule '" + std::string(word) + "'");
}

}  // namespace

std::string OpenBoxes::text() const {
  std::string text = "next " + std::to_string(next) + '\n';
  const std::map<std::uint64_t, Box> ordered(boxes.begin(), boxes.end());
  for (const auto& [id, box] : ordered) {
    text += std::to_string(id);
    for (const Interval& x : box) {
      char ends[64];
      std::snprintf(ends, sizeof ends, " %a:%a", x.lo, x.hi);
      text += ends;
    }
    text += '\n';
  }
  return text;
}

/// A leaf that is not proved comes before a wrong line after it.
Shown TreeReader::read() {
  try {
    read_boxes();
  } catch (const Rejection&) {
    if (proofs_ != nullptr) static_cast<void>(proofs_->finish(lines_));
    throw;
  }
  return proofs_ != nullptr ? proofs_->finish(lines_) : Shown{};
}

void TreeReader::read_boxes() {
  for (;;) {
    clock_.tick();
    if (!lines_.next()) throw Rejection("the file ends before the line 'end' of the tree");
    const auto words = words_of(lines_.text());
    if (words.size() == 4 && words[0] == "s")
      split(words);
    else if ((words.size() == 3 || (question_.closure && words.size() > 3)) && words[0] == "l")
      leaf(words);
    else
      return;
  }
}

TreeReader::Iterator TreeReader::find(std::string_view text) {
  const auto box = open_.boxes.find(read_count(text, std::size_t(-1)));
  if (box == open_.boxes.end()) throw Rejection("box " + std::string(text) + " is not open");
  return box;
}

void TreeReader::split(const std::vector<std::string_view>& words) {
  const auto parent = find(words[1]);
  const std::uint64_t number = parent->first;
  Box lower = std::move(parent->second);
  open_.boxes.erase(parent);
  const std::size_t k = read_count(words[2], format::kMostVariables);
  const double at = read_double(words[3]);
  if (k >= lower.size()) throw Rejection("there is no variable " + std::string(words[2]));
  if (!(lower[k].lo < at && at < lower[k].hi)) throw Rejection("the split is not inside the box");
  if (open_.boxes.size() > format::kMostOpen) throw Unfinished("too many boxes are open");
  if (branch_ != nullptr) branch_->split(number, k, at);
  Box upper = lower;
  lower[k].hi = upper[k].lo = at;
  open_.boxes.emplace(open_.next++, std::move(lower));
  open_.boxes.emplace(open_.next++, std::move(upper));
}

void TreeReader::leaf(const std::vector<std::string_view>& words) {
  const auto box = find(words[1]);
  const LeafClaim claim = claim_of(question_, words[2]);
  Leaf leaf{std::move(box->second),
            "leaf of box " + std::string(words[1]) + " (" + std::string(words[2]) + ")",
            lines_.number(), claim};
  if (question_.closure) leaf.tube = read_tube(question_, words);
  if (branch_ != nullptr) branch_->add_leaf(box->first, leaf.tube, leaf.line);
  open_.boxes.erase(box);
  if (proofs_ != nullptr) proofs_->add(lines_, std::move(leaf));
}

void TreeReader::require_end_word() const {
  const auto words = words_of(lines_.text());
  if (words.size() != 2 || words[0] != "end")
    throw Rejection("expected 's BOX VARIABLE AT', 'l BOX RULE' or 'end LEAVES'");
}

void TreeReader::require_end(std::uint64_t leaves) {
  if (read_count(words_of(lines_.text()).at(1), std::size_t(-1)) != leaves)
    throw Rejection("the line 'end' gives a wrong number of leaves");
  if (lines_.next()) throw Rejection("there is text after the line 'end'");
}

void TreeReader::require_tiling() const {
  if (!open_.boxes.empty())
    throw Rejection((open_.boxes.size() == 1 ? "1 box has"
                                             : std::to_string(open_.boxes.size()) + " boxes have") +
                    " no leaf, for example box " + std::to_string(open_.boxes.begin()->first));
}

void require_poses(const Question& question, const Shown& shown, Verification& result) {
  if (!shown.has_met_variety)
    throw Unfinished("no pose remains: the constraints exclude every pose of the motion");
  if (!question.constraints.empty() && !shown.has_met_point)
    result.note = "no pose was shown to satisfy the constraints: the claim may be about no pose";
}

}  // namespace regulus::verifier
