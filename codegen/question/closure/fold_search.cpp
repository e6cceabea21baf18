// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/fold_search.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/model/exact/exact_double.hpp"
#include "codegen/question/closure/line_model.hpp"
#include "codegen/question/closure/uncertain_values.hpp"
#include "runtime/interval/floating_point_scope.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// The solution of a swapped system begins within that of the one that was found.
constexpr double kRadiusOfStart = 0x1p-24;
constexpr std::uint64_t kMostBoxes = 4096;
/// The part of the line before its end where an unknown takes its place, halved.
constexpr double kPartOfChange = 0x1p-8;
/// Tubes go so much further than the fold, so that it is no end of them.
constexpr double kPartBeyondFold = 0x1p-8;
/// A fold beyond a place is looked for on a line that is so much longer.
constexpr double kPartBeyond = 1.5;
constexpr double kBeside = 0x1p-26;

/// The row of the inverse that is largest: where the matrix is nearly singular, all are multiples of
/// it. Empty if there is no inverse.
std::vector<double> left_null_vector(std::span<const Interval> matrix, std::size_t n) {
  std::vector<double> middles;
  for (const Interval& entry : matrix) middles.push_back(mid(entry));
  // At the fold itself there is no inverse: a little beside it there is.
  for (std::size_t i = 0; i < n; ++i) middles[i * n + i] += kBeside * std::fabs(middles[i * n + i]);
  const auto inverse = approx_inverse_of(middles, n);
  std::vector<double> best;
  double most = 0;
  for (std::size_t i = 0; inverse && i < n; ++i) {
    double size = 0;
    for (std::size_t j = 0; j < n; ++j) size = std::hypot(size, (*inverse)[i * n + j]);
    if (!(size > most)) continue;
    most = size;
    best.assign(inverse->begin() + std::ptrdiff_t(i * n),
                inverse->begin() + std::ptrdiff_t((i + 1) * n));
  }
  for (double& x : best) x /= most;
  return best;
}

class FoldSearch {
 public:
  FoldSearch(const PreparedClosure& prepared, const std::vector<double>& towards,
             std::vector<double> uncertain, const SearchOptions& search, const FormingWatch& watch)
      : prepared_(prepared),
        towards_(towards),
        uncertain_(within_balls(prepared, std::move(uncertain))),
        search_(options(search)),
        watch_(watch),
        line_(prepared, towards, uncertain_),
        n_(prepared.shape.unknowns) {}

  /// Returns where the fold is on the line, approximately, wherever that is.
  struct Place {
    double part;
    std::vector<double> unknowns;
  };
  std::optional<Place> place() {
    if (!follow_line() || !solve()) return std::nullopt;
    Place found{mid(solution_[0]), {}};
    for (std::size_t i = 0; i < n_; ++i) found.unknowns.push_back(mid(solution_[1 + i]));
    return found;
  }

  std::optional<Fold> find() {
    if (!are_possible(prepared_, uncertain_) || !follow_line() || !solve()) return std::nullopt;
    const Closure& closure = line_.closure();
    fold_.place.clear();
    fold_.path.towards = towards_;
    fold_.path.uncertain = uncertain_;
    for (std::size_t k = 0; k < towards_.size(); ++k) {
      const Interval from = prepared_.start.place[k];
      fold_.place.push_back(from + solution_[0] * (Interval(towards_[k]) - from));
      const std::optional<Interval>& inner = prepared_.problem.inner[k];
      if (!inner || !certain_subset(fold_.place[k], *inner)) return std::nullopt;
    }
    for (std::size_t k = towards_.size(); k < prepared_.shape.variables; ++k) {
      const Interval from = prepared_.start.place[k];
      const bool moves = !uncertain_.empty();
      const Interval to = moves ? Interval(uncertain_[k - towards_.size()]) : from;
      fold_.place.push_back(moves ? from + solution_[0] * (to - from) : from);
    }
    fold_.unknowns.assign(solution_.begin() + 1, solution_.begin() + 1 + std::ptrdiff_t(n_));
    fold_.direction.assign(solution_.begin() + 1 + std::ptrdiff_t(n_), solution_.end());
    const bool is_unconstrained =
        prepared_.request.motion.constraints.empty() && prepared_.request.motion.reach.empty();
    fold_.is_on_branch = is_unconstrained && closure.unknowns.size() == n_ && leads_to_fold();
    return fold_;
  }

