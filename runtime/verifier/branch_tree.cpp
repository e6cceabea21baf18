// SPDX-License-Identifier: Apache-2.0
// PROOF.md, "Closures", shows that links between neighbours and the start are enough.
#include "runtime/verifier/branch_tree.hpp"

#include <algorithm>
#include <numeric>

#include "runtime/verifier/branch_quantity.hpp"
#include "runtime/verifier/branch_start.hpp"
#include "runtime/verifier/outside.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

/// Pairs of boxes that are visited, for each that may be evaluated.
constexpr std::uint64_t kSteps = 16;

}  // namespace

void BranchTree::split(std::uint64_t number, std::size_t variable, double at) {
  const std::uint32_t depth = boxes_.nodes[number].depth + 1;
  if (depth > format::kDeepestTube) throw Unfinished("the tree is too deep");
  if (boxes_.nodes.size() > 4 * format::kMostTubes) throw Unfinished("there are too many boxes");
  boxes_.nodes[number].variable = std::int32_t(variable);
  boxes_.nodes[number].next = std::uint32_t(boxes_.nodes.size());
  boxes_.nodes[number].at = at;
  boxes_.nodes.resize(boxes_.nodes.size() + 2, BranchNode{.depth = depth});
}

std::string LeafPlace::text() const {
  return std::to_string(line) +
         (shard.number == 0 ? "" : " of shard " + std::to_string(shard.number));
}

TubeNumbers read_tube(const Question& q, const std::vector<std::string_view>& words) {
  const bool is_tube = format::has_tube(words[2]);
  const std::size_t m = q.variables.size(), n = q.closure->equations.size();
  const std::size_t count = is_tube ? m + n + n * m + n : 0;
  if (words.size() != 3 + count)
    throw Rejection("expected " + std::to_string(count) + " numbers after the word '" +
                    std::string(words[2]) + "'");
  TubeNumbers tube;
  if (!is_tube) return tube;
  for (const std::string_view word : std::span(words).subspan(3)) tube.push_back(read_double(word));
  if (!std::all_of(tube.end() - std::ptrdiff_t(n), tube.end(), [](double r) { return r > 0.0; }))
    throw Rejection("a radius of a tube is not positive");
  return tube;
}

void BranchTree::add_leaf(std::uint64_t number, const TubeNumbers& tube, std::size_t line) {
  if (tube.empty()) return;
  numbers_ += tube.size();
  if (boxes_.tubes.size() == format::kMostTubes || numbers_ > format::kMostTubeNumbers)
    throw Unfinished("there are too many tubes");
  boxes_.tubes.push_back(tube);
  boxes_.lines.push_back({line, shard_});
  boxes_.nodes[number].next = std::uint32_t(boxes_.tubes.size());
}

void BranchTree::check(Lines& lines, Verification& result, const BranchBoxes* before) {
  lines_ = &lines;
  test_.emplace(q_);
  joined_to_.resize(boxes_.tubes.size());
  std::iota(joined_to_.begin(), joined_to_.end(), 0U);
  Box box = variety_.outer;
  if (before == nullptr) check_start();
  link(0, box);
  require_connection();
  // A piece without tubes claims nothing; those after it can have none, as they would meet none here.
  if (before != nullptr && !(q_.paves && boxes_.tubes.empty())) require_joint(*before);
  if (q_.quantity && q_.quantity->attained) check_value();
  lines.name_line(0);
  result.links += links_;
}

void BranchTree::give_up(std::size_t tube, bool is_rejection, const std::string& why) {
  const LeafPlace& place = boxes_.lines[tube];
  const bool is_in_shard = place.shard.number != 0;
  lines_->name_line(is_in_shard ? place.shard.listed : place.line);
  const std::string here = is_in_shard ? "shard " + std::to_string(place.shard.number) + ": line " +
                                             std::to_string(place.line) + ": "
                                       : "";
  if (is_rejection) throw Rejection(here + why);
  throw Unfinished(here + why);
}

