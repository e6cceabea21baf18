// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/quantity_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/model/mechanism/twist.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

Json json_texts(const std::vector<GiNaC::ex>& values) {
  Json texts = Json::array();
  for (const GiNaC::ex& value : values) texts.push_back(formula_text(value));
  return texts;
}

/// Returns the number in decimals if they are exact.
std::string number_text(const GiNaC::ex& value) {
  const auto approx = approx_value(value);
  return approx && value.is_equal(shortest_decimal(*approx)) ? shortest_text(*approx)
                                                             : formula_text(value);
}

}  // namespace

std::string in_bars(const std::string& words, const Component& c) {
  const bool has_bars =
      c.is_absolute && c.part == PosePart::kColumn && !traits_of(c.kind).is_never_negative;
  return has_bars ? "|" + words + "|" : words;
}

std::string describe_limit(const Quantity& quantity, const GiNaC::ex& limit) {
  const Component& first = quantity.components.front();
  const std::string& unit = quantity.components.size() == 1 ? first.unit : quantity.unit;
  return fmt::format("{} {} {}{}", in_bars(quantity.name, first), quantity.is_least ? ">" : "<",
                     number_text(limit), unit_suffix(unit));
}

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
    object[traits.data == NeededData::kTwist ? "twist" : "load"] = json_vector_set(
        *first.set, traits.data == NeededData::kTwist ? units_of_rates(twist_of(model))
                                                      : units_of_wrench(model, twist_of(model)));
  if (traits.data == NeededData::kMotorErrors)
    object["actuator_errors_exact"] = json_texts(model.actuators.error);
  if (traits.data == NeededData::kLoadAndStiffness)
    object["stiffness_exact"] = json_texts(model.actuators.stiffness);
  return object;
}

}  // namespace regulus::detail
