// SPDX-License-Identifier: GPL-3.0-or-later
// Any robot with loops, as equations of its passive joints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/import/identifiers.hpp"
#include "codegen/model/import/loop_gap.hpp"

namespace regulus::detail {

/// The user chooses these about the robot.
struct ClosureWishes {
  std::vector<std::string> driven;  ///< names of joints; empty: what the file says
  std::vector<std::string> at;      ///< "JOINT=VALUE": where the loops are closed from
};

/// A joint in the model.
struct ClosedJoint {
  std::string name;  ///< in the model
  bool slides = false;
  double value = 0;  ///< at the start
  double reach = 0;  ///< of a motor that slides: how far it moves around the start
  GiNaC::realsymbol symbol;
  /// Of the file, with the start in them; nullopt where it has none, or the start is beyond them.
  std::optional<RangeOfJoint> limits{};
};

struct ClosedRobot {
  std::string summary;
  std::vector<ClosedJoint> driven, passive;
  std::vector<GiNaC::ex> equations;  ///< as many as passive joints
};

/// Returns the robot if the mechanism has loops. Notes say how they were closed, what was dropped and
/// what is held, and which limits of the file the model has.
///
/// Throws    InputError with the loop that cannot be closed, whose equations are dependent, or that no
///           motor drives, and for a freedom that moves more than a link between two pins in line and
///           that no motor holds; UsageError for `wishes`.
[[nodiscard]] std::optional<ClosedRobot> find_closed_robot(Mechanism& mechanism,
                                                           const std::string& file,
                                                           const ClosureWishes& wishes,
                                                           Identifiers& identifiers);

/// Returns the tables [pose], [closure], [motion.home] and [motion.around_home] of a model file.
[[nodiscard]] std::string closure_text(const ClosedRobot& robot);

}  // namespace regulus::detail
