// SPDX-License-Identifier: Apache-2.0
#include "runtime/evaluation/regularity_tests.hpp"

#include "runtime/regularity/determinant.hpp"
#include "runtime/regularity/h_matrix.hpp"
#include "runtime/regularity/minors.hpp"
#include "runtime/regularity/rohn.hpp"

namespace regulus::detail {
namespace {

using Side = ProductForm::Side;

/// Larger determinants are not expanded where K does not help: this would cost too much.
constexpr std::size_t kMaxFallback = 8;

/// Compares lower bounds of |det A| with the threshold; α = 0 needs only their sign.
template <typename LowerBound>
LaneMask above_threshold(Batch& batch, LaneMask lanes, LowerBound&& lower_rd) noexcept {
  LaneMask certain = 0;
  for_each_lane(lanes, [&](std::size_t lane) {
    if (batch.certain_above_threshold(lane, lower_rd(lane))) certain |= 1U << lane;
  });
  return certain;
}

/// Tests Pv < v for P ≥ |KA − I|, or Tv < v for T ≥ |B − I| with det B = det KA.
class HMatrixTest final : public RegularityTest {
 public:
  HMatrixTest(Rule rule, double alpha) noexcept : RegularityTest(rule), alpha_(alpha) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& /*budget*/) noexcept override {
    const bool moving = rule() == Rule::kSecondOrder;
    const std::size_t n = moving ? batch.order() : batch.kernel().columns;
    const ConstPointMatrix P = bounds(batch);
    lanes &= certain_h_matrix(P, batch.candidate_vector(n));
    batch.keep_vector(lanes, n);
    if (alpha_ == 0.0) return above_threshold(batch, lanes, [](std::size_t) { return 1.0; });
    const LaneNumbers product_rd = determinant_rd(P);
    const LaneNumbers moving_ru = moving ? batch.moving_determinant_ru() : kOnes;
    // |det A| = |det KA| / |det K|.
    return above_threshold(batch, lanes, [&](std::size_t lane) {
      return div_rd(product_rd[lane],
                    mul_ru(mag(batch.preconditioner_determinant(lane)), moving_ru[lane]));
    });
  }

 private:
  static constexpr LaneNumbers kOnes{{1, 1, 1, 1, 1, 1, 1, 1}};

  [[nodiscard]] ConstPointMatrix bounds(Batch& batch) const noexcept {
    switch (rule()) {
      case Rule::kSecondOrder:
        return batch.second_order_bounds();
      case Rule::kMeanValue:
        return batch.mean_value_bounds();
      default:
        return batch.natural_bounds();
    }
  }

  double alpha_;
};

/// An HMatrixTest for bounds that cost half of those of Rule::kSecondOrder. Their |det K(t)| is not
/// known: α = 0 only.
class MotionTest final : public RegularityTest {
 public:
  MotionTest() noexcept : RegularityTest(Rule::kSecondOrder) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& /*budget*/) noexcept override {
    const std::size_t n = batch.order();
    lanes &= certain_h_matrix(batch.motion_bounds(), batch.candidate_vector(n));
    batch.keep_vector(lanes, n);
    return above_threshold(batch, lanes, [](std::size_t) { return 1.0; });
  }
};

/// Tests the same T, direction by direction, if its spectral radius exceeds 1 only slightly. It
/// shows regularity, but no distance from singularity: α = 0 only.
class OrthantTest final : public RegularityTest {
 public:
  OrthantTest() noexcept : RegularityTest(Rule::kOrthants) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& budget) noexcept override {
    LaneMask certain = 0;
    for_each_lane(lanes, [&](std::size_t lane) {
      const double radius = batch.approx_spectral_radius(lane);
      if (!has_lane(budget.anyway, lane) && !budget.threshold.worth_trying(radius)) return;
      const LaneMask empty =
          batch.certain_by_orthants(1U << lane, has_lane(budget.last, lane) ? kMostHalvings : 0);
      budget.note({radius, empty != 0});
      certain |= empty;
    });
    return above_threshold(batch, certain, [](std::size_t) { return 1.0; });
  }

 private:
  /// Each takes some ten microseconds.
  static constexpr unsigned kMostHalvings = 2000;
};

