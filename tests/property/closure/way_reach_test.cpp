// SPDX-License-Identifier: GPL-3.0-or-later
// How far a way may go, and how large its errors may be, before a linkage reaches a toggle: compared
// with closed forms.
#include <gtest/gtest.h>

#include "tests/property/closure/checked_ways.hpp"
#include "tests/property/closure/four_bars.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

/// Returns where the way from `from` towards `to` first leaves the toggles; `to` if it does not.
double first_toggle(const FourBar& linkage, double from, double to) {
  constexpr int kSteps = 4000;
  for (int i = 1; i <= kSteps; ++i) {
    const double step = (to - from) / kSteps;
    if (linkage.is_between_toggles(from + i * step)) continue;
    double within = from + (i - 1) * step, beyond = from + i * step;
    for (int k = 0; k < 60; ++k) {
      const double middle = (within + beyond) / 2;
      (linkage.is_between_toggles(middle) ? within : beyond) = middle;
    }
    return within;
  }
  return to;
}

std::string with_error(std::string model, double error) {
  return model + fmt::format("error = {{ theta = \"{:.17g}\" }}\n", error);
}

/// A way between two toggles may have errors up to the nearer one, and no larger ones. So near to the
/// toggle a search may end undecided, as one in twenty may.
TEST(AWayWithErrors, IsRegularAsLongAsItsClosedFormIs) {
  std::mt19937 random(21);
  int later = 0, undecided = 0;
  for (int count = 0; count < trials(8, 40);) {
    const FourBar linkage = random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3), part(0.8, 0.95);
    const double start = angle(random);
    if (!linkage.is_between_toggles(start, 0.05)) continue;
    const double high = first_toggle(linkage, start, start + 7),
                 low = first_toggle(linkage, start, start - 7);
    // A toggle at an angle where two of them meet has no room for errors beyond it.
    if (high - start > 5 || start - low > 5 || high - start < 0.3 || start - low < 0.3) continue;
    if (linkage.is_between_toggles(high + 0.1) || linkage.is_between_toggles(low - 0.1)) continue;
    const std::vector<double> places{start, start + part(random) * (high - start),
                                     start - part(random) * (start - low), start};
    const double room = std::fmin(high - places[1], places[2] - low);
    if (room > 0.25) continue;
    ++count;
    later += places[2] - low < high - places[1] ? 1 : 0;
    const WayFile file(table_of(places));
    const std::string model = linkage.text(start, start - 1, start + 1);
    for (const double error : {0.98 * room, 1.02 * room}) {
      const std::string text = with_error(model, error);
      const CheckedWay checked = check_way_text(text, file.path());
      if (checked.verdict() == Verdict::kPossibleProblem) {
        ++undecided;
        continue;
      }
      ASSERT_EQ(checked.verdict(), error < room ? Verdict::kNoSingularity : Verdict::kSingularity)
          << text << table_of(places) << checked.claim();
      const verifier::Verification v = verified_way(certified_way(checked), text, file.path());
      EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << text << table_of(places) << describe(v);
    }
  }
  EXPECT_GT(later, 0);
  EXPECT_LE(20 * undecided, 2 * trials(8, 40));
}

/// Returns the share of all pieces from 0 to the end of the first stretch.
double end_of_first(const std::vector<PathStretch>& stretches) {
  return double(stretches.front().end.piece) + stretches.front().end.s;
}

TEST(APavedWay, IsFreeUpToTheToggleOfItsClosedForm) {
  constexpr double kResolution = 0x1p-9;
  std::mt19937 random(22);
  int ended = 0, whole = 0;
  for (int count = 0; count < trials(12, 60);) {
    const FourBar linkage = random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3), step(-2, 2);
    std::vector<double> places{angle(random)};
    if (!linkage.is_between_toggles(places[0], 0.05)) continue;
    for (std::size_t k = 1 + random() % 4; k > 0; --k)
      places.push_back(places.back() + step(random));
    std::optional<double> end;
    bool is_clear = true;
    for (std::size_t k = 0; k + 1 < places.size() && !end; ++k) {
      const double toggle = first_toggle(linkage, places[k], places[k + 1]);
      if (toggle != places[k + 1])
        end = double(k) + (toggle - places[k]) / (places[k + 1] - places[k]);
      else
        is_clear = is_clear && linkage.is_between_toggles(toggle, 0.02);
    }
    if (!is_clear) continue;
    ++count;
    const std::string model = linkage.text(places[0], places[0] - 1, places[0] + 1);
    const WayFile file(table_of(places));
    ModelOptions options;
    options.motion = "m";
    options.waypoints = file.path();
    PreparedWay prepared = prepare_way(read_request(model, options), 0, usual_options(), {});
    const WayFinding found = pave_way(prepared, usual_options(), kResolution, {});
    const std::vector<PathStretch> stretches = stretches_of(prepared, found);
    const double pieces = double(places.size() - 1);
    ASSERT_FALSE(stretches.empty());
    EXPECT_EQ(double(stretches.back().end.piece) + stretches.back().end.s, pieces);
    EXPECT_EQ(stretches.front().claim, Claim::kFree) << model << table_of(places);
    if (!end) {
      ++whole;
      EXPECT_EQ(stretches.size(), 1U);
      EXPECT_EQ(found.result.verdict, Verdict::kNoSingularity);
      continue;
    }
    ++ended;
    EXPECT_LE(end_of_first(stretches), *end) << model << table_of(places);
    EXPECT_GE(end_of_first(stretches), *end - 32 * kResolution) << model << table_of(places);
    EXPECT_EQ(stretches.size(), 2U);
    ASSERT_TRUE(found.deciding && found.deciding->fold) << model << table_of(places);
    EXPECT_NEAR(double(found.deciding->index) + mid(found.deciding->fold->place[0]), *end, 1e-6);
  }
  EXPECT_GT(ended, 2);
  EXPECT_GT(whole, 2);
}

}  // namespace
}  // namespace regulus::detail::test
