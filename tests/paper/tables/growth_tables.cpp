// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the growth of the boxes with the tolerance, with the range of the angles and with the
// narrowness of a bracket, as Markdown and as two pictures. Usage: growth_tables PICTURE.svg
// BOUNDS.svg [SECONDS PER CELL].
#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "codegen/answer/picture/gnuplot.hpp"
#include "tests/paper/tables/bound_growth.hpp"
#include "tests/paper/tables/growth.hpp"
#include "tests/paper/tables/words.hpp"

namespace regulus::detail::test {
namespace {

/// A bound has searches for six legs.
constexpr double kBoundLimit = 12;

struct Column {
  const char* title;
  std::vector<std::string> without;
};

const std::array kColumns = {
    Column{"without second-order", {"second-order"}},
    Column{"without moving", {"moving"}},
    Column{"auto", {}},
};

using Cell = std::optional<Result>;  ///< nullopt: not tried, after one that was stopped
using Row = std::array<Cell, kColumns.size()>;

bool finished(const Cell& cell) { return cell && cell->reason == Reason::kAllBoxesCertified; }

std::vector<Row> run(const Series& series, double limit) {
  std::vector<Row> rows(series.steps.size());
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    SearchOptions search;
    search.without = kColumns[c].without;
    search.time_limit = limit;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      rows[r][c] = run(question_at(series, series.steps[r]), search);
      if (!finished(rows[r][c])) break;
    }
  }
  return rows;
}

std::vector<GrowthPoint> points(const Series& series, const std::vector<Row>& rows, std::size_t c) {
  std::vector<GrowthPoint> result;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (series.steps[r] > 0 && finished(rows[r][c]))
      result.push_back({series.steps[r], static_cast<double>(rows[r][c]->statistics.boxes)});
  return result;
}

/// Returns how many leading points all columns have in common.
std::size_t common(const Series& series, const std::vector<Row>& rows) {
  std::size_t least = rows.size();
  for (std::size_t c = 0; c < kColumns.size(); ++c)
    least = std::min(least, points(series, rows, c).size());
  return least;
}

std::string words(const Cell& cell, double limit) {
  if (!cell) return "";
  const Statistics& s = cell->statistics;
  if (cell->reason == Reason::kTimeBudget)
    return fmt::format("> {}, > {:g}", count(s.boxes), limit);
  const std::string verdict = finished(cell) ? "" : fmt::format(", **{}**", letter(cell->verdict));
  return fmt::format("{}, {:.2g}{}", count(s.boxes), s.seconds, verdict);
}

std::string describe_exponent(std::span<const GrowthPoint> points) {
  const std::optional<double> p = exponent(points);
  return p ? fmt::format("{:.2f}", *p) : "–";
}

void print_exponents(const Series& series, const std::vector<Row>& rows) {
  const std::size_t shared = common(series, rows);
  std::string of_first = fmt::format("| exponent, first {} |", shared);
  std::string of_last = "| exponent, last 3 |";
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    const std::vector<GrowthPoint> all = points(series, rows, c);
    const std::span<const GrowthPoint> some(all);
    of_first += fmt::format(" {} |", describe_exponent(some.first(shared)));
    of_last +=
        fmt::format(" {} |", describe_exponent(some.last(std::min<std::size_t>(3, some.size()))));
  }
  std::cout << of_first << '\n' << of_last << '\n';
}

void print(const Series& series, const std::vector<Row>& rows, double limit) {
  const bool angle = series.abscissa == Abscissa::kAngle;
  std::cout << fmt::format("\n## {}\n\n{}: {}.\n\n| |", series.name, series.motion, series.caption);
  for (const Column& column : kColumns) std::cout << fmt::format(" {} |", column.title);
  std::cout << "\n|---|---|---|---|\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::cout << fmt::format("| ±{:g}{} |", series.steps[r], angle ? "°" : "");
    for (const Cell& cell : rows[r]) std::cout << fmt::format(" {} |", words(cell, limit));
    std::cout << '\n';
  }
  print_exponents(series, rows);
}

