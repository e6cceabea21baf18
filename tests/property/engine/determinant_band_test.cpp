// SPDX-License-Identifier: GPL-3.0-or-later
// The determinant over each piece of a trajectory encloses Arb's values at points of it. Arb uses
// the matrix as the model writes it, with random values of the uncertain quantities.
#include <arb_mat.h>
#include <gtest/gtest.h>

#include <random>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/search/paving.hpp"
#include "runtime/search/solver.hpp"

namespace regulus::detail {
namespace {

constexpr long kBits = 256;

class Samples : public Observer {
 public:
  explicit Samples(const Formulation& formulation) : size_(formulation.rows) {
    std::vector<std::string> names;
    for (const Variable& variable : formulation.variables) names.push_back(variable.name);
    Lowering lowering(names, {});
    for (const Expression& entry : formulation.natural_matrix) lowering.output(entry);
    matrix_ = std::move(lowering).finish();
  }

  void on_leaf(const OpenBox& box, Rule, const Proof& proof) noexcept override {
    ++leaves;
    ASSERT_TRUE(proof.determinant);
    widest = std::max(widest, (proof.determinant->hi - proof.determinant->lo) /
                                  std::max(mag(*proof.determinant), 1.0));
    for (int sample = 0; sample < 3; ++sample) {
      const Interval value = determinant_at(point_of(box.box, sample));
      EXPECT_FALSE(certain_disjoint(value, *proof.determinant))
          << box.box[0].lo << ": " << value.lo << " not in [" << proof.determinant->lo << ", "
          << proof.determinant->hi << ']';
      smallest = std::min(smallest, value.lo);
      largest = std::max(largest, value.hi);
    }
  }

  int leaves = 0;
  double widest = 0;  ///< relative to the magnitude
  double smallest = kInfinity, largest = -kInfinity;

 private:
  /// Returns both ends first, then any point; uncertain quantities are at their ends or anywhere.
  std::vector<Ball> point_of(std::span<const Interval> box, int sample) {
    std::uniform_real_distribution<double> part(0, 1);
    std::vector<Ball> point;
    for (std::size_t k = 0; k < box.size(); ++k) {
      const double end = (k == 0 ? sample == 1 : part(random_) < 0.5) ? box[k].hi : box[k].lo;
      const double inside =
          std::clamp(box[k].lo + part(random_) * (box[k].hi - box[k].lo), box[k].lo, box[k].hi);
      point.emplace_back(sample < 2 ? end : inside);
    }
    return point;
  }

  Interval determinant_at(const std::vector<Ball>& point) const {
    ArbArithmetic arithmetic(kBits);
    const auto entries =
        evaluate<ArbArithmetic>(matrix_, std::span<const Ball>(point), {}, arithmetic);
    EXPECT_FALSE(arithmetic.undefined());
    arb_mat_t matrix;
    arb_mat_init(matrix, size_, size_);
    for (int i = 0; i < size_; ++i)
      for (int j = 0; j < size_; ++j)
        arb_set(arb_mat_entry(matrix, i, j), entries[std::size_t(i * size_ + j)].get());
    Ball result;
    arb_mat_det(result.get(), matrix, kBits);
    arb_mat_clear(matrix);
    return result.enclosure();
  }

  int size_;
  Program matrix_;
  std::mt19937_64 random_{20240117};
};

struct Band {
  Result result;
  int leaves;
  double widest, smallest, largest;
};

Band band_over(const std::string& model, const std::string& motion,
               std::vector<std::string> tolerances = {}) {
  ModelOptions options;
  options.path = REGULUS_SOURCE_DIR "/models/" + model + ".toml";
  options.motion = motion;
  options.tolerances = std::move(tolerances);
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  const PreparedSearch preparation = prepare(options, search);
  Samples samples(preparation.stages->formulation());
  Settings settings;
  settings.exhaustive = settings.split_certified = settings.enclose_determinants = true;
  settings.min_relative_width = 0x1p-8;
  const Problem problem = preparation.problem();
  Band band{solve(problem, settings, &samples), samples.leaves, samples.widest, samples.smallest,
            samples.largest};
  return band;
}

TEST(DeterminantBand, HoldsArbsValuesOnThePapersTrajectories) {
  for (const char* motion : {"T1", "T2"}) {
    const Band band = band_over("robot_1", motion);
    EXPECT_EQ(band.result.verdict, Verdict::kNoSingularity);
    EXPECT_EQ(band.leaves, 256);
    EXPECT_LT(band.widest, 0.05) << motion;
    EXPECT_LT(band.largest, 0);
  }
}

TEST(DeterminantBand, HoldsThemForEveryUncertainValue) {
  EXPECT_EQ(band_over("robot_1", "T2_errors", {"base,platform=0.05"}).leaves, 256);
  EXPECT_EQ(band_over("planar_3rpr", "circle", {"base,platform=0.01"}).leaves, 256);
}

}  // namespace
}  // namespace regulus::detail
