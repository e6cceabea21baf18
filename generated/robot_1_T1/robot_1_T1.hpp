// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_1.toml T1 -o generated/robot_1_T1
// Model            robot 1
// Motion           T1
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         58a478441814040435ff3bd6eeae807fb63e1717f38974d84b2d08c6ae339380
//
// REGULUS_CHECK_NO_SINGULARITY means: for every value of the motion parameters within the bounds,
// the full 6×6 matrix of the model is defined and has full rank.
// Uncertain: nothing; geometry and control are exact.
#pragma once

#include <memory>
#include <stdexcept>

#include "robot_1_T1.h"

namespace robot_1_T1 {

/// A value of each motion parameter, or one bound of each.
using Parameters = ::robot_1_T1_parameters;

/// Their ranges, outward: pieces lie between them.
inline constexpr Parameters kLower = {
    0.0,  // T
};
inline constexpr Parameters kUpper = {
    1.0,  // T
};

/// Decides pieces of the motion; one thread at a time may use it.
class Checker {
 public:
  /// Memory is in proportion to max_boxes, the most boxes of one check: 1 to 1048576.
  /// Throws std::runtime_error that says what is wrong.
  explicit Checker(unsigned max_boxes = 256) {
    char fault[120] = "";
    checker_.reset(robot_1_T1_checker_new(max_boxes, fault, sizeof fault));
    if (!checker_) throw std::runtime_error(fault);
  }

  /// The piece between two bounds of each motion parameter. Does not allocate or lock.
  [[nodiscard]] regulus_check_report check(const Parameters& lower,
                                           const Parameters& upper) noexcept {
    regulus_check_report report;
    robot_1_T1_check(checker_.get(), &lower, &upper, &report);
    return report;
  }

  /// One value of each.
  [[nodiscard]] regulus_check_report check(const Parameters& at) noexcept { return check(at, at); }

  /// The instruction set that is used: avx512, avx2 or portable.
  [[nodiscard]] static const char* isa() noexcept { return robot_1_T1_isa(); }

 private:
  struct Free {
    void operator()(regulus_checker* checker) const noexcept { regulus_checker_free(checker); }
  };
  std::unique_ptr<regulus_checker, Free> checker_;
};

}  // namespace robot_1_T1