constexpr const char* kStyles[] = {"lc rgb '#d55e00' pt 5", "lc rgb '#e69f00' pt 9",
                                   "lc rgb '#0072b2' pt 7"};

/// Draws one panel of the picture; points at 0 have no logarithm.
std::string panel(const Series& series, const std::vector<Row>& rows, std::size_t number) {
  std::string data, curves;
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    const std::string name = fmt::format("$curve_{}_{}", number, c);
    data += name + " << end\n";
    for (const GrowthPoint& p : points(series, rows, c))
      data += fmt::format("{} {}\n", p.x, p.boxes);
    data += "end\n";
    curves += fmt::format("{}{} with linespoints ps 0.5 {} notitle", c == 0 ? "plot " : ", ", name,
                          kStyles[c]);
  }
  const double least =
      *std::find_if(series.steps.begin(), series.steps.end(), [](double x) { return x > 0; });
  return data +
         fmt::format("set title '{}'\nset xtics ({})\nset xrange [{}:{}]\n", series.name,
                     series.tics, least / 1.1, series.steps.back() * 1.1) +
         curves + '\n';
}

/// The cells of a bound, by gap. After a gap that was not reached in time, none is tried.
std::vector<BoundCell> run(const BoundSeries& series, double limit) {
  std::vector<BoundCell> cells;
  for (const double gap : kGaps) {
    cells.push_back(bound_forces(series, gap, limit));
    if (!cells.back().is_closed) break;
  }
  return cells;
}

void print(const BoundSeries& series, const std::vector<BoundCell>& cells, double limit) {
  std::cout << fmt::format(
      "\n## robot 1, forces, {}\n\n{}; the largest force in a leg under forces of at most 1 N "
      "in each\ndirection. `regulus bound` of the six legs; by the gap. The\nprocessor time "
      "includes that of forming the matrices, about a second.\n\n"
      "| gap | attained, N | proved, N | boxes | seconds |\n|---|---|---|---|---|\n",
      series.motion, series.caption);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const BoundCell& c = cells[i];
    const std::string seconds =
        c.is_closed ? fmt::format("{:.2g}", c.seconds) : fmt::format("> {:g}", limit);
    std::cout << fmt::format("| {:g} % | {:.5g} | {:.5g} | {}{} | {} |\n", 100 * kGaps[i],
                             c.attained, c.proved, c.is_closed ? "" : "> ", count(c.boxes),
                             seconds);
  }
}

/// Draws boxes and seconds, each by the gap.
std::string bound_picture(const std::vector<std::vector<BoundCell>>& all) {
  std::string data, boxes, seconds;
  for (std::size_t s = 0; s < all.size(); ++s) {
    data += fmt::format("$bound_{} << end\n", s);
    for (std::size_t i = 0; i < all[s].size() && all[s][i].is_closed; ++i)
      data += fmt::format("{} {} {}\n", 100 * kGaps[i], all[s][i].boxes, all[s][i].seconds);
    data += "end\n";
    const char* lead = s == 0 ? "plot" : ",";
    const char* style = s == 0 ? "lc rgb '#0072b2' pt 7" : "lc rgb '#009e73' pt 13";
    const auto curve = [&](int column) {
      return fmt::format("{} $bound_{} using 1:{} with linespoints ps 0.5 {} title '{}'", lead, s,
                         column, style, kBoundSeries[s].motion);
    };
    boxes += curve(2);
    seconds += curve(3);
  }
  constexpr const char* kHead =
      "set terminal svg size 760,320 font 'Helvetica,Arial,sans-serif,13' noenhanced "
      "background '#ffffff'\nset multiplot layout 1,2\nset logscale xy\nset key bottom left\n"
      "set xtics (0.5, 1, 2, 5, 10, 20)\nset xrange [0.4:25]\nset xlabel 'gap, %'\n";
  return kHead + data + "set ylabel 'boxes'\n" + boxes + "\nset ylabel 'processor seconds'\n" +
         "set yrange [0.1:*]\n" + seconds + "\nunset multiplot\n";
}