/// Bounds the determinant of A, or that of its product with K divided by that of K.
class DeterminantTest final : public RegularityTest {
 public:
  DeterminantTest(Rule rule, ProductForm form, double alpha) noexcept
      : RegularityTest(rule), form_(form), alpha_(alpha) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& /*budget*/) noexcept override {
    const LaneIntervals determinants = enclose(batch.product(form_, lanes), lanes);
    return above_threshold(batch, lanes, [&](std::size_t lane) {
      const double lower = mig(determinants[lane]);
      // α = 0: a product is regular only if both factors are.
      if (form_.side == Side::kNone || alpha_ == 0.0) return lower;
      return div_rd(lower, mag(batch.preconditioner_determinant(lane)));
    });
  }

 private:
  [[nodiscard]] LaneIntervals enclose(ConstIntervalMatrix matrix, LaneMask lanes) const noexcept {
    LaneIntervals result;
    if (rule() == Rule::kElimination) {
      for_each_lane(lanes, [&](std::size_t lane) {
        result[lane] = enclose_determinant_by_elimination(matrix_of_lane(matrix, lane));
      });
    } else if (lanes != 0) {
      result = enclose_determinants(matrix);
    }
    return result;
  }

  ProductForm form_;
  double alpha_;
};

/// An HMatrixTest of first order where the tests of T are far from a proof, and now and then. Where
/// a derivative grows without limit, such as that of |u| near 0, T is not defined or too wide, but
/// entries are bounded all the same.
class FirstOrderTest final : public RegularityTest {
 public:
  FirstOrderTest(Rule rule, double alpha) noexcept : RegularityTest(rule), test_(rule, alpha) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& budget) noexcept override {
    LaneMask far = lanes & ~batch.expanded();
    // Derivatives by many quantities cost much, and T uses them where it is defined.
    if (rule() == Rule::kHMatrix) {
      far |= lanes & budget.anyway;
      for_each_lane(lanes, [&](std::size_t lane) {
        if (!(batch.approx_spectral_radius(lane) < kFar)) far |= 1U << lane;
      });
    }
    return far == 0 ? 0 : test_.certify(batch, far, budget);
  }

 private:
  static constexpr double kFar = 4.0;
  HMatrixTest test_;
};

/// A DeterminantTest of A where K does not help: A is nearly singular there, or its scales are too
/// different, so K·A cannot show that A is regular; and where T is not defined.
class FallbackTest final : public RegularityTest {
 public:
  FallbackTest(Rule rule, bool expands, double alpha) noexcept
      : RegularityTest(rule), test_(rule, {}, alpha), expands_(expands) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& budget) noexcept override {
    LaneMask poor = lanes & ~batch.preconditioned();
    const LaneMask anyway = lanes & budget.anyway;
    if (anyway != 0) poor |= anyway & batch.poorly_preconditioned();
    if (anyway != 0 && expands_) poor |= anyway & ~batch.expanded();
    return poor == 0 ? 0 : test_.certify(batch, poor, budget);
  }

 private:
  DeterminantTest test_;
  bool expands_;
};

/// Uses the determinant as one expression of the variables: it keeps dependencies of entries.
class ClosedFormTest final : public RegularityTest {
 public:
  ClosedFormTest() noexcept : RegularityTest(Rule::kClosedForm) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& /*budget*/) noexcept override {
    const LaneMask natural = certify(batch, lanes, batch.natural_determinant());
    const LaneMask rest = lanes & ~natural;
    if (rest == 0 || batch.kernel().determinant_derivatives == nullptr) return natural;
    return natural | certify(batch, rest, batch.monotone_determinant());
  }

 private:
  /// In a lane that is not defined, the enclosure is all numbers.
  static LaneMask certify(Batch& batch, LaneMask lanes, ConstIntervalVector determinant) noexcept {
    return above_threshold(batch, lanes, [&](std::size_t lane) {
      return mig(Interval{determinant.lower(0, lane), determinant.upper(0, lane)});
    });
  }
};

/// Rohn's vertex determinants. They show regularity, but no distance to singular: α = 0 only.
class RohnTest final : public RegularityTest {
 public:
  explicit RohnTest(ProductForm form) noexcept : RegularityTest(Rule::kRohn), form_(form) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& /*budget*/) noexcept override {
    const ConstIntervalMatrix product = batch.product(form_, lanes);
    lanes = certain_rohn(product, lanes);
    return above_threshold(batch, lanes, [](std::size_t) { return 1.0; });
  }

 private:
  ProductForm form_;
};

/// A user's test. This class itself shows that J⁻¹ and the pose are defined.
class FilterTest final : public RegularityTest {
 public:
  FilterTest(const regulus_filter_interface& filter, double alpha) noexcept
      : RegularityTest(Rule::kFilter), filter_(filter), alpha_(alpha) {}

