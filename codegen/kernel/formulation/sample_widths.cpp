// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/sample_widths.hpp"

#include <algorithm>
#include <span>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"

namespace regulus::detail {
namespace {

/// Returns a quarter of a range, with its middle at `place` of its half-width from the range's.
Interval part_of(Interval range, double place) {
  const double middle = mid(range), half = range.hi / 2 - range.lo / 2;
  const double at = middle + place * half;
  return {std::max(range.lo, at - half / 4), std::min(range.hi, at + half / 4)};
}

}  // namespace

SampleWidths::SampleWidths(const std::vector<Variable>& variables) {
  for (const Variable& v : variables) {
    names_.push_back(v.name);
    motion_.push_back(
        hull(enclose_constant(v.range.lo, v.name), enclose_constant(v.range.hi, v.name)));
  }
  // Four points of a pattern in which each pair of variables takes all combinations of signs.
  for (std::size_t sample = 0; sample < 4; ++sample) {
    std::vector<Interval> box;
    for (std::size_t v = 0; v < motion_.size(); ++v)
      box.push_back(part_of(motion_[v], ((sample >> (v % 2)) & 1) != 0 ? 0.5 : -0.5));
    samples_.push_back(std::move(box));
  }
}

std::optional<Interval> SampleWidths::over(const Expression& e,
                                           const std::vector<Interval>& box) const {
  Lowering lowering(names_, {});
  lowering.output(e);
  IntervalArithmetic arithmetic;
  const std::vector<Interval> result =
      evaluate(std::move(lowering).finish(), std::span<const Interval>(box), {}, arithmetic);
  if (arithmetic.undefined()) return std::nullopt;
  return result[0];
}

double SampleWidths::approx_width(const Expression& e) const {
  double sum = 0;
  for (const std::vector<Interval>& box : samples_) {
    const std::optional<Interval> range = over(e, box);
    if (!range) return kInfinity;
    sum += range->hi - range->lo;
  }
  return sum;
}

std::optional<Interval> SampleWidths::over_motion(const Expression& e) const {
  return over(e, motion_);
}

}  // namespace regulus::detail
