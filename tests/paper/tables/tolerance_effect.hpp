// SPDX-License-Identifier: GPL-3.0-or-later
// §IV: the effect of anchor tolerances on the determinant of robot 1 at single poses.
//
// det M is affine in each anchor coordinate alone, so its extremes over the anchors' boxes are at
// vertices. A walk from vertex to vertex, one coordinate at a time, finds values of det M; interval
// elimination at a point certifies each.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/overrides.hpp"
#include "runtime/interval/interval.hpp"
#include "runtime/kernel/call.hpp"
#include "runtime/machine/machine_kernel.hpp"
#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/determinant.hpp"

namespace regulus::detail::test {

inline constexpr double kDegree = 3.14159265358979323846 / 180;
inline constexpr std::size_t kPose = 6;
inline constexpr std::size_t kAnchors = 36;
using Pose = std::array<double, kPose>;
using Signs = std::array<int, kAnchors>;

class ToleranceEffect {
 public:
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
    if (CheckedKernel(kernel).call(kernel.matrix, box.get(), nullptr, out.get()) != 0)
      throw std::runtime_error("the matrix has no value");
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
    if (!(certified.hi - certified.lo < 1e-6 * best))
      throw std::runtime_error("the determinant at a vertex is not certain");
    return best;
  }

  [[nodiscard]] double nominal(const Pose& pose) const {
    const Signs vertex{};
    return mid(determinant(pose, 0, &vertex));
  }

 private:
  Model model_;
  std::optional<machine::MachineKernel> kernel_;
  std::vector<double> nominal_;
};

inline const std::array<Pose, 4> kPoses{{{0, 0, 47.5, 0, 0, 0},
                                         {5, 5, 45, 5 * kDegree, -5 * kDegree, 5 * kDegree},
                                         {-5, 3, 50, -5 * kDegree, 5 * kDegree, 0},
                                         {10, -10, 45, 10 * kDegree, 10 * kDegree, -10 * kDegree}}};

}  // namespace regulus::detail::test
