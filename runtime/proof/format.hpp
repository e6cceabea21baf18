// SPDX-License-Identifier: Apache-2.0
// Definitions that the writer and the verifier of certificates share; FORMAT.md explains them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace regulus::format {

inline constexpr const char* kMagic = "regulus-certificate 1";
inline constexpr const char* kIndexMagic = "regulus-certificate-index 1";
inline constexpr const char* kShardMagic = "regulus-certificate-shard 1";
inline constexpr const char* kPlacesMagic = "regulus-certificate-places 1";
inline constexpr const char* kPlacesIndexMagic = "regulus-certificate-places-index 1";
inline constexpr const char* kPlacesShardMagic = "regulus-certificate-places-shard 1";
inline constexpr const char* kNoSingularity = "NO SINGULARITY";
inline constexpr const char* kSingularity = "SINGULARITY";
inline constexpr const char* kOppositeSigns = "opposite-signs";
inline constexpr const char* kSmallDeterminant = "small-determinant";
inline constexpr const char* kAlwaysSingular = "always-singular";
inline constexpr const char* kLostRank = "lost-rank";
inline constexpr const char* kNullVector = "null-vector";
inline constexpr const char* kChosen = "chosen";  ///< lines of it
inline constexpr const char* kVector = "vector";
inline constexpr char kExactValue = '=';  ///< begins a coordinate that is a constant expression
// Claims about forces within limits that hold a load.
inline constexpr const char* kFeasible = "FEASIBLE";
inline constexpr const char* kInfeasible = "INFEASIBLE";
inline constexpr const char* kPaving = "PAVING";
inline constexpr const char* kShortage = "shortage";  ///< the reason of INFEASIBLE
inline constexpr const char* kFree = "free";          ///< limits of a force that has none
// Claims about all solutions at one place.
inline constexpr const char* kComplete = "COMPLETE";
inline constexpr const char* kNone = "NONE";
inline constexpr const char* kIncomplete = "INCOMPLETE";
// Leaves of these claims.
inline constexpr const char* kFeasibleLeaf = "feasible";
inline constexpr const char* kInfeasibleLeaf = "infeasible";
inline constexpr const char* kUndecidedLeaf = "undecided";
inline constexpr const char* kOutsideLeaf = "outside";
inline constexpr const char* kTubeLeaf = "tube";  ///< of a claim about a closure
/// Returns true if a leaf of a claim about a closure has the numbers of a tube after this word.
[[nodiscard]] inline bool has_tube(std::string_view word) {
  return word == kTubeLeaf || word == kFeasibleLeaf || word == kInfeasibleLeaf;
}
// Lines of a singular configuration of a closure, and a coordinate that stays where it starts.
inline constexpr const char* kFold = "fold";  ///< and the reason
inline constexpr const char* kTowards = "towards";
inline constexpr const char* kArc = "arc";
inline constexpr const char* kStays = "start";
// The place of an attained end of a bound over a branch, and a coordinate there that is no double.
inline constexpr const char* kValue = "value";
inline constexpr const char* kOnlyValue = "-";
inline constexpr const char* kLowerEnd = "lower";  ///< a coordinate that is the end of its range
inline constexpr const char* kUpperEnd = "upper";
inline constexpr const char* kEndOfRoot = "-";  ///< in a shard: the end of a range of box 0

// The quantities of a claim about a bound, and its sides.
inline constexpr const char* kForce = "force";
inline constexpr const char* kForceLimits = "force-limits";  ///< over a branch: all forces
inline constexpr const char* kError = "error";
inline constexpr const char* kFiniteError = "finite-error";  ///< over a branch
inline constexpr const char* kSpeed = "speed";
inline constexpr const char* kSigmaMin = "sigma-min";
inline constexpr const char* kSigmaMax = "sigma-max";
inline constexpr const char* kCondition = "condition";
inline constexpr const char* kCondition2 = "condition-2";  ///< in the 2-norm
inline constexpr const char* kDeflection = "deflection";
inline constexpr const char* kDeterminant = "determinant";
inline constexpr const char* kDeterminantMax = "determinant-max";  ///< or with its sign
inline constexpr const char* kExpression = "expression";
inline constexpr const char* kRigid = "rigid";  ///< the stiffness of what gives way to no force
inline constexpr const char* kAbsolute = "absolute";
inline constexpr const char* kLargest = "largest";
inline constexpr const char* kLeast = "least";

inline constexpr const char* kRatio = "ratio";  ///< the reason of an attained condition number

