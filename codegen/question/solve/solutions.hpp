// SPDX-License-Identifier: GPL-3.0-or-later
// All solutions of a system, with a proof that there are no others. A search and a counting theorem
// fill the same values, and one report tells them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/solutions/complex.hpp"

namespace regulus {

/// A number of a solution: x, y, phi of a pose; q1 … q6 of a posture.
struct SolvedUnknown {
  std::string name, unit;  ///< "deg": the values are numbers of degrees
  /// Its values are the same after this; 0: it does not turn. Solutions that differ by it are one.
  double period = 0;
  /// Others than these may be beyond this range, in lengths or radians; nullopt: there are none.
  std::optional<Interval> range{};
};

/// Says whether a solution is within the limits of the model: of joints, of legs, of unknowns.
enum class WithinLimits : std::uint8_t { kNoLimits, kWithin, kBeyond, kUnknown };

/// A solution that is certain. Where quantities are uncertain, there is one for each of their values.
struct CertainSolution {
  std::vector<Interval> values;  ///< by unknown; each encloses the exact value
  double condition = 0;          ///< of the matrix at the solution, in the 2-norm; approximately
  /// The sign of the determinant of the matrix there: 1 or −1, which is certain; 0: not shown.
  int sign = 0;
  WithinLimits limits = WithinLimits::kNoLimits;
  std::string beyond{};  ///< what is beyond its limits, in words: "q3 = 3.2 rad beyond [-3, 3] rad"
  /// One that was followed, and a posture within tolerances, has roughly these values where all that is
  /// uncertain is in the middle of its range, by unknown, up to whole turns. Empty: one test shows it at all values.
  std::vector<double> middle{};
};

/// What is known about the number of solutions.
enum class Completeness : std::uint8_t {
  kComplete,    ///< these are all; none of them: there is no solution
  kIncomplete,  ///< there may be others
};

struct Solutions {
  std::vector<SolvedUnknown> unknowns;
  /// The file declares tolerances or control errors, and these are solutions without them.
  bool is_nominal = false;
  std::vector<CertainSolution> found;  ///< pairwise different, in the order of their values
  Completeness completeness = Completeness::kIncomplete;
  /// How completeness is shown, as the end of a sentence: "by a search of 1201 boxes", or "by the
  /// theorem that a Gough platform has at most 40 isolated complex poses (Ronga & Vust 1995)".
  std::string how;
  /// Why it is not shown; empty if it is: "infinitely many solutions, or one of several, near x = 3".
  std::string obstacle;
  bool changes = false;  ///< their number is not the same at all values of what is uncertain
  /// Boxes that may hold others, by unknown; of a search that was not completed.
  std::vector<std::vector<Interval>> open{};
  bool is_counted = false;  ///< they are complete by a count of the complex ones
  /// Of a count: the solutions among complex numbers that were certified; nullopt: not counted.
  std::optional<std::uint64_t> complex_found{};
  /// The same, roughly: their values by unknown, a quaternion up to a factor.
  std::vector<std::vector<Complex>> roots{};
  /// Postures of an arm whose joints turn have this number N, 1 to 3: joints N and N + 3 follow from those
  /// that were searched. 0: no such search has found them.
  std::size_t opposite = 0;
  /// Postures of another arm: the numbers, from 1, of the unknowns that follow from those that were searched.
  /// nullopt: no search has found them.
  std::optional<std::vector<std::size_t>> left_out{};
  std::uint64_t boxes = 0;  ///< of the search
  double seconds = 0;
  std::optional<Reason> stopped_by{};  ///< the limit that ended it
};

/// A number of the place that was asked about.
struct PlacedValue {
  std::string name, unit;
  std::string exact;  ///< in that unit, as options take it
  Interval enclosure;
};

/// One of many places, and what was found there.
struct SolvedPlace {
  int line = 0;  ///< of the file; without one its number, from 1
  std::optional<double> time{};
  std::vector<PlacedValue> place;
  Solutions solutions;
};

/// What is counted, and how the matrix is called whose determinant and condition are told.
struct SolvedNoun {
  std::string one, many;  ///< "pose", "poses"; "posture"; "configuration"
  std::string matrix;     ///< "the derivatives of the equations by the unknowns"
};

}  // namespace regulus
