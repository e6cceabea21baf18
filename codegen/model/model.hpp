// SPDX-License-Identifier: GPL-3.0-or-later
// The model of a robot: its pose parameters, geometry, inverse Jacobian and motions, as GiNaC
// expressions with exact numbers. It comes from a model file (model_file.hpp) or from C++ code.
//
// Symbols are real: for a complex one GiNaC turns abs(x)^2 into x*conjugate(x).
//
// GiNaC simplifies on construction (x/x becomes 1, sqrt(x)^2 becomes x, 0*log(x) becomes 0), so an
// expression here may be defined where the written one is not. `must_be_defined` keeps the
// conditions that the simplification could hide: a pose is undefined, and never safe, unless every
// expression of that list is defined there. The values of these expressions have no meaning.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace regulus {

/// A range with exact ends: rationals, or constant expressions such as 15*Pi/180. lo ≤ hi.
struct Range {
  GiNaC::ex lo;
  GiNaC::ex hi;
};

struct PoseParameter {
  GiNaC::realsymbol symbol;
  std::string name;
  std::string unit;           ///< a label; "1" = none
  bool is_deviation = false;  ///< from a commanded length: 0 in every motion, and in no report
};

/// The factor of a column of the matrix: a component of the twist.
struct TwistComponent {
  enum class Kind { kLinear, kAngular };
  Kind kind = Kind::kLinear;
  std::string name;
  std::string unit;  ///< of the motion, not of its rate: "cm", "rad"
};

/// One scalar constant of the robot: value ± tolerance. tolerance 0 = exact.
struct GeometryParameter {
  GiNaC::realsymbol symbol;
  std::string name;
  GiNaC::ex value;
  GiNaC::ex tolerance = 0;  ///< for a member of a ball: the ball's radius
  std::string group;        ///< the group that --tolerance GROUP=E sets; empty = none
  int ball = -1;  ///< index into Model::balls if its point varies in a ball, otherwise −1
  bool takes_degrees = false;  ///< --tolerance gives its tolerance, an angle, in degrees
};

/// A point of the geometry that lies within `radius` of its nominal position.
struct ToleranceBall {
  std::vector<std::size_t> members;  ///< indices into Model::geometry, the point's coordinates
  GiNaC::ex radius = 0;
  std::string group;
};

/// A set of wrenches on the platform, or of its twists: a box, or a ball in some coordinates.
struct VectorSet {
  std::string name;
  std::vector<GeometryParameter> entries;  ///< by column of the matrix
  std::vector<ToleranceBall> balls;        ///< members: indices into `entries`
};

/// Data of the motors, each by row of the matrix; empty if the model does not say. A list may end
/// before the rows of constraints: such a row has no limits, no error, and gives way to no force.
struct Actuators {
  std::vector<std::string> units;  ///< of the motors' coordinates; empty: lengths
  std::string force_unit = "N";
  bool has_force_unit = false;       ///< the model names it
  std::vector<Range> force;          ///< limits
  std::vector<GiNaC::ex> speed;      ///< limits of the absolute value
  std::vector<GiNaC::ex> error;      ///< ± of a length or an angle
  std::vector<GiNaC::ex> stiffness;  ///< force per unit of length
};

/// A row of the matrix that a motor drives.
struct MotorRow {
  std::size_t leg = 0;  ///< its number, from 1
  std::string unit{};   ///< of the motor's coordinate; empty: not known
};

/// A motion parameter t_j. In a box variety it is the pose parameter itself (same symbol).
struct MotionParameter {
  GiNaC::realsymbol symbol;
  std::string name;
  std::string unit;
  Range range;
};

namespace detail {
struct Trajectory;
}  // namespace detail

/// The file of a motion along way-points.
struct WaypointSource {
  std::string file;                      ///< if relative, to the folder of the model file
  std::string shown;                     ///< for reports; empty: as `file`
  std::string interpolation = "linear";  ///< "linear", "cubic" or "hermite"
};

/// The poses of its set that a motion is about.
enum class Where {
  kEverywhere,
  kReachable,     ///< those that the robot reaches
  kWithinRanges,  ///< those that it reaches with its actuated joints within their ranges
};

/// Returns the word of model files; empty for all poses.
[[nodiscard]] constexpr const char* name(Where where) noexcept {
  return where == Where::kReachable      ? "reachable"
         : where == Where::kWithinRanges ? "within-ranges"
                                         : "";
}

