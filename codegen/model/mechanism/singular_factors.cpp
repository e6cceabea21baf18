// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/singular_factors.hpp"

#include <algorithm>

#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/mechanism/determinant_factors.hpp"

namespace regulus::detail {
namespace {

/// Usual names, for arms in which the first joints place the wrist.
std::string usual_name(const std::vector<std::size_t>& joints, std::size_t count) {
  if (joints.size() > 1) return count >= 5 ? "shoulder" : "";
  if (joints.empty()) return "";
  return count >= 5 && joints.front() + 2 == count ? "wrist" : "elbow";
}

/// Returns the Jacobian with the angles themselves in the place of their numbers of degrees.
GiNaC::matrix in_radians(const Model& model) {
  GiNaC::matrix J = model.jacobian.value_or(model.matrix);
  GiNaC::exmap degrees;
  for (const PoseParameter& p : model.pose)
    if (is_in_degrees(p.unit)) degrees[p.symbol] = p.symbol / one_degree();
  for (unsigned i = 0; i < J.rows(); ++i)
    for (unsigned j = 0; j < J.cols(); ++j)
      J(i, j) = J(i, j).subs(degrees, GiNaC::subs_options::no_pattern);
  return J;
}

}  // namespace

std::vector<SingularFactor> singular_factors(const Model& model) {
  if (model.matrix_kind != MatrixKind::kForward) return {};
  std::vector<PoseParameter> pose = model.pose;
  for (PoseParameter& p : pose)
    if (is_in_degrees(p.unit)) p.unit = "rad";
  const auto blocks = determinant_blocks(in_radians(model), pose);
  std::vector<SingularFactor> result;
  for (const DeterminantBlock& block : blocks) {
    if (!block.is_factored) return {};
    for (const DeterminantFactor& factor : block.factors) {
      SingularFactor next{usual_name(factor.joints, model.pose.size()), formula_text(factor.value)};
      if (std::ranges::find(result, next.text, &SingularFactor::text) == result.end())
        result.push_back(std::move(next));
    }
  }
  return result;
}

}  // namespace regulus::detail
