// SPDX-License-Identifier: GPL-3.0-or-later
// Runs every cell of the paper's Tables IV–VII and prints them as Markdown, one table for each of
// the paper's, rows and columns as there. Usage: paper_tables [SECONDS PER CELL].
#include <fmt/format.h>

#include <cstdlib>
#include <iostream>

#include "tests/paper/tables/run_cell.hpp"
#include "tests/paper/tables/words.hpp"

namespace regulus::test {
namespace {

std::string found(const PaperCell& cell, const Result& result, double limit) {
  const std::string boxes = count(result.statistics.boxes);
  if (result.reason == Reason::kTimeBudget) return fmt::format("> {:g}, {}", limit, boxes);
  const char* mark = result.verdict == cell.verdict ? "" : "**";
  return fmt::format("{:.2g}, {}, {}{}{}", result.statistics.seconds, boxes, mark,
                     letter(result.verdict), mark);
}

std::string text(const PaperTable& table, const PaperCell& cell, double limit) {
  const std::string ours = found(cell, run(table, cell, limit), limit);
  return fmt::format("{} → {}", *cell.seconds == '\0' ? "–" : cell.seconds, ours);
}

void print(const PaperTable& table, double limit) {
  std::cout << fmt::format("\n## {}: {}\n\n| |", table.name, table.caption);
  for (const char* column : table.columns) std::cout << fmt::format(" {} |", column);
  std::cout << "\n|---|";
  for (std::size_t i = 0; i < table.columns.size(); ++i) std::cout << "---|";
  std::cout << '\n';
  for (const PaperRow& row : table.rows) {
    std::cout << fmt::format("| {} |", row.label);
    for (const PaperCell& cell : row.cells)
      std::cout << fmt::format(" {} |", text(table, cell, limit)) << std::flush;
    for (std::size_t i = row.cells.size(); i < table.columns.size(); ++i) std::cout << " |";
    std::cout << '\n';
  }
  std::cout << fmt::format("\n{}\n", table.note);
}

std::string head(double limit) {
  return fmt::format(
      "# Tables IV–VII of the paper\n\n"
      "Written by `make paper LIMIT={:g}`. A cell reads: the paper's seconds on a 1.7 GHz laptop "
      "→\n"
      "seconds of the search here, boxes evaluated, verdict. N is NO SINGULARITY, S SINGULARITY, "
      "P\n"
      "POSSIBLE PROBLEM, bold where the paper's is another; `> {:g}` is a cell that was stopped "
      "then,\n"
      "with the boxes until then; – where the paper has no figure. (D) keeps uncertain quantities "
      "in\n"
      "the elements, (V) splits them. `auto` is not one of the paper's methods. The others run as\n"
      "`--method` names them, with the defaults of the command: determinants by expansion, then "
      "by\n"
      "elimination; `--bisect impact`; `--entries auto`.\n",
      limit, limit);
}

}  // namespace
}  // namespace regulus::test

int main(int argc, char** argv) {
  const double limit = argc > 1 ? std::atof(argv[1]) : 10;
  if (!(limit > 0)) {
    std::cerr << "usage: paper_tables [SECONDS PER CELL]\n";
    return 64;
  }
  std::cout << regulus::test::head(limit);
  for (const regulus::test::PaperTable& table : regulus::test::kPaperTables)
    regulus::test::print(table, limit);
}
