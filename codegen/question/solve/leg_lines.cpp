// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/leg_lines.hpp"

#include <vector>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/question/solve/platform_legs.hpp"

namespace regulus::detail {

using GiNaC::ex;

CertifiedLegs certified_legs(const Request& request) {
  const Model& model = request.model;
  const NominalGeometry nominal(model);
  const bool varies = has_tolerances(request);
  const std::set<std::string> names = uncertain_names(request);
  CertifiedLegs legs{varies ? geometry_lines(model, names) : "", names.size()};
  const std::size_t axes = is_in_plane(request) ? 2 : 3;
  const std::vector<ex> squares = squared_lengths(request), errors = errors_of_squares(request);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    legs.lines += "leg ";
    for (const auto* anchor : {&model.legs[i].base, &model.legs[i].platform})
      for (std::size_t axis = 0; axis < axes; ++axis) {
        const ex& x = (*anchor)[axis];
        legs.lines += expression_text(varies ? x : nominal.at(x)) + " | ";
      }
    legs.lines += expression_text(squares[i]);
    if (!errors[i].is_zero()) {
      legs.lines += " +- " + expression_text(errors[i]);
      ++legs.uncertain;
    }
    legs.lines += '\n';
  }
  return legs;
}

}  // namespace regulus::detail
