// SPDX-License-Identifier: GPL-3.0-or-later
// A hostile model, the question about it, and the truth. This file uses no code of the solver, the
// front end or the runtime.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/attack/oracle/rational.hpp"
#include "tests/attack/oracle/solutions.hpp"

namespace regulus::detail::attack {

enum class Truth {
  kSingular,   ///< some pose and uncertain value of the variety has |det| ≤ alpha, or less rank
  kRegular,    ///< no pose and value has
  kUndefined,  ///< an expression has no value at some pose; elsewhere the matrix is regular
  kUndefinedOrSingular,  ///< the same, and it may be singular elsewhere
  kEmpty,                ///< no pose satisfies the constraints
  kRefused,              ///< the text is not a model: it must be refused
};

[[nodiscard]] const char* name(Truth truth);

/// Returns a text as a string of TOML.
[[nodiscard]] inline std::string quoted(const std::string& text) { return '"' + text + '"'; }

/// A quantity that takes every value from lo to hi: a motion parameter, an uncertain constant, or
/// the control error NAME_error of a pose parameter. Ends that are not rational are moved inward.
struct Axis {
  std::string name;
  Rational lo, hi;
};

/// The point with these axes lies within `radius` of `centre`.
struct BallOfAxes {
  std::vector<std::string> axes;
  std::vector<Rational> centre;
  Rational radius;
};

/// A pose parameter: its TOML in the motion, and an expression of the axes unless it is an axis.
struct PoseEntry {
  std::string name, toml, expression;
};

struct NamedText {
  std::string name, text;
};

/// An entry of the matrix: an expression, or a TOML number without quotation marks.
struct Cell {
  std::string text;
  bool bare = false;
};

/// A [gough] table with exact numbers; the TOML may spell them in any way.
struct Hexapod {
  std::string orientation;
  std::array<std::array<Rational, 3>, 6> base, platform;
  std::vector<NamedText> toml;  ///< the other keys
};

struct ModelSource {
  std::vector<PoseEntry> pose;
  std::vector<NamedText> geometry;  ///< TOML
  std::vector<NamedText> let;       ///< expressions
  std::vector<std::vector<Cell>> rows;
  std::vector<Cell> row_scale;
  std::vector<NamedText> closure;  ///< TOML; `rows` is then what the oracle knows of its matrix
  std::optional<Hexapod> hexapod;  ///< replaces pose names, geometry, let and rows
  std::string parameters;          ///< TOML of the inline table; empty: none
  std::string way;                 ///< text of the file way.csv that the motion follows; or empty
  std::vector<NamedText> error;    ///< TOML
  std::vector<std::string> constraints;
  std::string alpha;         ///< TOML; empty: none
  std::string instead;       ///< the whole text, if it is not a model
  std::string extra_motion;  ///< TOML lines

  [[nodiscard]] std::string text() const;
};

/// Values of some axes, as constant expressions.
using Planted = std::map<std::string, std::string>;

struct Attack {
  std::string family;
  std::uint64_t seed = 0;
  ModelSource model;
  std::vector<std::string> options;

  Truth truth = Truth::kRegular;
  bool may_be_refused = false;  ///< a reader need not accept this question
  bool decidable = false;       ///< the true verdict is expected, not only allowed
  std::string argument;         ///< the reason for this truth, in a few words

  /// If it is set, the question is about all solutions; `truth` is then regular if they are, empty if
  /// there are none, singular if no list can be complete.
  std::optional<SolveTruth> solve;

  // These values serve to check the truth.
  std::vector<Axis> axes;
  std::vector<BallOfAxes> balls;
  Planted planted;      ///< singular or undefined: the point; regular: a point near the worst
  Planted other_sign;   ///< if not empty: a point where the determinant has the other sign
  Rational margin;      ///< if kRegular: |det| − alpha is at least that
  Rational alpha;       ///< the result of the options and the motion
  bool sampled = true;  ///< a random point of the axes is a point of the variety
};

}  // namespace regulus::detail::attack
