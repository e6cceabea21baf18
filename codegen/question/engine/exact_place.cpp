// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/exact_place.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "codegen/kernel/symbolic/exact_rank.hpp"
#include "codegen/question/engine/singular_descent.hpp"
#include "runtime/interval/arithmetic.hpp"

namespace regulus::detail {
namespace {

using Place = SingularDescent::Place;

constexpr int kStarts = 4;
/// A larger matrix is not multiplied out, because its certificate could not be checked.
constexpr std::size_t kMostColumns = 8;
/// A coordinate so near to a simple value is probably meant to have it. Where a singularity is
/// touched, a descent ends at half of the digits.
constexpr double kNear = 1e-4;
constexpr int kMultiplesOfTurn = 12;  ///< of pi, in a half turn
constexpr int kDenominators[] = {1, 10, 100};
constexpr double kLargestNumerator = 1e9;

/// A simple value of one variable.
struct SimpleValue {
  double approx = 0;
  Interval enclosure;
  PlaceInRange place = PlaceInRange::kInside;
  ExactNumber number;
  GiNaC::ex exact;
};

ExactNumber lowest_terms(std::int32_t numerator, std::int32_t denominator, bool of_pi) {
  const std::int32_t divisor = std::max(std::gcd(numerator, denominator), 1);
  return {numerator / divisor, denominator / divisor, of_pi ? 1 : 0};
}

SimpleValue value_of(const ExactNumber& number) {
  const GiNaC::ex fraction = GiNaC::numeric(number.numerator, number.denominator);
  const Interval part = Interval(number.numerator) / Interval(number.denominator);
  SimpleValue value;
  value.number = number;
  value.enclosure = number.of_pi != 0 ? part * kPi : part;
  value.exact = number.of_pi != 0 ? fraction * GiNaC::Pi : fraction;
  value.approx = mid(value.enclosure);
  // A double needs no other name.
  if (number.numerator == 0) value.enclosure = Interval(0.0);
  if (value.enclosure.lo == value.enclosure.hi) value.number = {};
  return value;
}

/// Moves the coordinates of a singular place to simple values.
class Simplifier {
 public:
  Simplifier(const PreparedSearch& p, SingularDescent& descent)
      : p_(p), variables_(p.stages->natural_formulation().variables), descent_(descent) {}

  /// First fixes the coordinates that seem to have such values, then the others one by one, as long
  /// as the matrix stays singular to many digits.
  [[nodiscard]] std::optional<std::vector<SimpleValue>> simplify(Place place) {
    chosen_.assign(variables_.size(), std::nullopt);
    for (std::size_t k = 0; k < variables_.size(); ++k)
      for (const SimpleValue& value : simple_values(k, place.point[k].lo))
        if (std::fabs(value.approx - place.point[k].lo) <= kNear && !chosen_[k]) fix(k, value);
    if (!settle(place)) return std::nullopt;
    for (std::size_t k = 0; k < variables_.size(); ++k)
      if (!chosen_[k] && !choose(k, place)) return std::nullopt;
    std::vector<SimpleValue> result;
    for (const std::optional<SimpleValue>& value : chosen_) result.push_back(*value);
    return result;
  }

 private:
  void fix(std::size_t k, const SimpleValue& value) {
    chosen_[k] = value;
    descent_.fix(k, value.approx);
  }

  /// Moves the other coordinates to where the matrix is singular; false if they do not reach it.
  bool settle(Place& place) {
    for (std::size_t k = 0; k < place.point.size(); ++k)
      if (chosen_[k]) place.point[k] = Interval(chosen_[k]->approx);
    std::optional<Place> next = descent_.from(place.point);
    if (!next || next->singular_value > kAlmostLostRank) return false;
    place = std::move(*next);
    return true;
  }

  bool choose(std::size_t k, Place& place) {
    for (const SimpleValue& value : simple_values(k, place.point[k].lo)) {
      fix(k, value);
      if (settle(place)) return true;
    }
    return false;
  }

