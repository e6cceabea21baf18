// SPDX-License-Identifier: GPL-3.0-or-later
// How far errors move platforms on legs along way-points, against poses that Newton's method finds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <span>

#include "tests/property/closure/deviated_platforms.hpp"
#include "tests/property/closure/finite_ways.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::platform_way_test {
namespace {

namespace finite = test::finite_ways;
using finite::FiniteOnWay;
using test::Hexapod;
using test::Tripod;
using verifier::Outcome;

using Place = std::array<double, 3>;
const std::vector<Place> kPlaces{{4.8, 5, 0.1}, {5, 5.1, 0.12}, {5.2, 4.9, 0.05}, {4.9, 4.8, 0}};
constexpr double kLegs = 0.002, kAnchors = 0.001;
constexpr const char* kFreedoms[] = {"x_deviation", "y_deviation", "phi_deviation"};

std::string table(const std::vector<Place>& places) {
  std::string text = "x,y,phi\n";
  for (const Place& p : places) text += fmt::format("{},{},{}\n", p[0], p[1], p[2]);
  return text;
}

std::string model(const std::string& motion = "waypoints = \"way.csv\"\n") {
  return Tripod::text("0.002", motion, "base_tolerance = 0.001\n");
}

test::Real at(const Place& a, const Place& b, int i, int parts, int coordinate) {
  return a[std::size_t(coordinate)] +
         (b[std::size_t(coordinate)] - a[std::size_t(coordinate)]) * test::Real(i) / parts;
}

std::array<double, 3> seen(const std::vector<Place>& places, int parts) {
  std::array<double, 3> most{};
  for (std::size_t k = 0; k + 1 < places.size(); ++k)
    for (int i = 0; i <= parts; ++i) {
      Tripod robot;
      for (int c = 0; c < 3; ++c)
        robot.pose[std::size_t(c)] = at(places[k], places[k + 1], i, parts, c);
      const auto here = robot.largest_at_corners(kLegs, kAnchors);
      for (std::size_t c = 0; c < 3; ++c) most[c] = std::fmax(most[c], double(here[c]));
    }
  return most;
}

TEST(PlatformOnAWay, DeviatesAsNewtonFinds) {
  const test::WayFile file(table(kPlaces));
  const std::array<double, 3> most = seen(kPlaces, 20);
  for (std::size_t freedom = 0; freedom < 3; ++freedom) {
    const ComponentBound c = finite::finite_error({model(), file.path(), kFreedoms[freedom]});
    finite::expect_finite(c, most[freedom]);
    // Newton's method finds that deviation at the place that is told.
    ASSERT_TRUE(c.place);
    const auto& place = c.place->json;
    const std::size_t piece = place.at("segment").at("segment").get<std::size_t>() - 1;
    ASSERT_LT(piece + 1, kPlaces.size());
    Tripod robot;
    const char* const names[] = {"x", "y", "phi"};
    for (std::size_t k = 0; k < 3; ++k) {
      robot.pose[k] = finite::middle_of(place.at("pose").at(names[k]));
      EXPECT_GE(double(robot.pose[k]), std::fmin(kPlaces[piece][k], kPlaces[piece + 1][k]) - 1e-12);
      EXPECT_LE(double(robot.pose[k]), std::fmax(kPlaces[piece][k], kPlaces[piece + 1][k]) + 1e-12);
      const auto uncertain = [&place](const std::string& name) {
        return finite::middle_of(place.at("uncertain").at(name));
      };
      robot.legs[k] = uncertain(fmt::format("leg_{}_error", k + 1));
      EXPECT_LE(std::fabs(robot.legs[k]), kLegs);
      for (std::size_t i = 0; i < 2; ++i) {
        robot.base[k][i] =
            uncertain(fmt::format("a{}_{}", k + 1, i == 0 ? "x" : "y")) - Tripod::kBase[k][i];
        EXPECT_LE(std::fabs(robot.base[k][i]), kAnchors + 1e-12);
      }
    }
    const double there = double(std::fabs(robot.deviation()[freedom]));
    EXPECT_GE(there, c.attained->approx - 1e-12);
    EXPECT_LE(there, c.proved->approx);
  }
}

TEST(PlatformOnAWay, DeviatesAsOverTheRangeThatTheWayCovers) {
  const test::WayFile once(table({{4.8, 5, 0.1}, {5.2, 5, 0.1}})),
      parts(table({{4.8, 5, 0.1}, {4.85, 5, 0.1}, {5.1, 5, 0.1}, {5.2, 5, 0.1}})),
      back(table({{5.2, 5, 0.1}, {4.8, 5, 0.1}, {5, 5, 0.1}}));
  for (const char* freedom : kFreedoms) {
    const ComponentBound range = finite::finite_error(
                             {model("x = [4.8, 5.2]\ny = 5\nphi = \"1/10\"\n"), "", freedom}),
                         way = finite::finite_error({model(), once.path(), freedom});
    finite::expect_same(range, way);
    for (const test::WayFile* other : {&parts, &back})
      finite::expect_same(way, finite::finite_error({model(), other->path(), freedom}));
  }
}

/// Segments in another order, with the same places.
TEST(PlatformOnAWay, DeviatesTheSameInAnyOrderOfATour) {
  std::vector<Place> tour = kPlaces;
  tour.push_back(kPlaces.front());
  std::vector<Place> other(tour.rbegin() + 1, tour.rend());
  other.push_back(other.front());
  const test::WayFile first(table(tour)), second(table(other));
  for (const char* freedom : kFreedoms)
    finite::expect_same(finite::finite_error({model(), first.path(), freedom}),
                        finite::finite_error({model(), second.path(), freedom}));
}

std::string hexapod(double anchors) {
  return Hexapod::text("waypoints = \"way.csv\"\npsi = 0\nphi = 0\n", anchors);
}
constexpr const char* kWayOfHexapod = "x,y,z,theta\n-1,1,47,0\n1,1.5,46.5,0.05\n0.5,0,47,-0.05\n";

/// All anchors of the base have tolerances: there are 24 uncertain quantities.
TEST(PlatformOnAWay, OnSixLegsDeviatesAsNewtonFinds) {
  constexpr double kPlacesOfHexapod[3][4] = {
      {-1, 1, 47, 0}, {-0.5, 1.125, 46.875, 0.0125}, {0, 1.25, 46.75, 0.025}};
  std::string rows = "x,y,z,theta\n";
  for (const auto& p : kPlacesOfHexapod)
    rows += fmt::format("{},{},{},{}\n", p[0], p[1], p[2], p[3]);
  const test::WayFile file(rows);
  const std::vector<std::pair<const char*, std::size_t>> all = {{"yaw_deviation", 5},
                                                                {"z_deviation", 2}};
  for (const auto& [name, freedom] : std::span(all).first(std::size_t(test::trials(1, 2)))) {
    const ComponentBound c =
        finite::finite_error({hexapod(Hexapod::kAnchors), file.path(), name, 0.2});
    std::mt19937 random(7);
    double most = 0;
    for (std::size_t k = 0; k < 2; ++k)
      for (int i = 0; i <= 6; ++i) {
        Hexapod robot;
        const auto coordinate = [&](int j) {
          return kPlacesOfHexapod[k][j] +
                 (kPlacesOfHexapod[k + 1][j] - kPlacesOfHexapod[k][j]) * test::Real(i) / 6;
        };
        robot.pose = {coordinate(0), coordinate(1), coordinate(2), 0, coordinate(3), 0};
        most = std::fmax(most, double(robot.largest_at_corners(freedom, random)));
      }
    finite::expect_finite(c, most);
  }
}

TEST(PlatformOnAWay, OnSixLegsHasProofsOfBothEnds) {
  const test::WayFile file(kWayOfHexapod);
  const FiniteOnWay asked{hexapod(0), file.path(), "z_deviation", 0.2};
  const finite::BothEnds ends = finite::verified_ends(asked, 2);
  for (const std::string* const text : {&ends.safe, &ends.attained})
    for (const auto& [from, to] :
         {std::pair<const char*, const char*>{"error = 0.001", "error = 0.003"},
          {"[-9, 9, 0]", "[-9, 8, 0]"},
          {"base_tolerance = 0", "base_tolerance = 0.002"},
          {"psi = 0", "psi = 0.1"}})
      EXPECT_EQ(
          test::verified_way(*text, finite::with_other(asked.model, from, to), file.path()).outcome,
          Outcome::kRejected)
          << from;
}

class AForgedDeviationOnAWay : public testing::Test {
 protected:
  void SetUp() override { ends_ = finite::verified_ends(asked_, 2); }
  [[nodiscard]] Outcome outcome(const std::string& text, const std::string& model_text,
                                const std::string& file) const {
    return test::verified_way(text, model_text, file).outcome;
  }

