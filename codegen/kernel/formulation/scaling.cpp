// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/scaling.hpp"

#include <arb.h>
#include <cln/integer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

constexpr int kPoints = 8;
constexpr long kBits = 128;

/// Scales that differ by less are not changed: scales of rows, which share K's grid; of columns,
/// which only affect how the rows of K compare; and of the matrix as a whole.
constexpr double kMildRows = 12, kMildColumns = 24, kMildMean = 48;

/// No robot's matrix has entries beyond this, and sums of exponents might overflow.
constexpr long kMostExponent = 100'000;

/// With a threshold 2^-e is a constant of the kernel, and multiplies other row scales.
constexpr int kModerateExponent = 900;

/// The binary exponent of an entry's greatest magnitude; nullopt for 0.
using Exponent = std::optional<long>;

/// Returns nullopt for a number that may be 0, because it shows no scale.
Exponent exponent_of(const Ball& value) {
  if (!arb_is_finite(value.get()) || arb_contains_zero(value.get())) return std::nullopt;
  mag_t size;
  mag_init(size);
  arf_get_mag(size, arb_midref(value.get()));
  const bool in_range =
      mag_cmp_2exp_si(size, kMostExponent) < 0 && mag_cmp_2exp_si(size, -kMostExponent) > 0;
  mag_clear(size);
  if (!in_range) return std::nullopt;
  return arf_abs_bound_lt_2exp_si(arb_midref(value.get()));
}

/// Returns the coordinate of a variable at a sample point. The points are chosen so that
/// expressions of a model are unlikely to vanish there.
Interval sample(Interval range, int point, std::size_t variable) {
  constexpr double kGolden = 0.6180339887498949;
  const double turn = (point + 0.5) * kGolden * static_cast<double>(2 * variable + 1);
  const double part = turn - std::floor(turn);
  return Interval(std::clamp(range.lo + part * (range.hi - range.lo), range.lo, range.hi));
}

/// Evaluates entries at points.
class Entries {
 public:
  Entries(const Expressions& entries, const std::vector<Variable>& variables, WorkMeter* meter)
      : meter_(meter) {
    std::vector<std::string> names;
    for (const Variable& v : variables) {
      names.push_back(v.name);
      ranges_.push_back(
          hull(enclose_constant(v.range.lo, v.name), enclose_constant(v.range.hi, v.name)));
    }
    Lowering lowering(names, {}, meter);
    for (const Expression& entry : entries) lowering.output(entry);
    program_ = std::move(lowering).finish();
    known_ = convert_constants(program_, arithmetic_);
    values_.resize(program_.nodes.size());
  }

  /// Empty if an entry is undefined there.
  std::vector<Ball> at(int point) {
    spend(meter_, program_.nodes.size());
    std::vector<Ball> inputs;
    for (std::size_t v = 0; v < ranges_.size(); ++v)
      inputs.emplace_back(sample(ranges_[v], point, v), kBits);
    arithmetic_.clear();
    run<ArbArithmetic, Ball>(program_, known_, inputs, {}, values_, arithmetic_);
    std::vector<Ball> outputs;
    if (arithmetic_.undefined()) return outputs;
    for (const NodeId output : program_.outputs) outputs.push_back(values_[output]);
    return outputs;
  }

 private:
  WorkMeter* meter_;
  std::vector<Interval> ranges_;
  Program program_;
  ArbArithmetic arithmetic_{kBits};
  KnownValues<Ball> known_;
  std::vector<Ball> values_;
};

/// Empty if the entries are defined at none of the points.
std::vector<Exponent> exponents_of(const Expressions& expressions,
                                   const std::vector<Variable>& variables, WorkMeter* meter) {
  Entries entries(expressions, variables, meter);
  std::vector<Exponent> largest;
  for (int point = 0; point < kPoints; ++point) {
    const std::vector<Ball> values = entries.at(point);
    if (values.empty()) continue;
    largest.resize(values.size());
    for (std::size_t e = 0; e < values.size(); ++e)
      largest[e] = std::max(largest[e], exponent_of(values[e]));
  }
  return largest;
}

class Scales {
 public:
  Scales(std::vector<Exponent> exponents, std::size_t columns)
      : exponents_(std::move(exponents)),
        m_(exponents_.size() / columns),
        n_(columns),
        rows_(m_, 0),
        columns_(n_, 0) {}

  /// Makes the entries of a spanning forest of rows and columns 0. Afterwards, matrices that differ
  /// only in scales are the same.
  void normalize() {
    std::vector<bool> row_known(m_, false), column_known(n_, false);
    for (std::size_t root = 0; root < m_; ++root) {
      if (row_known[root]) continue;
      row_known[root] = true;
      while (extend(row_known, column_known)) {
      }
    }
  }

  /// Makes every entry ≤ 0 and those of a diagonal 0. Returns false if there is no such diagonal.
  ///
  /// The shortest augmenting path method for assignment problems: columns are assigned rows, and
  /// the dual variables are the scales.
  [[nodiscard]] bool match() {
    std::vector<std::size_t> column_of(m_ + 1, kNone);  // row m_ holds the column being assigned
    std::vector<long> row_price(m_ + 1, 0), column_price(n_, 0);
    for (std::size_t j = 0; j < n_; ++j)
      if (!assign(j, column_of, row_price, column_price)) return false;
    for (std::size_t i = 0; i < m_; ++i) rows_[i] += row_price[i];
    for (std::size_t j = 0; j < n_; ++j) columns_[j] += column_price[j];
    // Rows without a column have any scale that keeps them ≤ 0.
    for (std::size_t i = 0; i < m_; ++i)
      if (column_of[i] == kNone) raise(i);
    return true;
  }

