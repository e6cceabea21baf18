// SPDX-License-Identifier: GPL-3.0-or-later
// One box as the methods see it: M(B), K·M(B) and the bounds of the determinant (T-RO 2007, §III-A
// and §III-B1). For people; no verdict is taken from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/request.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Rounding  outward.
struct BoxEvaluation {
  struct Range {
    std::string variable;
    Interval range;
  };
  struct Bound {
    std::string method;        ///< "reg", "kj-numeric", … of check --method
    std::string entries;       ///< "natural" or "derivatives", of check --entries
    std::string determinant;   ///< "expansion" or "elimination", of check --determinant
    Interval value;            ///< encloses det M over the box
    std::optional<bool> rohn;  ///< Rohn's test of the method's matrix; nullopt: not for this order
  };

  std::vector<Range> box;
  std::size_t rows = 0, columns = 0;
  std::vector<Interval> matrix;   ///< M(B), row-major; empty: M is not defined all over the box
  std::vector<double> K;          ///< columns×rows; empty: M has no inverse at the middle
  std::vector<Interval> product;  ///< K·M(B) in the rewritten form; empty with `matrix` or K
  std::vector<Interval> numeric;  ///< K times M(B)
  std::vector<Bound> bounds;      ///< of a square matrix
};

/// Evaluates the whole box of the motion. M is the model's matrix: neither scaled, nor with column
/// operations.
[[nodiscard]] BoxEvaluation evaluate_box(const Request& request);

}  // namespace regulus::detail