  LaneMask certify(Batch& batch, LaneMask lanes, TestBudget& /*budget*/) noexcept override {
    lanes &= batch.certain_posed();
    const ConstIntervalMatrix product = batch.product({Side::kLeft, false}, lanes);
    const ConstIntervalMatrix matrix = batch.product({}, lanes);
    if (lanes == 0) return 0;
    const regulus_kernel& kernel = batch.kernel();
    return call_filter(
        filter_, {lanes, kernel.variables, kernel.motion_variables, kernel.rows, kernel.columns,
                  batch.boxes().data(), matrix.data(), batch.preconditioner().data(),
                  product.data(), batch.row_scales().data(), alpha_});
  }

 private:
  const regulus_filter_interface& filter_;
  double alpha_;
};

/// Returns true if a quantity that is not a motion parameter touches several rows.
bool has_wide_uncertainty(const regulus_kernel& kernel, const RowStructure& structure) noexcept {
  for (std::size_t k = kernel.motion_variables; k < kernel.variables; ++k)
    if (!structure.touches_one_row(k)) return true;
  return false;
}

bool with_rohn(Method method) noexcept {
  return method == Method::kRegRohn || method == Method::kKjRohn || method == Method::kJkRohn;
}

template <typename Test>
void add_first_order(TestSequence& tests, bool natural, bool mean_value, double alpha) {
  if (natural) tests.push_back(std::make_unique<Test>(Rule::kHMatrix, alpha));
  if (mean_value) tests.push_back(std::make_unique<Test>(Rule::kMeanValue, alpha));
}

/// Returns the built-in tests, in the order of the method's name.
TestSequence tests_of_method(const Problem& problem, const Settings& settings,
                             const RowStructure& structure) {
  const double alpha = problem.alpha.hi;
  const regulus_kernel& kernel = *problem.kernel;
  const Ingredients& use = settings.ingredients;
  TestSequence tests;
  if (settings.method == Method::kAuto) {
    const bool mean_value =
        use.mean_value && kernel.left_derivatives != nullptr && kernel.left_product != nullptr;
    if (structure.empty()) add_first_order<HMatrixTest>(tests, use.natural, mean_value, alpha);
    if (structure.is_known())
      tests.push_back(std::make_unique<HMatrixTest>(Rule::kSecondOrder, alpha));
    if (tests_learn(problem, settings, structure)) tests.push_back(std::make_unique<OrthantTest>());
    // If quantities touch one row only, bounds that do not use this are far wider as a rule.
    if (!structure.empty()) add_first_order<FirstOrderTest>(tests, use.natural, mean_value, alpha);
    if (kernel.rows == kernel.columns && kernel.columns <= kMaxFallback)
      for (const Rule rule : {Rule::kDeterminant, Rule::kElimination})
        tests.push_back(std::make_unique<FallbackTest>(rule, structure.is_known(), alpha));
    return tests;
  }
  if (settings.method == Method::kClosedForm) {
    tests.push_back(std::make_unique<ClosedFormTest>());
    return tests;
  }
  const ProductForm form = form_of(settings.method);
  const bool rohn = with_rohn(settings.method) && alpha == 0.0;
  if (settings.determinant != Determinant::kElimination)
    tests.push_back(std::make_unique<DeterminantTest>(Rule::kDeterminant, form, alpha));
  // If elimination shows that a matrix is regular, Rohn's test does too.
  if (settings.determinant == Determinant::kElimination ||
      (settings.determinant == Determinant::kBoth && !rohn))
    tests.push_back(std::make_unique<DeterminantTest>(Rule::kElimination, form, alpha));
  if (rohn) tests.push_back(std::make_unique<RohnTest>(form));
  return tests;
}

}  // namespace

bool tests_learn(const Problem& problem, const Settings& settings,
                 const RowStructure& structure) noexcept {
  return settings.method == Method::kAuto && settings.ingredients.orthants &&
         problem.alpha.hi == 0.0 && structure.is_known() && !structure.empty();
}

TestSequence make_easy_tests(const Problem& problem, const Settings& settings,
                             const RowStructure& structure) {
  TestSequence tests;
  if (settings.method != Method::kAuto || !structure.is_known() || structure.empty()) return tests;
  if (settings.ingredients.natural)
    tests.push_back(std::make_unique<HMatrixTest>(Rule::kHMatrix, problem.alpha.hi));
  if (settings.ingredients.moving && problem.alpha.hi == 0.0 &&
      has_wide_uncertainty(*problem.kernel, structure))
    tests.push_back(std::make_unique<MotionTest>());
  return tests;
}

TestSequence make_tests(const Problem& problem, const Settings& settings,
                        const RowStructure& structure) {
  TestSequence tests = tests_of_method(problem, settings, structure);
  for (const regulus_filter_interface* filter : settings.filters)
    tests.push_back(std::make_unique<FilterTest>(*filter, problem.alpha.hi));
  return tests;
}

}  // namespace regulus::detail
