// SPDX-License-Identifier: GPL-3.0-or-later
// What grows in `regulus margin`: a tolerance, the threshold, or the size of a box variety.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

#include "codegen/engine/pipeline.hpp"

namespace regulus::inline bracketing {

enum class MarginQuantity { kTolerance, kAlpha, kScale };

/// A value with the text that denotes it exactly, and which `check` would take.
struct MarginValue {
  std::string text;
  GiNaC::ex exact;
  double approx = 0;  ///< for planning only
  std::vector<GiNaC::ex> must_be_defined{};
};

/// The decimal that reads back as `value`.
[[nodiscard]] MarginValue decimal_value(double value);

/// LO:HI, or LO: when HI is to be found.
struct MarginQuestion {
  MarginQuantity quantity = MarginQuantity::kTolerance;
  std::string groups;  ///< of a tolerance
  MarginValue low;
  std::optional<MarginValue> high;
};

/// Takes the one option with a range out of the others, which stay as they are: a tolerance or the
/// alpha of `model`, or `scale`, which may be empty. Throws UsageError.
[[nodiscard]] MarginQuestion take_question(ModelOptions& model, const std::string& scale);

/// The ranges of a request as they were read, which scales refer to.
class MarginRequest {
 public:
  /// Throws UsageError when the motion or the model cannot grow in that way.
  MarginRequest(Request nominal, const MarginQuestion& question);

  [[nodiscard]] Request at(const MarginValue& value) const;
  /// Ranges and threshold at `value`, for variables that were formed at another.
  ///
  /// Ensures   the variety of `p` is that of `value`; its formulation, and so its kernel, are
  ///           untouched: no expression in them depends on a tolerance, on the range of a motion
  ///           parameter, or on α.
  void replan(PreparedSearch& p, const MarginValue& value) const;

 private:
  Request nominal_;
  MarginQuestion question_;
};

/// "tolerance of base,platform"
[[nodiscard]] std::string describe_quantity(const MarginQuestion& question);

}  // namespace regulus::inline bracketing
