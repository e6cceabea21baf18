// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a model's expressions at poses of a motion, to nearest, for planning only.
#pragma once

#include <Eigen/Core>
#include <random>

#include "codegen/model/exact/point_values.hpp"
#include "codegen/model/request.hpp"

namespace regulus::detail {

[[nodiscard]] Eigen::MatrixXd values_of(const GiNaC::matrix& A, PointValues& at);

/// Places of a motion, the same ones in every run.
class SamplePoints {
 public:
  /// `request` must outlive this object.
  explicit SamplePoints(const Request& request) : request_(request) {}

  /// Returns values of motion parameters and pose: of the middle, or of the next place.
  [[nodiscard]] GiNaC::exmap middle() { return pose_at(true); }
  [[nodiscard]] GiNaC::exmap next() { return pose_at(false); }

  /// Sets uncertain values to ends of their ranges; if `in_the_middle`, only those with a middle of
  /// 0: a load about 0 has no force in its middle.
  void add_uncertain(GiNaC::exmap& point, bool in_the_middle);

 private:
  [[nodiscard]] GiNaC::exmap pose_at(bool in_the_middle);
  /// Returns the pose on some piece of a trajectory, or in the middle of the one in the middle.
  [[nodiscard]] std::vector<GiNaC::ex> poses_of_piece(bool in_the_middle);

  const Request& request_;
  std::minstd_rand random_{1};
  std::uniform_real_distribution<double> uniform_{0, 1};
};

}  // namespace regulus::detail
