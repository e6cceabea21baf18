// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/columns/approx_bounds.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/regularity/h_matrix.hpp"
#include "runtime/regularity/midpoint_inverse.hpp"

namespace regulus::detail {
namespace {

double approx_value(const GiNaC::ex& e) {
  return GiNaC::ex_to<GiNaC::numeric>(e.evalf()).to_double();
}

void store_range(std::vector<double>& values, const ApproxRange& x) {
  values.insert(values.end(), x.lo.begin(), x.lo.end());
  values.insert(values.end(), x.hi.begin(), x.hi.end());
}

/// Returns the place of a lane's box in the range of a variable: 0 in the middle, ±1 at an end.
/// Signs are rows of a Hadamard matrix, so that any two variables meet in all four combinations.
double place_of(std::size_t lane, std::size_t variable) {
  if (lane == 0) return 0;
  const auto common = static_cast<unsigned>(lane & (variable % (kLanes - 1) + 1));
  return std::popcount(common) % 2 == 0 ? 1 : -1;
}

/// yᵀPv/yᵀv: if rows differ in scale, this is far nearer to the radius than the norm of Pv.
std::vector<double> rayleigh_quotients(const std::vector<double>& P, std::size_t n,
                                       const std::vector<double>& v, const std::vector<double>& y) {
  std::vector<double> above(kLanes, 0.0), below(kLanes, 0.0), quotients(kLanes);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t l = 0; l < kLanes; ++l) {
      below[l] += y[point_at(i, l)] * v[point_at(i, l)];
      for (std::size_t j = 0; j < n; ++j)
        above[l] += y[point_at(i, l)] * P[point_at(i * n + j, l)] * v[point_at(j, l)];
    }
  for (std::size_t l = 0; l < kLanes; ++l) quotients[l] = above[l] / below[l];
  return quotients;
}

}  // namespace

ApproxBounds::ApproxBounds(const PolynomialMatrix& A, Rewriter& rewriter,
                           const BoundsSetting& setting)
    : setting_(setting),
      rows_(static_cast<std::size_t>(A.rows())),
      columns_(static_cast<std::size_t>(A.columns)) {
  std::vector<PolynomialDifferentiator> by;
  for (const Variable& v : setting.variables) {
    names_.push_back(v.name);
    ranges_.emplace_back(approx_value(v.range.lo), approx_value(v.range.hi));
    by.emplace_back(v.name, rewriter.atoms(), rewriter.expander());
  }
  matrix_.polynomials = A.entries;
  form_product(A);
  differentiate_product(by);
  if (setting_.second_order) differentiate_rows(A, by);
  nest(rewriter.atoms());
}

bool ApproxBounds::touches_one_row(std::size_t variable) const {
  return setting_.row_of_variable[variable] != Expansion::kNoRow;
}

/// The j-th coefficient atom is the j-th entry of K's first row, which represents any row.
void ApproxBounds::form_product(const PolynomialMatrix& A) {
  for (int c = 0; c < A.columns; ++c) {
    std::vector<PolynomialTerm> terms;
    for (int j = 0; j < A.rows(); ++j)
      for (const PolynomialTerm& term : A.at(j, c).terms())
        terms.push_back(
            {Monomial{term.monomial.variables,
                      multiply(term.monomial.coefficients, AtomProduct(1, static_cast<Atom>(j)))},
             term.factor});
    product_.polynomials.emplace_back(std::move(terms));
  }
}

void ApproxBounds::differentiate_product(std::vector<PolynomialDifferentiator>& by) {
  for (std::size_t p = 0; p < by.size(); ++p)
    for (std::size_t c = 0; c < columns_ && !touches_one_row(p); ++c) {
      const Polynomial first = by[p].derivative(product_.polynomials[c]);
      if (first.is_zero()) continue;
      first_.polynomials.push_back(first);
      first_.places.push_back({0, c, p, p});
      for (std::size_t q = p; q < by.size() && setting_.second_order; ++q) {
        if (touches_one_row(q)) continue;
        Polynomial second = by[q].derivative(first);
        if (second.is_zero()) continue;
        second_.polynomials.push_back(std::move(second));
        second_.places.push_back({0, c, p, q});
      }
    }
}

