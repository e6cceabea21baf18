// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/quantity_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

Json json_texts(const std::vector<GiNaC::ex>& values) {
  Json texts = Json::array();
  for (const GiNaC::ex& value : values) texts.push_back(formula_text(value));
  return texts;
}

}  // namespace

Json json_quantity(const Model& model, const Quantity& quantity) {
  const Component& first = quantity.components.front();
  const QuantityTraits& traits = traits_of(quantity.kind);
  Json object{{"kind", *traits.word == '\0' ? quantity.name : traits.word},
              {"unit", quantity.unit},
              {"least", quantity.is_least},
              {"signed", !first.is_absolute},
              {"components", Json::array()}};
  if (*traits.norm != '\0') object["norm"] = traits.norm;
  for (const Component& c : quantity.components) object["components"].push_back(c.label);
  if (first.set != nullptr)
    object[traits.data == NeededData::kTwist ? "twist" : "load"] = json_vector_set(*first.set);
  if (traits.data == NeededData::kMotorErrors)
    object["actuator_errors_exact"] = json_texts(model.actuators.error);
  if (traits.data == NeededData::kLoadAndStiffness)
    object["stiffness_exact"] = json_texts(model.actuators.stiffness);
  return object;
}

}  // namespace regulus
