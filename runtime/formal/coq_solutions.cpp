// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_solutions.hpp"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <vector>

#include "runtime/formal/coq_question.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfRange = 64;
constexpr double kNarrowest = 0x1p-50;  ///< a part of the range: doubles decide no narrower line
constexpr int kMostDigits = 300;        ///< after the point

/// x as a decimal with so many digits after the point, rounded to `direction`: FE_DOWNWARD or FE_UPWARD.
/// Coq checks what the theorem states, so a wrong digit makes it no false theorem.
std::string decimal(double x, int digits, int direction) {
  const int before = std::fegetround();
  std::fesetround(direction);
  std::vector<char> text(std::size_t(digits) + 400);
  std::snprintf(text.data(), text.size(), "%.*f", digits, x);
  std::fesetround(before);
  std::string result(text.data());
  if (result.find('.') != std::string::npos) {
    result.erase(result.find_last_not_of('0') + 1);
    if (result.back() == '.') result.pop_back();
  }
  return result == "-0" ? "0" : result;
}

/// `(1.234, 1.236)`: the last digit stands for about a tenth of the width, or more.
std::string ends(const Interval& value, double range) {
  const double least = std::max(value.hi - value.lo, kNarrowest * range);
  const int digits =
      least > 0 ? std::clamp(int(std::ceil(1 - std::log10(least))), 0, kMostDigits) : kMostDigits;
  double lo = value.lo, hi = value.hi;
  if (const double more = (least - (hi - lo)) / 2; more > 0) lo -= more, hi += more;
  return "(" + decimal(lo, digits, FE_DOWNWARD) + ", " + decimal(hi, digits, FE_UPWARD) + ")";
}

}  // namespace

std::string coq_solutions(const Question& question) {
  const auto radii = evaluate(question.graph, question.closure->radius, {}, kBitsOfRange);
  if (!radii) throw Unfinished("the ranges of the unknowns have no certain values");
  std::vector<CoqItem> lines;
  for (const SolutionLine& solution : question.solutions->solutions) {
    std::string line;
    for (std::size_t i = 0; i < solution.values.size(); ++i)
      line +=
          (i == 0 ? "[" : "; ") + ends(solution.values[i], std::abs((*radii)[i].enclosure().hi));
    lines.push_back({"", line + "]"});
  }
  return "\n(** The solutions: an interval for each unknown. *)\n"
         "Definition the_solutions : list line :=\n  " +
         coq_list(lines, "   ") + ".\n";
}

}  // namespace regulus::verifier
