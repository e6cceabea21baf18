// SPDX-License-Identifier: GPL-3.0-or-later
// Decides boxes for the search for all solutions, in one thread: has the system none in the box, or
// exactly one?
//
// Φ(x, p) = 0, x of the variables' box X as it is, p of the box P. With c ∈ P, M a matrix that
// contains all mean derivatives ∫₀¹ Φ_p(x, c + t(p − c)) dt, and any matrix K, each solution meets
//
//     Φ(X, c) + M(p − c) ∋ 0   and   KΦ(X, c) + KM(p − c) ∋ 0.
//
// Both narrow P, row by row; nothing is left if there is no solution. That a larger box than P has
// exactly one, for each x, is the test of branch_tube.hpp without variables: it holds for each x alone.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "codegen/question/closure/closed_system.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {

/// n equations in n unknowns, evaluated over eight boxes at once. Each thread has its own.
class RootSystem {
 public:
  using Box = SystemBoxes::Box;
  struct Values : SystemBoxes::System {
    std::vector<Interval> also{};  ///< 0 at the solutions that are looked for, beside the equations
    /// Empty, or at a point: `value` is in core + by_datum·data for all data. n, n×m row-major, m.
    std::vector<Interval> core{}, by_datum{}, data{};
  };

  RootSystem() = default;
  RootSystem(const RootSystem&) = delete;
  RootSystem& operator=(const RootSystem&) = delete;
  virtual ~RootSystem() = default;

  /// `has_rates`: with the derivatives of the derivatives, by unknown, if the system has them.
  ///
  /// Rounding  outward; MXCSR at nearest.
  virtual void evaluate(std::span<const Box> boxes, bool has_rates) = 0;
  /// Returns nullopt if an expression is not certainly defined all over the box of that lane.
  [[nodiscard]] virtual std::optional<Values> at(std::size_t lane) const = 0;

 protected:
  [[nodiscard]] static bool is_point(const Box& box) {
    return std::ranges::all_of(box, [](const Interval& x) { return x.lo == x.hi; });
  }
};

using MakeRootSystem = std::function<std::unique_ptr<RootSystem>()>;

struct RootQuestion {
  const Problem& problem;  ///< its ranges: of the variables, and where each unknown is looked for
  ClosedShape shape;
  MakeRootSystem system;
  /// If there is one, no solutions are looked for: boxes are asked for all over which the derivatives of
  /// this system are regular. It has the unknowns of the other one.
  MakeRootSystem regular{};
  /// Names the systems among those of the question about the solutions, for other processes.
  std::size_t number = 0;
};

/// The systems of a search without variables. They live as long as this or a copy of it.
struct RootSystems {
  std::size_t number = 0;  ///< RootQuestion::number
  std::size_t unknowns = 0;
  MakeRootSystem system{}, regular{};

  [[nodiscard]] RootQuestion question(const Problem& problem) const {
    return {problem, {0, 0, unknowns, 0}, system, regular, number};
  }
};

/// A solution, for each place of the variables.
struct Root {
  std::vector<double> center, radius;  ///< by unknown: it is the only one so near
  std::vector<Interval> values;        ///< encloses it
  int sign = 0;                        ///< of det Φ_p all over that box; 0: not shown

  /// True if a solution within these bounds is this one.
  [[nodiscard]] bool is(std::span<const Interval> other) const {
    for (std::size_t i = 0; i < center.size(); ++i)
      if (!(mag(other[i] - Interval(center[i])) <= radius[i])) return false;
    return true;
  }
};

/// The finding about one box. It depends on the box alone.
struct RootFinding {
  bool is_empty = false;             ///< no solution
  bool is_undefined = false;         ///< an expression is not certainly defined
  bool is_regular = false;           ///< the system `regular` is so all over what is left
  std::optional<Root> root{};        ///< the box has no other; this one may be outside
  std::vector<Interval> unknowns{};  ///< the part of the box with its solutions
  std::vector<double> impact{};      ///< by variable and unknown; empty: not known
};

/// A judge of boxes (runtime/search/box_judges.hpp). Each thread has its own.
class RootJudge {
 public:
  using Box = SystemBoxes::Box;
  using Question = RootQuestion;
  using Finding = RootFinding;

  /// The parts of the question must outlive this object.
  explicit RootJudge(const RootQuestion& question)
      : question_(question),
        system_(question.system()),
        regular_(question.regular ? question.regular() : nullptr) {}

  /// Requires  at most kLanes boxes, and as many findings, which are new.
  /// Rounding  outward; MXCSR at nearest.
  void judge(std::span<const Box> boxes, std::span<RootFinding> findings, double horizon);

  /// Returns the solution that Newton's method leads to, if it is certain and the only one near.
  ///
  /// Shape     variables: their box; near: by unknown.
  /// Rounding  as judge().
  [[nodiscard]] std::optional<Root> root_near(const Box& variables, std::vector<double> near);

  static void put(cluster::ByteWriter& to, const RootFinding& finding);
  /// Throws    MalformedMessage.
  [[nodiscard]] static RootFinding take(cluster::ByteReader& from, const RootQuestion& question);

 private:
  struct Trial;

  void narrow(std::span<Trial> trials);
  void find_roots(std::span<Trial> trials);
  void find_root_about(Trial& trial);
  void test_regularity(std::span<Trial> trials);
  void sharpen(const Box& variables, Root& root);

  const RootQuestion question_;
  std::unique_ptr<RootSystem> system_, regular_;
};

}  // namespace regulus::detail