void ApproxBounds::differentiate_rows(const PolynomialMatrix& A,
                                      std::vector<PolynomialDifferentiator>& by) {
  for (std::size_t k = 0; k < by.size(); ++k) {
    if (!touches_one_row(k)) continue;
    const int i = setting_.row_of_variable[k];
    for (std::size_t j = 0; j < columns_; ++j) {
      const Polynomial first = by[k].derivative(A.at(i, static_cast<int>(j)));
      if (first.is_zero()) continue;
      row_first_.polynomials.push_back(first);
      row_first_.places.push_back({static_cast<std::size_t>(i), j, k, k});
      for (std::size_t q = 0; q < by.size(); ++q) {
        const bool same_row = setting_.row_of_variable[q] == i;
        if ((same_row && q < k) || (!same_row && touches_one_row(q))) continue;
        Polynomial second = by[q].derivative(first);
        if (second.is_zero()) continue;
        row_second_.polynomials.push_back(std::move(second));
        row_second_.places.push_back(
            {static_cast<std::size_t>(i), j, std::min(k, q), std::max(k, q)});
      }
    }
  }
}

void ApproxBounds::nest(const AtomTable& atoms) {
  atoms_.emplace(atoms, names_);
  const ApproxValues coefficients = approx_coefficient_values(atoms, rows_ * columns_);
  const ApproxValues nominal = nominal_values(atoms), none;
  const auto nest_all = [&](Functions& functions, const ApproxValues& fixed) {
    for (const Polynomial& p : functions.polynomials)
      functions.forms.emplace_back(p, atoms, fixed, coefficients);
    functions.polynomials.clear();
  };
  for (Functions* functions : {&matrix_, &product_, &first_, &second_})
    nest_all(*functions, nominal);
  for (Functions* functions : {&row_first_, &row_second_}) nest_all(*functions, none);
}

/// Returns the values of atoms that depend only on quantities with a row.
ApproxValues ApproxBounds::nominal_values(const AtomTable& atoms) {
  ApproxValues values(atoms.variable_atoms());
  if (std::none_of(setting_.row_of_variable.begin(), setting_.row_of_variable.end(),
                   [](int row) { return row != Expansion::kNoRow; }))
    return values;
  SampleBoxes middle;
  for (const Interval& x : ranges_) middle.emplace_back(kLanes, Interval(mid(x)));
  const ApproxRanges ranges = atoms_->over(middle);
  for (std::size_t a = 0; a < values.size(); ++a) {
    const Occurrences variables =
        count_occurrences(atoms.variable_expression(static_cast<Atom>(a)));
    bool fixed = true;
    for (std::size_t v = 0; v < names_.size(); ++v)
      fixed = fixed && (touches_one_row(v) || variables.count(names_[v]) == 0);
    if (fixed) values[a] = ranges[a].lo[0];
  }
  return values;
}

SampleBoxes ApproxBounds::whole() const {
  SampleBoxes boxes;
  for (const Interval& x : ranges_) boxes.emplace_back(kLanes, x);
  return boxes;
}

void ApproxBounds::load(const SampleBoxes& boxes) {
  center_.clear();
  radius_.clear();
  for (const std::vector<Interval>& lanes : boxes) {
    center_.emplace_back();
    for (const Interval& x : lanes) {
      center_.back().emplace_back(mid(x));
      radius_.push_back((x.hi - x.lo) / 2);
    }
  }
}

bool ApproxBounds::find_preconditioner(const ApproxRanges& at_center) {
  std::vector<double> matrix;
  for (const NestedRange& entry : matrix_.forms) {
    const ApproxRange x = entry.over(at_center, nullptr);
    matrix.insert(matrix.end(), x.lo.begin(), x.lo.end());
  }
  K_.assign(rows_ * columns_ * kLanes, 0.0);
  LaneNumbers determinant;
  if (approx_inverse(ConstPointMatrix(matrix.data(), rows_, columns_),
                     PointMatrix(K_.data(), columns_, rows_), determinant) != 0)
    return false;
  K_rows_.assign(rows_ * columns_, LaneValues{});
  for (std::size_t e = 0; e < K_rows_.size(); ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane) K_rows_[e][lane] = K_[point_at(e, lane)];
  return std::all_of(K_.begin(), K_.end(), [](double x) { return std::isfinite(x); });
}

