// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/root_judge.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/question/solve/interval_matrices.hpp"
#include "runtime/existence/branch_tube.hpp"
#include "runtime/existence/narrowing.hpp"

namespace regulus::detail {
namespace {

constexpr int kRounds = 12, kSharpenings = 12;
/// So many steps are made in any case.
constexpr int kStepsOfNewton = 3;
constexpr int kStepsToRoot = 12;
/// A round that leaves more of every side is the last one.
constexpr double kWorthwhile = 0.9;
/// The radius of a uniqueness test is larger than the box by this, so that neighbours overlap.
constexpr double kRoom = 1 + 0x1p-6;
constexpr double kLeastRadius = 0x1p-46;  ///< relative to 1 or to the unknown
constexpr double kSmallRadius = 0x1p-24;

double least_radius(double center) { return kLeastRadius * std::fmax(1.0, std::fabs(center)); }

/// Returns the least radius about the centre, rounded up, that reaches all of the box.
double reach(double center, const Interval& box) { return mag(box - Interval(center)); }

}  // namespace

/// Holds what is known of a box while it is judged.
struct RootJudge::Trial {
  Box box;               ///< of the variables, and of the unknowns: what is left of it
  RootFinding* finding;  ///< about it
  bool is_open = true;
  bool is_promising = false;  ///< K·Φ_p is nearly the unit matrix
  std::vector<double> center{};

  [[nodiscard]] std::span<Interval> unknowns(const ClosedShape& shape) {
    return std::span(box).subspan(shape.variables);
  }
};

namespace {

/// The box of the variables with other values of the unknowns.
template <class Value>
SystemBoxes::Box with_unknowns(const SystemBoxes::Box& box, std::size_t variables,
                               std::size_t unknowns, const Value& value_of) {
  SystemBoxes::Box result(box.begin(), box.begin() + std::ptrdiff_t(variables));
  for (std::size_t i = 0; i < unknowns; ++i) result.push_back(value_of(i));
  return result;
}

/// M of root_judge.hpp: the derivatives over the box, or those at the centre and half of what they
/// change by, whichever is narrower.
std::vector<Interval> mean_derivatives(const RootSystem::Values& over,
                                       const RootSystem::Values& at_center,
                                       std::span<const Interval> steps) {
  const std::size_t n = steps.size();
  std::vector<Interval> mean = over.by_unknown;
  if (over.rates_by_unknown.empty()) return mean;
  for (std::size_t e = 0; e < n * n; ++e) {
    Interval change(0.0);
    for (std::size_t k = 0; k < n; ++k) change += over.rates_by_unknown[k * n * n + e] * steps[k];
    const Interval near = at_center.by_unknown[e] + Interval(0.5) * change;
    if (const auto both = intersect(mean[e], near)) mean[e] = *both;
  }
  return mean;
}

std::vector<double> middles(std::span<const Interval> values) {
  std::vector<double> result;
  for (const Interval& value : values) result.push_back(mid(value));
  return result;
}

/// Encloses the values, or K times them.
std::vector<Interval> values_of(const RootSystem::Values& at, const std::vector<double>* K,
                                std::size_t n) {
  std::vector<Interval> values = at.core.empty() ? at.value : at.core;
  if (K != nullptr) values = product(*K, values, n);
  if (at.core.empty()) return values;
  const std::vector<Interval> spread = K != nullptr ? product(*K, at.by_datum, n) : at.by_datum;
  const std::size_t m = at.data.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < m; ++k) values[i] += spread[i * m + k] * at.data[k];
  return values;
}

/// Returns for each unknown how much the equations change over the box by it, relative to all.
std::vector<double> impact_of(std::span<const Interval> mean, std::span<const Interval> steps,
                              std::size_t variables) {
  const std::size_t n = steps.size();
  std::vector<double> impact(variables + n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    double all = 0;
    for (std::size_t j = 0; j < n; ++j) all += mag(mean[i * n + j]) * mag(steps[j]);
    for (std::size_t j = 0; j < n; ++j)
      if (all > 0 && std::isfinite(all))
        impact[variables + j] += mag(mean[i * n + j]) * mag(steps[j]) / all;
  }
  return impact;
}

/// True if a solution may be farther than a part of the radius, whatever the box is: the equations have
/// uncertain numbers, and the tube of the solution may be cut by the box.
bool is_blurred(std::span<const Interval> steps, std::span<const double> radius) {
  constexpr double kPart = 0.25;
  for (std::size_t i = 0; i < radius.size(); ++i)
    if (rad_ru(steps[i]) > kPart * radius[i]) return true;
  return false;
}

/// The test of branch_tube.hpp without variables.
TubeImage image_about(const std::vector<double>& center, const std::vector<double>& radius,
                      std::span<const double> inverse, const RootSystem::Values& at_center,
                      const RootSystem::Values& over) {
  return image_of(
      {{}, center, {}, radius}, {}, inverse,
      {at_center.value, over.by_unknown, {}, at_center.by_unknown, {}, over.rates_by_unknown, {}});
}

}  // namespace