// Limits: a file beyond them is not a certificate. So reading takes bounded memory and stack.
inline constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 32;  ///< of a file
inline constexpr std::size_t kLongestLine = 1 << 20;
inline constexpr std::size_t kLongestName = 80;
inline constexpr std::size_t kMostNodes = 1 << 20;
inline constexpr int kMostNesting = 300;
inline constexpr int kDeepestNode = 4000;  ///< nesting depth of operations
inline constexpr int kMostPower = 1 << 20;
inline constexpr std::size_t kMostDigits = 4096;
inline constexpr std::size_t kMostRows = 32;
inline constexpr std::size_t kMostVariables = 128;
inline constexpr std::size_t kMostLoadRanges = 10;   ///< components of a load that have a range
inline constexpr std::size_t kMostLines = 20000;     ///< of the header
inline constexpr std::size_t kMostPieces = 1 << 20;  ///< of a trajectory
inline constexpr std::size_t kMostPieceNames = 512;
inline constexpr std::size_t kMostSolutions = 1 << 12;
inline constexpr std::size_t kMostPlaces = 1 << 20;       ///< of a table
inline constexpr std::size_t kLongestPart = 1 << 26;      ///< about one of them, in bytes
inline constexpr std::size_t kMostUnknowns = 32;          ///< of a closure
inline constexpr std::size_t kMostTubes = 1 << 20;        ///< leaves of a proof about a closure
inline constexpr std::size_t kMostTubeNumbers = 1 << 25;  ///< of all its tubes
inline constexpr std::size_t kDeepestTube = 1000;         ///< splits above a leaf of it
inline constexpr std::size_t kMostOpen = 1 << 22;         ///< boxes that wait at one time
inline constexpr std::size_t kMostShards = 1 << 20;
inline constexpr std::uint64_t kLeastShardSize = 4096;  ///< that can be asked for, in bytes

/// The shards of the index FILE are in the folder FILE.shards.
inline constexpr const char* kShardsEnding = ".shards";
/// Returns the file of a shard; they are numbered from 1.
[[nodiscard]] inline std::string shard_file(const std::string& index, std::size_t shard) {
  return index + kShardsEnding + '/' + std::to_string(shard);
}

/// The set that a claim is about.
struct ClaimedSet {
  std::size_t rows = 0, columns = 0;
  std::size_t uncertain = 0;  ///< quantities, control errors among them
  bool has_threshold = false;
  bool is_within_reach = false;  ///< poses with a negative root are no part of it
};

/// Returns "at every pose and value of the 2 uncertain quantities", or "at some …".
[[nodiscard]] inline std::string describe_place(const ClaimedSet& set, bool every) {
  const std::string values =
      set.uncertain == 0
          ? ""
          : " and value of the " + std::to_string(set.uncertain) + " uncertain quantities";
  return std::string(every ? "at every" : "at some") +
         (set.is_within_reach ? " reachable pose" : " pose") + values;
}

/// Returns a claim about forces within limits in words; `verdict`: FEASIBLE, INFEASIBLE or PAVING.
[[nodiscard]] inline std::string describe_load_claim(const ClaimedSet& set,
                                                     const std::string& verdict) {
  const std::string held = ", the full " + std::to_string(set.rows) + "x" +
                           std::to_string(set.columns) +
                           " matrix of the model is defined, and forces within the limits hold "
                           "every wrench of the load";
  const std::string not_held = ", no forces within the limits hold some wrench of the load";
  if (verdict == kInfeasible) return describe_place(set, false) + " of the variety" + not_held;
  if (verdict == kFeasible) return describe_place(set, true) + " of the variety" + held;
  return describe_place(set, true) + " of the variety in a leaf '" + kFeasibleLeaf + "'" + held +
         "; in a leaf '" + kInfeasibleLeaf + "'" + not_held;
}

/// A bound of a quantity, in the words of its lines.
struct ClaimedBound {
  std::string quantity;  ///< kForce, …
  std::string side;      ///< kAbsolute, kLargest or kLeast
  std::string row;       ///< "3"; empty if the quantity has none
  std::string columns;   ///< "4", or "1 2 3" for the norm of these components; empty if it has none
  std::string set;       ///< the name of the load or the twist; empty if it has none
  std::string expression;
  std::string bound;  ///< empty: the quantity has no bound
  bool is_of_closure = false;
};