/// Evaluates functions of one row of K·A for all of its rows; interval layout.
std::vector<double> ApproxBounds::in_all_rows(const Functions& row,
                                              const ApproxRanges& atoms) const {
  std::vector<double> values;
  values.reserve(2 * kLanes * columns_ * row.forms.size());
  for (const NestedRange& form : row.forms)
    for (std::size_t i = 0; i < columns_; ++i)
      store_range(values, form.over(atoms, K_rows_.data() + i * rows_));
  return values;
}

std::vector<double> ApproxBounds::in_one_row(const Functions& list,
                                             const ApproxRanges& atoms) const {
  std::vector<double> values;
  for (const NestedRange& form : list.forms) store_range(values, form.over(atoms, nullptr));
  return values;
}

std::vector<DerivativePlace> ApproxBounds::places_in_all_rows(const Functions& row) const {
  std::vector<DerivativePlace> places;
  for (DerivativePlace place : row.places)
    for (place.row = 0; place.row < columns_; ++place.row) places.push_back(place);
  return places;
}

RowStructure ApproxBounds::row_structure() const {
  RowStructure structure;
  for (std::size_t v = 0; v < names_.size(); ++v) {
    structure.ball.push_back(setting_.variables[v].ball);
    if (!touches_one_row(v)) {
      structure.slot.push_back(RowStructure::kWide);
      continue;
    }
    const auto row = static_cast<std::size_t>(setting_.row_of_variable[v]);
    const auto known = std::find(structure.rows.begin(), structure.rows.end(), row);
    structure.slot.push_back(static_cast<int>(known - structure.rows.begin()));
    if (known == structure.rows.end()) structure.rows.push_back(row);
  }
  return structure;
}

SecondOrderInput ApproxBounds::input() const {
  const auto listed = [](const std::vector<double>& x) {
    return ConstIntervalVector(x.data(), x.size() / (2 * kLanes));
  };
  return {.K = ConstPointMatrix(K_.data(), columns_, rows_),
          .product = ConstIntervalMatrix(values_.product.data(), columns_, columns_),
          .first = listed(values_.first),
          .second = listed(values_.second),
          .row_first = listed(values_.row_first),
          .row_second = listed(values_.row_second),
          .radius = ConstPointVector(radius_.data(), radius_.size() / kLanes)};
}

std::vector<double> ApproxBounds::second_order_bounds(const ApproxRanges& at_center,
                                                      const ApproxRanges& over_boxes,
                                                      std::size_t& order) {
  if (!second_order_)
    second_order_.emplace(
        DerivativeLists{rows_, columns_, names_.size(), places_in_all_rows(first_),
                        places_in_all_rows(second_), row_first_.places, row_second_.places},
        row_structure(), SecondOrderOptions{});
  // Column by column, in the order of the functions of one row.
  const std::vector<double> by_column = in_all_rows(product_, at_center);
  values_.product.resize(by_column.size());
  for (std::size_t c = 0; c < columns_; ++c)
    for (std::size_t i = 0; i < columns_; ++i)
      std::copy_n(by_column.data() + lower_at(c * columns_ + i, 0), 2 * kLanes,
                  values_.product.data() + lower_at(i * columns_ + c, 0));
  values_.first = in_all_rows(first_, at_center);
  values_.second = in_all_rows(second_, over_boxes);
  values_.row_first = in_one_row(row_first_, at_center);
  values_.row_second = in_one_row(row_second_, over_boxes);
  order = second_order_->order();
  std::vector<double> T(order * order * kLanes);
  second_order_->bound_ru(input(), PointMatrix(T.data(), order, order));
  return T;
}