 private:
  static SearchOptions options(SearchOptions search) {
    search.max_boxes = kMostBoxes;
    search.workers = nullptr;
    search.threads = 1;
    return search;
  }

  [[nodiscard]] PreparedClosure prepared(Request request) const {
    return prepare_closure(std::move(request), 0, search_, watch_);
  }

  [[nodiscard]] Request line_request(double to) const {
    const Closure& closure = line_.closure();
    return line_.system(line_.part_parameter(), {0, exact_number(to)}, 0, closure.unknowns,
                        closure.ranges, line_.equations(), closure.start, closure.start_radius);
  }

  /// Goes along the line until the branch is lost.
  bool follow_line() {
    const PreparedClosure line = prepared(line_request(1));
    if (line.preparation.stopped) return false;
    SystemBoxes system(line.problem, line.scaling, line.shape);
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    lost_ = track_until_lost(system, line.shape, line.near_start, {1.0});
    return lost_ && lost_->part > 0 && lost_->part < 1;
  }

  /// The unknown that moves most where Φ_p is nearly singular, and how all move.
  [[nodiscard]] std::vector<double> null_vector() const {
    const std::vector<double>& inverse = lost_->last.inverse;
    std::vector<double> best(n_, 0.0);
    double most = 0;
    for (std::size_t j = 0; j < n_; ++j) {
      double size = 0;
      for (std::size_t i = 0; i < n_; ++i) size = std::hypot(size, inverse[i * n_ + j]);
      if (size <= most) continue;
      most = size;
      for (std::size_t i = 0; i < n_; ++i) best[i] = inverse[i * n_ + j] / size;
    }
    return best;
  }

  bool solve() {
    const std::vector<double> v = null_vector();
    const Closure& closure = line_.closure();
    const BranchPoint& last = lost_->last.at;
    std::vector<PoseParameter> unknowns{line_.part_parameter()};
    std::vector<Range> ranges{{-1, 2}};
    std::vector<ex> start{exact_number(last.variables[0])}, equations = line_.equations();
    unknowns.insert(unknowns.end(), closure.unknowns.begin(), closure.unknowns.end());
    ranges.insert(ranges.end(), closure.ranges.begin(), closure.ranges.end());
    ex length = -1;
    for (std::size_t i = 0; i < n_; ++i) {
      start.push_back(exact_number(last.unknowns[i]));
      const GiNaC::realsymbol component("direction_" + std::to_string(i + 1));
      unknowns.push_back({component, component.get_name(), "1"});
      ranges.push_back({-4, 4});
      length += exact_number(v[i]) * component;
    }
    fold_.path.normal = v;
    for (const ex& equation : line_.equations()) {
      ex moved = 0;
      for (std::size_t i = 0; i < n_; ++i)
        moved += equation.diff(closure.unknowns[i].symbol) * unknowns[1 + n_ + i].symbol;
      equations.push_back(moved);
    }
    equations.push_back(length);
    for (const double component : v) start.push_back(exact_number(component));
    const PreparedClosure bordered = prepared(
        line_.system(std::nullopt, {}, 0, std::move(unknowns), std::move(ranges),
                     std::move(equations), std::move(start), std::vector<ex>(1 + 2 * n_, 1)));
    return !bordered.preparation.stopped && enclose_solution(bordered);
  }

  bool enclose_solution(const PreparedClosure& bordered) {
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    SystemBoxes system(bordered.problem, bordered.scaling, bordered.shape);
    TubeFinder finder(system, bordered.shape, bordered.ranges);
    const BranchPoint near = bordered.near_start;
    const auto settled = settle(system, bordered.shape, {&near, 1});
    if (!settled[0]) return false;
    const TubeTrial trial{{}, {{}, settled[0]->at.unknowns, {}, {}}, settled[0]->inverse};
    TubeFinding found;
    finder.find({&trial, 1}, {&found, 1});
    if (!found.tube) return false;
    solution_ = enclose(*found.tube, {});
    fold_.path.end = *std::move(found.tube);
    return true;
  }

