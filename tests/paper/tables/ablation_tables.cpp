// SPDX-License-Identifier: GPL-3.0-or-later
// Shows what each ingredient of method auto contributes: omits one after the other. Prints
// Markdown. Usage: ablation_tables [SECONDS PER CELL].
#include <cstdlib>
#include <iostream>

#include "codegen/question/engine/ingredients.hpp"
#include "tests/paper/tables/ablation.hpp"
#include "tests/paper/tables/words.hpp"

namespace regulus::detail::test {
namespace {

std::vector<Ablation> ablations() {
  std::vector<Ablation> list = {{}};
  for (const std::string& name : ingredient_names()) list.push_back({{name}});
  list.push_back({{"second-order", "mean-value"}});
  list.push_back({{"midpoints", "corners", "descents"}});
  list.push_back({{}, "weighted"});
  list.push_back({{}, "widest"});
  list.push_back({{}, "impact", "kj"});
  return list;
}

std::string cell(const Result& result, const Result& whole, double limit) {
  const Statistics& s = result.statistics;
  if (result.reason == Reason::kTimeBudget)
    return fmt::format("> {}, > {:g} s", count(s.boxes), limit);
  const double ratio = s.seconds / whole.statistics.seconds;
  const std::string verdict =
      result.verdict == whole.verdict ? "" : fmt::format(", **{}**", letter(result.verdict));
  return fmt::format("{}, {:.2g}{}", count(s.boxes), ratio, verdict);
}

std::string first_cell(const Result& whole) {
  return fmt::format("{}, {:.3g} ms, {}", count(whole.statistics.boxes),
                     1e3 * whole.statistics.seconds, letter(whole.verdict));
}

/// Runs problem after problem, so that times to be compared are measured close together.
std::vector<std::vector<std::string>> cells(const std::vector<Ablation>& rows, double limit) {
  std::vector<std::vector<std::string>> text(rows.size());
  for (const AblationProblem& problem : kAblationProblems) {
    const Result whole = run(problem.question, rows[0].options(limit));
    text[0].push_back(first_cell(whole));
    for (std::size_t r = 1; r < rows.size(); ++r)
      text[r].push_back(cell(run(problem.question, rows[r].options(limit)), whole, limit));
    std::cerr << problem.name << '\n';
  }
  return text;
}

std::string command(const Question& q) {
  std::string text = "check " + q.model + ' ' + q.motion;
  for (const std::string& range : q.ranges) text += " --range '" + range + "'";
  for (const std::string& tolerance : q.tolerances) text += " --tolerance " + tolerance;
  if (!q.alpha.empty()) text += " --alpha " + q.alpha;
  return text;
}

std::string head(double limit) {
  std::string text = fmt::format(
      "# What each ingredient contributes\n\n"
      "Written by `make ablation LIMIT={:g}`. The first row is `--method auto` as it is: boxes, "
      "processor\ntime of the search, verdict (N: NO SINGULARITY, S: SINGULARITY, P: POSSIBLE "
      "PROBLEM). In the others\none ingredient is left out: boxes, and time as a multiple of the "
      "first row's. Times are the quickest\nof several, on a machine that others use: a third "
      "more or less says nothing. `>` is where the\nclock stopped it after {:g} s; bold is another "
      "verdict. Each cell is a `regulus` command with the options of\nits row:\n\n",
      limit, limit);
  for (const AblationProblem& problem : kAblationProblems)
    text += fmt::format("- {}: `{}`\n", problem.name, command(problem.question));
  return text +
         "\n`regulus check --help` says what the names mean. An ingredient may be of no use to "
         "some "
         "of these\nproblems: rows and balls without uncertain anchors, midpoints, corners and "
         "descents where nothing\nis singular, natural and mean-value where uncertain anchors are "
         "taken by rows.\n\n";
}

void print(const std::vector<Ablation>& rows, double limit) {
  const auto text = cells(rows, limit);
  std::cout << head(limit) << "| |";
  for (const AblationProblem& problem : kAblationProblems)
    std::cout << fmt::format(" {} |", problem.name);
  std::cout << "\n|---|";
  for (std::size_t i = 0; i < std::size(kAblationProblems); ++i) std::cout << "---|";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::cout << fmt::format("\n| {} |", rows[r].words());
    for (const std::string& cell : text[r]) std::cout << fmt::format(" {} |", cell);
  }
  std::cout << '\n';
}

}  // namespace
}  // namespace regulus::detail::test

int main(int argc, char** argv) {
  const double limit = argc > 1 ? std::atof(argv[1]) : 10;
  if (!(limit > 0)) {
    std::cerr << "usage: ablation_tables [SECONDS PER CELL]\n";
    return 64;
  }
  regulus::detail::test::print(regulus::detail::test::ablations(), limit);
}
