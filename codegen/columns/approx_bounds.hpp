// SPDX-License-Identifier: GPL-3.0-or-later
// How well a search will get on with a form of A: the spectral radius of the bounds that it would
// find on a few boxes of the motion. Plain doubles; nothing here feeds a verdict.
#pragma once

#include <optional>
#include <vector>

#include "codegen/columns/approx_ranges.hpp"
#include "codegen/columns/column_operations.hpp"
#include "codegen/program/module.hpp"
#include "codegen/symbolic/derivative.hpp"
#include "codegen/symbolic/rewrite.hpp"
#include "codegen/symbolic/variable.hpp"
#include "runtime/regularity/second_order.hpp"

namespace regulus::inline columns {

/// Which bounds, over what.
struct BoundsSetting {
  const std::vector<Variable>& variables;
  /// Or Expansion::kNoRow. Quantities with a row are kept at their nominal values, as
  /// regularity/second_order.hpp has it.
  std::vector<int> row_of_variable;
  bool second_order = true;  ///< T of regularity/second_order.hpp; else P ≥ |KA − I|
};

/// Eight boxes of the motion, with the uncertain quantities whole; by variable, then by lane.
using SampleBoxes = std::vector<std::vector<Interval>>;

class ApproxBounds {
 public:
  ApproxBounds(const PolynomialMatrix& A, Rewriter& rewriter, const BoundsSetting& setting);

  /// All lanes the whole of the motion.
  [[nodiscard]] SampleBoxes whole() const;

  /// Of each lane; +∞ where A is undefined or K not found. Below 1 a search certifies the box.
  [[nodiscard]] std::vector<double> radii(const SampleBoxes& boxes);

  /// Halves the boxes of radius 1 or more as a search does, after radii(boxes): where it tells
  /// most. A lane keeps the half that is nearer to its own point: the middle of the motion in the
  /// first, between there and a corner in the others.
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
  /// A, row-major; a row of K·A and its derivatives by what touches several rows; derivatives of A
  /// by what touches one.
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

}  // namespace regulus::inline columns