  const std::vector<Place> places_{kPlaces.begin(), kPlaces.begin() + 3};
  const test::WayFile file_{table(places_)};
  const FiniteOnWay asked_{model(), file_.path(), "x_deviation", 0.1};
  finite::BothEnds ends_;
};

TEST_F(AForgedDeviationOnAWay, IsThatOfItsModelAndFile) {
  for (const std::string* const text : {&ends_.safe, &ends_.attained}) {
    for (const auto& [from, to] :
         {std::pair<const char*, const char*>{"error = 0.002", "error = 0.003"},
          {"base = [3, 10]", "base = [3, 11]"},
          {"platform = [2, 2]", "platform = [2, 1]"},
          {"base_tolerance = 0.001", "base_tolerance = 0.002"},
          {"waypoints", "error = { x = \"1/1000\" }\nwaypoints"}})
      EXPECT_EQ(outcome(*text, finite::with_other(asked_.model, from, to), file_.path()),
                Outcome::kRejected)
          << from;
    for (std::size_t k = 0; k < places_.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        std::vector<Place> moved = places_;
        moved[k][c] += 0.01;
        EXPECT_EQ(outcome(*text, asked_.model, test::WayFile(table(moved)).path()),
                  Outcome::kRejected)
            << k << c;
      }
    std::vector<Place> longer = places_;
    longer.push_back(places_.front());
    EXPECT_EQ(outcome(*text, asked_.model, test::WayFile(table(longer)).path()),
              Outcome::kRejected);
    longer.resize(2);
    EXPECT_EQ(outcome(*text, asked_.model, test::WayFile(table(longer)).path()),
              Outcome::kRejected);
    longer = {places_[2], places_[1], places_[0]};
    EXPECT_EQ(outcome(*text, asked_.model, test::WayFile(table(longer)).path()),
              Outcome::kRejected);
  }
}

TEST_F(AForgedDeviationOnAWay, HasNoOtherPiecesTreesOrBounds) {
  const double most = seen(places_, 20)[0];
  finite::expect_refused(finite::with_bound(ends_.safe, fmt::format("{:.9f}", 0.999 * most)),
                         asked_, "a bound that is exceeded");
  finite::expect_refused(finite::with_bound(ends_.attained, fmt::format("{:.9f}", 1.2 * most)),
                         asked_, "a bound that is not attained");
  for (const std::string* const text : {&ends_.safe, &ends_.attained}) {
    // A tree about the deviation may prove another segment, too: without errors it is 0 on both.
    for (const std::vector<std::size_t>& order :
         std::vector<std::vector<std::size_t>>{{1}, {2}, {1, 2, 2}, {1, 2, 1, 2}, {}})
      finite::expect_refused(finite::with_trees(*text, order), asked_, "other trees");
    for (const char* word : {"error", "speed", "condition"})
      finite::expect_refused(finite::with_other(*text, "\nquantity finite-error\n",
                                                fmt::format("\nquantity {}\n", word)),
                             asked_, word);
    std::size_t at = text->find("\npiece ");
    for (int k = 0; k < 2; ++k, at = text->find("\npiece ", at + 1)) {
      const std::string line = text->substr(at, text->find('\n', at + 1) - at);
      finite::expect_refused(finite::with_other(*text, line, ""), asked_, "without a piece");
      finite::expect_refused(
          finite::with_other(*text, line, finite::with_other(line, "piece ", "piece 1/1000 + ")),
          asked_, "another piece");
    }
    // The same is true from another start, and another question than that of the file.
    for (const char* start : {"1/2", "1"})
      EXPECT_EQ(
          outcome(finite::with_other(*text, "\nstart 0\n", fmt::format("\nstart {}\n", start)),
                  asked_.model, asked_.file),
          Outcome::kRejected)
          << start;
    // Without errors the deviation is 0, also at the start.
    finite::expect_refused(
        finite::with_other(*text, "unknown x_deviation = 0 ", "unknown x_deviation = 1/100 "),
        asked_, "values at the start");
    // An equation, and errors of legs, that are those of another platform; what is commanded.
    for (const auto& [from, to] :
         {std::pair<const char*, const char*>{"pose leg_1 = 0 +-", "pose leg_1 = s/1000 +-"},
          {"pose leg_1 = 0 +-", "pose leg_1 = 1/1000 +-"},
          {"pose leg_2 = 0 +- 1/500\n", "pose leg_2 = 0 +- 1/1000\n"},
          {"pose leg_3 = 0 +- 1/500\n", "pose leg_3 = 0\n"},
          {"a2_y - y", "a2_y + y"}})
      EXPECT_NE(outcome(finite::with_other(*text, from, to), asked_.model, asked_.file),
                Outcome::kVerified)
          << from << to;
  }
}

/// The commanded pose has no errors, so a tube around the way is refused, and not answered otherwise.
TEST(PlatformOnAWay, HasNoTubeAroundIt) {
  const test::WayFile file(table(kPlaces));
  try {
    static_cast<void>(finite::finite_error(
        {model("waypoints = \"way.csv\"\nerror = { x = 0.01 }\n"), file.path(), "x_deviation"}));
    FAIL();
  } catch (const UsageError& why) {
    EXPECT_NE(std::string(why.what()).find("leave the motion's error of the pose out"),
              std::string::npos)
        << why.what();
  }
}

}  // namespace
}  // namespace regulus::detail::platform_way_test
