// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// The geometry of a model at its nominal values.
class NominalGeometry {
 public:
  explicit NominalGeometry(const Model& model) {
    for (const GeometryParameter& g : model.geometry) values_[g.symbol] = g.value;
  }
  [[nodiscard]] GiNaC::ex at(const GiNaC::ex& expression) const { return expression.subs(values_); }

 private:
  GiNaC::exmap values_;
};

/// Returns the pose of a motion whose parameters have values.
[[nodiscard]] inline std::vector<GiNaC::ex> pose_of(const Motion& motion) {
  GiNaC::exmap values;
  for (const MotionParameter& p : motion.parameters) values[p.symbol] = p.range.lo;
  std::vector<GiNaC::ex> pose;
  for (const GiNaC::ex& x : motion.pose) pose.push_back(x.subs(values));
  return pose;
}

}  // namespace regulus::detail
