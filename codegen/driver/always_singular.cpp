// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/always_singular.hpp"

#include <algorithm>
#include <optional>

#include "regulus/codegen/driver/arb_oracle.hpp"
#include "regulus/codegen/symbolic/determinant.hpp"
#include "regulus/kernel/call.hpp"
#include "regulus/regularity/aligned_buffer.hpp"
#include "regulus/regularity/lanes.hpp"

namespace regulus::codegen {
namespace {

constexpr long kBits = 212;
constexpr std::uint64_t kBudget = 200000;

/// Points that fill the variety evenly enough, the middle first.
constexpr double kParts[] = {0.5, 0.381966, 0.763932, 0.145898};
constexpr std::size_t kPoints = std::size(kParts);

std::vector<Interval> sample(const Preparation& p, std::size_t number) {
  std::vector<Interval> point;
  for (std::size_t k = 0; k < p.variety.outer.size(); ++k) {
    const std::optional<Interval>& inner = p.variety.inner[k];
    if (!inner) {
      point.push_back(p.variety.outer[k]);
      continue;
    }
    const double part = kParts[(number * (k + 1)) % kPoints];
    const double x = inner->lo + part * (inner->hi - inner->lo);
    point.emplace_back(std::clamp(x, inner->lo, inner->hi));
  }
  return point;
}

bool certified_somewhere(const Result& result) {
  const auto& leaves = result.statistics.leaves;
  for (std::size_t rule = 0; rule < leaves.size(); ++rule)
    if (Rule(rule) != Rule::kOutside && Rule(rule) != Rule::kBlocked && leaves[rule] != 0)
      return true;
  return false;
}

/// Every sample is defined, and its determinant too small to be told from 0.
bool vanishes_at_samples(const Preparation& p) {
  ArbOracle oracle(p.stages->matrix(), p.subject.rows, kBits);
  for (std::size_t number = 0; number < kPoints; ++number) {
    const auto determinant = oracle.enclose(sample(p, number));
    if (!determinant || determinant->lo > 0 || determinant->hi < 0) return false;
  }
  return true;
}

bool vanishes_identically(const Preparation& p) {
  FormulationOptions options;
  options.left_product = options.derivatives = options.right_product = false;
  options.determinant = true;
  options.determinant_budget = kBudget;
  try {
    const Request& request = p.stages->request();
    const Formulation f = formulate(request.model, request.motion, options);
    return f.determinant.size() == 1 && f.determinant.front().is_constant(0);
  } catch (const ClosedFormError&) {
    return false;
  }
}

/// The outputs of a function at a point; nullopt where it is not certainly defined.
std::optional<std::vector<Interval>> values(const Preparation& p, regulus_function function,
                                            std::size_t outputs,
                                            const std::vector<Interval>& point) {
  if (outputs == 0) return std::vector<Interval>();
  AlignedBuffer box(2 * kLanes * std::max<std::size_t>(point.size(), 1));
  AlignedBuffer out(2 * kLanes * outputs);
  for (std::size_t k = 0; k < point.size(); ++k) {
    std::fill_n(box.get() + lower_at(k, 0), kLanes, point[k].lo);
    std::fill_n(box.get() + upper_at(k, 0), kLanes, point[k].hi);
  }
  if (Kernel(p.kernel->functions()).call(function, box.get(), nullptr, out.get()) != 0)
    return std::nullopt;
  std::vector<Interval> result;
  for (std::size_t e = 0; e < outputs; ++e)
    result.emplace_back(out[lower_at(e, 0)], out[upper_at(e, 0)]);
  return result;
}

std::optional<Witness> witness_of(const Preparation& p) {
  const regulus_kernel& kernel = p.kernel->functions();
  for (std::size_t number = 0; number < kPoints; ++number) {
    const std::vector<Interval> point = sample(p, number);
    const auto matrix = values(p, kernel.matrix, kernel.rows * kernel.columns, point);
    const auto constraints = values(p, kernel.constraint, kernel.constraints, point);
    const auto pose = values(p, kernel.pose, kernel.pose_parameters, point);
    if (!matrix || !constraints || !pose) continue;
    if (std::any_of(constraints->begin(), constraints->end(),
                    [](const Interval& h) { return !(h.hi <= 0.0); }))
      continue;
    const WitnessPoint here{point, Interval(0.0), *pose};
    return Witness{{here}, here};
  }
  return std::nullopt;
}

}  // namespace

void recognise_always_singular(const Preparation& p, Result& result) {
  if (p.subject.rows != p.subject.columns || result.verdict == Verdict::kNoSingularity) return;
  if (certified_somewhere(result) || !vanishes_at_samples(p) || !vanishes_identically(p)) return;
  const std::optional<Witness> witness = witness_of(p);
  if (!witness) return;
  result.verdict = Verdict::kSingularity;
  result.reason = Reason::kAlwaysSingular;
  result.witness = witness;
  result.blocking_box.clear();
}

}  // namespace regulus::codegen
