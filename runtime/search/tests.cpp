// SPDX-License-Identifier: Apache-2.0
#include "regulus/search/tests.hpp"

#include "regulus/regularity/h_matrix.hpp"
#include "regulus/regularity/rohn.hpp"

namespace regulus {
namespace {

using Side = ProductForm::Side;

/// Lower bounds of |det A| decide against the threshold; α = 0 needs only their sign.
template <typename LowerBound>
LaneMask above_threshold(Batch& batch, LaneMask lanes, LowerBound&& lower_rd) noexcept {
  LaneMask certain = 0;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (batch.certain_above_threshold(lane, lower_rd(lane))) certain |= 1U << lane;
  });
  return certain;
}

/// Pv < v for P ≥ |KA − I|, or Tv < v for T ≥ |B − I| with det B = det KA.
class HMatrixTest final : public RegularityTest {
 public:
  HMatrixTest(Rule rule, double alpha) noexcept : RegularityTest(rule), alpha_(alpha) {}

  LaneMask certify(Batch& batch, LaneMask lanes) noexcept override {
    const bool structured = rule() == Rule::kStructured;
    const std::size_t n = structured ? batch.order() : batch.kernel().columns;
    const double* P = bounds(batch);
    lanes &= certain_h_matrix(P, n, batch.candidate_vector());
    batch.keep_vector(lanes, n);
    if (alpha_ == 0.0) return above_threshold(batch, lanes, [](std::size_t) { return 1.0; });
    double product_rd[kLanes];
    determinant_rd(P, n, product_rd);
    // |det A| = |det KA| / |det K|.
    return above_threshold(batch, lanes, [&](std::size_t lane) {
      return div_rd(product_rd[lane], mag(batch.preconditioner_determinant(lane)));
    });
  }

 private:
  [[nodiscard]] const double* bounds(Batch& batch) const noexcept {
    switch (rule()) {
      case Rule::kStructured:
        return batch.structured_bounds();
      case Rule::kMeanValue:
        return batch.mean_value_bounds();
      default:
        return batch.natural_bounds();
    }
  }

  double alpha_;
};

/// An interval determinant of A, or of its product with K divided by that of K.
class DeterminantTest final : public RegularityTest {
 public:
  DeterminantTest(ProductForm form, Determinant determinant, double alpha) noexcept
      : RegularityTest(Rule::kDeterminant), form_(form), determinant_(determinant), alpha_(alpha) {}

  LaneMask certify(Batch& batch, LaneMask lanes) noexcept override {
    const double* product = batch.product(form_, lanes);
    const std::size_t n = batch.kernel().columns;
    return above_threshold(batch, lanes, [&](std::size_t lane) {
      const IntervalMatrix M = interval_lane(product, n, lane);
      const double lower =
          mig(determinant_ == Determinant::kExpansion ? enclose_determinant(M)
                                                      : enclose_determinant_by_elimination(M));
      // α = 0: a product is regular only if both factors are.
      if (form_.side == Side::kNone || alpha_ == 0.0) return lower;
      return div_rd(lower, mag(batch.preconditioner_determinant(lane)));
    });
  }

 private:
  ProductForm form_;
  Determinant determinant_;
  double alpha_;
};

/// The determinant as one expression of the variables: no dependency between entries is lost.
class ClosedFormTest final : public RegularityTest {
 public:
  ClosedFormTest() noexcept : RegularityTest(Rule::kClosedForm) {}

  LaneMask certify(Batch& batch, LaneMask lanes) noexcept override {
    const LaneMask natural = certify(batch, lanes, batch.natural_determinant());
    const LaneMask rest = lanes & ~natural;
    if (rest == 0 || batch.kernel().determinant_derivatives == nullptr) return natural;
    return natural | certify(batch, rest, batch.monotone_determinant());
  }

