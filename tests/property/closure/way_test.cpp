// SPDX-License-Identifier: GPL-3.0-or-later
// Branches that are followed along way-points, compared with closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>

#include "tests/property/closure/checked_ways.hpp"
#include "tests/property/closure/four_bars.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;

double at_part(double from, double to, double s) { return from + s * (to - from); }

/// Every place of the way has the configuration of the linkage, and not that of its mirror.
void expect_configurations(const FourBar& linkage, const CheckedWay& checked,
                           const std::vector<double>& places) {
  for (std::size_t k = 0; k + 1 < places.size(); ++k)
    for (int i = 0; i <= 16; ++i) {
      const double s = i / 16.0;
      const FourBar::Angles angles = linkage.at(at_part(places[k], places[k + 1], s));
      const std::vector<Interval> unknowns = unknowns_on(checked, k, s);
      for (const auto& [value, interval] :
           {std::pair(angles.phi, unknowns[0]), std::pair(angles.psi, unknowns[1])}) {
        const double turns = std::round((mid(interval) - value) / (2 * std::numbers::pi));
        const double moved = value + turns * 2 * std::numbers::pi;
        EXPECT_GE(moved, interval.lo - 1e-9);
        EXPECT_LE(moved, interval.hi + 1e-9);
      }
    }
}

/// Returns the first segment that leaves the toggles; the number of segments if none does.
std::size_t first_beyond(const FourBar& linkage, const std::vector<double>& places, double room) {
  for (std::size_t k = 0; k + 1 < places.size(); ++k)
    for (int i = 0; i <= 2000; ++i)
      if (!linkage.is_between_toggles(at_part(places[k], places[k + 1], i / 2000.0), room))
        return k;
  return places.size() - 1;
}

TEST(AWayOfAFourBar, HasTheVerdictAndTheConfigurationsOfItsClosedForm) {
  std::mt19937 random(11);
  int regular = 0, later = 0, first = 0;
  for (int count = 0; count < trials(24, 80);) {
    const FourBar linkage = random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3), step(-2, 2);
    std::vector<double> places{angle(random)};
    if (!linkage.is_between_toggles(places[0], 0.05)) continue;
    for (std::size_t k = 1 + random() % 5; k > 0; --k)
      places.push_back(places.back() + step(random));
    const std::size_t beyond = first_beyond(linkage, places, 0);
    const bool is_regular = beyond + 1 == places.size();
    if (beyond != first_beyond(linkage, places, 0.02)) continue;
    ++count;
    const std::string model =
        linkage.text(places[0], places[0] - 1, places[0] + 1, count % 4 == 0 ? 1e-4 : 0);
    const WayFile file(table_of(places));
    const CheckedWay checked = check_way_text(model, file.path());
    ASSERT_EQ(checked.verdict(), is_regular ? Verdict::kNoSingularity : Verdict::kSingularity)
        << model << table_of(places) << checked.claim();
    const std::string certificate = certified_way(checked);
    const verifier::Verification v = verified_way(certificate, model, file.path());
    EXPECT_EQ(v.outcome, Outcome::kVerified) << model << table_of(places) << describe(v);
    if (is_regular) {
      ++regular;
      EXPECT_EQ(v.pieces, places.size() - 1);
      expect_configurations(linkage, checked, places);
    } else {
      ASSERT_EQ(checked.found.deciding->index, beyond);
      ++(beyond == 0 ? first : later);
      const double s = mid(checked.found.deciding->fold->place[0]);
      const double diagonal = linkage.diagonal(at_part(places[beyond], places[beyond + 1], s));
      EXPECT_NEAR(std::fmin(std::fabs(diagonal - std::fabs(linkage.b - linkage.c)),
                            std::fabs(diagonal - linkage.b - linkage.c)),
                  0, 1e-7);
    }
  }
  EXPECT_GE(regular, trials(5, 20));
  EXPECT_GE(later, trials(3, 12));
  EXPECT_GE(first, trials(3, 12));
}

