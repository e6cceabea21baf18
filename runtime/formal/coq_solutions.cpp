// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "runtime/formal/coq_claim.hpp"
#include "runtime/formal/coq_poses.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/rational.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfRange = 64;
constexpr double kNarrowest = 0x1p-50;  ///< a part of the range: doubles decide no narrower line
constexpr int kMostDigits = 300;        ///< after the point
constexpr int kDeepestSearch = 400;     ///< the most steps one after the other

enum class Side : std::uint8_t { kBelow, kAbove };

/// Returns the nearest decimal with so many digits after the point that is not above x, or not below.
std::string decimal(double x, int digits, Side side) {
  const Rational exact = rational_of(x);
  fmpz_t whole;
  fmpz_init_set_ui(whole, 10);
  fmpz_pow_ui(whole, whole, ulong(digits));
  fmpz_mul(whole, whole, fmpq_numref(exact.get()));
  (side == Side::kAbove ? fmpz_cdiv_q : fmpz_fdiv_q)(whole, whole, fmpq_denref(exact.get()));
  const bool is_negative = fmpz_sgn(whole) < 0;
  fmpz_abs(whole, whole);
  char* const raw = fmpz_get_str(nullptr, 10, whole);
  std::string text(raw);
  flint_free(raw);
  fmpz_clear(whole);
  const auto after = std::size_t(digits);
  if (text.size() <= after) text.insert(0, after + 1 - text.size(), '0');
  if (after > 0) text.insert(text.size() - after, ".");
  while (text.find('.') != std::string::npos && (text.back() == '0' || text.back() == '.'))
    text.pop_back();
  return (is_negative ? "-" : "") + text;
}

}  // namespace

/// `(1.234, 1.236)`: the last digit stands for about a tenth of the width, or more.
std::string coq_interval(const Interval& value, double range) {
  const double least = std::max(value.hi - value.lo, kNarrowest * range);
  const int digits =
      least > 0 ? std::clamp(int(std::ceil(1 - std::log10(least))), 0, kMostDigits) : kMostDigits;
  double lo = value.lo, hi = value.hi;
  if (const double more = (least - (hi - lo)) / 2; more > 0) lo -= more, hi += more;
  return "(" + decimal(lo, digits, Side::kBelow) + ", " + decimal(hi, digits, Side::kAbove) + ")";
}

std::string coq_solutions(const Question& question, const std::string& margin) {
  const auto radii = evaluate(question.graph, question.closure->radius, {}, kBitsOfRange);
  if (!radii) throw Unfinished("the ranges of the unknowns have no certain values");
  std::vector<CoqItem> lines;
  for (const SolutionLine& solution : question.solutions->solutions) {
    std::string line;
    for (std::size_t i = 0; i < solution.values.size(); ++i)
      line += (i == 0 ? "[" : "; ") +
              coq_interval(solution.values[i], std::abs((*radii)[i].enclosure().hi));
    lines.push_back({"", line + "]"});
  }
  return coq_list(lines, margin);
}

std::string method_of_search(const Question& question) {
  return "\n(** The variables of second order, and how often a part of the ranges is halved or "
         "narrowed. *)\nDefinition the_method : method := Method " +
         std::to_string(question.variables.size() + question.closure->names.size()) + " " +
         std::to_string(kDeepestSearch) + ".\n";
}

std::string solutions_theorem(const Question& question, const std::vector<std::string>& lines) {
  const ListedConfigurations listed =
      configurations_of(question, lines, SquaresOfLegs::kInEquations);
  const Question& q = listed.question;
  const std::string claim =
      q.solutions->verdict == format::kIncomplete ? "some_solutions" : "all_solutions";
  return coq_heading(q) + coq_question(listed.lines, q).text +
         "\n(** The solutions: an interval for each unknown. *)\n"
         "Definition the_solutions : list line :=\n  " +
         coq_solutions(q, "   ") + ".\n" + method_of_search(q) +
         coq_claim(claim + " the_closure the_solutions",
                   "check_" + claim + "_correct the_closure the_method the_solutions");
}

}  // namespace regulus::verifier
