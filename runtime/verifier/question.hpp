// SPDX-License-Identifier: Apache-2.0
// The first part of a certificate: the claim, the matrix and the set.
#pragma once

#include <array>
#include <cstdint>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/files/sha256.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/exact_range.hpp"
#include "runtime/verifier/expression.hpp"
#include "runtime/verifier/interval.hpp"

namespace regulus::verifier {

/// Reads lines of bounded length. Knows the number of the current line, for a caught Rejection.
class Lines {
 public:
  /// `most`: the most bytes to read.
  explicit Lines(std::istream& in, std::uint64_t most = format::kMaxBytes) : in_(in), left_(most) {}

  /// Reads the next line, without its end; returns false at the end of the file. Throws Rejection
  /// if the line is too long, is not ended, is beyond `most`, or has bytes that are not text.
  [[nodiscard]] bool next();
  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] std::size_t number() const noexcept { return named_ != 0 ? named_ : number_; }
  /// An earlier line is wrong: number() returns this line until the next one is read.
  void name_line(std::size_t number) noexcept { named_ = number; }
  /// The next call of next() returns again what the last one has returned.
  void repeat() noexcept { repeats_ = true; }
  /// From now on adds each line that is read, with its end, to a digest that must outlive this object.
  void digest_into(detail::Sha256& digest) noexcept { digest_ = &digest; }
  /// From now on keeps the lines that are read, until take_kept.
  void keep() noexcept { keeps_ = true; }
  [[nodiscard]] std::vector<std::string> take_kept() {
    keeps_ = false;
    return std::move(kept_);
  }

 private:
  [[nodiscard]] bool read();

  std::istream& in_;
  std::uint64_t left_;
  std::string text_;
  std::size_t number_ = 0, named_ = 0;
  bool keeps_ = false, repeats_ = false, has_line_ = false;
  std::vector<std::string> kept_;
  detail::Sha256* digest_ = nullptr;
};

enum class VariableKind { kParameter, kUncertain, kError };

/// A variable: its value lies between the values of two constant expressions.
struct Variable {
  std::string name;
  VariableKind kind;
  NodeId lo, hi;
};

/// Uncertain quantities that are the coordinates of a point in a ball: the distance from the
/// middles of their ranges is at most `radius`, a constant expression.
struct BallOfVariables {
  std::vector<std::size_t> members;
  std::vector<NodeId> middles;
  NodeId radius = -1;
};

/// A ball about 0 in some components of a wrench.
struct WrenchBall {
  NodeId radius = kNoNode;
  std::vector<std::size_t> members;
};

/// A load or a set of twists: all sums of a vector within the spreads of the middles and a vector of
/// each ball. Constant expressions.
struct VectorSetLines {
  std::string name;
  std::vector<NodeId> middle, spread;  ///< by column
  std::vector<WrenchBall> balls;
};

/// The load of a claim about forces, and the limits of the forces: constant expressions.
struct LoadLines : VectorSetLines {
  std::string verdict;                 ///< FEASIBLE, INFEASIBLE or PAVING
  std::vector<NodeId> least, largest;  ///< by row; kNoNode: the force has no limits
};

/// A quantity and its bound: FORMAT.md, "Bounds of quantities". Numbers are constant expressions.
struct QuantityLines {
  std::string kind;                  ///< format::kForce, …
  std::string side;                  ///< format::kAbsolute, kLargest or kLeast
  std::size_t row = 0;               ///< from 0
  std::vector<std::size_t> columns;  ///< from 0; several: the norm of these components
  std::string set_kind;              ///< "load" or "twist"
  std::optional<VectorSetLines> set;
  bool has_norms = false;              ///< of a speed: the balls of the set enter as norms
  std::vector<NodeId> errors;          ///< of the motors, by row
  std::vector<NodeId> speeds;          ///< the same
  std::vector<NodeId> stiffness;       ///< by row; kNoNode: it gives way to no force
  std::vector<NodeId> factors;         ///< by column: C of J⁻¹C
  std::vector<NodeId> least, largest;  ///< over a branch: the limits of the forces, by motor
  std::vector<Rational> combined;      ///< a regular matrix, row-major; empty: none
  NodeId expression = kNoNode;
  std::vector<NodeId> expression_defined;
  NodeId reference = kNoNode;  ///< y
  NodeId bound = kNoNode;      ///< kNoNode: there is none, as the matrix of the model is singular
  std::string claim;           ///< in words

  /// Over a branch: the derivatives of the equations by the pose parameters, row by row of the
  /// equations; and the place where the bound is attained, if it is on this piece.
  std::vector<NodeId> by_motor;
  std::optional<std::vector<Interval>> attained;

  /// After border(): the matrix of the model, and its shape.
  std::vector<NodeId> model_matrix;
  std::size_t model_rows = 0, model_columns = 0;
  /// The same, if is_about_ratio(): the matrix is diag(row_scales)·unscaled; no scales: it is unscaled.
  std::vector<NodeId> row_scales, unscaled;
};

/// The equations that close a mechanism, and the branch of their solutions. FORMAT.md, "Closures".
/// The unknowns are variables of the graph, numbered after those of the question.
struct ClosureLines {
  std::vector<std::string> names;      ///< by unknown
  std::vector<NodeId> middle, radius;  ///< by unknown; constant expressions
  std::vector<NodeId> start;           ///< by motion parameter; constant expressions
  std::vector<NodeId> equations;
  std::vector<std::string> poses;                         ///< the names of the pose parameters
  std::vector<std::pair<std::string, std::string>> lets;  ///< names and texts of the lines `let`
};

