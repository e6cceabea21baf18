// SPDX-License-Identifier: GPL-3.0-or-later
// Many four-bars, also such whose mirrored assemblies come near each other, and motions that end next to a
// toggle: no verdict contradicts the closed form.
#include <gtest/gtest.h>

#include "codegen/model/file/model_file.hpp"
#include "codegen/question/closure/closure_report.hpp"
#include "tests/property/closure/four_bars.hpp"

namespace regulus::detail {
namespace {

using test::FourBar;

/// The least distance of the diagonal from the toggles over a range; negative beyond one.
double room(const FourBar& linkage, double from, double to) {
  double least = 1e9;
  for (int i = 0; i <= 4000; ++i) {
    const double s = linkage.diagonal(from + (to - from) * i / 4000);
    least = std::fmin(least,
                      std::fmin(s - std::fabs(linkage.b - linkage.c), linkage.b + linkage.c - s));
  }
  return least;
}

Verdict verdict_of(const std::string& text) {
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.threads = 1;
  search.time_limit = 20;
  ModelOptions options;
  options.motion = "m";
  PreparedClosure prepared = prepare_closure(read_request(text, options), 0, search, {});
  return check_result(prepared, check_closure(prepared, search, {})).verdict;
}

TEST(ManyFourBars, HaveNoVerdictAgainstTheirClosedForm) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-3, 3), part(0, 1);
  int decided = 0, all = 0;
  for (int count = 0; count < 2000;) {
    FourBar linkage = test::random_four_bar(random);
    // Almost a parallelogram or a kite: the assemblies nearly meet.
    const double slightly = std::pow(10.0, -1 - 4 * part(random));
    if (random() % 4 == 0) linkage.c = linkage.a + slightly, linkage.b = linkage.d + slightly;
    if (random() % 4 == 0) linkage.b = linkage.c * (1 + slightly);
    const double start = angle(random);
    if (!linkage.is_between_toggles(start, 1e-3)) continue;
    double from = start - 2.5 * part(random), to = start + 2.5 * part(random);
    if (random() % 2 == 0) {
      // The motion ends a little before a toggle, or beyond it.
      double a = start, b = to;
      if (linkage.is_between_toggles(b)) continue;
      for (int i = 0; i < 60; ++i) {
        const double middle = (a + b) / 2;
        (linkage.is_between_toggles(middle) ? a : b) = middle;
      }
      const double distance = std::pow(10.0, -2 - 5 * part(random));
      to = random() % 2 == 0 ? a - distance : a + distance;
      from = std::fmax(from, start - 0.3);
      if (to <= start) continue;
    }
    ++count;
    const double least = room(linkage, from, to);
    const Verdict verdict = verdict_of(linkage.text(start, from, to));
    const double doubt = 1e-9;
    if (least > doubt) {
      EXPECT_NE(verdict, Verdict::kSingularity) << linkage.text(start, from, to);
    }
    if (least < -doubt) {
      EXPECT_NE(verdict, Verdict::kNoSingularity) << linkage.text(start, from, to);
    }
    // Nearer to a toggle than that, doubles may decide nothing.
    if (std::fabs(least) < 1e-3) continue;
    ++all;
    decided += verdict != Verdict::kPossibleProblem;
  }
  EXPECT_GT(all, 500);
  EXPECT_GE(decided, 0.99 * all);
}

}  // namespace
}  // namespace regulus::detail
