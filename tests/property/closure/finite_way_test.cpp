// SPDX-License-Identifier: GPL-3.0-or-later
// How far errors move a four-bar along way-points, against its closed form; and its forged proofs.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/property/closure/finite_ways.hpp"
#include "tests/property/closure/four_bars.hpp"

namespace regulus::detail::finite_way_test {
namespace {

namespace finite = test::finite_ways;
using finite::FiniteOnWay;
using verifier::Outcome;

constexpr test::FourBar kLinkage{0.2, 0.35355, 0.25, 0.45};
constexpr double kMotor = 0.01, kLinks = 0.002;
const std::vector<double> kPlaces{0.8, 1.2, 0.5, 0.9};

/// The model, whose motion over ranges begins at `from`.
std::string model(double from, double to) {
  return kLinkage.text(from, std::fmin(from, to), std::fmax(from, to), kLinks) +
         "error = { theta = 0.01 }\n";
}

std::array<double, 2> moved(double theta, double motor, double a, double b) {
  test::FourBar other = kLinkage;
  other.a += a, other.b += b;
  const test::FourBar::Angles actual = other.at(theta + motor), nominal = kLinkage.at(theta);
  return {std::fabs(actual.phi - nominal.phi), std::fabs(actual.psi - nominal.psi)};
}

/// The largest errors of both angles at many places of the way and corners of the errors.
std::array<double, 2> seen(const std::vector<double>& places) {
  std::array<double, 2> most{};
  for (std::size_t k = 0; k + 1 < places.size(); ++k)
    for (int i = 0; i <= 200; ++i)
      for (int corner = 0; corner < 8; ++corner) {
        const auto sign = [corner](int bit) { return (corner >> bit & 1) != 0 ? 1.0 : -1.0; };
        const double theta = places[k] + (places[k + 1] - places[k]) * i / 200;
        const auto here = moved(theta, sign(0) * kMotor, sign(1) * kLinks, sign(2) * kLinks);
        for (std::size_t j = 0; j < 2; ++j) most[j] = std::fmax(most[j], here[j]);
      }
  return most;
}

constexpr const char* kUnknowns[] = {"phi", "psi"};

TEST(FiniteErrorOnAWay, BoundsWhatTheClosedFormGives) {
  const test::WayFile file(test::theta_table(kPlaces));
  const std::array<double, 2> most = seen(kPlaces);
  for (std::size_t i = 0; i < 2; ++i) {
    const ComponentBound c =
        finite::finite_error({model(kPlaces[0], 1), file.path(), kUnknowns[i]});
    finite::expect_finite(c, most[i]);
    // It is attained at the place that is told.
    ASSERT_TRUE(c.place);
    const auto& place = c.place->json;
    const std::size_t k = place.at("segment").at("segment").get<std::size_t>() - 1;
    ASSERT_LT(k + 1, kPlaces.size());
    const auto uncertain = [&place](const char* name) {
      return finite::middle_of(place.at("uncertain").at(name));
    };
    const double error = uncertain("theta_error"),
                 theta = finite::middle_of(place.at("pose").at("theta")) - error;
    EXPECT_GE(theta, std::fmin(kPlaces[k], kPlaces[k + 1]) - 1e-12);
    EXPECT_LE(theta, std::fmax(kPlaces[k], kPlaces[k + 1]) + 1e-12);
    EXPECT_LE(std::fabs(error), kMotor);
    const auto there =
        moved(theta, error, uncertain("a") - kLinkage.a, uncertain("b") - kLinkage.b);
    EXPECT_GE(there[i], c.attained->approx - 1e-12);
    EXPECT_LE(there[i], c.proved->approx);
  }
}

TEST(FiniteErrorOnAWay, IsThatOfTheRangeThatTheWayCovers) {
  const test::WayFile once(test::theta_table({0.8, 1.2}));
  const std::string text = model(0.8, 1.2);
  for (const char* unknown : kUnknowns) {
    const ComponentBound range = finite::finite_error({text, "", unknown}),
                         way = finite::finite_error({text, once.path(), unknown});
    finite::expect_same(range, way);
    // The same places, in parts and the other way round.
    for (const std::vector<double>& places : std::vector<std::vector<double>>{
             {0.8, 0.9, 1.05, 1.2}, {0.8, 1.2, 0.8}, {0.8, 1, 0.9, 1.2}}) {
      const test::WayFile other(test::theta_table(places));
      finite::expect_same(way, finite::finite_error({text, other.path(), unknown}));
    }
  }
}

/// A tour has the same places in both directions.
TEST(FiniteErrorOnAWay, DoesNotDependOnTheDirectionOfATour) {
  const std::string text = model(0.8, 1);
  const test::WayFile there(test::theta_table({0.8, 1.1, 0.6, 0.8})),
      back(test::theta_table({0.8, 0.6, 1.1, 0.8}));
  for (const char* unknown : kUnknowns)
    finite::expect_same(finite::finite_error({text, there.path(), unknown}),
                        finite::finite_error({text, back.path(), unknown}));
}

TEST(FiniteErrorOnAWay, IsComparedWithALimit) {
  const test::WayFile file(test::theta_table(kPlaces));
  const double most = seen(kPlaces)[1];
  for (const double part : {0.95, 1.05}) {
    const test::TemporaryDirectory directory;
    const ComponentBound c = finite::finite_error({model(kPlaces[0], 1), file.path(), "psi", 0.05,
                                                   fmt::format("{:.8f}", part * most),
                                                   (directory.path() / "limit").string()});
    EXPECT_EQ(c.verdict, part < 1 ? LimitVerdict::kExceeded : LimitVerdict::kWithin) << c.reason;
    const EndProof& proof = part < 1 ? c.proofs.singular() : c.proofs.safe();
    EXPECT_EQ(test::verified_way(test::file_contents(proof.file), model(kPlaces[0], 1), file.path())
                  .outcome,
              Outcome::kVerified);
  }
}

/// The crank comes to a toggle on the second segment; the way there is finite, so no limit is exceeded.
TEST(FiniteErrorOnAWay, EndsWithTheBranch) {
  const test::WayFile file(test::theta_table({1, 1.5, 2.4, 1}));
  const ComponentBound c = finite::finite_error({model(1, 1.5), file.path(), "psi"});
  EXPECT_FALSE(c.proved);
  EXPECT_TRUE(c.is_unbounded) << c.reason;
  ASSERT_TRUE(c.place);
  EXPECT_NE(c.place->pose.find("segment 2"), std::string::npos) << c.place->pose;
  const ComponentBound limit =
      finite::finite_error({model(1, 1.5), file.path(), "psi", 0.05, "0.1"});
  EXPECT_EQ(limit.verdict, LimitVerdict::kUndecided);
}

/// The spline through 0.8, 1.2 and 0.8 has no place beyond them.
TEST(FiniteErrorOnAWay, FollowsCurves) {
  std::string text = model(0.8, 1.2);
  text =
      text.substr(0, text.find("[motion.m]")) +
      "[motion.m]\nwaypoints = \"way.csv\"\ninterpolation = \"cubic\"\nerror = { theta = 0.01 }\n";
  const test::WayFile file(test::theta_table({0.8, 1.2, 0.8}));
  const FiniteOnWay curve{text, file.path(), "psi", 0.1};
  finite::expect_same(finite::finite_error({model(0.8, 1.2), "", "psi"}),
                      finite::finite_error(curve));
  finite::verified_ends(curve, 2);
}

class AForgedFiniteErrorOnAWay : public testing::Test {
 protected:
  void SetUp() override { ends_ = finite::verified_ends(asked_, 3); }
  [[nodiscard]] Outcome outcome(const std::string& text) const {
    return test::verified_way(text, asked_.model, file_.path()).outcome;
  }