/// Links all neighbours in a box.
void BranchTree::link(std::size_t number, Box& box) {
  const BranchNode& node = boxes_.nodes[number];
  if (is_leaf(node)) return;
  const auto cut = std::size_t(node.variable);
  const Interval whole = box[cut];
  box[cut] = {whole.lo, node.at};
  link(node.next, box);
  box[cut] = {node.at, whole.hi};
  link(node.next + 1, box);
  box[cut] = point(node.at);
  link_across(node.next, node.next + 1, cut, box);
  box[cut] = whole;
}

/// Links the leaves of two boxes that share a part of their faces, `common`, at a cut.
void BranchTree::link_across(std::size_t lower, std::size_t upper, std::size_t cut, Box& common) {
  clock_.tick();
  if (++steps_ / kSteps > options_.max_boxes) throw Unfinished("there are too many neighbours");
  if (!is_leaf(below_->nodes[lower])) return descend(lower, upper, true, cut, common);
  if (!is_leaf(boxes_.nodes[upper])) return descend(upper, lower, false, cut, common);
  const std::uint32_t a = below_->nodes[lower].next, b = boxes_.nodes[upper].next;
  if (a != 0 && b != 0) require_link(a - 1, b - 1, common);
}

/// Goes on with the parts of one of the two boxes that have a share in the common face.
void BranchTree::descend(std::size_t number, std::size_t other, bool is_lower, std::size_t cut,
                         Box& common) {
  const BranchNode& node = (is_lower ? *below_ : boxes_).nodes[number];
  const auto on = [&](std::size_t part) {
    is_lower ? link_across(part, other, cut, common) : link_across(other, part, cut, common);
  };
  const auto variable = std::size_t(node.variable);
  if (variable == cut) return on(is_lower ? node.next + 1 : node.next);
  const Interval whole = common[variable];
  if (whole.lo < node.at) {
    common[variable].hi = std::min(whole.hi, node.at);
    on(node.next);
    common[variable] = whole;
  }
  if (node.at < whole.hi) {
    common[variable].lo = std::max(whole.lo, node.at);
    on(node.next + 1);
    common[variable] = whole;
  }
}

/// Shows that two tubes have the same solution at a place of the face of their boxes.
void BranchTree::require_link(std::size_t a, std::size_t b, const Box& face) {
  Box place;
  for (const Interval x : face) place.push_back(point(mid(x)));
  if (below_ == &boxes_) {
    require_link(boxes_, a, b, place, place);
    joined_to_[root_of(std::uint32_t(a))] = root_of(std::uint32_t(b));
    return;
  }
  Box end = place, begin = place;
  end[0] = point(1.0), begin[0] = point(0.0);
  require_link(*below_, a, b, end, begin);
}

/// Shows it at a place that is `at_a` for the first tube, and `at_b` for the other, which is of this tree.
/// The equations of both are equal there.
void BranchTree::require_link(const BranchBoxes& of_a, std::size_t a, std::size_t b,
                              const Box& at_a, const Box& at_b) {
  const std::string names =
      "the tubes of lines " + of_a.lines[a].text() + " and " + boxes_.lines[b].text();
  const TubeNumbers &first = of_a.tubes[a], &other = boxes_.tubes[b];
  std::vector<double> start, scale;
  for (const Interval p : test_->middle_of(first, at_a)) start.push_back(mid(p));
  for (std::size_t i = 0; i < start.size(); ++i)
    scale.push_back(std::min(test_->radius_of(first)[i], test_->radius_of(other)[i]));
  const auto solution = test_->solution_near(at_b, start, scale);
  if (!solution || test_->place_of(*solution, first, at_a) != Place::kInside)
    give_up(b, false, names + ": no configuration was found where their boxes meet");
  const Place of_other = test_->place_of(*solution, other, at_b);
  if (of_other != Place::kInside)
    give_up(b, of_other == Place::kOutside,
            names + (of_other == Place::kOutside ? " have" : " may have") +
                " different configurations where their boxes meet");
  ++links_;
}

