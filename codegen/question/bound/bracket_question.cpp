// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bracket_question.hpp"

#include "codegen/model/exact/sign.hpp"
#include "codegen/question/bound/bound_certificate.hpp"

namespace regulus::detail {

MarginQuestion question_of(const Bordered& bordered, MarginValue low,
                           std::optional<MarginValue> high) {
  MarginQuestion question;
  question.quantity =
      bordered.parameter.empty() ? MarginQuantity::kAlpha : MarginQuantity::kParameter;
  question.groups = bordered.parameter;
  question.is_two_sided = bordered.is_two_sided;
  question.low = std::move(low);
  question.high = std::move(high);
  return question;
}

MarginQuestion question_at_limit(const Bordered& bordered) {
  const Motion& motion = bordered.request.motion;
  const GiNaC::ex end =
      bordered.parameter.empty() ? motion.alpha : motion.parameters.back().range.hi;
  return question_of(bordered, decimal_value(0),
                     MarginValue{"the limit", end, approx_value(end).value_or(0), {}});
}

MarginQuestion question_within_limit(MarginQuestion question, const Component& component,
                                     const GiNaC::ex& limit) {
  question.about = [component, limit](const Request& grown) {
    return border_at_limit(grown, component, limit).request;
  };
  question.certified = [component, limit](const Request& grown) -> CertifiedMotion {
    const Bordered bordered = border_at_limit(grown, component, limit);
    const Motion& motion = bordered.request.motion;
    const GiNaC::ex end =
        bordered.parameter.empty() ? motion.alpha : motion.parameters.back().range.hi;
    return {grown, [component, bordered, end](const Request& about,
                                              const std::set<std::string>& uncertain) {
              return certified_bound(about, component, bordered, end, uncertain);
            }};
  };
  return question;
}

Request request_of_pieces(const Bordered& bordered) {
  Request request = bordered.request;
  if (!bordered.parameter.empty()) request.model.matrix = bordered.plain;
  return request;
}

}  // namespace regulus::detail