void RootJudge::judge(std::span<const Box> boxes, std::span<RootFinding> findings, double) {
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < boxes.size(); ++i) trials.push_back({boxes[i], &findings[i]});
  for (int round = 0; round < kRounds; ++round) {
    if (std::ranges::none_of(trials, &Trial::is_open)) break;
    narrow(trials);
    regular_ ? test_regularity(trials) : find_roots(trials);
  }
  for (Trial& trial : trials) {
    const auto unknowns = trial.unknowns(question_.shape);
    trial.finding->unknowns.assign(unknowns.begin(), unknowns.end());
    if (trial.finding->root) sharpen(trial.box, *trial.finding->root);
  }
}

/// Narrows the boxes once, and says which of them may be shown to have exactly one solution.
void RootJudge::narrow(std::span<Trial> trials) {
  const std::size_t n = question_.shape.unknowns, m = question_.shape.variables;
  std::vector<Trial*> open;
  std::vector<Box> boxes, centers;
  for (Trial& trial : trials) {
    if (!trial.is_open) continue;
    open.push_back(&trial);
    trial.center = middles(trial.unknowns(question_.shape));
    boxes.push_back(trial.box);
    centers.push_back(
        with_unknowns(trial.box, m, n, [&](std::size_t i) { return Interval(trial.center[i]); }));
  }
  system_->evaluate(boxes, true);
  std::vector<std::optional<RootSystem::Values>> over;
  for (std::size_t i = 0; i < open.size(); ++i) over.push_back(system_->at(i));
  system_->evaluate(centers, false);
  for (std::size_t i = 0; i < open.size(); ++i) {
    Trial& trial = *open[i];
    RootFinding& finding = *trial.finding;
    const auto at_center = system_->at(i);
    trial.is_open = trial.is_promising = false;
    finding.is_undefined = !over[i] || !at_center;
    if (finding.is_undefined) continue;
    finding.is_empty = !std::ranges::all_of(over[i]->value, contains_zero) ||
                       !std::ranges::all_of(over[i]->also, contains_zero);
    if (finding.is_empty) continue;
    const std::span<Interval> P = trial.unknowns(question_.shape);
    const std::vector<Interval> before(P.begin(), P.end());
    std::vector<Interval> steps;
    for (std::size_t j = 0; j < n; ++j) steps.push_back(P[j] - Interval(trial.center[j]));
    const std::vector<Interval> mean = mean_derivatives(*over[i], *at_center, steps);
    finding.impact = impact_of(mean, steps, m);
    finding.is_empty = !narrow_by_rows(mean, values_of(*at_center, nullptr, n), trial.center, P);
    if (finding.is_empty) continue;
    if (const auto K = approx_inverse_of(middles(at_center->by_unknown), n)) {
      const std::vector<Interval> KM = product(*K, mean, n);
      finding.is_empty = !narrow_by_rows(KM, values_of(*at_center, &*K, n), trial.center, P);
      trial.is_promising = is_near_unit(KM, steps);
    }
    for (std::size_t j = 0; j < n; ++j)
      trial.is_open = trial.is_open || width_ru(P[j]) < kWorthwhile * width_ru(before[j]);
    trial.is_open = trial.is_open && !finding.is_empty;
    trial.is_promising = trial.is_promising && !finding.is_empty;
  }
}