std::string legend() {
  std::string text =
      "unset logscale\nunset title\nunset border\nunset xtics\nunset ytics\nunset ylabel\n"
      "set key center center\nset xrange [0:1]\nset yrange [0:1]\n";
  for (std::size_t c = 0; c < kColumns.size(); ++c)
    text += fmt::format("{}NaN with linespoints {} title '{}'", c == 0 ? "plot " : ", ", kStyles[c],
                        kColumns[c].title);
  return text + '\n';
}

std::string picture(const std::vector<std::string>& panels) {
  std::string text =
      "set terminal svg size 1020,640 font 'Helvetica,Arial,sans-serif,13' noenhanced "
      "background '#ffffff'\nset multiplot layout 2,3\nset logscale xy\n"
      "set ylabel 'boxes'\nset key off\n";
  for (const std::string& panel : panels) text += panel;
  return text + "set key on\n" + legend() + "unset multiplot\n";
}

std::string head(double limit) {
  return fmt::format(
      "# How the cost grows\n\n"
      "Written by `make growth LIMIT={:g}`. A cell reads: boxes evaluated, processor seconds of "
      "the "
      "search\n(the quickest of several); `>` where the clock stopped it after {:g} s, and "
      "nothing further\ndown was tried then. Bold: the verdict where it is not NO SINGULARITY (S: "
      "SINGULARITY, P: POSSIBLE\nPROBLEM). Columns are `regulus check` with the options they "
      "name:\n\n"
      "- `--without second-order` is the method before: an H-matrix test on the rewritten entries "
      "of\n  K·J⁻¹ and on their mean-value form, uncertain quantities among the variables.\n"
      "- `--without moving` has uncertain quantities by the row they touch, and K fixed: what is\n"
      "  left is of first order in the width of a box.\n"
      "- `auto` is the method as it is: K moves with the pose.\n\n"
      "The exponent p is that of boxes ≈ c·xᵖ, x the tolerance or the angle, by least squares on "
      "the\nlogarithms: over the first rows with x > 0, those that all three columns finish, so "
      "that the\nthree figures compare; and over the last three rows that a column finishes. The "
      "boxes follow no\npower law: they begin at one and end at a pole, the tolerance or range at "
      "which the test fails\nfor a single pose.\n\n![boxes by tolerance and by angle, on "
      "logarithmic scales](growth.svg)\n",
      limit, limit);
}

}  // namespace
}  // namespace regulus::detail::test

int main(int argc, char** argv) {
  using namespace regulus::detail::test;
  const double limit = argc > 3 ? std::atof(argv[3]) : 10;
  if (argc < 3 || !(limit > 0)) {
    std::cerr << "usage: growth_tables PICTURE.svg BOUNDS.svg [SECONDS PER CELL]\n";
    return 64;
  }
  std::vector<std::string> panels;
  std::cout << head(limit);
  for (const Series& series : kGrowth) {
    const std::vector<Row> rows = run(series, limit);
    print(series, rows, limit);
    std::cout.flush();
    panels.push_back(panel(series, rows, panels.size()));
  }
  std::vector<std::vector<BoundCell>> bounds;
  for (const BoundSeries& series : kBoundSeries) {
    bounds.push_back(run(series, kBoundLimit * limit));
    print(series, bounds.back(), kBoundLimit * limit);
    std::cout.flush();
  }
  regulus::detail::Gnuplot(argv[1]).draw(picture(panels),
                                         "Boxes and seconds by tolerance, range and gap");
  std::cout << "\n![boxes and seconds of a bound by the gap](bound_growth.svg)\n";
  regulus::detail::Gnuplot(argv[2]).draw(bound_picture(bounds),
                                         "Boxes and seconds of a bound by the gap");
}