/// A telescopic leg of a platform: its anchors, by the constants of the robot, and its squared length, which is
/// a constant expression or a variable.
struct LegLine {
  std::array<NodeId, 3> base{}, platform{};
  NodeId square = kNoNode;
};

/// A joint of an arm: the frame that it moves in, seen from the one that the joint before moves, and its
/// axis through the origin, of length 1, about which it turns or along which it slides. These are constant expressions.
struct ArmJointLine {
  static constexpr std::size_t kNone = std::size_t(-1);

  bool slides = false;
  bool is_of_tool = false;           ///< it is no joint: the tool may be turned about its z axis
  std::array<NodeId, 9> rotation{};  ///< of the frame, row by row
  std::array<NodeId, 3> place{}, axis{};
  NodeId held = kNoNode;  ///< the value that it keeps; kNoNode: it is free, or follows another
  /// The number of the line of the joint that it follows: its value is multiplier times that one's, and the offset.
  std::size_t leader = kNone;
  NodeId multiplier = kNoNode, offset = kNoNode;
};

/// The claim is about values of a free joint, by its number, that are in a range.
struct JointRange {
  std::size_t joint = 0;
  NodeId lower = kNoNode, upper = kNoNode;
};

/// An arm whose end is at a place.
struct ArmLines {
  std::vector<ArmJointLine> joints;
  /// The frame of the tool, seen from that which the last joint turns; and where the tool is: x, y, z,
  /// roll, pitch, yaw. Empty: the end is where the free joints put it that have these values.
  std::vector<NodeId> tip, tool, values;
  std::vector<JointRange> ranges{};

  [[nodiscard]] std::string description() const;
};

/// A solution: the enclosure of each of its values.
struct SolutionLine {
  std::size_t line = 0;
  std::vector<Interval> values;
};

/// A claim about all solutions at one place: FORMAT.md, "All solutions".
struct SolutionLines {
  std::string verdict;  ///< format::kComplete, kNone or kIncomplete
  std::vector<LegLine> legs;
  std::optional<ArmLines> arm;
  std::vector<SolutionLine> solutions;
  /// Of the proof, by solution: about where it is at the middles of what is uncertain. Empty: one test
  /// shows each solution at all values.
  std::vector<std::vector<double>> from{};
};

/// An expression with its line.
struct StatedValue {
  NodeId node = kNoNode;
  std::size_t line = 0;
  std::string text;
};

struct Question {
  bool singular = false;  ///< the claim is shown by a witness: SINGULARITY or INFEASIBLE
  bool paves = false;     ///< PAVING: each leaf has a claim of its own
  bool is_index = false;  ///< the proof is in shards
  /// The question is about several pieces: nothing after the line `piecewise` has been read.
  bool is_piecewise = false;
  /// The branch of a closure comes from a piece before this one: it does not begin at the start.
  bool continues = false;
  std::string model, sha256, motion;
  Graph graph;
  NodeId alpha = -1;
  std::vector<Variable> variables;  ///< in the order of their numbers
  std::vector<RationalEnds> ends;   ///< by variable; enclose_variety finds them
  std::vector<BallOfVariables> balls;
  std::size_t rows = 0, columns = 0;
  std::vector<NodeId> matrix;          ///< row-major
  std::vector<NodeId> scale;           ///< empty, or a factor for each row
  std::vector<NodeId> defined;         ///< the model means nothing where these are undefined
  std::vector<NodeId> motion_defined;  ///< the motion means nothing where these are undefined
  std::vector<NodeId> constraints;     ///< each ≤ 0 in the variety
  bool is_within_reach = false;        ///< the first ones exclude poses with a negative root
  bool has_threshold = false;          ///< alpha is not written as 0
  /// A claim about forces has this. The matrix is then J⁻¹, with the scales in its rows.
  std::optional<LoadLines> load;
  /// A claim about a bound has this. The matrix and the variables are those of the model, until
  /// border() puts in those of the bound.
  std::optional<QuantityLines> quantity;
  /// A claim about a closure has this. There is no matrix; `rows` and `columns` count the equations.
  std::optional<ClosureLines> closure;
  /// A claim about all solutions has this, and of what is above a closure with its variables, or the
  /// uncertain quantities of a robot.
  std::optional<SolutionLines> solutions;

  // For the comparison with a model file.
  /// The stated values, by kind and name: "alpha ", "lower x", "upper x", "value a", "spread a",
  /// "pose x", "error x", "entry 0", "scale 0", "constraint 0", "reach 0", "wrench 0",
  /// "wrench-spread 0", "wrench-ball 0", "least 0", "largest 0", "motor-error 0", "stiffness 0",
  /// "factor 0", "unknown p", "unknown-radius p", "start x", "equation 0",
  /// "base 0_x", "platform 0_x", "square 0", "square-spread 0", "joint 0_0" to "joint 0_17", "tip 0", "tool 0",
  /// "joint-value 0", "joint-range 0" and "joint-range-end 0".
  std::map<std::string, StatedValue, std::less<>> stated;
  Scope actual;     ///< names of constants and of poses with their errors
  Scope commanded;  ///< names of parameters, constants and commanded poses

  [[nodiscard]] format::ClaimedSet claimed_set() const;
  /// Returns the claim in words.
  [[nodiscard]] std::string claim() const;
};

/// Reads up to and including the line `proof`. Throws Rejection.
void read_question(Lines& lines, Question& question);

/// Reads a decimal number without sign, at most `most`. Throws std::runtime_error.
[[nodiscard]] std::size_t read_count(std::string_view text, std::size_t most);

}  // namespace regulus::verifier