/// Returns the smaller of the natural and the mean-value bound, entry by entry.
std::vector<double> ApproxBounds::first_order_bounds(const ApproxRanges& at_center,
                                                     const ApproxRanges& over_boxes) {
  std::vector<double> P(columns_ * columns_ * kLanes), mean(P.size());
  const auto add_distance = [&](const std::vector<double>& product, std::vector<double>& to) {
    for (std::size_t c = 0; c < columns_; ++c)
      for (std::size_t i = 0; i < columns_; ++i)
        for (std::size_t l = 0; l < kLanes; ++l) {
          const double unit = i == c ? 1 : 0;
          const std::size_t e = c * columns_ + i;
          to[point_at(i * columns_ + c, l)] = std::max(std::fabs(product[lower_at(e, l)] - unit),
                                                       std::fabs(product[upper_at(e, l)] - unit));
        }
  };
  add_distance(in_all_rows(product_, over_boxes), P);
  add_distance(in_all_rows(product_, at_center), mean);
  const std::vector<double> first = in_all_rows(first_, over_boxes);
  const std::vector<DerivativePlace> places = places_in_all_rows(first_);
  slopes_.assign(places.size() * kLanes, 0.0);
  for (std::size_t e = 0; e < places.size(); ++e)
    for (std::size_t l = 0; l < kLanes; ++l) {
      double& slope = slopes_[point_at(e, l)];
      slope = std::max(std::fabs(first[lower_at(e, l)]), std::fabs(first[upper_at(e, l)]));
      mean[point_at(places[e].row * columns_ + places[e].column, l)] +=
          slope * radius_[point_at(places[e].first, l)];
    }
  for (std::size_t e = 0; e < P.size(); ++e) P[e] = std::min(P[e], mean[e]);
  return P;
}

std::vector<double> ApproxBounds::radii(const SampleBoxes& boxes) {
  std::vector<double> radii(kLanes, std::numeric_limits<double>::infinity());
  load(boxes);
  impact_.assign(radius_.begin(), radius_.end());
  const ApproxRanges at_center = atoms_->over(center_);
  const ApproxRanges over_boxes = atoms_->over(boxes);
  if (!find_preconditioner(at_center)) return radii;
  std::size_t order = columns_;
  const std::vector<double> bounds = setting_.second_order
                                         ? second_order_bounds(at_center, over_boxes, order)
                                         : first_order_bounds(at_center, over_boxes);
  if (std::all_of(bounds.begin(), bounds.end(), [](double x) { return std::isfinite(x); }))
    weigh(bounds, order, radii);
  return radii;
}

/// Computes the radii, and the contribution of each variable.
void ApproxBounds::weigh(const std::vector<double>& bounds, std::size_t order,
                         std::vector<double>& radii) {
  std::vector<double> v(order * kLanes), y(order * kLanes);
  const PerronVectors vectors{.right = PointVector(v.data(), order),
                              .left = PointVector(y.data(), order)};
  static_cast<void>(approx_perron(ConstPointMatrix(bounds.data(), order, order), vectors));
  radii = rayleigh_quotients(bounds, order, v, y);
  if (setting_.second_order)
    return second_order_->approx_impact(input(), vectors,
                                        PointVector(impact_.data(), impact_.size() / kLanes));
  std::fill(impact_.begin(), impact_.end(), 0.0);
  const std::vector<DerivativePlace> places = places_in_all_rows(first_);
  for (std::size_t e = 0; e < places.size(); ++e)
    for (std::size_t l = 0; l < kLanes; ++l)
      impact_[point_at(places[e].first, l)] +=
          y[point_at(places[e].row, l)] * slopes_[point_at(e, l)] *
          radius_[point_at(places[e].first, l)] * v[point_at(places[e].column, l)];
}

void ApproxBounds::split(SampleBoxes& boxes, const std::vector<double>& radii) const {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if (radii[lane] < 1) continue;
    std::size_t most = names_.size();
    for (std::size_t v = 0; v < names_.size(); ++v)
      if (setting_.variables[v].kind == VariableKind::kMotion &&
          (most == names_.size() || impact_[point_at(v, lane)] > impact_[point_at(most, lane)]))
        most = v;
    if (most == names_.size()) return;
    const Interval range = ranges_[most];
    const double point = mid(range) + 0.9 * place_of(lane, most) * (range.hi - mid(range));
    Interval& x = boxes[most][lane];
    x = point < mid(x) ? Interval(x.lo, mid(x)) : Interval(mid(x), x.hi);
  }
}

}  // namespace regulus::detail