/// Returns "force of motor 1 under the load payload", for example: a quantity over a branch.
[[nodiscard]] inline std::string describe_quantity_over_branch(const ClaimedBound& b) {
  if (b.quantity == kForce) return "force of motor " + b.row + " under the load " + b.set;
  if (b.quantity == kError)
    return "error to first order of unknown " + b.columns + " by the errors of the motors";
  if (b.quantity == kFiniteError)
    return "distance of unknown " + b.columns + " from its value without errors";
  if (b.quantity == kSpeed)
    return "speed of unknown " + b.columns + " for the speeds of the motors";
  if (b.quantity == kDeflection)
    return "deflection of unknown " + b.columns + " under the load " + b.set;
  const std::string matrix = "the equations' derivatives by the unknowns";
  const std::string scaled = matrix + " with the factors of its columns";
  if (b.quantity == kCondition) return "condition number in the maximum norm of " + scaled;
  if (b.quantity == kCondition2) return "condition number in the 2-norm of " + scaled;
  if (b.quantity == kSigmaMin) return "least singular value of " + scaled;
  if (b.quantity == kSigmaMax) return "largest singular value of " + scaled;
  return b.quantity == kDeterminant ? "|det of " + matrix + '|' : "det of " + matrix;
}

/// Returns "force in row 3 under the load payload", for example.
[[nodiscard]] inline std::string describe_quantity(const ClaimedBound& b) {
  const bool is_norm = b.columns.find(' ') != std::string::npos;
  const std::string components = is_norm ? "norm of components " : "component ";
  if (b.quantity == kForce) return "force in row " + b.row + " under the load " + b.set;
  if (b.quantity == kSpeed) return "speed of row " + b.row + " for the twist " + b.set;
  if (b.quantity == kError)
    return components + b.columns + " of the pose error by the errors of the motors";
  if (b.quantity == kDeflection)
    return components + b.columns + " of the deflection under the load " + b.set;
  const std::string matrix = "J^-1 with the factors of its columns";
  if (b.quantity == kSigmaMin) return "least singular value of " + matrix;
  if (b.quantity == kSigmaMax) return "largest singular value of " + matrix;
  if (b.quantity == kCondition)
    return "condition number by row " + b.row + " and component " + b.columns + " of " + matrix;
  if (b.quantity == kCondition2) return "condition number in the 2-norm of " + matrix;
  if (b.quantity == kDeterminantMax) return "det J^-1";
  return b.quantity == kDeterminant ? "|det J^-1|" : b.expression;
}

/// Returns a claim about a bound in words; `set`: of the matrix of the model.
[[nodiscard]] inline std::string describe_bound_claim(const ClaimedSet& set, const ClaimedBound& b,
                                                      bool is_attained) {
  const std::string set_of = describe_place(set, !is_attained) + " of the variety";
  if (b.quantity == kForceLimits)
    return std::string("on the branch through the start, ") +
           (is_attained
                ? "the force of some motor under the load " + b.set + " is beyond its limits "
                : "the forces of all motors under the load " + b.set +
                      " are within their limits ") +
           set_of + (is_attained ? " and some" : " and every") + " vector of it";
  const std::string name =
      b.is_of_closure ? describe_quantity_over_branch(b) : describe_quantity(b);
  const std::string branch = b.is_of_closure ? "on the branch through the start, " : "";
  const std::string value = b.side == kAbsolute ? '|' + name + '|' : name;
  const std::string vectors =
      b.set.empty() ? "" : std::string(is_attained ? " and some" : " and every") + " vector of it";
  const std::string place = ' ' + set_of + vectors;
  if (b.bound.empty()) return value + " has no bound: the matrix of the model is singular" + place;
  const char* const beyond =
      is_attained ? (b.side == kLeast ? " <= " : " >= ") : (b.side == kLeast ? " > " : " < ");
  return branch + value + beyond + b.bound + place;
}

/// A threshold of a closure is compared with this value.
inline constexpr const char* kDeterminantOfClosure =
    "|det of the equations' derivatives by the unknowns|";

/// Returns the claim about a closure of as many equations as the set has rows in words.
[[nodiscard]] inline std::string describe_closure_claim(const ClaimedSet& set, bool singular) {
  const std::string equations =
      "the " + (set.rows == 1 ? "equation is" : std::to_string(set.rows) + " equations are");
  const std::string place = ", " + describe_place(set, !singular) + " of the variety";
  const std::string determinant = kDeterminantOfClosure;
  if (singular)
    return "configurations of the mechanism lead from the start to one where " +
           (set.has_threshold ? determinant + " is at most alpha" : equations + " singular") +
           place;
  return "the mechanism has exactly one configuration on its branch, and " + equations +
         (set.has_threshold ? " defined there, and " + determinant + " exceeds alpha"
                            : " defined and regular there") +
         place;
}

