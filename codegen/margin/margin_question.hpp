// SPDX-License-Identifier: GPL-3.0-or-later
// The quantity that grows in `regulus margin`: a tolerance, the threshold, the size of a box
// variety, or the range of one parameter.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

#include "codegen/engine/pipeline.hpp"

namespace regulus::inline bracketing {

enum class MarginQuantity { kTolerance, kAlpha, kScale, kParameter };

/// A value with the text that denotes it exactly and that `check` accepts.
struct MarginValue {
  std::string text;
  GiNaC::ex exact;
  double approx = 0;  ///< for planning only
  std::vector<GiNaC::ex> must_be_defined{};
};

/// Returns the decimal that reads back as `value`.
[[nodiscard]] MarginValue decimal_value(double value);

/// LO:HI, or LO: if HI must be found.
struct MarginQuestion {
  MarginQuantity quantity = MarginQuantity::kTolerance;
  std::string groups;         ///< of a tolerance; the name of a parameter
  bool is_two_sided = false;  ///< a parameter grows to [−v, v]; otherwise to [0, v]
  MarginValue low;
  std::optional<MarginValue> high;
};

/// Removes the one option with a range: a tolerance or the alpha of `model`, or `scale`, which may
/// be empty. The others stay as they are. Throws UsageError.
[[nodiscard]] MarginQuestion take_question(ModelOptions& model, const std::string& scale);

/// The ranges of a request as read; scales refer to them.
class MarginRequest {
 public:
  /// Throws    UsageError if the motion or the model cannot grow in that way.
  MarginRequest(Request nominal, const MarginQuestion& question);

  [[nodiscard]] Request at(const MarginValue& value) const;
  /// Sets ranges and threshold at `value`, for variables that were formed at another value.
  ///
  /// Ensures   the variety of `p` is that of `value`. Its formulation and its kernel do not change:
  ///           no expression in them depends on a tolerance, on the range of a motion parameter, or
  ///           on α.
  void replan(PreparedSearch& p, const MarginValue& value) const;

 private:
  Request nominal_;
  MarginQuestion question_;
};

/// Returns "tolerance of base,platform", for example.
[[nodiscard]] std::string describe_quantity(const MarginQuestion& question);

}  // namespace regulus::bracketing
