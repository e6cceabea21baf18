// SPDX-License-Identifier: GPL-3.0-or-later
// The searches that a bracket consists of: of a set of poses, or of a path.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/margin/margin_question.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/search/bracket.hpp"

namespace regulus::detail {

/// The result at one value.
struct MarginStep {
  MarginValue value;
  Result result;
  std::string claim;
};

using StepListener = std::function<void(const MarginStep&)>;

/// Searches at any value of a question. It also looks for witnesses, if it can do so without a
/// search; each witness that it returns is at a smaller value than the one before.
class Attempts {
 public:
  /// The least value that is not safe, as far as it is known.
  using Refuted = std::optional<double>;

  Attempts() = default;
  Attempts(const Attempts&) = delete;
  Attempts& operator=(const Attempts&) = delete;
  virtual ~Attempts() = default;

  /// Searches within the boxes and the seconds that are planned.
  [[nodiscard]] virtual MarginStep at(const MarginValue& value, const PlannedAttempt& planned) = 0;

  /// Looks for witnesses before the first search, in a part of `seconds`.
  [[nodiscard]] virtual std::vector<MarginStep> beforehand(double seconds);
  /// True if the other functions can find one.
  [[nodiscard]] virtual bool can_look() const noexcept;
  /// Looks below `refuted` near the box where a search ended.
  [[nodiscard]] virtual std::vector<MarginStep> near(const Result& ended, Refuted refuted);
  /// Looks below `refuted` everywhere, once no search is useful any more.
  [[nodiscard]] virtual std::vector<MarginStep> everywhere(double seconds, Refuted refuted);
};

}  // namespace regulus::detail
