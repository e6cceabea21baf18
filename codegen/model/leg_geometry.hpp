// SPDX-License-Identifier: GPL-3.0-or-later
// The points, lengths and axes of legs in a model file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "codegen/model/legs.hpp"
#include "codegen/model/sections.hpp"

namespace regulus::inline model {

/// Quantities of one kind, with one tolerance.
enum class LegGroup : std::size_t { kBase, kPlatform, kCrank, kRod, kAxis };

/// Reads geometry. A number becomes a parameter of the model's geometry in the group of its kind; an
/// expression of names becomes a name.
class LegGeometry {
 public:
  LegGeometry(ModelReading& reading, const TomlEntry& legs) : reading_(reading), legs_(legs) {}

  /// Returns the keys of tolerances in [legs].
  [[nodiscard]] static std::vector<std::string> keys();

  void read_tolerances();
  void set_coordinates(std::size_t count) { coordinates_ = count; }

  // `number`: of the leg, the end of the names.

  [[nodiscard]] FormulaPoint point(const TomlEntry& list, LegGroup kind, const std::string& number);
  [[nodiscard]] Formula length(const TomlEntry& entry, LegGroup kind, const std::string& number);
  /// An axis of exact numbers becomes a unit vector. If axes have a tolerance, its coordinates are
  /// parameters.
  [[nodiscard]] LegAxis axis(const TomlEntry& list, const std::string& number);

  /// Returns a unit vector of exact numbers.
  [[nodiscard]] FormulaPoint direction(const TomlEntry& list);
  [[nodiscard]] ParsedExpression constant(const TomlEntry& entry);
  [[nodiscard]] std::vector<TomlEntry> elements(const TomlEntry& list, std::size_t count) const;

 private:
  struct Group {
    const char* name;    ///< of the group
    const char* letter;  ///< of its parameters
    const char* key;
    GiNaC::ex tolerance = 0;
    bool given = false;
  };

  [[nodiscard]] Group& group(LegGroup kind) { return groups_[std::size_t(kind)]; }
  [[nodiscard]] Formula quantity(const TomlEntry& entry, const std::string& name,
                                 const Group& group, int ball);
  [[nodiscard]] Point unit(const TomlEntry& list, const Point& v) const;

  ModelReading& reading_;
  const TomlEntry& legs_;
  std::array<Group, 5> groups_ = {{{"base", "a", "base_tolerance"},
                                   {"platform", "b", "platform_tolerance"},
                                   {"cranks", "crank_", "crank_tolerance"},
                                   {"rods", "rod_", "rod_tolerance"},
                                   {"axes", "n", "axis_tolerance"}}};
  bool balls_ = false;
  std::size_t coordinates_ = 3;
};

}  // namespace regulus::model
