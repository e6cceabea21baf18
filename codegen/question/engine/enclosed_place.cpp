// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/enclosed_place.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/symbolic/derivative.hpp"
#include "codegen/question/engine/singular_descent.hpp"
#include "codegen/support/decomposition.hpp"
#include "runtime/existence/null_vector.hpp"
#include "runtime/interval/arithmetic.hpp"

namespace regulus::detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kPlaces = 8;
/// A coordinate that is nearer to an end of its range is fixed.
constexpr double kAtEnd = 0x1p-40;
/// Variables whose derivatives are formed; the motion's come first.
constexpr std::size_t kMostCandidates = 32;
constexpr long kBitsOfEntries = 128;
/// A smaller component of v, compared with the largest, takes no part.
constexpr double kPartOfVector = 1e-7;

/// The matrix, its derivatives by some variables, and all that must be defined.
class NaturalMatrix {
 public:
  NaturalMatrix(const Formulation& f, std::vector<std::size_t> variables)
      : variables_(std::move(variables)), entries_(f.natural_matrix.size()) {
    std::vector<Expression> outputs = f.natural_matrix;
    for (const Expression& entry : outputs) is_zero_.push_back(entry.is_constant(0));
    for (const std::size_t k : variables_) {
      Differentiator by(f.variables[k].name);
      for (const Expression& entry : f.natural_matrix) outputs.push_back(by.derivative(entry));
    }
    outputs.insert(outputs.end(), f.must_be_defined.begin(), f.must_be_defined.end());
    program_ = lower_outputs(f, outputs);
  }

  [[nodiscard]] const std::vector<std::size_t>& variables() const { return variables_; }
  /// True if the entry is written as 0.
  [[nodiscard]] bool is_zero(std::size_t entry) const { return is_zero_[entry]; }

  /// Encloses the matrix over a box, and its derivatives by the variables with these places in the list.
  [[nodiscard]] std::optional<MatrixOverBox> over(std::span<const Interval> box,
                                                  std::span<const std::size_t> places) const {
    ArbArithmetic arithmetic(kBitsOfEntries);
    std::vector<Ball> inputs;
    for (const Interval& x : box) inputs.emplace_back(x, kBitsOfEntries);
    const std::vector<Ball> outputs =
        evaluate<ArbArithmetic>(program_, std::span<const Ball>(inputs), {}, arithmetic);
    if (arithmetic.undefined()) return std::nullopt;
    const auto part = [&](std::size_t block, std::vector<Interval>& to) {
      for (std::size_t e = 0; e < entries_; ++e)
        to.push_back(outputs[block * entries_ + e].enclosure());
    };
    MatrixOverBox result;
    part(0, result.entries);
    for (const std::size_t place : places) part(1 + place, result.slopes);
    return result;
  }

 private:
  std::vector<std::size_t> variables_;
  std::size_t entries_;
  std::vector<bool> is_zero_;
  Program program_;
};

/// Some columns of the matrix, and the rows that are not 0 identically in them.
struct Minor {
  std::vector<std::size_t> rows, columns;
};

/// One singular place.
class PlaceEnclosure {
 public:
  PlaceEnclosure(const PreparedSearch& p, const NaturalMatrix& matrix,
                 const SingularDescent::Place& place)
      : p_(p), matrix_(matrix), point_(place.point) {
    for (std::size_t k = 0; k < point_.size(); ++k)
      if (!p_.variety.inner[k]) point_[k] = p_.variety.outer[k];
  }

  /// First with the columns alone that take part in v: a loss that concerns few rows has a smaller
  /// codimension than one of all.
  [[nodiscard]] std::optional<EnclosedPlace> enclose() {
    std::vector<std::size_t> all_variables;
    for (std::size_t i = 0; i < matrix_.variables().size(); ++i) all_variables.push_back(i);
    at_ = matrix_.over(point_, all_variables);
    if (!at_) return std::nullopt;
    Minor all = minor_of({});
    const VectorXd v = null_vector(all);
    std::vector<std::size_t> support;
    for (std::size_t j = 0; j < all.columns.size(); ++j)
      if (std::fabs(v(Index(j))) > kPartOfVector * v.cwiseAbs().maxCoeff()) support.push_back(j);
    if (support.size() < all.columns.size())
      if (auto found = enclose_in(minor_of(support))) return found;
    return enclose_in(all);
  }