/// Links all tubes that meet those of the piece before.
void BranchTree::require_joint(const BranchBoxes& before) {
  const Interval along = variety_.outer.at(0);
  if (along.lo != 0.0 || along.hi != 1.0) throw Unfinished("a piece is not from 0 to 1");
  Box common = variety_.outer;
  const std::uint64_t links = links_;
  below_ = &before;
  link_across(0, 0, 0, common);
  below_ = &boxes_;
  if (links_ == links) throw Unfinished("no tube of this piece meets one of the piece before");
}

/// The one configuration within the radius of the start must be that of each leaf in which the
/// start may be.
void BranchTree::check_start() {
  const Box place = start_place(q_, variety_);
  const StartBox start(q_);
  const std::vector<std::size_t> tubes = tubes_at(boxes_, place);
  // A tube may be much thinner than the radius of the start.
  std::vector<double> scale = start.radius();
  for (const std::size_t tube : tubes)
    for (std::size_t i = 0; i < scale.size(); ++i)
      scale[i] = std::min(scale[i], test_->radius_of(boxes_.tubes[tube])[i]);
  const SolutionBox solution = start.only_solution(*test_, place, scale);
  for (const std::size_t tube : tubes) require_start(tube, place, solution);
  starts_in_set_ = is_certain_point(q_, variety_, place);
}

/// The configuration at the place of the value attains the bound.
void BranchTree::check_value() {
  const Box& place = *q_.quantity->attained;
  const std::vector<std::size_t> tubes = tubes_at(boxes_, place);
  const TubeNumbers& tube = boxes_.tubes[tubes.front()];
  std::vector<double> start;
  for (const Interval p : test_->middle_of(tube, place)) start.push_back(mid(p));
  const auto solution = test_->solution_near(place, start, test_->radius_of(tube));
  if (!solution || test_->place_of(*solution, tube, place) != Place::kInside)
    give_up(tubes.front(), false, "the configuration at the place of the value was not found");
  if (!BranchQuantity(q_).attains_bound(*test_))
    throw Unfinished("it was not shown that the value is attained at its place");
}

std::vector<std::size_t> tubes_at(const BranchBoxes& boxes, const Box& place) {
  std::vector<std::size_t> tubes, waiting{0};
  while (!waiting.empty()) {
    const BranchNode& node = boxes.nodes[waiting.back()];
    waiting.pop_back();
    if (node.variable >= 0) {
      const Interval x = place[std::size_t(node.variable)];
      if (x.hi >= node.at) waiting.push_back(node.next + 1);
      if (x.lo <= node.at) waiting.push_back(node.next);
      continue;
    }
    if (node.next == 0) throw Rejection("the place is in a leaf without a tube");
    tubes.push_back(node.next - 1);
  }
  return tubes;
}

void BranchTree::require_start(std::size_t tube, const Box& place, const SolutionBox& solution) {
  const Place where = test_->place_of(solution, boxes_.tubes[tube], place);
  if (where == Place::kOutside)
    give_up(tube, true, "the tube has another configuration than the start");
  if (where == Place::kUnknown)
    give_up(tube, false, "the tube may have another configuration than the start");
}

std::uint32_t BranchTree::root_of(std::uint32_t tube) {
  while (joined_to_[tube] != tube) tube = joined_to_[tube] = joined_to_[joined_to_[tube]];
  return tube;
}

/// All tubes have the configuration of the first one.
void BranchTree::require_connection() {
  for (std::uint32_t tube = 1; tube < boxes_.tubes.size(); ++tube)
    if (root_of(tube) != root_of(0))
      give_up(tube, false,
              "no chain of neighbours joins the tube of line " + boxes_.lines[0].text() +
                  " to this one");
}

}  // namespace regulus::verifier