  /// Tubes lead from the start along the line, and then along an unknown to the fold. They change
  /// over a little before the end, so that the tubes of the line reach beyond that place.
  bool leads_to_fold() {
    PreparedClosure line = prepared(line_request(lost_->part * (1 - kPartOfChange)));
    const ClosureResult first =
        run_closure(line, settings_of(line, search_, watch_.interrupt), nullptr);
    if (!first.is_proved()) return false;
    const auto change = place_of_change(line);
    if (!change) return false;
    std::size_t k = 0;
    for (std::size_t i = 1; i < n_; ++i)
      if (mig(fold_.direction[i]) > mig(fold_.direction[k])) k = i;
    PreparedClosure swapped = prepared(swapped_request(*change, k));
    const ClosureResult second =
        run_closure(swapped, settings_of(swapped, search_, watch_.interrupt), nullptr);
    if (!second.is_proved()) return false;
    const BranchLeaf* const change_over = meeting(first, second, change->unknowns[k], k);
    const BranchLeaf* const end = change_over == nullptr ? nullptr : holding_fold(second, k);
    if (end == nullptr) return false;
    add_arcs(0, first, Interval(0), *change_over);
    add_arcs(1 + k, second, Interval(change->unknowns[k]), *end);
    return true;
  }

  /// Adds the tubes from the one at a place to another.
  void add_arcs(std::size_t coordinate, const ClosureResult& result, const Interval& from,
                const BranchLeaf& last) {
    std::vector<const BranchLeaf*> leaves;
    for (const BranchLeaf& leaf : result.branch.tree.leaves()) leaves.push_back(&leaf);
    std::ranges::sort(leaves, {}, [](const BranchLeaf* leaf) { return leaf->at.box[0].lo; });
    // The place is at an end of the range.
    if (from.lo > leaves.front()->at.box[0].lo) std::ranges::reverse(leaves);
    for (const BranchLeaf* const leaf : leaves) {
      fold_.path.arcs.push_back({coordinate, leaf->at.box[0], *leaf->tube});
      if (leaf == &last) return;
    }
  }

  std::optional<BranchPoint> place_of_change(const PreparedClosure& line) const {
    SystemBoxes system(line.problem, line.scaling, line.shape);
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    const std::vector<double> place{lost_->part * (1 - 2 * kPartOfChange)};
    const auto found = track(system, line.shape, line.near_start, {&place, 1});
    return found[0] ? std::optional(found[0]->at) : std::nullopt;
  }

  /// The unknown that moves most takes the place of the line.
  [[nodiscard]] Request swapped_request(const BranchPoint& from, std::size_t k) const {
    const Closure& closure = line_.closure();
    std::vector<PoseParameter> unknowns{line_.part_parameter()};
    std::vector<Range> ranges{{0, 1}};
    std::vector<ex> start{exact_number(from.variables[0])};
    for (std::size_t i = 0; i < n_; ++i) {
      if (i == k) continue;
      unknowns.push_back(closure.unknowns[i]);
      ranges.push_back(closure.ranges[i]);
      start.push_back(exact_number(from.unknowns[i]));
    }
    const double way = mid(fold_.unknowns[k]) - from.unknowns[k];
    const Interval range =
        hull(Interval(from.unknowns[k]), fold_.unknowns[k] + Interval(way * kPartBeyondFold));
    return line_.system(closure.unknowns[k], {exact_number(range.lo), exact_number(range.hi)},
                        exact_number(from.unknowns[k]), std::move(unknowns), std::move(ranges),
                        line_.equations(), std::move(start),
                        std::vector<ex>(n_, exact_number(kRadiusOfStart)));
  }