  const test::WayFile file_{test::theta_table({0.8, 1, 0.7, 0.75})};
  const FiniteOnWay asked_{model(0.8, 1), file_.path(), "psi", 0.1};
  finite::BothEnds ends_;
};

TEST_F(AForgedFiniteErrorOnAWay, HasNoOtherBound) {
  EXPECT_EQ(outcome(finite::with_bound(ends_.safe, "1")), Outcome::kVerified);
  EXPECT_EQ(outcome(finite::with_bound(ends_.attained, "1/1000")), Outcome::kVerified);
  const double most = seen({0.8, 1, 0.7, 0.75})[1];
  finite::expect_refused(finite::with_bound(ends_.safe, fmt::format("{:.9f}", 0.999 * most)),
                         asked_, "a bound that is exceeded");
  finite::expect_refused(finite::with_bound(ends_.attained, fmt::format("{:.9f}", 1.2 * most)),
                         asked_, "a bound that is not attained");
}

/// Errors to first order have other trees and other lines.
TEST_F(AForgedFiniteErrorOnAWay, IsNoOtherQuantity) {
  for (const std::string* const text : {&ends_.safe, &ends_.attained}) {
    for (const char* word : {"error", "finite", "finite-errors", "speed", "determinant"})
      finite::expect_refused(finite::with_other(*text, "\nquantity finite-error\n",
                                                fmt::format("\nquantity {}\n", word)),
                             asked_, word);
    finite::expect_refused(finite::with_other(*text, "\nside absolute\n", "\nside largest\n"),
                           asked_, "another side");
    finite::expect_refused(finite::with_other(*text, "\ncolumn 2\n", "\ncolumn 1\n"), asked_,
                           "another unknown by the line alone");
  }
}

TEST_F(AForgedFiniteErrorOnAWay, HasNoOtherTreesOrPlaces) {
  for (const std::string* const text : {&ends_.safe, &ends_.attained}) {
    EXPECT_EQ(finite::with_trees(*text, {1, 2, 3}), *text);
    for (const std::vector<std::size_t>& order : std::vector<std::vector<std::size_t>>{
             {1, 2}, {2, 3}, {2, 1, 3}, {1, 3, 2}, {3, 2, 1}, {1, 1, 3}, {1, 2, 3, 3}, {}})
      finite::expect_refused(finite::with_trees(*text, order), asked_, "other trees");
  }
  const std::size_t at = ends_.attained.find("\nvalue ") + 1;
  const std::string line = ends_.attained.substr(at, ends_.attained.find('\n', at) - at);
  std::string other = line;
  other[6] = line[6] == '1' ? '2' : '1';
  finite::expect_refused(finite::with_other(ends_.attained, line, other), asked_,
                         "on another piece");
  finite::expect_refused(finite::with_other(ends_.attained, line + '\n', ""), asked_, "nowhere");
  finite::expect_refused(finite::with_other(ends_.safe, "\ntree\n", '\n' + line + "\ntree\n"),
                         asked_, "a place of what is kept");
}

/// A piece that does not begin where the one before it ends, or with larger errors than the tubes have.
TEST_F(AForgedFiniteErrorOnAWay, HasNoOtherQuestion) {
  for (const std::string* const text : {&ends_.safe, &ends_.attained}) {
    std::size_t at = text->find("\npiece ");
    for (int k = 0; k < 3; ++k, at = text->find("\npiece ", at + 1)) {
      ASSERT_NE(at, std::string::npos);
      const std::string line = text->substr(at, text->find('\n', at + 1) - at);
      finite::expect_refused(finite::with_other(*text, line, ""), asked_, "without a piece");
      finite::expect_refused(finite::with_other(*text, line, line + line), asked_,
                             "one piece twice");
      finite::expect_refused(
          finite::with_other(*text, line, finite::with_other(line, "piece ", "piece 1/1000 + ")),
          asked_, "another piece");
    }
    finite::expect_refused(finite::with_other(*text, "+- 1/100\n", "+- 1/10\n"), asked_, "errors");
    finite::expect_refused(finite::with_other(*text, "+- 1/500\n", "+- 1/20\n"), asked_,
                           "tolerances");
  }
}

TEST_F(AForgedFiniteErrorOnAWay, IsThatOfItsModelAndFile) {
  for (const std::string* const text : {&ends_.safe, &ends_.attained}) {
    for (const auto& [from, to] :
         {std::pair<const char*, const char*>{"theta = 0.01", "theta = 0.02"},
          {"tolerance = \"0.002", "tolerance = \"0.003"},
          {"d = \"0.45", "d = \"0.46"},
          {"psi = \"1e-4\"", "psi = \"1e-3\""}})
      EXPECT_EQ(test::verified_way(*text, finite::with_other(asked_.model, from, to), file_.path())
                    .outcome,
                Outcome::kRejected)
          << from;
    for (const std::vector<double>& places : std::vector<std::vector<double>>{
             {0.8, 1, 0.7}, {0.8, 1, 0.7, 0.75, 0.8}, {0.8, 1.1, 0.7, 0.75}, {0.9, 1, 0.7, 0.75}}) {
      const test::WayFile other(test::theta_table(places));
      EXPECT_EQ(test::verified_way(*text, asked_.model, other.path()).outcome, Outcome::kRejected)
          << test::theta_table(places);
    }
  }
}

}  // namespace
}  // namespace regulus::detail::finite_way_test
