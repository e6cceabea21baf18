// SPDX-License-Identifier: GPL-3.0-or-later
// §IV: the effect of anchor tolerances on the determinant of robot 1 at single poses. The paper has
// 25–40 % under "±0.1": ranges of width 0.1 give this; with ±0.1 it varies by 47–73 %.
//
// det M is affine in each anchor coordinate alone, so its extremes over the anchors' boxes are at
// vertices. A walk from vertex to vertex, one coordinate at a time, finds values of det M; interval
// elimination at a point certifies each.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/overrides.hpp"
#include "runtime/interval/interval.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/machine/machine_kernel.hpp"
#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/determinant.hpp"

namespace regulus {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr std::size_t kPose = 6;
constexpr std::size_t kAnchors = 36;
using Pose = std::array<double, kPose>;
using Signs = std::array<int, kAnchors>;

class ToleranceEffect : public testing::Test {
 protected:
  ToleranceEffect() : model_(load_model(REGULUS_SOURCE_DIR "/models/robot_1.toml")) {
    set_tolerance(model_, "base,platform", "1");  // so that all anchors are variables
    FormulationOptions options;
    options.left_product = options.derivatives = options.right_product = false;
    const Formulation formulation = formulate(model_, find_motion(model_, "table4_5"), options);
    kernel_.emplace(select(lower(formulation)), best_isa());
    for (const Variable& v : formulation.variables)
      if (v.kind == VariableKind::kGeometry)
        nominal_.push_back(GiNaC::ex_to<GiNaC::numeric>((v.range.lo + v.range.hi) / 2).to_double());
  }

  /// Encloses det M over the whole of ±tolerance, or at the vertex that the signs name.
  [[nodiscard]] Interval determinant(const Pose& pose, double tolerance,
                                     const Signs* vertex) const {
    const regulus_kernel& kernel = *kernel_->get();
    AlignedBuffer box(2 * kernel.variables * kLanes), out(2 * kPose * kPose * kLanes);
    for (std::size_t k = 0; k < kernel.variables; ++k) {
      Interval x(k < kPose ? pose[k] : nominal_[k - kPose]);
      if (k >= kPose && vertex != nullptr) x = Interval(x.lo + tolerance * (*vertex)[k - kPose]);
      if (k >= kPose && vertex == nullptr) x = x + Interval{-tolerance, tolerance};
      std::fill_n(box.get() + lower_at(k, 0), kLanes, x.lo);
      std::fill_n(box.get() + upper_at(k, 0), kLanes, x.hi);
    }
    EXPECT_EQ(CheckedKernel(kernel).call(kernel.matrix, box.get(), nullptr, out.get()), 0U);
    const LaneMatrix M = matrix_of_lane(ConstIntervalMatrix(out.get(), kPose, kPose), 0);
    return vertex != nullptr ? enclose_determinant_by_elimination(M) : enclose_determinant(M);
  }

  /// Returns a value of |det M|: the largest (sense = 1) or least (−1) that single steps reach.
  [[nodiscard]] double extreme(const Pose& pose, double tolerance, int sense) const {
    Signs vertex{};
    double best = std::fabs(mid(determinant(pose, tolerance, &vertex)));
    for (bool moved = true; moved;) {
      moved = false;
      for (int& sign : vertex)
        for (const int trial : {-1, 1}) {
          const int before = std::exchange(sign, trial);
          const double value = std::fabs(mid(determinant(pose, tolerance, &vertex)));
          const bool better = sense * (value - best) > 1e-9 * best;
          if (better) best = value;
          moved = moved || better;
          if (!better) sign = before;
        }
    }
    const Interval certified = determinant(pose, tolerance, &vertex);
    EXPECT_LT(certified.hi - certified.lo, 1e-6 * best);
    return best;
  }

  Model model_;
  std::optional<machine::MachineKernel> kernel_;
  std::vector<double> nominal_;
};

const std::array<Pose, 4> kPoses{{{0, 0, 47.5, 0, 0, 0},
                                  {5, 5, 45, 5 * kDegree, -5 * kDegree, 5 * kDegree},
                                  {-5, 3, 50, -5 * kDegree, 5 * kDegree, 0},
                                  {10, -10, 45, 10 * kDegree, 10 * kDegree, -10 * kDegree}}};

TEST_F(ToleranceEffect, ChangesTheDeterminantByAQuarterToTwoFifths) {
  for (const Pose& pose : kPoses) {
    const Signs nominal{};
    const double value = std::fabs(mid(determinant(pose, 0, &nominal)));
    for (const int sense : {-1, 1}) {
      const double change = std::fabs(extreme(pose, 0.05, sense) / value - 1);
      EXPECT_GE(change, 0.25);
      EXPECT_LE(change, 0.40);
      EXPECT_GE(std::fabs(extreme(pose, 0.1, sense) / value - 1), 0.47);
    }
  }
}

TEST_F(ToleranceEffect, IntervalEvaluationIsFarWiderThanTheExtremes) {
  for (const Pose& pose : kPoses) {
    const double most = extreme(pose, 0.1, 1), least = extreme(pose, 0.1, -1);
    const Interval enclosure = determinant(pose, 0.1, nullptr);
    const Signs nominal{};
    const double sign = mid(determinant(pose, 0, &nominal)) > 0 ? 1 : -1;
    EXPECT_LE(enclosure.lo, std::min(sign * most, sign * least));
    EXPECT_GE(enclosure.hi, std::max(sign * most, sign * least));
    EXPECT_LT(enclosure.lo * enclosure.hi, 0);  // the enclosure loses the sign, as in the paper
    EXPECT_GE(enclosure.hi - enclosure.lo, 7 * (most - least));
  }
}

}  // namespace
}  // namespace regulus
