// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/undefined_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"

namespace regulus::detail {

nlohmann::ordered_json json_undefined(const SearchSubject& p, const Undefined& undefined) {
  auto expressions = nlohmann::ordered_json::array();
  for (const UndefinedExpression& e : undefined.expressions) {
    nlohmann::ordered_json object = {{"expression", e.text}};
    if (!e.argument.empty()) {
      object["argument"] = e.argument;
      object["enclosure"] = json_interval(e.enclosure);
    }
    expressions.push_back(std::move(object));
  }
  return {{"parameters", json_parameters(p, undefined.variables)},
          {"pose", json_pose(p, undefined.pose)},
          {"uncertain", json_uncertain(p, undefined.variables)},
          {"expressions", expressions}};
}

void tell_undefined(const SearchSubject& p, const Undefined& undefined, Facts& facts) {
  facts.add("undefined", json_undefined(p, undefined));
  for (const UndefinedExpression& e : undefined.expressions)
    facts.say("undefined",
              e.text + (e.argument.empty() ? ""
                                           : fmt::format(", where {} {} {}", e.argument,
                                                         is_thin(e.enclosure) ? "=" : "in",
                                                         short_interval(e.enclosure))));
  if (undefined.expressions.empty()) facts.say("undefined", "a value is too large to be enclosed");
  facts.say("", "at " + describe_place(p, undefined.variables));
  facts.say("", describe_pose_of(p, undefined.pose));
}

}  // namespace regulus::detail
