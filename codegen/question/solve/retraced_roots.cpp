// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/retraced_roots.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace regulus::detail {
namespace {

/// Boxes of so many leaves are in memory at a time.
constexpr std::size_t kLeavesAtOnce = 1 << 16;

[[noreturn]] void refuse(BoxId box, const char* why) {
  throw SavedTreeError("box " + std::to_string(box) + why);
}

}  // namespace

RetracedRoots::RetracedRoots(const RestoredTree& tree, Narrow narrow)
    : tree_(tree), narrow_(std::move(narrow)), split_(tree.size()), lower_(tree.size()) {
  is_open_.resize(tree.size());
  is_judged_.resize(tree.size());
  is_empty_.resize(tree.size());
  BoxId lower = 1;
  for (const RestoredTree::Step& step : tree.steps())
    if (step.variable) split_[step.box] = &step, lower_[step.box] = lower, lower += 2;
  const auto& leaves = tree.leaves();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    is_open_[leaves[i].box] = i + tree.open() >= leaves.size();
    if (is_open_[leaves[i].box] || std::isfinite(leaves[i].bound)) require_judging(leaves[i].box);
  }
}

/// And of all boxes above it.
void RetracedRoots::require_judging(BoxId box) {
  for (; !is_judged_[box]; box = tree_.parent(box)) {
    is_judged_[box] = true;
    if (box == 0) return;
  }
}

bool RetracedRoots::prove(const Box& root, const JudgeMany& judge) {
  for (bool are_all = false; !are_all;)
    if (!judge_from_root(root, judge) || !judge_empty(judge, are_all)) return false;
  return true;
}

RetracedRoots::Leaf* RetracedRoots::leaf(BoxId box) {
  const auto found = leaves_.find(box);
  return found == leaves_.end() ? nullptr : &found->second;
}

/// One generation after the other.
bool RetracedRoots::judge_from_root(const Box& root, const JudgeMany& judge) {
  rest_.clear();
  std::vector<Part> generation = {{0, root}};
  while (!generation.empty()) {
    if (!judge_generation(generation, judge)) return false;
    std::vector<Part> next;
    for (Part& part : generation) follow(std::move(part), next);
    generation = std::move(next);
  }
  return true;
}

bool RetracedRoots::judge_generation(const std::vector<Part>& parts, const JudgeMany& judge) {
  std::vector<Box> boxes;
  std::vector<BoxId> ids;
  for (const auto& [id, box] : parts)
    if (is_judged_[id] && !is_open_[id] && !found_.contains(id))
      ids.push_back(id), boxes.push_back(box);
  std::vector<RootFinding> findings(boxes.size());
  if (!judge(boxes, findings)) return false;
  for (std::size_t i = 0; i < ids.size(); ++i) found_.emplace(ids[i], std::move(findings[i]));
  return true;
}

void RetracedRoots::follow(Part part, std::vector<Part>& next) {
  const BoxId id = part.id;
  if (!is_judged_[id]) return rest_.push_back(std::move(part));
  if (is_open_[id]) {
    leaves_.insert_or_assign(id, Leaf{std::move(part.box)});
    return;
  }
  const RootFinding& finding = found_.at(id);
  const auto variable = narrow_(part.box, finding);
  const RestoredTree::Step* const split = split_[id];
  if (split == nullptr) {
    if (variable) refuse(id, " is not a leaf of this search");
    leaves_.insert_or_assign(id, Leaf{std::move(part.box), finding});
    return;
  }
  if (variable != split->variable || mid(part.box[*variable]) != split->at)
    refuse(id, " is split otherwise by this search");
  halve(std::move(part), next);
}

void RetracedRoots::halve(Part part, std::vector<Part>& halves) const {
  const RestoredTree::Step& split = *split_[part.id];
  const auto parts = cut(part.box[*split.variable], split.at);
  if (!parts) refuse(part.id, " is cut outside");
  const BoxId lower = lower_[part.id];
  part.box[*split.variable] = parts->left;
  halves.push_back({lower, part.box});
  part.box[*split.variable] = parts->right;
  halves.push_back({lower + 1, std::move(part.box)});
}

/// `are_all`: set to false if leaves must be judged otherwise.
bool RetracedRoots::judge_empty(const JudgeMany& judge, bool& are_all) {
  are_all = true;
  while (!rest_.empty()) {
    const std::vector<Part> leaves = empty_leaves();
    std::vector<Box> boxes;
    for (const Part& leaf : leaves) boxes.push_back(leaf.box);
    std::vector<RootFinding> findings(boxes.size());
    if (!judge(boxes, findings)) return false;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      is_empty_[leaves[i].id] = findings[i].is_empty;
      if (findings[i].is_empty) continue;
      require_judging(leaves[i].id);
      are_all = false;
    }
  }
  return true;
}

/// Takes the next leaves that are not known to be empty from what is left.
std::vector<RetracedRoots::Part> RetracedRoots::empty_leaves() {
  std::vector<Part> leaves;
  while (!rest_.empty() && leaves.size() < kLeavesAtOnce) {
    Part part = std::move(rest_.back());
    rest_.pop_back();
    if (split_[part.id] != nullptr)
      halve(std::move(part), rest_);
    else if (!is_empty_[part.id])
      leaves.push_back(std::move(part));
  }
  return leaves;
}

}  // namespace regulus::detail
