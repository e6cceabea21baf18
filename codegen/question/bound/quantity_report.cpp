// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/quantity_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/model/exact/ginac_text.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the word of the command line; of an expression its name.
std::string word_of(const Quantity& quantity) {
  const QuantityKind kind =
      quantity.kind == QuantityKind::kCondition2 ? QuantityKind::kCondition : quantity.kind;
  for (const std::string& word : quantity_words())
    if (kind_of(word) == kind) return word;
  return quantity.name;
}

Json json_texts(const std::vector<GiNaC::ex>& values) {
  Json texts = Json::array();
  for (const GiNaC::ex& value : values) texts.push_back(formula_text(value));
  return texts;
}

}  // namespace

Json json_quantity(const Model& model, const Quantity& quantity) {
  const Component& first = quantity.components.front();
  Json object{{"kind", word_of(quantity)},
              {"unit", quantity.unit},
              {"least", quantity.is_least},
              {"signed", !first.is_absolute},
              {"components", Json::array()}};
  if (quantity.kind == QuantityKind::kCondition) object["norm"] = "max";
  if (quantity.kind == QuantityKind::kCondition2) object["norm"] = "2";
  for (const Component& c : quantity.components) object["components"].push_back(c.label);
  if (first.set != nullptr)
    object[quantity.kind == QuantityKind::kSpeed ? "twist" : "load"] = json_vector_set(*first.set);
  if (quantity.kind == QuantityKind::kError)
    object["actuator_errors_exact"] = json_texts(model.actuators.error);
  if (quantity.kind == QuantityKind::kDeflection)
    object["stiffness_exact"] = json_texts(model.actuators.stiffness);
  return object;
}

}  // namespace regulus
