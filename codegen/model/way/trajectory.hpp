// SPDX-License-Identifier: GPL-3.0-or-later
// A trajectory of many pieces, such as the way-points of a controller.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "codegen/model/model.hpp"

namespace regulus::detail {

/// One pose parameter along a piece, for 0 ≤ s ≤ 1:
///
///   power[0] + power[1] s + power[2] s² + power[3] s³ + cosine·cos(turn·s) + sine·sin(turn·s).
///
/// All are exact constants in the unit of the pose parameter; `turn` is an angle.
struct PieceOfPose {
  std::array<GiNaC::ex, 4> power{};
  GiNaC::ex cosine = 0, sine = 0, turn = 0;
};

/// The names of the coefficients of a piece, in the order of coefficient().
constexpr std::size_t kPieceCoefficients = 7;
[[nodiscard]] const GiNaC::ex& coefficient(const PieceOfPose& piece, std::size_t index);

struct TrajectoryPiece {
  int first_line = 0, last_line = 0;  ///< of the file
  GiNaC::ex begin = 0, end = 0;       ///< time
  std::vector<PieceOfPose> pose;      ///< in the order of Model::pose
};

struct Trajectory {
  std::string file;
  std::string sha256;         ///< of the file's bytes
  std::string interpolation;  ///< for reports: "linear", "cubic", "hermite", "G-code"
  bool has_time = false;      ///< otherwise segment k takes the time from k − 1 to k
  std::string time_unit;
  std::vector<TrajectoryPiece> pieces;  ///< at least one
  std::vector<std::string> notes;       ///< what may have been meant otherwise
  std::vector<std::string> warnings{};  ///< the same, of angles beyond a turn; with the line
};

/// Returns the expression of a pose parameter in s, without terms whose coefficients are 0.
[[nodiscard]] GiNaC::ex expression_of(const PieceOfPose& piece, const GiNaC::ex& s);

/// Returns the file that Motion::waypoints names, which is beside that of the model.
///
/// Requires  the motion has way-points.
[[nodiscard]] std::string file_of_waypoints(const Model& model, const Motion& motion);

/// Reads the file that Motion::waypoints names, and fills Motion::trajectory.
///
/// Errors    InputError with the line of the file; FileError.
void load_trajectory(const Model& model, Motion& motion);

/// Replaces the way-points of a motion by those of a file, which is relative to the working folder.
/// A pose parameter without a column keeps the value that the motion gives it, which must be
/// constant.
void follow_waypoints(const Model& model, Motion& motion, const std::string& file);

}  // namespace regulus::detail