  /// Returns the values to try for a variable, the best first.
  [[nodiscard]] std::vector<SimpleValue> simple_values(std::size_t k, double x) const {
    const std::optional<Interval>& inner = p_.variety.inner[k];
    std::vector<SimpleValue> values;
    if (inner) {
      add_fractions(x, variables_[k].unit != "rad", values);
      std::erase_if(values, [&](const SimpleValue& value) {
        return !(inner->lo <= value.enclosure.lo && value.enclosure.hi <= inner->hi);
      });
    }
    if (!p_.is_replanned) add_ends(k, x, values);
    return values;
  }

  static void add_fractions(double x, bool decimals_first, std::vector<SimpleValue>& values) {
    const auto add = [&](double unit, std::int32_t denominator, bool of_pi) {
      const double nearest = std::round(x / unit);
      if (std::fabs(nearest) >= kLargestNumerator) return;
      for (const int step : {0, 1, -1})
        values.push_back(
            value_of(lowest_terms(static_cast<std::int32_t>(nearest) + step, denominator, of_pi)));
    };
    const auto add_multiples = [&] { add(kPi.lo / kMultiplesOfTurn, kMultiplesOfTurn, true); };
    if (!decimals_first) add_multiples();
    for (const int denominator : kDenominators) add(1.0 / denominator, denominator, false);
    if (decimals_first) add_multiples();
  }

  /// The nearer end of the range, or its one value.
  void add_ends(std::size_t k, double x, std::vector<SimpleValue>& values) const {
    const Interval& outer = p_.variety.outer[k];
    const std::optional<Interval>& inner = p_.variety.inner[k];
    const bool upper = inner && x > mid(outer);
    SimpleValue end;
    end.place = upper ? PlaceInRange::kUpperEnd : PlaceInRange::kLowerEnd;
    end.enclosure = !inner  ? outer
                    : upper ? Interval(inner->hi, outer.hi)
                            : Interval(outer.lo, inner->lo);
    end.exact = upper ? variables_[k].range.hi : variables_[k].range.lo;
    end.approx = !inner ? mid(outer) : upper ? inner->hi : inner->lo;
    values.push_back(end);
  }

  const PreparedSearch& p_;
  const std::vector<Variable>& variables_;
  SingularDescent& descent_;
  std::vector<std::optional<SimpleValue>> chosen_;
};

/// nullopt unless exact algebra shows that the matrix loses rank there.
std::optional<ExactPlace> decide(const Formulation& f, const std::vector<SimpleValue>& values) {
  std::map<std::string, GiNaC::ex> exact;
  ExactPlace place;
  for (std::size_t k = 0; k < values.size(); ++k) {
    exact.emplace(f.variables[k].name, values[k].exact);
    place.variables.push_back(values[k].enclosure);
    place.places.push_back(values[k].place);
    place.numbers.push_back(values[k].number);
  }
  if (!is_rank_lost(f.natural_matrix, std::size_t(f.rows), std::size_t(f.columns), exact))
    return std::nullopt;
  return place;
}

bool has_balls(const Formulation& f) {
  return std::any_of(f.variables.begin(), f.variables.end(),
                     [](const Variable& v) { return v.ball >= 0; });
}

}  // namespace

std::optional<ExactPlace> find_exact_place(const PreparedSearch& p, std::span<const Interval> box) {
  const Formulation& f = p.stages->natural_formulation();
  if (std::size_t(f.columns) > kMostColumns || has_balls(f)) return std::nullopt;
  const Program entries = lower_outputs(f, f.natural_matrix);
  const ApproxMatrix matrix = approx_matrix(f, entries);
  SingularDescent descent(p, matrix);
  for (int number = -1; number < kStarts && !descent.exhausted(); ++number) {
    descent.release();
    const auto place = descent.from(number < 0 ? descent.middle_of(box) : descent.start(number));
    if (!place || place->singular_value > kAlmostLostRank) continue;
    const auto values = Simplifier(p, descent).simplify(*place);
    if (!values) continue;
    if (auto exact = decide(f, *values)) return exact;
  }
  return std::nullopt;
}

}  // namespace regulus::detail
