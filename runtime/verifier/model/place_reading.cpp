// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/place_reading.hpp"

#include <algorithm>

#include "runtime/verifier/model/equality.hpp"
#include "runtime/verifier/model/place_comparison.hpp"

namespace regulus::verifier {
namespace {

constexpr std::string_view kGeometry = "geometry.";

bool is_zero(const WrittenValue& value) {
  return !value.is_string && !value.text.empty() &&
         value.text.find_first_not_of("0.") == std::string::npos;
}

}  // namespace

void PlaceReading::name_constants() {
  const Scope none;
  for (auto at = values_.lower_bound(kGeometry); starts(at, kGeometry); ++at) {
    const std::string rest = at->first.substr(kGeometry.size());
    std::string name = rest.substr(0, rest.find_first_of(".["));
    std::string key = rest.substr(name.size());
    if (key.starts_with(".value")) key = key.substr(6);
    if (key.starts_with("["))
      name += '_' + std::to_string(std::stoul(key.substr(1)) + 1);
    else if (!key.empty())
      continue;  // a tolerance, a radius or a group
    const NodeId value = comparer_.expression_at(at->first, none);
    comparer_.expect_defined(comparer_.place_of(at->first), value);
    q_.actual.emplace(name, value);
  }
}

NodeId PlaceReading::value_of(const std::string& pose) {
  const std::string place = motion_ + pose;
  if (has(place)) return comparer_.pose_at(place, pose);
  if (!has(place + "[0]") || !has(place + "[1]") || has(place + "[2]")) return kNoNode;
  const NodeId lo = comparer_.pose_at(place + "[0]", pose),
               hi = comparer_.pose_at(place + "[1]", pose);
  return equality(q_, lo, hi) == Equality::kEqual ? lo : kNoNode;
}

void PlaceReading::require_place_option(const std::string& what) {
  if (!comparer_.may_differ(kPlaceOption)) comparer_.refuse_model(what);
  comparer_.note_difference(what + "; the place is that of the certificate");
}

void PlaceReading::require_no_tolerances() {
  for (const auto& [place, value] : values_) {
    const bool is_of_robot = place.starts_with(kGeometry) || place.starts_with("gough.") ||
                             place.starts_with("legs.") || place.starts_with("serial.");
    const bool is_spread = is_of_robot && (place.find("tolerance") != std::string::npos ||
                                           place.find(".radius") != std::string::npos);
    if ((is_spread || place.starts_with(motion_ + "error")) && !is_zero(value))
      comparer_.leave_out(comparer_.place_of(place), "the claim is without tolerances and errors");
  }
}

void PlaceReading::require_known_keys() {
  for (auto at = values_.lower_bound(motion_); starts(at, motion_); ++at) {
    const std::string rest = at->first.substr(motion_.size());
    const std::string name = rest.substr(0, rest.find_first_of(".["));
    const auto poses = section_->pose();
    const bool is_pose = std::ranges::any_of(poses, [&](const SectionPose& p) {
      return p.name == name && (rest == name || rest == name + "[0]" || rest == name + "[1]");
    });
    if (!is_pose && name != "legs" && name != "tool" && name != "error" && name != "alpha")
      comparer_.leave_out(comparer_.place_of(at->first), "this reader does not know it");
  }
}

}  // namespace regulus::verifier