/// Returns the claim PAVING about a closure in words. `load`: the name of the load whose forces are compared
/// with limits; empty: there is none.
[[nodiscard]] inline std::string describe_branch_paving(ClaimedSet set, const std::string& load) {
  const bool has_threshold = std::exchange(set.has_threshold, false);
  const std::string branch = describe_closure_claim(set, false) + " in a leaf with a tube";
  if (has_threshold)
    return branch + "; " + kDeterminantOfClosure + " exceeds alpha in a leaf '" + kFeasibleLeaf +
           "', and is at most alpha in a leaf '" + kInfeasibleLeaf + "'";
  if (load.empty()) return branch;
  return branch + "; the forces of all motors under the load " + load +
         " are within their limits for every vector of it in a leaf '" + kFeasibleLeaf +
         "', and that of some motor is beyond its limits for some vector of it in a leaf '" +
         kInfeasibleLeaf + "'";
}

/// A claim about all solutions.
struct ClaimedSolutions {
  std::string verdict;  ///< kComplete, kNone or kIncomplete
  std::string robot;    ///< kOfSixLegs, …
  std::string one, many;
  std::size_t count = 0;
  std::size_t uncertain = 0;  ///< quantities, control errors among them
};
inline constexpr const char* kOfUnknowns =
    "a mechanism with these equations and ranges of its unknowns";
inline constexpr const char* kOfThreeLegs =
    "a platform on three legs in the plane with these anchors and lengths";
inline constexpr const char* kOfSixLegs = "a platform on six legs with these anchors and lengths";
/// Describes an arm of six or four free joints. `has_turning_tool`: one of the six is a turn of its tool.
[[nodiscard]] inline std::string describe_arm(std::size_t free, bool has_turning_tool,
                                              bool has_followers, bool has_ranges) {
  return std::string("an arm of these ") +
         (free == 4          ? "four"
          : has_turning_tool ? "five"
                             : "six") +
         " joints" + (has_followers ? " and those that follow them" : "") +
         (has_ranges ? ", within the lines 'joint-range'," : "") +
         (has_turning_tool ? " whose tool is at this place, with its z axis in this direction,"
                           : " whose end is at this place");
}

/// Returns a claim about all solutions in words.
[[nodiscard]] inline std::string describe_solutions_claim(const ClaimedSolutions& claimed) {
  const std::string robot =
      (claimed.uncertain == 0 ? ""
                              : "at every value of the " + std::to_string(claimed.uncertain) +
                                    " uncertain quantities, ") +
      claimed.robot;
  if (claimed.verdict == kNone) return robot + " has no " + claimed.one;
  const std::string count =
      std::to_string(claimed.count) + ' ' + (claimed.count == 1 ? claimed.one : claimed.many);
  return robot + (claimed.verdict == kComplete ? " has exactly " : " has at least ") + count +
         (claimed.count == 1 ? ", within the line 'solution'"
                             : ", one within each line 'solution'");
}

// A certificate about the places of a table: the words before the number of a part, and of all parts.
inline constexpr const char* kPlace = "place ";
inline constexpr const char* kPlaces = "places ";

/// How many parts of a certificate about places have each verdict.
struct ClaimedPlaces {
  std::size_t complete = 0, none = 0, incomplete = 0, solutions = 0;
};

/// Returns the claim of all its parts in words.
[[nodiscard]] inline std::string describe_places_claim(const ClaimedPlaces& c) {
  const std::size_t count = c.complete + c.none + c.incomplete;
  std::string text = "the claim of each part about a place, of " + std::to_string(count);
  const char* before = ": ";
  for (const auto& [verdict, number] :
       {std::pair{kComplete, c.complete}, {kNone, c.none}, {kIncomplete, c.incomplete}})
    if (number > 0) {
      text += before + std::string(verdict) + " at " + std::to_string(number);
      before = ", ";
    }
  return text + "; " + std::to_string(c.solutions) + " solutions in all";
}

/// Returns a claim about singularity in words. Nothing but these functions words a claim.
[[nodiscard]] inline std::string describe_claim(const ClaimedSet& set, bool singular) {
  const std::string matrix = "the full " + std::to_string(set.rows) + "x" +
                             std::to_string(set.columns) + " matrix of the model";
  const std::string about = set.has_threshold ? "|det| of " + matrix : matrix;
  if (singular)
    return about + (set.has_threshold ? " is at most alpha " : " is singular ") +
           describe_place(set, false) + " of the variety";
  return about + (set.has_threshold ? " exceeds alpha " : " is defined and has full rank ") +
         describe_place(set, true) + " of the variety";
}

}  // namespace regulus::format
