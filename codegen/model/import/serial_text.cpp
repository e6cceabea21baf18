// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/serial_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

#include "codegen/model/file/written.hpp"
#include "codegen/model/import/joint_ranges.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

std::string toml_list(std::span<const WrittenNumber> numbers) {
  std::string text;
  for (const WrittenNumber& number : numbers)
    text += (text.empty() ? "" : ", ") + toml_number(number);
  return "[" + text + "]";
}

/// Returns ", xyz = […], rpy = […]", without what is zero.
std::string pose_text(const Pose& pose) {
  std::string text;
  if (std::ranges::any_of(pose.xyz, [](const WrittenNumber& x) { return !x.is_zero(); }))
    text += ", xyz = " + toml_list(pose.xyz);
  if (pose.orientation == OrientationForm::kRpy) text += ", rpy = " + toml_list(pose.angles);
  if (pose.orientation == OrientationForm::kQuaternion)
    text += ", quaternion = " + toml_list(pose.angles);
  if (pose.orientation == OrientationForm::kRotation) {
    const std::span<const WrittenNumber> entries(pose.angles);
    text += fmt::format(", rotation = [{}, {}, {}]", toml_list(entries.first(3)),
                        toml_list(entries.subspan(3, 3)), toml_list(entries.last(3)));
  }
  return text;
}

/// The joints that are written: those that move, and fixed ones that place the next.
std::vector<const ImportedJoint*> written_joints(const Chain& chain) {
  std::vector<const ImportedJoint*> result;
  for (const ImportedJoint* joint : chain.joints)
    if (moves(*joint) || !joint->origin.is_identity()) result.push_back(joint);
  return result;
}

/// Returns the name of a joint that has its own value; of another, which joint it follows, and how.
std::string value_text(const ImportedJoint& joint, const std::string& name) {
  if (!joint.mimics) return fmt::format("name = \"{}\"", name);
  std::string text = fmt::format("mimic = \"{}\"", name);
  if (!joint.rule->multiplier.value.is_equal(1))
    text += ", multiplier = " + toml_number(joint.rule->multiplier);
  if (!joint.rule->offset.is_zero()) text += ", offset = " + toml_number(joint.rule->offset);
  return text;
}

/// `name`: that of the joint, or of the joint that it follows.
std::string joint_text(const ImportedJoint& joint, const std::string& name) {
  if (!moves(joint))
    return fmt::format("  {{ type = \"fixed\"{} }}, # {}\n", pose_text(joint.origin),
                       in_quotes(joint.name));
  std::string text = "  { " + value_text(joint, name);
  if (!turns(joint)) text += ", type = \"prismatic\"";
  text += pose_text(joint.origin);
  const bool is_default =
      joint.axis[0].is_zero() && joint.axis[1].is_zero() && joint.axis[2].value.is_equal(1);
  if (!is_default) text += ", axis = " + toml_list(joint.axis);
  return text + (!joint.mimics ? " },\n" : " }, # " + in_quotes(joint.name) + "\n");
}

}  // namespace

std::string toml_number(const WrittenNumber& number) {
  constexpr std::size_t kMostDigits = 15;  // of a number of TOML without quotes
  const bool plain = number.text.find_first_not_of("-.0123456789") == std::string::npos;
  return plain && number.text.size() <= kMostDigits ? number.text : "\"" + number.text + "\"";
}

std::string serial_text(const Chain& chain, const std::string& file, Identifiers& identifiers,
                        std::vector<std::string>& notes) {
  std::string joints, limits, home;
  bool home_is_allowed = true;
  std::map<std::string, std::string> names;
  const std::vector<const ImportedJoint*> written = written_joints(chain);
  for (const ImportedJoint* joint : written)
    if (moves(*joint) && !joint->mimics) names[joint->name] = identifiers.of(joint->name);
  for (const ImportedJoint* joint : written) {
    const bool leads = !joint->mimics;
    const std::string name = moves(*joint) ? names.at(leads ? joint->name : *joint->mimics) : "";
    joints += joint_text(*joint, name);
    if (!moves(*joint) || !leads) continue;
    const auto [range, remark] = range_of(*joint, chain, file, notes);
    limits += fmt::format("{} = [{}, {}]{}\n", name, toml_number(range.lower),
                          toml_number(range.upper), remark);
    home += name + " = 0\n";
    home_is_allowed = home_is_allowed && range.lower.approx() <= 0 && range.upper.approx() >= 0;
  }
  std::string text =
      fmt::format("[serial] # from link {} to link {}\nunit = \"m\"\njoints = [\n{}]\n",
                  in_quotes(chain.base), in_quotes(chain.tip), joints);
  text += "\n[motion.limits] # the ranges of the joints\n" + limits;
  if (home_is_allowed) return text + "\n[motion.home] # every joint at zero\n" + home;
  notes.emplace_back("no motion 'home': the limits exclude the pose with every joint at zero");
  return text;
}

}  // namespace regulus::detail
