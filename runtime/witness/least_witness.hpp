// SPDX-License-Identifier: Apache-2.0
// Searches, in plain doubles, for the least value at which a growing set contains a singularity.
// The result is a place to look at, never a claim: point_witness.hpp certifies.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "runtime/evaluation/batch.hpp"

namespace regulus::detail {

/// The ranges of the variables at a value, for points that lie at the same part of every range. The
/// ends of the ranges are linear in the value.
class Growth {
 public:
  /// `at_low`, `at_high`: the ranges at `low` < `high`; starts lie within those at `low`.
  Growth(double low, std::vector<Interval> at_low, double high, std::vector<Interval> at_high);

  /// Uses the true ranges of two problems, to the precision of doubles.
  static Growth between(double low, const Problem& at_low, double high, const Problem& at_high);

  [[nodiscard]] double low() const noexcept { return low_; }
  [[nodiscard]] double high() const noexcept { return high_; }
  [[nodiscard]] std::size_t variables() const noexcept { return at_low_.size(); }
  /// Returns variable k at part t of its range, 0 ≤ t ≤ 1.
  [[nodiscard]] double at(double value, std::size_t k, double t) const noexcept;
  [[nodiscard]] std::vector<double> point(double value, std::span<const double> parts) const;

 private:
  double low_, high_;
  std::vector<Interval> at_low_, at_high_;
};

/// A pattern search downhill from many places: first over the parts of the ranges at one value,
/// then down to the value at which the determinant vanishes at those parts, and so on. If the
/// threshold grows, the ranges are fixed and the search minimises the determinant.
class LeastWitness {
 public:
  using Parts = std::vector<double>;

  /// Parts of the ranges at which the determinant is nearly 0 (or α) at a value; `from`: other
  /// parts, at which it is not nearly 0 at `low`.
  struct Place {
    double value;
    Parts parts, from;
  };

  /// `threshold_grows`: the values are those of α and the ranges do not grow.
  ///
  /// Requires  a square kernel; `problem` is that of growth.high() and outlives this. If the
  ///           threshold grows, high may be infinite, and `problem` is that of any value > 0.
  LeastWitness(const Problem& problem, const Settings& settings, Growth growth,
               bool threshold_grows);

  /// Starts from the middle, corners and other places, until the time is over or 2^18 packs of points
  /// have been evaluated; repeated calls continue with new places. Without the end of the time, the
  /// result is always the same. Returns found().
  bool search(double seconds, int starts, const std::atomic<bool>* interrupt);
  /// Starts from the middle of a box.
  bool search_from(std::span<const Interval> box);

  /// Returns the best result so far; its value is at most growth.high().
  [[nodiscard]] const std::optional<Place>& found() const noexcept { return found_; }

  /// Returns two points at a value slightly above the found one: the singularity is then between
  /// the two points. Empty if nothing was found.
  [[nodiscard]] std::vector<std::vector<double>> points_at(double value) const;

 private:
  struct Move {
    std::size_t variable;
    double part;
  };
  using Clock = std::chrono::steady_clock;

  /// Returns the value at which the ranges are widest.
  [[nodiscard]] double widest() const noexcept {
    return threshold_grows_ ? growth_.low() : growth_.high();
  }
  [[nodiscard]] bool must_stop() const noexcept;
  void evaluate(std::size_t points);
  [[nodiscard]] Parts start(int number);
  void improve_from(Parts parts);
  [[nodiscard]] bool set_out_from(const Parts& parts);
  double minimise(double value, Parts& parts);
  bool sweep(double value, Parts& parts, double step, double& best);
  void list_moves(const Parts& parts, double step);
  bool leap(double value, Parts& parts, const Parts& before, double& best);
  [[nodiscard]] double root(double value, const Parts& parts);
  void keep(double value, const Parts& parts);
  [[nodiscard]] double objective_at(double value, const Parts& parts);
  void load(std::size_t lane, double value, const Parts& parts);
  [[nodiscard]] double objective(std::size_t lane);

  const Problem& problem_;
  Growth growth_;
  bool threshold_grows_;
  std::size_t motion_variables_;
  RowStructure no_structure_;
  Batch batch_;
  std::vector<Interval> box_;
  std::vector<Move> moves_;
  Parts trial_;
  std::minstd_rand random_;
  int next_start_ = 0;
  double sign_ = 0;  ///< of the determinant where the search starts
  Parts start_;
  double least_;
  std::optional<Place> found_;
  std::uint64_t packs_left_ = 0;
  Clock::time_point end_;
  const std::atomic<bool>* interrupt_ = nullptr;
};

}  // namespace regulus::detail
