// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_parts.hpp"

#include <algorithm>
#include <bit>

namespace regulus::detail {
namespace {

constexpr double kShortestPart = 0x1p-24;

}  // namespace

PathParts::PathParts(const PathBounds& path, const Problem& problem, const PathVariables& variables,
                     bool wants_trees)
    : path_(path),
      problem_(problem),
      wants_trees_(wants_trees),
      ranges_(path.errors().begin(), path.errors().end()),
      next_id_(path.pieces(), 1) {
  std::size_t next = 1 + variables.added + variables.uncertain;
  for (const Interval& error : ranges_) number_.push_back(error.hi > 0 ? next++ : 0);
  for (std::size_t k = 0; k < variables.added; ++k) {
    number_.push_back(1 + k);
    ranges_.push_back(problem.outer[path.moving().size() + k]);
  }
  if (wants_trees) trees_ = std::vector<TreeKept>(path.pieces());
}

PathPart PathParts::whole() const {
  std::size_t all = 1;
  while (all < path_.pieces()) all *= 2;
  return {0, all, 0, 0, 0, 1, {}};
}

std::size_t PathParts::end_of(const PathPart& part) const {
  return std::min(part.piece + part.pieces, path_.pieces());
}

std::uint32_t PathParts::depth_of(const PathPart& part) const {
  const std::size_t all = whole().pieces;
  return std::uint32_t(std::bit_width(all / part.pieces)) - 1 + part.depth;
}

void PathParts::load_box(const PathPart& part, std::vector<Interval>& box) const {
  for (std::size_t m = 0; m < path_.moving().size(); ++m) {
    const Interval poses = commanded(part, m) + error_of(part, m);
    box[m] = intersect(poses, problem_.outer[m]).value_or(problem_.outer[m]);
  }
  for (std::size_t m = path_.moving().size(); m < ranges_.size(); ++m) box[m] = error_of(part, m);
}

Interval PathParts::commanded(const PathPart& part, std::size_t m) const {
  if (m >= path_.moving().size()) return Interval(0.0);
  return part.pieces > 1 ? path_.over_pieces(part.piece, part.pieces, m)
                         : path_.over(part.piece, m, part.begin, part.end);
}

Interval PathParts::error_of(const PathPart& part, std::size_t m) const {
  return part.errors.empty() ? ranges_[m] : part.errors[m];
}

void PathParts::split_group(const PathPart& part, std::vector<PathPart>& halves) const {
  const std::size_t half = part.pieces / 2;
  halves.push_back({part.piece, half, 0, 0, 0, 1, {}});
  if (part.piece + half < path_.pieces())
    halves.push_back({part.piece + half, half, 0, 0, 0, 1, {}});
}

bool PathParts::split(PathPart& part, std::size_t variable, std::vector<PathPart>& halves) {
  if (variable >= ranges_.size()) return false;  // the path stands still
  const Interval path = commanded(part, variable), error = error_of(part, variable);
  const bool in_error = error.hi - error.lo > path.hi - path.lo;
  const auto parts = in_error ? bisect(error) : bisect(Interval(part.begin, part.end));
  if (!parts || (!in_error && part.end - part.begin < kShortestPart)) return false;
  PathPart first = part, second = std::move(part);
  if (in_error) {
    if (first.errors.empty()) first.errors = second.errors = ranges_;
    first.errors[variable] = parts->left;
    second.errors[variable] = parts->right;
  } else {
    first.end = second.begin = parts->left.hi;
  }
  BoxId& next = next_id_[first.piece];
  const std::size_t number = in_error ? number_[variable] : 0;
  if (wants_trees_)
    trees_[first.piece].split({first.id, std::uint32_t(number), parts->left.hi, next});
  first.id = next++;
  second.id = next++;
  ++first.depth, ++second.depth;
  halves.push_back(std::move(first));
  halves.push_back(std::move(second));
  return true;
}

void PathParts::leaf(const PathPart& part, Rule rule) {
  if (!wants_trees_) return;
  for (std::size_t k = part.piece; k < end_of(part); ++k) trees_[k].leaf(part.id, rule);
}

}  // namespace regulus::detail