  [[nodiscard]] bool are_mild() const {
    const auto spread = [](const std::vector<long>& x) {
      const auto [least, most] = std::minmax_element(x.begin(), x.end());
      return static_cast<double>(*most - *least);
    };
    const auto mean = [](const std::vector<long>& x) {
      return static_cast<double>(std::accumulate(x.begin(), x.end(), 0L)) /
             static_cast<double>(x.size());
    };
    return spread(rows_) <= kMildRows && spread(columns_) <= kMildColumns &&
           std::fabs(mean(rows_) + mean(columns_)) <= kMildMean;
  }

  [[nodiscard]] MatrixScaling result() const {
    return {std::vector<int>(rows_.begin(), rows_.end()),
            std::vector<int>(columns_.begin(), columns_.end())};
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  static constexpr long kFar = std::numeric_limits<long>::max() / 4;

  [[nodiscard]] Exponent at(std::size_t i, std::size_t j) const {
    const Exponent& e = exponents_[i * n_ + j];
    if (!e) return std::nullopt;
    return *e + rows_[i] + columns_[j];
  }

  /// Takes the first entry that joins a known row or column to an unknown one.
  bool extend(std::vector<bool>& row_known, std::vector<bool>& column_known) {
    for (std::size_t i = 0; i < m_; ++i)
      for (std::size_t j = 0; j < n_; ++j) {
        const Exponent e = at(i, j);
        if (!e || row_known[i] == column_known[j]) continue;
        (row_known[i] ? columns_[j] : rows_[i]) -= *e;
        row_known[i] = column_known[j] = true;
        return true;
      }
    return false;
  }

  /// Assigns one more column a row, so that the sum of −e over the assignment is least.
  /// Ensures   −e ≥ u_j + v_i for every entry, with equality on the assignment.
  bool assign(std::size_t column, std::vector<std::size_t>& column_of, std::vector<long>& v,
              std::vector<long>& u) const {
    std::vector<long> distance(m_ + 1, kFar);
    std::vector<std::size_t> previous(m_ + 1, kNone);
    std::vector<bool> used(m_ + 1, false);
    std::size_t at_row = m_;
    column_of[m_] = column;
    do {
      used[at_row] = true;
      const std::size_t j = column_of[at_row];
      long step = kFar;
      std::size_t next = kNone;
      for (std::size_t i = 0; i < m_; ++i) {
        if (used[i]) continue;
        const Exponent e = at(i, j);
        const long reduced = e ? -*e - u[j] - v[i] : kFar;
        if (reduced < distance[i]) distance[i] = reduced, previous[i] = at_row;
        if (distance[i] < step) step = distance[i], next = i;
      }
      if (next == kNone) return false;
      for (std::size_t i = 0; i <= m_; ++i) {
        if (used[i])
          u[column_of[i]] += step, v[i] -= step;
        else if (distance[i] < kFar)
          distance[i] -= step;
      }
      at_row = next;
    } while (column_of[at_row] != kNone);
    for (; at_row != m_; at_row = previous[at_row]) column_of[at_row] = column_of[previous[at_row]];
    return true;
  }

  void raise(std::size_t row) {
    Exponent largest;
    for (std::size_t j = 0; j < n_; ++j) largest = std::max(largest, at(row, j));
    if (largest) rows_[row] -= *largest;
  }

  std::vector<Exponent> exponents_;
  std::size_t m_, n_;
  std::vector<long> rows_, columns_;
};

}  // namespace

int MatrixScaling::determinant_exponent() const noexcept {
  return std::accumulate(rows.begin(), rows.end(), 0) +
         std::accumulate(columns.begin(), columns.end(), 0);
}

Expression MatrixScaling::apply(const Expression& entry, int row, int column) const {
  if (empty()) return entry;
  const int e = rows[static_cast<std::size_t>(row)] + columns[static_cast<std::size_t>(column)];
  return product({power_of_two(e), entry});
}

cln::cl_RA power_of_two(int e) {
  return e >= 0 ? cln::cl_RA(cln::ash(cln::cl_I(1), e))
                : 1 / cln::cl_RA(cln::ash(cln::cl_I(1), -e));
}

MatrixScaling find_scaling(const Expressions& entries, int columns,
                           const std::vector<Variable>& variables, bool moderate,
                           WorkMeter* meter) {
  std::vector<Exponent> exponents;
  try {
    exponents = exponents_of(entries, variables, meter);
  } catch (const InputError&) {
    // enclose_variety reports a range without a value.
  }
  if (exponents.empty()) return {};
  Scales scales(std::move(exponents), static_cast<std::size_t>(columns));
  scales.normalize();
  if (!scales.match() || scales.are_mild()) return {};
  MatrixScaling result = scales.result();
  if (moderate && std::abs(result.determinant_exponent()) > kModerateExponent) return {};
  return result;
}

}  // namespace regulus::detail
