// SPDX-License-Identifier: GPL-3.0-or-later
// The points, lengths and axes of legs in a model file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "codegen/model/drawing.hpp"
#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/file/quantities.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/legs.hpp"

namespace regulus::detail {

/// Quantities of one kind, with one tolerance.
enum class LegGroup : std::size_t { kBase, kPlatform, kCrank, kRod, kAxis };

/// Reads geometry. Each coordinate and each length becomes a parameter of the model's geometry in the
/// group of its kind, however it is written.
class LegGeometry {
 public:
  LegGeometry(ModelReading& reading, const TomlEntry& legs) : reading_(reading), legs_(legs) {}

  /// Returns the keys of tolerances in [legs].
  [[nodiscard]] static std::vector<std::string> keys();

  void read_tolerances();
  /// Refuses tolerances that no leg has a quantity for.
  void require_uses() const;
  /// Returns the drawing with the unit of all lengths that were read, a label.
  [[nodiscard]] Drawing labelled(Drawing drawing, const std::string& unit) const {
    for (const std::string& length : lengths_) drawing.units[length] = unit;
    return drawing;
  }
  void set_coordinates(std::size_t count) { coordinates_ = count; }

  // `number`: of the leg, the end of the names. A point or a length may have a tolerance of its own:
  // { value = …, tolerance = E }, and a point { value = …, radius = R }, which is a ball.

  [[nodiscard]] FormulaPoint point(const TomlEntry& list, LegGroup kind, const std::string& number);
  [[nodiscard]] Formula length(const TomlEntry& entry, LegGroup kind, const std::string& number);
  /// An axis of exact numbers becomes a unit vector. If axes have a tolerance, its coordinates are
  /// parameters.
  [[nodiscard]] LegAxis axis(const TomlEntry& list, const std::string& number);
  /// The same for the axis of a joint that no motor turns, h1_x ….
  [[nodiscard]] LegAxis hinge(const TomlEntry& list, const std::string& number);

  /// Returns a unit vector of exact numbers.
  [[nodiscard]] FormulaPoint direction(const TomlEntry& list);
  [[nodiscard]] ParsedExpression constant(const TomlEntry& entry,
                                          NumberUnit unit = NumberUnit::kPlain);
  [[nodiscard]] std::vector<TomlEntry> elements(const TomlEntry& list, std::size_t count) const;

 private:
  struct Group {
    const char* name;    ///< of the group
    const char* letter;  ///< of its parameters
    const char* key;
    const char* quantities;  ///< in messages
    GiNaC::ex tolerance = 0;
    TomlEntry given{};
    bool is_used = false;
    bool has_others = false;  ///< a quantity of this kind has a tolerance of its own
  };
  /// A point or a length with the tolerance that it has.
  struct Given {
    TomlEntry value;
    GiNaC::ex tolerance = 0;
    bool is_ball = false;
  };

  [[nodiscard]] Given given(const TomlEntry& entry, Group& of, bool is_point);
  [[nodiscard]] Group& group(LegGroup kind) { return groups_[std::size_t(kind)]; }
  [[nodiscard]] LegAxis axis(const TomlEntry& list, const char* letter, const std::string& number);
  [[nodiscard]] FormulaPoint point(const TomlEntry& list, Group& of, const char* letter,
                                   const std::string& number);
  /// Declares the quantity, and returns its name.
  [[nodiscard]] Formula quantity(const TomlEntry& entry, const ParsedExpression& value,
                                 const std::string& name, const DeclaredTolerance& tolerance);
  [[nodiscard]] Point unit(const TomlEntry& list, const Point& v) const;

  ModelReading& reading_;
  const TomlEntry& legs_;
  std::array<Group, 5> groups_ = {{{"base", "a", "base_tolerance", "joint of the base"},
                                   {"platform", "b", "platform_tolerance", "joint of the platform"},
                                   {"cranks", "crank_", "crank_tolerance", "crank"},
                                   {"rods", "rod_", "rod_tolerance", "rod"},
                                   {"axes", "n", "axis_tolerance", "axis"}}};
  bool balls_ = false;
  std::size_t coordinates_ = 3;
  std::vector<std::string> lengths_;  ///< the names of their parameters
};

}  // namespace regulus::detail
