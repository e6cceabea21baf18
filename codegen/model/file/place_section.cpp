// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "codegen/model/constants.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/model/place.hpp"

namespace regulus::detail {
namespace {

/// Reads a motion that has the lengths of the legs, or the place of the tool, in the place of a pose.
class PlaceReader {
 public:
  PlaceReader(const ModelReading& reading, const TomlEntry& entry)
      : model_(reading.model), toml_(reading.toml), entry_(entry) {
    motion_.name = entry.key;
    for (const PoseParameter& p : model_.pose) motion_.pose.push_back(p.symbol);
    motion_.error.assign(model_.pose.size(), 0);
  }

  Motion read_lengths(const TomlEntry& list) {
    const std::size_t count = model_.legs.size();
    if (count == 0)
      toml_.reject(list, "this robot has no legs whose lengths make a pose",
                   "give the pose, or a robot of [gough], or of [legs] with three legs RPR, or six "
                   "legs UPS or SPS");
    refuse_beside(list, "a motion by the lengths of the legs");
    const auto lengths = toml_.elements(list, "a list of lengths, one for each leg");
    if (lengths.size() != count)
      toml_.refuse(list, std::to_string(lengths.size()) + " lengths in " + list.path,
                   std::to_string(count) + ", one for each leg");
    for (const TomlEntry& length : lengths) motion_.legs.push_back(nonnegative(length, ""));
    read_errors_of_lengths();
    return std::move(motion_);
  }

  Motion read_tool(const TomlEntry& list) {
    if (!model_.arm) toml_.reject(list, "this robot is no arm, and has no tool", "give the pose");
    refuse_beside(list, "a motion by the place of the tool");
    const std::vector<PlaceName> names = tool_names(model_);
    const auto numbers = toml_.elements(list, "[x, y, z, roll, pitch, yaw]");
    if (numbers.size() != names.size())
      toml_.refuse(list, std::to_string(numbers.size()) + " numbers in " + list.path,
                   "[x, y, z, roll, pitch, yaw]");
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& unit = names[i].unit;
      const ParsedExpression term = toml_.constant(numbers[i], number_unit(unit));
      append(motion_.must_be_defined, term.must_be_defined);
      warn_about_angle(motion_.warnings, {term.value, term.value}, unit, toml_.place(numbers[i]));
      motion_.tool.push_back(is_in_degrees(unit) ? term.value * one_degree() : term.value);
    }
    read_errors_of_tool(names);
    return std::move(motion_);
  }

 private:
  void refuse_beside(const TomlEntry& only, const std::string& motion) const {
    for (const TomlEntry& e : toml_.entries(entry_))
      if (e.key != only.key && e.key != "error")
        toml_.reject(e, motion + " has no " + in_quotes(e.key), "remove one of them");
  }

  GiNaC::ex nonnegative(const TomlEntry& entry, const std::string& unit) {
    const ParsedExpression term = toml_.constant(entry, number_unit(unit));
    append(motion_.must_be_defined, term.must_be_defined);
    return checked_nonnegative(term, toml_.place(entry));
  }

  /// `error`: { legs = ± on each length, or a list, one for each leg }.
  void read_errors_of_lengths() {
    const TomlEntry given = toml_.optional(entry_, "error");
    if (!given.node) return;
    (void)toml_.entries(given, std::vector<std::string>{"legs"});
    const TomlEntry legs = toml_.required(given, "legs");
    std::vector<GiNaC::ex>& error = motion_.error;
    if (!legs.node->is_array()) return error.assign(error.size(), nonnegative(legs, ""));
    const auto each = toml_.elements(legs, "a list of errors, one for each leg");
    if (each.size() != error.size())
      toml_.refuse(legs, std::to_string(each.size()) + " errors in " + legs.path,
                   std::to_string(error.size()) + ", one for each leg");
    for (std::size_t i = 0; i < each.size(); ++i) error[i] = nonnegative(each[i], "");
  }

  /// `error`: { x = ± on x, … }, by the names of the numbers of a place.
  void read_errors_of_tool(const std::vector<PlaceName>& names) {
    const TomlEntry given = toml_.optional(entry_, "error");
    if (!given.node) return;
    std::vector<std::string> known;
    for (const PlaceName& name : names) known.push_back(name.name);
    motion_.tool_error.assign(names.size(), 0);
    for (const TomlEntry& e : toml_.entries(given, known)) {
      const auto k = std::size_t(std::ranges::find(known, e.key) - known.begin());
      const std::string& unit = names[k].unit;
      const GiNaC::ex error = nonnegative(e, unit);
      warn_about_angle(motion_.warnings, {-error, error}, unit, toml_.place(e));
      motion_.tool_error[k] = is_in_degrees(unit) ? error * one_degree() : error;
    }
  }

  const Model& model_;
  const TomlReader& toml_;
  const TomlEntry& entry_;
  Motion motion_;
};

}  // namespace

std::optional<Motion> read_motion_by_place(const ModelReading& reading, const TomlEntry& entry) {
  PlaceReader reader(reading, entry);
  const TomlEntry legs = reading.toml.optional(entry, "legs");
  if (legs.node) return reader.read_lengths(legs);
  const TomlEntry tool = reading.toml.optional(entry, "tool");
  return tool.node ? std::optional(reader.read_tool(tool)) : std::nullopt;
}

}  // namespace regulus::detail