 private:
  /// A lane that is not defined is enclosed by all numbers.
  static LaneMask certify(Batch& batch, LaneMask lanes, const double* determinant) noexcept {
    return above_threshold(batch, lanes, [&](std::size_t lane) {
      return mig(Interval{determinant[lower_at(0, lane)], determinant[upper_at(0, lane)]});
    });
  }
};

/// Rohn's vertex determinants. They show regularity, not a distance from it: α = 0 only.
class RohnTest final : public RegularityTest {
 public:
  explicit RohnTest(ProductForm form) noexcept : RegularityTest(Rule::kRohn), form_(form) {}

  LaneMask certify(Batch& batch, LaneMask lanes) noexcept override {
    const double* product = batch.product(form_, lanes);
    lanes = certain_rohn(product, batch.kernel().columns, lanes);
    return above_threshold(batch, lanes, [](std::size_t) { return 1.0; });
  }

 private:
  ProductForm form_;
};

/// A test that is not ours. That J⁻¹ and the pose are defined is shown by us all the same.
class FilterTest final : public RegularityTest {
 public:
  FilterTest(const regulus_filter_interface& filter, double alpha) noexcept
      : RegularityTest(Rule::kFilter), filter_(filter), alpha_(alpha) {}

  LaneMask certify(Batch& batch, LaneMask lanes) noexcept override {
    lanes &= batch.certain_posed();
    const double* product = batch.product({Side::kLeft, false}, lanes);
    const double* matrix = batch.product({}, lanes);
    if (lanes == 0) return 0;
    const regulus_kernel& kernel = batch.kernel();
    return call_filter(filter_, {lanes, kernel.variables, kernel.motion_variables, kernel.rows,
                                 kernel.columns, batch.boxes(), matrix, batch.preconditioner(),
                                 product, batch.row_scales(), alpha_});
  }

 private:
  const regulus_filter_interface& filter_;
  double alpha_;
};

ProductForm form_of(Method method) noexcept {
  switch (method) {
    case Method::kKj:
    case Method::kKjRohn:
      return {Side::kLeft, false};
    case Method::kJk:
    case Method::kJkRohn:
      return {Side::kRight, false};
    case Method::kKjNumeric:
      return {Side::kLeft, true};
    case Method::kJkNumeric:
      return {Side::kRight, true};
    default:
      return {Side::kNone, false};
  }
}

bool with_rohn(Method method) noexcept {
  return method == Method::kRegRohn || method == Method::kKjRohn || method == Method::kJkRohn;
}

/// Ours, in the order of the method's name.
TestSequence tests_of_method(const Problem& problem, const Settings& settings,
                             const RowStructure& structure) {
  const double alpha = problem.alpha.hi;
  const regulus_kernel& kernel = *problem.kernel;
  TestSequence tests;
  if (!structure.empty()) {
    tests.push_back(std::make_unique<HMatrixTest>(Rule::kStructured, alpha));
    return tests;
  }
  if (settings.method == Method::kAuto) {
    tests.push_back(std::make_unique<HMatrixTest>(Rule::kHMatrix, alpha));
    if (kernel.left_derivatives != nullptr && kernel.left_product != nullptr)
      tests.push_back(std::make_unique<HMatrixTest>(Rule::kMeanValue, alpha));
    return tests;
  }
  if (settings.method == Method::kClosedForm) {
    tests.push_back(std::make_unique<ClosedFormTest>());
    return tests;
  }
  const ProductForm form = form_of(settings.method);
  tests.push_back(std::make_unique<DeterminantTest>(form, settings.determinant, alpha));
  if (with_rohn(settings.method) && alpha == 0.0) tests.push_back(std::make_unique<RohnTest>(form));
  return tests;
}

}  // namespace

TestSequence make_tests(const Problem& problem, const Settings& settings,
                        const RowStructure& structure) {
  TestSequence tests = tests_of_method(problem, settings, structure);
  for (const regulus_filter_interface* filter : settings.filters)
    tests.push_back(std::make_unique<FilterTest>(*filter, problem.alpha.hi));
  return tests;
}

}  // namespace regulus
