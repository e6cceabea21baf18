// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/inverse_in_one_unit.hpp"

#include "codegen/model/constants.hpp"
#include "codegen/model/mechanism/twist.hpp"

namespace regulus::detail {

std::vector<GiNaC::ex> column_scales(const Model& model) {
  const std::vector<TwistComponent> twist = twist_of(model);
  std::vector<GiNaC::ex> scales(model.matrix.cols(), 1);
  for (std::size_t j = 0; j < twist.size() && model.characteristic_length; ++j)
    if (twist[j].kind == TwistComponent::Kind::kAngular)
      scales[j] = 1 / *model.characteristic_length;
  return scales;
}

Request inverse_in_one_unit(Request request) {
  Model& model = request.model;
  const std::vector<GiNaC::ex> scales = column_scales(model);
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j) {
      model.matrix(i, j) *= scales[j];
      if (!model.row_scale.empty()) model.matrix(i, j) *= model.row_scale[i];
    }
  append(model.must_be_defined, model.row_scale);
  model.row_scale.clear();
  model.twist.clear();
  model.matrix_notes.clear();
  model.characteristic_length.reset();
  request.motion.alpha = 0;
  return request;
}

}  // namespace regulus::detail
