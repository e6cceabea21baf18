// SPDX-License-Identifier: GPL-3.0-or-later
// Estimates how well a search works with a form of A: the spectral radius of the bounds that it
// would find on a few boxes of the motion. Plain doubles; no verdict depends on them.
#pragma once

#include <optional>
#include <vector>

#include "codegen/kernel/columns/approx_ranges.hpp"
#include "codegen/kernel/columns/column_operations.hpp"
#include "codegen/kernel/program/module.hpp"
#include "codegen/kernel/symbolic/derivative.hpp"
#include "codegen/kernel/symbolic/rewrite.hpp"
#include "codegen/kernel/symbolic/variable.hpp"
#include "runtime/regularity/second_order.hpp"

namespace regulus::detail {

/// The kind of bounds, and the boxes for them.
struct BoundsSetting {
  const std::vector<Variable>& variables;
  /// The row, or Expansion::kNoRow. Quantities with a row are kept at their nominal values, as in
  /// regularity/second_order.hpp.
  std::vector<int> row_of_variable;
  bool second_order = true;  ///< T of regularity/second_order.hpp; else P ≥ |KA − I|
};

/// Eight boxes of the motion, with the whole ranges of uncertain quantities; by variable, then by
/// lane.
using SampleBoxes = std::vector<std::vector<Interval>>;

class ApproxBounds {
 public:
  ApproxBounds(const PolynomialMatrix& A, Rewriter& rewriter, const BoundsSetting& setting);

  /// Returns boxes that are the whole motion in all lanes.
  [[nodiscard]] SampleBoxes whole() const;

  /// Returns the radius of each lane; +∞ if A is undefined or K was not found. A search certifies a
  /// box below 1.
  [[nodiscard]] std::vector<double> radii(const SampleBoxes& boxes);

  /// Halves the boxes of radius 1 or more as a search does, after radii(boxes), along the variable
  /// with the largest effect. A lane keeps the half that is nearer to its own point: for the first
  /// lane the middle of the motion, for the others a point between the middle and a corner.
  void split(SampleBoxes& boxes, const std::vector<double>& radii) const;

 private:
  /// Polynomials, and the places of those that are derivatives.
  struct Functions {
    std::vector<Polynomial> polynomials;
    std::vector<DerivativePlace> places;
    std::vector<NestedRange> forms;
  };
  [[nodiscard]] bool touches_one_row(std::size_t variable) const;
  void form_product(const PolynomialMatrix& A);
  void differentiate_product(std::vector<PolynomialDifferentiator>& by);
  void differentiate_rows(const PolynomialMatrix& A, std::vector<PolynomialDifferentiator>& by);
  void nest(const AtomTable& atoms);
  [[nodiscard]] ApproxValues nominal_values(const AtomTable& atoms);
  void load(const SampleBoxes& boxes);
  [[nodiscard]] bool find_preconditioner(const ApproxRanges& at_center);
  [[nodiscard]] std::vector<double> in_all_rows(const Functions& row,
                                                const ApproxRanges& atoms) const;
  [[nodiscard]] std::vector<double> in_one_row(const Functions& list,
                                               const ApproxRanges& atoms) const;
  [[nodiscard]] std::vector<DerivativePlace> places_in_all_rows(const Functions& row) const;
  [[nodiscard]] std::vector<double> second_order_bounds(const ApproxRanges& at_center,
                                                        const ApproxRanges& over_boxes,
                                                        std::size_t& order);
  [[nodiscard]] std::vector<double> first_order_bounds(const ApproxRanges& at_center,
                                                       const ApproxRanges& over_boxes);
  void weigh(const std::vector<double>& bounds, std::size_t order, std::vector<double>& radii);

  const BoundsSetting setting_;
  std::size_t rows_, columns_;
  std::vector<std::string> names_;
  std::vector<Interval> ranges_;
  /// A, row-major; a row of K·A and its derivatives by quantities that touch several rows;
  /// derivatives of A by quantities that touch one row.
  Functions matrix_, product_, first_, second_, row_first_, row_second_;

  std::optional<AtomRanges> atoms_;
  std::optional<SecondOrderBounds> second_order_;
  struct Values {
    std::vector<double> product, first, second, row_first, row_second;
  };
  [[nodiscard]] SecondOrderInput input() const;
  [[nodiscard]] RowStructure row_structure() const;

  Values values_;  // of second order only; interval layout
  SampleBoxes center_;
  std::vector<double> slopes_;      // magnitudes of the first derivatives; of first order only
  std::vector<double> impact_;      // by variable, by lane
  std::vector<double> radius_, K_;  // point layout
  std::vector<LaneValues> K_rows_;  // n×m
};

}  // namespace regulus::detail