 private:
  /// No columns mean all of them, with all rows.
  [[nodiscard]] Minor minor_of(const std::vector<std::size_t>& columns) const {
    Minor minor{{}, columns};
    const auto m = std::size_t(p_.labels.rows), n = std::size_t(p_.labels.columns);
    for (std::size_t j = 0; columns.empty() && j < n; ++j) minor.columns.push_back(j);
    const auto is_zero = [&](std::size_t i, std::size_t j) { return matrix_.is_zero(i * n + j); };
    for (std::size_t i = 0; i < m; ++i)
      if (columns.empty() ||
          !std::ranges::all_of(columns, [&](std::size_t j) { return is_zero(i, j); }))
        minor.rows.push_back(i);
    return minor;
  }

  /// The entries of a minor, of those of a matrix from place `at` on.
  [[nodiscard]] std::vector<Interval> part(const Minor& minor, const std::vector<Interval>& entries,
                                           std::size_t at) const {
    std::vector<Interval> result;
    for (const std::size_t i : minor.rows)
      for (const std::size_t j : minor.columns)
        result.push_back(entries[at + i * std::size_t(p_.labels.columns) + j]);
    return result;
  }

  [[nodiscard]] RowMajor approx_part(const Minor& minor, const std::vector<Interval>& entries,
                                     std::size_t at) const {
    RowMajor result(Index(minor.rows.size()), Index(minor.columns.size()));
    const std::vector<Interval> part = this->part(minor, entries, at);
    for (std::size_t e = 0; e < part.size(); ++e) result.data()[e] = mid(part[e]);
    return result;
  }

  /// v in the balanced matrix, where its components can be compared.
  [[nodiscard]] VectorXd null_vector(const Minor& minor) const {
    const RowMajor A = approx_part(minor, at_->entries, 0);
    const BalancedMatrix balanced =
        balance({A.data(), std::size_t(A.size())}, minor.rows.size(), minor.columns.size());
    return decompose(balanced.entries).v.rightCols<1>();
  }

  [[nodiscard]] std::optional<EnclosedPlace> enclose_in(const Minor& minor) const {
    if (minor.rows.size() < minor.columns.size()) return std::nullopt;
    std::vector<double> v, t;
    const std::vector<std::size_t> chosen = choose(minor, v);
    if (chosen.empty()) return std::nullopt;
    std::vector<Interval> ranges;
    for (const std::size_t place : chosen) {
      t.push_back(mid(point_[matrix_.variables()[place]]));
      ranges.push_back(*p_.variety.inner[matrix_.variables()[place]]);
    }
    const std::size_t entries = at_->entries.size();
    const MatrixFunction over =
        [&](std::span<const Interval> of_chosen) -> std::optional<MatrixOverBox> {
      const auto all = matrix_.over(with(chosen, of_chosen), chosen);
      if (!all) return std::nullopt;
      MatrixOverBox result{part(minor, all->entries, 0), {}};
      for (std::size_t k = 0; k < chosen.size(); ++k) {
        const std::vector<Interval> slopes = part(minor, all->slopes, k * entries);
        result.slopes.insert(result.slopes.end(), slopes.begin(), slopes.end());
      }
      return result;
    };
    const auto found = enclose_null_vector(over, std::move(t), std::move(v), ranges);
    if (!found) return std::nullopt;
    EnclosedPlace result{with(chosen, found->t), {}, {}};
    for (const std::size_t place : chosen)
      result.chosen.push_back(std::uint32_t(matrix_.variables()[place]));
    result.null_vector.assign(std::size_t(p_.labels.columns), Interval(0.0));
    for (std::size_t j = 0; j < minor.columns.size(); ++j)
      result.null_vector[minor.columns[j]] = found->vector[j];
    return result;
  }