/// A way that only just does not reach a toggle, or just does, is never said to be regular if it is not.
TEST(AWayOfAFourBar, ThatTouchesAToggleIsNotRegular) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const double toggle = std::acos((0.04 + 0.2025 - std::pow(0.35355 + 0.25, 2)) / (2 * 0.2 * 0.45));
  for (const double beyond : {1e-2, 1e-4, 1e-7, 1e-12}) {
    const std::vector<double> places{1, -0.5, toggle + beyond, 1};
    const WayFile file(table_of(places));
    const CheckedWay checked = check_way_text(linkage.text(1, 0, 2), file.path(), few_boxes());
    EXPECT_NE(checked.verdict(), Verdict::kNoSingularity) << beyond;
    ASSERT_TRUE(checked.found.deciding);
    EXPECT_EQ(checked.found.deciding->index, 1U) << beyond;
  }
  const WayFile before(table_of({1, -0.5, toggle - 1e-3, 1}));
  EXPECT_EQ(check_way_text(linkage.text(1, 0, 2), before.path()).verdict(),
            Verdict::kNoSingularity);
}

/// Way-points where the search of one piece cuts it, the way there and back, and places without a way.
TEST(AWayOfAFourBar, MayStopTurnAndStandStill) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const std::string model = linkage.text(0.5, 0, 2, 1e-3);
  for (const std::vector<double>& places :
       std::vector<std::vector<double>>{{0.5, -2, 0.5, -2, 0.5},
                                        {0.5, 0.25, 0, -0.25, -0.5, 1},
                                        {0.5, 0.5, 0.5, 1.5, 1.5, 0.5},
                                        {0.5, 0.5},
                                        {0.5, 0.5 + 0x1p-40, 0.5}}) {
    const WayFile file(table_of(places));
    const CheckedWay checked = check_way_text(model, file.path());
    ASSERT_EQ(checked.verdict(), Verdict::kNoSingularity) << table_of(places) << checked.claim();
    expect_configurations(linkage, checked, places);
    const verifier::Verification v = verified_way(certified_way(checked), model, file.path());
    EXPECT_EQ(v.outcome, Outcome::kVerified) << table_of(places) << describe(v);
  }
}

/// Two motors, and the point where the couplers meet: circles of the same radius about both elbows.
struct FiveBar {
  static constexpr double kHalf = 0.5, kCrank = 1, kCoupler = 1.25;

  static std::complex<double> point(double theta1, double theta2) {
    const std::complex<double> a = -kHalf + std::polar(kCrank, theta1),
                               b = kHalf + std::polar(kCrank, theta2), way = b - a;
    const double height = std::sqrt(kCoupler * kCoupler - std::norm(way) / 4);
    return (a + b) / 2.0 + way / std::abs(way) * std::complex<double>(0, height);
  }
  static std::string text(double theta1, double theta2, double error) {
    const std::complex<double> p = point(theta1, theta2);
    return fmt::format(
        "regulus = 1\nname = \"five-bar\"\n[pose]\ntheta1 = \"rad\"\ntheta2 = \"rad\"\n[let]\n"
        "e1_x = \"x + 0.5 - cos(theta1)\"\ne1_y = \"y - sin(theta1)\"\n"
        "e2_x = \"x - 0.5 - cos(theta2)\"\ne2_y = \"y - sin(theta2)\"\n[closure]\n"
        "unknowns = {{ x = \"m\", y = \"m\" }}\nequations = [\"e1_x^2 + e1_y^2 - 1.25^2\", "
        "\"e2_x^2 + e2_y^2 - 1.25^2\"]\nstart = {{ theta1 = \"{:.17g}\", theta2 = \"{:.17g}\", x = "
        "\"{:.17g}\", y = \"{:.17g}\" }}\n[motion.m]\ntheta1 = [0, 3]\ntheta2 = [0, 3]\nerror = {{ "
        "theta1 = \"{:.17g}\", theta2 = \"{:.17g}\" }}\n",
        theta1, theta2, p.real(), p.imag(), error, error);
  }
};

TEST(AWayOfAFiveBar, HasThePlacesOfItsClosedForm) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> of_first(1.5, 2.3), of_second(0.9, 1.6);
  for (int count = 0; count < trials(6, 20); ++count) {
    std::vector<std::pair<double, double>> places;
    std::string table = "theta2,theta1\n";
    for (int k = 0; k < 4; ++k) {
      places.emplace_back(of_first(random), of_second(random));
      table += fmt::format("{:.17g},{:.17g}\n", places.back().second, places.back().first);
    }
    const std::string model =
        FiveBar::text(places[0].first, places[0].second, count % 2 == 0 ? 0 : 0.002);
    const WayFile file(table);
    const CheckedWay checked = check_way_text(model, file.path());
    ASSERT_EQ(checked.verdict(), Verdict::kNoSingularity) << model << table << checked.claim();
    for (std::size_t k = 0; k < 3; ++k)
      for (int i = 0; i <= 8; ++i) {
        const double s = i / 8.0;
        const std::complex<double> p =
            FiveBar::point(at_part(places[k].first, places[k + 1].first, s),
                           at_part(places[k].second, places[k + 1].second, s));
        const std::vector<Interval> unknowns = unknowns_on(checked, k, s);
        EXPECT_NEAR(p.real(), mid(unknowns[0]), rad_ru(unknowns[0]) + 1e-9);
        EXPECT_NEAR(p.imag(), mid(unknowns[1]), rad_ru(unknowns[1]) + 1e-9);
      }
    const verifier::Verification v = verified_way(certified_way(checked), model, file.path());
    EXPECT_EQ(v.outcome, Outcome::kVerified) << model << table << describe(v);
  }
}