/// Tests if a box about all of the promising ones has exactly one solution.
void RootJudge::find_roots(std::span<Trial> trials) {
  const std::size_t n = question_.shape.unknowns, m = question_.shape.variables;
  std::vector<Trial*> promising;
  std::vector<Box> boxes, centers;
  std::vector<std::vector<double>> radii;
  for (Trial& trial : trials) {
    if (!trial.is_promising) continue;
    promising.push_back(&trial);
    const std::span<Interval> P = trial.unknowns(question_.shape);
    trial.center = middles(P);
    std::vector<double>& radius = radii.emplace_back();
    for (std::size_t i = 0; i < n; ++i)
      radius.push_back(
          std::fmax(least_radius(trial.center[i]), kRoom * reach(trial.center[i], P[i])));
    centers.push_back(
        with_unknowns(trial.box, m, n, [&](std::size_t i) { return Interval(trial.center[i]); }));
    boxes.push_back(with_unknowns(trial.box, m, n, [&](std::size_t i) {
      return Interval(trial.center[i]) + Interval(-radius[i], radius[i]);
    }));
  }
  if (promising.empty()) return;
  system_->evaluate(centers, false);
  std::vector<std::optional<RootSystem::Values>> at_center;
  for (std::size_t i = 0; i < promising.size(); ++i) at_center.push_back(system_->at(i));
  system_->evaluate(boxes, true);
  std::vector<Trial*> small;
  for (std::size_t i = 0; i < promising.size(); ++i) {
    Trial& trial = *promising[i];
    const auto over = system_->at(i);
    if (!over || !at_center[i]) continue;
    const auto K = approx_inverse_of(middles(at_center[i]->by_unknown), n);
    if (!K) continue;
    const TubeImage image = image_about(trial.center, radii[i], *K, *at_center[i], *over);
    if (!has_one_solution({{}, trial.center, {}, radii[i]}, image)) {
      if (std::ranges::max(radii[i]) < kSmallRadius ||
          is_blurred(product(*K, at_center[i]->value, n), radii[i]))
        small.push_back(&trial);
      continue;
    }
    Root& root = trial.finding->root.emplace();
    root.center = trial.center, root.radius = radii[i];
    for (std::size_t j = 0; j < n; ++j)
      root.values.push_back(Interval(trial.center[j]) +
                            Interval(-image.radius[j], image.radius[j]));
    trial.is_open = trial.is_promising = false;
  }
  for (Trial* const trial : small) find_root_about(*trial);
}

/// The box is so small that rounding, or what is uncertain, may fail the test: it is tried with more room.
void RootJudge::find_root_about(Trial& trial) {
  auto root = root_near(trial.box, trial.center);
  if (!root || !root->is(trial.unknowns(question_.shape))) return;
  trial.finding->root = std::move(root);
  trial.is_open = trial.is_promising = false;
}

/// Tests the promising boxes.
void RootJudge::test_regularity(std::span<Trial> trials) {
  const std::size_t n = question_.shape.unknowns;
  std::vector<Trial*> promising;
  std::vector<Box> boxes;
  for (Trial& trial : trials)
    if (trial.is_promising && !trial.finding->is_regular)
      promising.push_back(&trial), boxes.push_back(trial.box);
  if (promising.empty()) return;
  regular_->evaluate(boxes, false);
  for (std::size_t i = 0; i < promising.size(); ++i) {
    Trial& trial = *promising[i];
    trial.is_promising = false;
    const auto over = regular_->at(i);
    const auto K = over ? approx_inverse_of(middles(over->by_unknown), n) : std::nullopt;
    if (!K) continue;
    trial.finding->is_regular = is_near_unit(product(*K, over->by_unknown, n), n);
  }
}

