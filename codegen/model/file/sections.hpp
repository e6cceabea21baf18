// SPDX-License-Identifier: GPL-3.0-or-later
// The sections of a model file, one reader each.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "codegen/model/file/declarations.hpp"
#include "codegen/model/file/toml_reader.hpp"
#include "codegen/model/model.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// The most operations that all expressions of a file may have together, including named
/// sub-expressions. A 6×6 matrix of the largest expressions is below it.
constexpr double kMaxModelSize = 5e6;

/// The data that the readers share.
struct ModelReading {
  TomlReader toml;
  Declarations names{};
  Model model{};
  double size = 0;  ///< of the expressions so far
  /// Each ≤ 0 where the actuated joints of [legs] are within their ranges.
  std::vector<ParsedExpression> joint_ranges{};
  WorkMeter meter{WorkMeter::kNoLimit};

  /// Adds up the sizes; refuses the entry that makes the model too large.
  void count(const ParsedExpression& term, const TomlEntry& entry) {
    size += term.size;
    meter.spend(static_cast<std::uint64_t>(term.size));
    if (size > kMaxModelSize)
      toml.refuse(entry, "a model too large at " + entry.path,
                  "at most 5 million operations in all, named sub-expressions included");
  }
};

/// Refuses the name of a pose parameter, or of `what`, that is a key of motions.
void require_pose_name(const TomlReader& toml, const TomlEntry& entry, const std::string& name,
                       const std::string& what = "a pose parameter");

/// Declares NAME of an entry NAME = "unit", a pose parameter or `what`.
[[nodiscard]] PoseParameter read_parameter(ModelReading& reading, const TomlEntry& entry,
                                           const std::string& what = "a pose parameter");

/// Returns the value of the word that the entry has; refuses another word.
template <typename Value, std::size_t count>
Value choice(const TomlReader& toml, const TomlEntry& entry,
             const std::array<std::pair<std::string, Value>, count>& choices) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.push_back("\"" + word + "\"");
  const std::string given = toml.text(entry, alternatives(words));
  for (const auto& [word, value] : choices)
    if (word == given) return value;
  toml.refuse(entry, alternatives(words));
}

void read_pose(ModelReading& reading, const TomlEntry& pose);
void read_geometry(ModelReading& reading, const TomlEntry& geometry);
void read_let(ModelReading& reading, const TomlEntry& let);
void read_matrix(ModelReading& reading, const TomlEntry& matrix);

/// Fills the unknowns of Model::closure and their names from a [closure] table; it comes before
/// [let], which may use them.
void read_unknowns(ModelReading& reading, const TomlEntry& closure);

/// Fills the rest of Model::closure, and the matrix, from the table; needs pose and names.
void read_closure(ModelReading& reading, const TomlEntry& closure);

/// True if the expression, or a condition of it, has an unknown of Model::closure.
[[nodiscard]] bool depends_on_unknown(const Model& model, const ParsedExpression& term);

/// Fills pose, geometry, matrix and names from a [gough] table. Its values may use the names of
/// [geometry] and [let], which are read before.
void read_gough(ModelReading& reading, const TomlEntry& gough);

/// Fills pose, matrix, names and, if every joint has a range, the motion `limits` from a [serial]
/// table. Its values may use the names of [geometry] and [let], which are read before.
void read_serial(ModelReading& reading, const TomlEntry& serial);

/// Fills pose, geometry, matrix, names and joint_ranges from a [legs] table. Its values may use the
/// names of [geometry] and [let], which are read before.
void read_legs(ModelReading& reading, const TomlEntry& legs);

/// Fills Model::drawing from a [drawing] table, for a model that gives its matrix; needs the names.
void read_drawing(ModelReading& reading, const TomlEntry& drawing);

/// Fills Model::twist from the names of the matrix's columns; needs the pose.
void read_twist_names(ModelReading& reading, const TomlEntry& names);

/// The sets of wrenches [load.NAME] and of twists [twist.NAME]. They need the matrix.
void read_loads(ModelReading& reading, const TomlEntry& loads);
void read_twists(ModelReading& reading, const TomlEntry& twists);

void read_actuators(ModelReading& reading, const TomlEntry& actuators);
void read_characteristic_length(ModelReading& reading, const TomlEntry& length);

/// Reads a motion by the lengths of the legs or by the place of the tool; nullopt: it is none of these.
[[nodiscard]] std::optional<Motion> read_motion_by_place(const ModelReading& reading,
                                                         const TomlEntry& entry);

void read_motions(ModelReading& reading, const TomlEntry& motions);

/// Adds a warning for each expression of the file that has a number beyond a turn as an angle, such as
/// cos(135): degrees may be meant.
void warn_about_written_angles(ModelReading& reading, const TomlEntry& root);

}  // namespace regulus::detail
