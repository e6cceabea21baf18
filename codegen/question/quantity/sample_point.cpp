// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/sample_point.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/model/way/trajectory.hpp"

namespace regulus::detail {

using GiNaC::ex;

Eigen::MatrixXd values_of(const GiNaC::matrix& A, PointValues& at) {
  Eigen::MatrixXd values(Eigen::Index(A.rows()), Eigen::Index(A.cols()));
  for (unsigned i = 0; i < A.rows(); ++i)
    for (unsigned j = 0; j < A.cols(); ++j)
      values(Eigen::Index(i), Eigen::Index(j)) = at.of(A(i, j));
  return values;
}

GiNaC::exmap SamplePoints::pose_at(bool in_the_middle) {
  const Motion& motion = request_.motion;
  GiNaC::exmap point;
  for (const MotionParameter& p : motion.parameters) {
    const ex t = in_the_middle ? ex(0.5) : ex(uniform_(random_));
    point[p.symbol] = (p.range.lo + t * (p.range.hi - p.range.lo)).evalf();
  }
  const GiNaC::exmap parameters = point;
  const std::vector<ex> pieces =
      motion.trajectory ? poses_of_piece(in_the_middle) : std::vector<ex>();
  for (std::size_t i = 0; i < request_.model.pose.size(); ++i)
    point[request_.model.pose[i].symbol] =
        i < pieces.size() ? pieces[i] : motion.pose[i].subs(parameters).evalf();
  return point;
}

std::vector<ex> SamplePoints::poses_of_piece(bool in_the_middle) {
  const std::vector<TrajectoryPiece>& pieces = request_.motion.trajectory->pieces;
  const double t = in_the_middle ? 0.5 : uniform_(random_);
  const double s = in_the_middle ? 0.5 : uniform_(random_);
  const auto k = std::min(std::size_t(t * double(pieces.size())), pieces.size() - 1);
  std::vector<ex> poses;
  for (const PieceOfPose& p : pieces[k].pose) poses.push_back(expression_of(p, ex(s)).evalf());
  return poses;
}

void SamplePoints::add_uncertain(GiNaC::exmap& point, bool in_the_middle) {
  const Model& model = request_.model;
  for (const GeometryParameter& g : model.geometry) {
    const double side = uniform_(random_) < 0.5 ? -1 : 1;
    const double part =
        g.ball < 0
            ? side
            : side /
                  std::sqrt(double(model.balls[static_cast<std::size_t>(g.ball)].members.size()));
    const bool is_nominal = in_the_middle && !g.value.is_zero();
    point[g.symbol] = (g.value + (is_nominal ? ex(0) : ex(part)) * g.tolerance).evalf();
  }
}

}  // namespace regulus::detail