/// p + iq is the square root of x + iy: around 0 it comes back with the other sign.
const std::string kRoot =
    "regulus = 1\nname = \"root\"\n[pose]\nx = \"m\"\ny = \"m\"\n[closure]\n"
    "unknowns = { p = \"m\", q = \"m\" }\nequations = [\"p^2 - q^2 - x\", \"2*p*q - y\"]\n"
    "start = { x = 1, y = 0, p = 1, q = 0 }\n[motion.m]\nx = [-2, 2]\ny = [-2, 2]\n";

TEST(AWayAroundABranchPoint, ComesBackOnTheOtherSheet) {
  const std::string round = "0,1\n-1,0\n0,-1\n1,0\n";
  for (const int rounds : {1, 2}) {
    const WayFile file("x,y\n1,0\n" + round + (rounds == 2 ? round : ""));
    const CheckedWay checked = check_way_text(kRoot, file.path());
    ASSERT_EQ(checked.verdict(), Verdict::kNoSingularity) << checked.claim();
    const std::vector<Interval> end = unknowns_on(checked, 4U * unsigned(rounds) - 1, 1);
    EXPECT_TRUE(contains(end[0], rounds == 1 ? -1 : 1));
    EXPECT_LT(width_ru(end[0]), 0.5);
    const verifier::Verification v = verified_way(certified_way(checked), kRoot, file.path());
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  }
  // Through 0 there is no regular way.
  const WayFile through("x,y\n1,0\n-1,0\n");
  EXPECT_NE(check_way_text(kRoot, through.path(), few_boxes()).verdict(), Verdict::kNoSingularity);
}

TEST(AWayOfAClosure, IsTheSameForAllNumbersOfThreads) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const WayFile file(table_of({0.5, -2, 1.7, -1})), beyond(table_of({0.5, -2, 2.4}));
  for (const WayFile* way : {&file, &beyond}) {
    SearchOptions two = usual_options();
    two.threads = 2;
    const std::string model = linkage.text(0.5, 0, 2, 1e-3);
    const std::string certificate = certified_way(check_way_text(model, way->path()));
    EXPECT_FALSE(certificate.empty());
    EXPECT_EQ(certificate, certified_way(check_way_text(model, way->path(), two)));
  }
}

/// The names of a piece are none of the model's.
TEST(AWayOfAClosure, MayHaveUnknownsWithTheNamesOfAPiece) {
  const std::string model =
      "regulus = 1\nname = \"slider\"\n[pose]\nx = \"m\"\n[geometry]\ns_ = 1\n[closure]\n"
      "unknowns = { s = \"m\", x_c1 = \"m\" }\n"
      "equations = [\"s^2 - x - s_\", \"x_c1 - s - x\"]\n"
      "start = { x = 0, s = 1, x_c1 = 1 }\n[motion.m]\nx = [-0.5, 1]\n";
  const WayFile file("x\n0\n1\n-0.75\n");
  const CheckedWay checked = check_way_text(model, file.path());
  ASSERT_EQ(checked.verdict(), Verdict::kNoSingularity) << checked.claim();
  const verifier::Verification v = verified_way(certified_way(checked), model, file.path());
  EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
}

TEST(AWayOfAClosure, BeginsAtTheStart) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  const WayFile file(table_of({0.6, 1}));
  try {
    static_cast<void>(check_way_text(linkage.text(0.5, 0, 2), file.path()));
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), HasSubstr("does not contain the start"));
    EXPECT_THAT(error.what(), HasSubstr("let the way-points begin at closure.start"));
  }
}

}  // namespace
}  // namespace regulus::detail::test
