// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/attained_place.hpp"

#include <fmt/format.h>

#include "codegen/answer/facts.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/witness_report.hpp"

namespace regulus::detail {
namespace {

void remove_parameter(AttainedPlace& place, const std::string& name) {
  const std::string parameter = fmt::format("{} = ", name);
  if (const std::size_t at = place.pose.rfind(parameter); at != std::string::npos)
    place.pose.erase(at == 0 ? 0 : at - 2);
  if (place.pose.empty()) place.pose = "the only pose";
  place.json["parameters"].erase(name);
  place.json["pose"].erase(name);
}

}  // namespace

AttainedPlace attained_place(const PreparedSearch& preparation, const Result& result,
                             const std::string& parameter) {
  AttainedPlace place;
  if (!result.witness) {
    place.pose = "every pose";
    return place;
  }
  const Witness& witness = *result.witness;
  const WitnessPoint& point = witness.near ? *witness.near : witness.points.front();
  place.pose = describe_place(preparation, point.variables);
  place.values = Facts(Readers::kPeople)
                     .say("", describe_uncertain_values(preparation, point.variables))
                     .text();
  place.json = json_point(preparation, point);
  place.json.erase("determinant");
  if (!parameter.empty()) remove_parameter(place, parameter);
  return place;
}

}  // namespace regulus::detail