  /// The point with other values of the chosen variables.
  [[nodiscard]] std::vector<Interval> with(const std::vector<std::size_t>& chosen,
                                           std::span<const Interval> values) const {
    std::vector<Interval> box = point_;
    for (std::size_t i = 0; i < chosen.size(); ++i) box[matrix_.variables()[chosen[i]]] = values[i];
    return box;
  }

  /// The width of a variable's range if it may be chosen, 0 if it is fixed.
  [[nodiscard]] double freedom(std::size_t place) const {
    const std::size_t k = matrix_.variables()[place];
    const std::optional<Interval>& inner = p_.variety.inner[k];
    const double x = mid(point_[k]);
    return inner && inner->lo + kAtEnd < x && x < inner->hi - kAtEnd ? inner->hi - inner->lo : 0;
  }

  /// Finds v, and the variables, by their places in the list, whose derivatives (∂_kA)·v span what the
  /// columns of A do not reach. Empty if they do not.
  [[nodiscard]] std::vector<std::size_t> choose(const Minor& minor,
                                                std::vector<double>& v_of) const {
    const std::size_t variables = matrix_.variables().size();
    const Index m = Index(minor.rows.size()), d = m - Index(minor.columns.size()) + 1;
    const RowMajor A = approx_part(minor, at_->entries, 0);
    const BalancedMatrix balanced =
        balance({A.data(), std::size_t(A.size())}, minor.rows.size(), minor.columns.size());
    const SingularValueDecomposition svd = decompose(balanced.entries);
    const VectorXd v = balanced.column_scale.asDiagonal() * svd.v.rightCols<1>();
    MatrixXd moved(m, Index(variables));
    for (std::size_t place = 0; place < variables; ++place)
      moved.col(Index(place)) =
          freedom(place) * (balanced.row_scale.asDiagonal() *
                            (approx_part(minor, at_->slopes, place * at_->entries.size()) * v));
    const MatrixXd out = svd.u.rightCols(d).transpose() * moved;
    if (!out.allFinite() || out.cols() < d) return {};
    const PivotedColumns pivoted = pivot(out);
    std::vector<std::size_t> chosen;
    for (Index i = 0; i < d; ++i) {
      chosen.push_back(std::size_t(pivoted.order[std::size_t(i)]));
      if (pivoted.beyond(i) == 0 || freedom(chosen.back()) == 0) return {};
    }
    std::ranges::sort(chosen);
    v_of.assign(v.data(), v.data() + v.size());
    return chosen;
  }

  const PreparedSearch& p_;
  const NaturalMatrix& matrix_;
  std::vector<Interval> point_;  ///< in the model's variables
  std::optional<MatrixOverBox> at_;
};

/// The variables that may be chosen. A coordinate of a ball is not: its ends depend on the others.
std::vector<std::size_t> candidates(const PreparedSearch& p, const Formulation& f) {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < f.variables.size() && result.size() < kMostCandidates; ++k) {
    const std::optional<Interval>& inner = p.variety.inner[k];
    if (inner && inner->lo < inner->hi && f.variables[k].ball < 0) result.push_back(k);
  }
  return result;
}

}  // namespace

[[gnu::noinline]] std::optional<EnclosedPlace> find_enclosed_place(const PreparedSearch& p,
                                                                   std::span<const Interval> box) {
  const Formulation& f = p.stages->natural_formulation();
  const Program entries = lower_outputs(f, f.natural_matrix);
  const ApproxMatrix approx = approx_matrix(f, entries);
  SingularDescent descent(p, approx);
  std::optional<NaturalMatrix> matrix;
  for (int number = -1; number < kPlaces && !descent.exhausted(); ++number) {
    const auto place = descent.from(number < 0 ? descent.middle_of(box) : descent.start(number));
    if (!place || place->singular_value > kAlmostLostRank) continue;
    if (!matrix) matrix.emplace(f, candidates(p, f));
    if (auto found = PlaceEnclosure(p, *matrix, *place).enclose()) return found;
  }
  return std::nullopt;
}

}  // namespace regulus::detail