/// A motion variety: pose = f(t_1 … t_m), t in a box, H_j(t) ≤ 0; or a trajectory of many pieces,
/// which has no parameters and no constraints.
struct Motion {
  std::string name;
  std::vector<MotionParameter> parameters;
  std::vector<GiNaC::ex> pose;         ///< in the order of Model::pose
  std::vector<GiNaC::ex> error;        ///< control error ±, in the order of Model::pose; 0 = none
  std::vector<GiNaC::ex> constraints;  ///< each ≤ 0; in the motion, pose and geometry symbols
  Where where = Where::kEverywhere;
  std::vector<GiNaC::ex>
      reach{};  ///< each ≥ 0 where the robot reaches the pose; poses where one is
                ///< negative are no part of the variety; as in constraints
  GiNaC::ex alpha = 0;
  std::vector<GiNaC::ex> must_be_defined;  ///< of pose and constraints; in their symbols
  /// The lengths of Model::legs, in the place of a pose; empty: the pose is given.
  std::vector<GiNaC::ex> legs{};
  /// x, y, z, roll, pitch, yaw of an arm's tool, in the place of a pose; empty: the pose is given.
  std::vector<GiNaC::ex> tool{};
  std::vector<GiNaC::ex> tool_error{};  ///< control error ± on each of them; empty: none
  /// What the geometry adds to each number of `pose`, or of `tool`, in radians for angles; empty: nothing.
  std::vector<GiNaC::ex> added_to_place{};
  [[nodiscard]] bool has_no_pose() const { return !legs.empty() || !tool.empty(); }
  /// If it is set, `pose` only has the values of pose parameters that the file does not give.
  std::optional<WaypointSource> waypoints{};
  /// The pieces of the file, once it is read.
  std::shared_ptr<const detail::Trajectory> trajectory{};
  std::vector<std::string> warnings{};  ///< what may have been meant otherwise, with the line
};

/// The meaning of a model's matrix.
enum class MatrixKind {
  kInverse,            ///< columns belong to the twist, rows to motors and constraints
  kForward,            ///< columns belong to joints, rows to the twist of the tool
  kForwardTransposed,  ///< rows belong to joints
};

/// Returns the noun in claims: "the full 6×6 matrix".
[[nodiscard]] constexpr const char* name(MatrixKind kind) noexcept {
  return kind == MatrixKind::kInverse   ? "matrix"
         : kind == MatrixKind::kForward ? "forward Jacobian"
                                        : "transposed forward Jacobian";
}

/// Equations that tie unknowns (passive joints, or a pose) to the pose parameters (driven joints):
/// Φ(pose, unknowns) = 0, as many equations as unknowns. The matrix of such a model is ∂Φ/∂unknowns,
/// row by row of the equations.
struct Closure {
  std::vector<PoseParameter> unknowns;
  std::vector<Range> ranges;            ///< by unknown: where its values are
  std::vector<GiNaC::ex> equations;     ///< in pose, unknown and geometry symbols
  std::vector<GiNaC::ex> start_pose;    ///< of the branch, in the order of Model::pose
  std::vector<GiNaC::ex> start;         ///< near the configuration there, by unknown
  std::vector<GiNaC::ex> start_radius;  ///< by unknown: it is the only one so near
  std::vector<char> is_radius_usual{};  ///< by unknown: a smaller one will do, too; empty: none
  std::vector<char> has_range{};        ///< by unknown: the model gives its range; empty: none
};

/// A leg whose length a motor sets.
struct ExtensibleLeg {
  std::array<GiNaC::ex, 3> base, platform;  ///< anchors, each in its own frame
  std::array<GiNaC::ex, 3> vector;          ///< from one to the other, in pose and geometry symbols
};

/// An expression in the names of a model, with the conditions for it to be defined.
struct AskedExpression {
  GiNaC::ex value;
  std::vector<GiNaC::ex> must_be_defined;
};

namespace detail {
struct Drawing;
struct Serial;
}  // namespace detail

struct Model {
  std::string name;
  std::string source;
  std::string path;    ///< of the file it came from; empty when built in C++
  std::string sha256;  ///< of the file's bytes, lower-case hexadecimal
  std::vector<PoseParameter> pose;
  std::vector<GeometryParameter> geometry;
  std::vector<ToleranceBall> balls;
  GiNaC::matrix matrix;  ///< m×n, m ≥ n, in the pose and geometry symbols
  MatrixKind matrix_kind = MatrixKind::kInverse;
  /// If it is set, the robot's own matrix: `matrix` is of the same size, has the same determinant at
  /// all poses and for all values of the geometry, and takes its place in a search.
  std::optional<GiNaC::matrix> jacobian{};
  std::vector<std::string> matrix_notes;  ///< what a report says of it; a line each
  std::optional<Closure> closure{};
  /// The motors have the first rows, and passive constraints the others. nullopt: each row is a motor's.
  std::optional<std::vector<MotorRow>> motors{};
  std::vector<GiNaC::ex> row_scale;  ///< empty, or m positive factors: J⁻¹ row = row_scale · row
  std::vector<TwistComponent> twist;       ///< by column; empty if the model does not say
  std::vector<GiNaC::ex> must_be_defined;  ///< of matrix and row_scale; log(s): s must be positive
  std::vector<VectorSet> loads;            ///< wrenches
  std::vector<VectorSet> twists;
  Actuators actuators;
  /// An angle times this length is compared with a length; nullopt: the model does not say.
  std::optional<GiNaC::ex> characteristic_length;
  std::vector<ExtensibleLeg> legs{};                 ///< all legs, if each is such; else empty
  std::shared_ptr<const detail::Serial> arm{};       ///< null: it is no serial arm
  std::optional<AskedExpression> asked;              ///< by an option of the command line
  std::shared_ptr<const detail::Drawing> drawing{};  ///< null: the model gives no points to draw
  std::vector<Motion> motions;
  /// Of the joints, in the order of `pose`; empty: the file gives none. Questions stay within them.
  std::vector<Range> limits{};
  std::vector<std::string> warnings{};  ///< what may have been meant otherwise, with the line
};

}  // namespace regulus