  /// Returns the leaf of the line that holds the configuration at the start of the swapped tubes.
  static const BranchLeaf* meeting(const ClosureResult& first, const ClosureResult& second,
                                   double at_k, std::size_t k) {
    const std::vector<Interval>& others = second.links.configuration;
    std::vector<Interval> unknowns(others.begin() + 1, others.end());
    unknowns.insert(unknowns.begin() + std::ptrdiff_t(k), Interval(at_k));
    return leaf_with(first, others[0], unknowns);
  }

  /// Returns the leaf in whose tube these unknowns are; nullptr if there is none.
  static const BranchLeaf* leaf_with(const ClosureResult& result, const Interval& place,
                                     const std::vector<Interval>& unknowns) {
    for (const std::size_t leaf : result.branch.tree.leaves_at({&place, 1})) {
      const BranchLeaf& found = result.branch.tree.leaves()[leaf];
      if (found.tube && certain_subset(place, found.at.box[0]))
        return certain_holds(*found.tube, {&place, 1}, unknowns) ? &found : nullptr;
    }
    return nullptr;
  }

  [[nodiscard]] const BranchLeaf* holding_fold(const ClosureResult& second, std::size_t k) const {
    std::vector<Interval> others{solution_[0]};
    for (std::size_t i = 0; i < n_; ++i)
      if (i != k) others.push_back(fold_.unknowns[i]);
    return leaf_with(second, fold_.unknowns[k], others);
  }

  const PreparedClosure& prepared_;
  const std::vector<double>& towards_;
  const std::vector<double> uncertain_;
  const SearchOptions search_;
  const FormingWatch& watch_;
  const LineModel line_;
  const std::size_t n_;
  std::optional<LostWay> lost_;
  std::vector<Interval> solution_;
  Fold fold_;
};

}  // namespace

std::optional<Fold> find_fold(const PreparedClosure& prepared, const std::vector<double>& towards,
                              const std::vector<double>& uncertain, const SearchOptions& search,
                              const FormingWatch& watch) {
  return FoldSearch(prepared, towards, uncertain, search, watch).find();
}

/// With w, wᵀΦ_p = 0 at the fold, it moves by δt = −wᵀΦ_g δg / wᵀΦ_x d along the line with direction d.
std::optional<std::vector<double>> nearest_corner(const PreparedClosure& prepared,
                                                  const std::vector<double>& towards,
                                                  const SearchOptions& search,
                                                  const FormingWatch& watch) {
  const std::size_t n = prepared.shape.unknowns, m = prepared.shape.variables;
  const std::vector<double>& from = prepared.near_start.variables;
  std::vector<double> beyond, direction(m, 0.0);
  for (std::size_t k = 0; k < towards.size(); ++k) {
    direction[k] = kPartBeyond * (towards[k] - from[k]);
    beyond.push_back(from[k] + direction[k]);
  }
  const auto fold = FoldSearch(prepared, beyond, {}, search, watch).place();
  if (!fold) return std::nullopt;
  SystemBoxes::Box at;
  for (std::size_t k = 0; k < m; ++k) at.emplace_back(from[k] + fold->part * direction[k]);
  for (const double p : fold->unknowns) at.emplace_back(p);
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  SystemBoxes system(prepared.problem, prepared.scaling, prepared.shape);
  system.evaluate({&at, 1});
  const auto found = system.at(0);
  const std::vector<double> w =
      found ? left_null_vector(found->by_unknown, n) : std::vector<double>();
  if (w.empty()) return std::nullopt;
  std::vector<double> along(m, 0.0);
  double line = 0;
  for (std::size_t k = 0; k < m; ++k) {
    for (std::size_t j = 0; j < n; ++j) along[k] += w[j] * mid(found->by_variable[j * m + k]);
    line += along[k] * direction[k];
  }
  std::vector<double> corner;
  for (std::size_t k = prepared.shape.parameters; k < m; ++k) {
    const std::optional<Interval>& range = prepared.problem.inner[k];
    if (!range) return std::nullopt;
    corner.push_back(along[k] / line > 0 ? range->hi : range->lo);
  }
  aim_at_balls(prepared, along, line > 0, corner);
  return corner;
}

}  // namespace regulus::detail