/// Narrows the enclosure of a root, as long as that helps, about centres that Newton's method finds.
void RootJudge::sharpen(const Box& variables, Root& root) {
  const std::size_t n = question_.shape.unknowns, m = question_.shape.variables;
  std::vector<double> center = middles(root.values);
  for (int i = 0; i < kSharpenings; ++i) {
    std::vector<double> radius;
    for (std::size_t j = 0; j < n; ++j)
      radius.push_back(std::fmax(reach(center[j], root.values[j]), least_radius(center[j])));
    const std::vector<Box> boxes = {
        with_unknowns(variables, m, n, [&](std::size_t j) { return Interval(center[j]); }),
        with_unknowns(variables, m, n, [&](std::size_t j) {
          return Interval(center[j]) + Interval(-radius[j], radius[j]);
        })};
    system_->evaluate(boxes, true);
    const auto at_center = system_->at(0), over = system_->at(1);
    if (!over || !at_center) return;
    root.sign = sign_of_determinant(over->by_unknown, n);
    const auto K = approx_inverse_of(middles(at_center->by_unknown), n);
    if (!K) return;
    const TubeImage image = image_about(center, radius, *K, *at_center, *over);
    const std::vector<Interval> steps = product(*K, at_center->value, n);
    bool is_better = i < kStepsOfNewton;
    for (std::size_t j = 0; j < n; ++j) {
      // The solution is in the tube, which contains `values`, and a fixed point of its map.
      const Interval image_of_root =
          Interval(center[j]) + Interval(-image.radius[j], image.radius[j]);
      const auto both = intersect(root.values[j], image_of_root);
      if (!both) return;
      is_better = is_better || width_ru(*both) < kWorthwhile * width_ru(root.values[j]);
      root.values[j] = *both;
      center[j] -= mid(steps[j]);
    }
    if (!is_better) return;
  }
}

std::optional<Root> RootJudge::root_near(const Box& variables, std::vector<double> near) {
  const std::size_t n = question_.shape.unknowns, m = question_.shape.variables;
  std::optional<RootSystem::Values> at_center;
  std::optional<std::vector<double>> K;
  for (int i = 0; i < kStepsToRoot; ++i) {
    const std::vector<Box> points = {
        with_unknowns(variables, m, n, [&](std::size_t j) { return Interval(near[j]); })};
    system_->evaluate(points, false);
    at_center = system_->at(0);
    if (!at_center) return std::nullopt;
    K = approx_inverse_of(middles(at_center->by_unknown), n);
    if (!K) return std::nullopt;
    if (i + 1 == kStepsToRoot) break;
    const std::vector<Interval> steps = product(*K, at_center->value, n);
    for (std::size_t j = 0; j < n; ++j) near[j] -= mid(steps[j]);
  }
  // Uncertain numbers need room: wide boxes are tried, and then boxes as large as the solution's tube.
  const std::vector<Interval> steps = product(*K, at_center->value, n);
  const bool is_uncertain = is_blurred(steps, std::vector<double>(n, kSmallRadius));
  std::vector<std::vector<double>> radii;
  for (int halving = 3; is_uncertain && halving < 8; ++halving)
    radii.emplace_back(n, std::ldexp(1.0, -halving));
  for (const double size : {0x1p-8, 0x1p-14, 0x1p-22, 0x1p-32}) radii.emplace_back(n, size);
  for (const double factor : {2.0, 1.5, 3.0}) {
    if (!is_uncertain) break;
    std::vector<double>& radius = radii.emplace_back();
    for (const Interval& step : steps) radius.push_back(std::fmax(factor * mag(step), 0x1p-32));
  }
  for (const std::vector<double>& radius : radii) {
    const std::vector<Box> boxes = {with_unknowns(variables, m, n, [&](std::size_t i) {
      return Interval(near[i]) + Interval(-radius[i], radius[i]);
    })};
    system_->evaluate(boxes, true);
    const auto over = system_->at(0);
    if (!over) continue;
    const TubeImage image = image_about(near, radius, *K, *at_center, *over);
    if (!has_one_solution({{}, near, {}, radius}, image)) continue;
    Root root{near, radius, {}};
    for (std::size_t j = 0; j < n; ++j)
      root.values.push_back(Interval(near[j]) + Interval(-image.radius[j], image.radius[j]));
    sharpen(variables, root);
    return root;
  }
  return std::nullopt;
}

}  // namespace regulus::detail
