// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds over a branch along way-points, against closed forms at many places of the way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "codegen/question/closure/branch_load.hpp"
#include "codegen/support/decomposition.hpp"
#include "tests/property/closure/checked_way_values.hpp"
#include "tests/support/files.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;

/// The values that a closed form and its differences give for a linkage at one angle.
struct AtAngle {
  AtAngle(const FourBar& f, double theta) {
    constexpr double h = 1e-6;
    const FourBar::Angles at = f.at(theta), above = f.at(theta + h), below = f.at(theta - h);
    const auto turned = [](double x) { return std::remainder(x, 2 * std::numbers::pi); };
    J = {turned(above.phi - below.phi) / (2 * h), turned(above.psi - below.psi) / (2 * h)};
    A << -f.b * std::sin(at.phi), f.c * std::sin(at.psi), f.b * std::cos(at.phi),
        -f.c * std::cos(at.psi);
    const Eigen::VectorXd sigma = singular_values(A);
    sigma_max = sigma(0), sigma_min = sigma(1);
  }
  Eigen::Vector2d J;  ///< of φ and ψ
  Eigen::Matrix2d A;  ///< the derivatives of the equations
  double sigma_max = 0, sigma_min = 0;
};

/// A quantity, its component, and its largest f for all loads and errors of kDataOfMotors.
struct Case {
  const char* what;
  QuantityOptions words;
  std::size_t component;
  double sign;  ///< of f
  std::function<double(const AtAngle&)> f;
};

double largest_work(const Eigen::Vector2d& along) {
  return std::fmax(std::fabs(-along[0] + 2 * along[1]), std::fabs(3 * along[0] + 2 * along[1]));
}

std::vector<Case> cases() {
  const auto norm = [](const Eigen::Matrix2d& M) {
    return M.cwiseAbs().rowwise().sum().maxCoeff();
  };
  return {
      {"error of phi", words_of("error"), 0, 1,
       [](const AtAngle& v) { return 0.01 * std::fabs(v.J[0]); }},
      {"error of psi", words_of("error"), 1, 1,
       [](const AtAngle& v) { return 0.01 * std::fabs(v.J[1]); }},
      {"speed of psi", words_of("speed"), 1, 1,
       [](const AtAngle& v) { return 2 * std::fabs(v.J[1]); }},
      {"force", words_of("force"), 0, 1, [](const AtAngle& v) { return largest_work(v.J); }},
      {"deflection of phi", words_of("deflection"), 0, 1,
       [](const AtAngle& v) { return std::fabs(v.J[0]) / 50 * largest_work(v.J); }},
      {"determinant", words_of("determinant"), 0, -1,
       [](const AtAngle& v) { return -std::fabs(v.A.determinant()); }},
      {"condition", words_of("condition"), 0, 1,
       [norm](const AtAngle& v) { return norm(v.A) * norm(v.A.inverse()); }},
      {"condition 2", words_of("condition", "2"), 0, 1,
       [](const AtAngle& v) { return v.sigma_max / v.sigma_min; }},
      {"sigma-min", words_of("sigma-min"), 0, -1, [](const AtAngle& v) { return -v.sigma_min; }},
      {"sigma-max", words_of("sigma-max"), 0, 1, [](const AtAngle& v) { return v.sigma_max; }},
  };
}

/// The largest f at many places of the way, and links at the ends of their tolerances.
double largest_on(const FourBar& linkage, const std::vector<double>& places, double tolerance,
                  const Case& c) {
  double most = -INFINITY;
  const std::vector<double> ends =
      tolerance > 0 ? std::vector<double>{-tolerance, 0, tolerance} : std::vector<double>{0};
  for (const double da : ends)
    for (const double db : ends) {
      FourBar other = linkage;
      other.a += da, other.b += db;
      for (std::size_t k = 0; k + 1 < places.size(); ++k)
        for (int i = 0; i <= 400; ++i) {
          const double at = places[k] + (places[k + 1] - places[k]) * i / 400;
          most = std::fmax(most, c.f({other, at}));
        }
    }
  return most;
}

/// Both ends hold what the samples say, and the samples come near them.
void expect_bracket(const ComponentBound& found, double seen, const Case& c) {
  ASSERT_TRUE(found.proved && found.attained) << c.what << ' ' << found.reason;
  EXPECT_TRUE(found.is_closed) << c.what << ' ' << found.reason;
  const double proved = c.sign * found.proved->approx, attained = c.sign * found.attained->approx;
  const double room = 1e-5 * (1 + std::fabs(seen));
  EXPECT_LE(seen, proved + room) << c.what;
  EXPECT_LE(attained, seen + 2e-3 * std::fabs(seen) + room) << c.what;
  EXPECT_LE(proved - attained, 0.021 * std::fmax(std::fabs(proved), std::fabs(attained))) << c.what;
}

void expect_proofs(const ComponentBound& found, const std::string& path, const std::string& model,
                   const WayFile& file, std::size_t pieces, const char* what) {
  for (const char* const end : {".safe", ".singular"}) {
    const verifier::Verification v = verified_way(file_contents(path + end), model, file.path());
    EXPECT_EQ(v.outcome, Outcome::kVerified) << what << end << describe(v) << found.proofs.lines();
    EXPECT_EQ(v.pieces, pieces) << what << end;
    EXPECT_FALSE(v.bound.empty());
  }
}

/// A linkage and a way on which it stays away from its toggles.
struct RegularWay {
  FourBar linkage;
  std::vector<double> places;
  double tolerance;

  [[nodiscard]] std::string model() const {
    return linkage.text(places[0], places[0] - 0.1, places[0] + 0.1, tolerance) + kDataOfMotors;
  }
};

std::vector<RegularWay> regular_ways(unsigned seed, int wanted) {
  std::mt19937 random(seed);
  std::vector<RegularWay> ways;
  while (int(ways.size()) < wanted) {
    const FourBar linkage = random_four_bar(random);
    std::uniform_real_distribution<double> angle(-3, 3), step(-0.8, 0.8);
    std::vector<double> places{angle(random)};
    for (std::size_t k = 2 + random() % 3; k > 0; --k)
      places.push_back(places.back() + step(random));
    bool is_regular = true;
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
      for (int i = 0; i <= 40; ++i)
        is_regular = is_regular && linkage.is_between_toggles(
                                       places[k] + (places[k + 1] - places[k]) * i / 40, 0.1);
    if (is_regular) ways.push_back({linkage, places, ways.size() % 3 == 2 ? 1e-3 : 0});
  }
  return ways;
}

void expect_bounds(const RegularWay& way) {
  const TemporaryDirectory directory;
  const WayFile file(theta_table(way.places));
  const std::string model = way.model();
  for (const Case& c : cases()) {
    const std::string path = (directory.path() / "end").string();
    AskedOnWay question{c.words, 0.02, "", path, c.component};
    const ComponentBound found = bound_on_way(model, file.path(), question);
    expect_bracket(found, largest_on(way.linkage, way.places, way.tolerance, c), c);
    expect_proofs(found, path + certificate_suffix(found.component), model, file,
                  way.places.size() - 1, c.what);
  }
}

TEST(BoundsOnAWay, HoldWhatConfigurationsGiveWithProofsOfBothEnds) {
  for (const RegularWay& way : regular_ways(5, trials(3, 20))) expect_bounds(way);
}

/// A tube is as narrow as rounding leaves it where the motor rests.
TEST(BoundsOnAWay, HoldWhatConfigurationsGiveWhereTheMotorRests) {
  const FourBar linkage{0.2, 0.35355, 0.25, 0.45};
  for (const double tolerance : {0.0, 1e-3})
    for (const std::vector<double>& places :
         {std::vector<double>{0.3, 0.3}, std::vector<double>{0, 0.3, 0.3, -0.2}})
      expect_bounds({linkage, places, tolerance});
}

TEST(BoundsOnAWay, AreThoseOfRangesThatTheWayCovers) {
  for (const RegularWay& way : regular_ways(17, trials(2, 8))) {
    const auto [from, to] = std::ranges::minmax(way.places);
    const std::string model = way.model();
    std::string over = way.linkage.text(way.places[0], from, to, way.tolerance) + kDataOfMotors;
    const WayFile file(theta_table(way.places));
    for (const Case& c : cases()) {
      const ComponentBound along =
          bound_on_way(model, file.path(), {c.words, 0.01, "", "", c.component});
      const ComponentBound whole = bound_on_way(over, "", {c.words, 0.01, "", "", c.component});
      ASSERT_TRUE(along.proved && whole.proved && along.attained && whole.attained) << c.what;
      EXPECT_LE(c.sign * along.attained->approx, c.sign * whole.proved->approx) << c.what;
      EXPECT_LE(c.sign * whole.attained->approx, c.sign * along.proved->approx) << c.what;
    }
  }
}

TEST(BoundsOnAWay, CompareWithALimitAndNameTheSegment) {
  const TemporaryDirectory directory;
  const RegularWay way = regular_ways(29, 1).front();
  const WayFile file(theta_table(way.places));
  const Case c = cases()[1];
  const double seen = largest_on(way.linkage, way.places, 0, c);
  for (const double part : {0.95, 1.05}) {
    const std::string path = (directory.path() / "limit").string();
    const std::string limit = fmt::format("{:.6f}", part * seen);
    const ComponentBound found =
        bound_on_way(way.model(), file.path(), {c.words, 0.02, limit, path, c.component});
    EXPECT_EQ(found.verdict, part < 1 ? LimitVerdict::kExceeded : LimitVerdict::kWithin);
    const std::string end = part < 1 ? ".singular" : ".safe";
    const std::string text = file_contents(path + certificate_suffix(found.component) + end);
    EXPECT_EQ(verified_way(text, way.model(), file.path()).outcome, Outcome::kVerified) << text;
    if (part > 1) continue;
    ASSERT_TRUE(found.place);
    EXPECT_THAT(found.place->pose, HasSubstr("segment "));
    EXPECT_TRUE(found.place->json.contains("segment"));
    EXPECT_THAT(found.place->values, HasSubstr("theta = "));
    // At the place the closed form exceeds the limit.
    const std::size_t k = found.place->json["segment"]["segment"].get<std::size_t>() - 1;
    ASSERT_LT(k + 1, way.places.size());
    const double at =
        std::stod(found.place->values.substr(found.place->values.find("theta = ") + 8));
    EXPECT_GE(at, std::fmin(way.places[k], way.places[k + 1]) - 1e-5);
    EXPECT_LE(at, std::fmax(way.places[k], way.places[k + 1]) + 1e-5);
    EXPECT_GE(c.f({way.linkage, at}), part * seen - 1e-4);
  }
}

/// Two motors and an error of the pose, against Newton's method at many places.
class FiveBarOnAWay : public testing::Test {
 protected:
  static constexpr const char* kModel =
      "regulus = 1\nname = \"five-bar\"\n[pose]\nt1 = \"rad\"\nt2 = \"rad\"\n[closure]\n"
      "unknowns = { x = \"m\", y = \"m\" }\nequations = [\"(x + 0.5 - cos(t1))^2 + (y - sin(t1))^2 "
      "- 1.5625\", \"(x - 0.5 - cos(t2))^2 + (y - sin(t2))^2 - 1.5625\"]\nstart = { t1 = 2, t2 = "
      "1, "
      "x = 0.089, y = 1.6524 }\nradius = { x = 0.3, y = 0.3 }\n[actuators]\nerror = [0.002, "
      "0.001]\n"
      "[motion.m]\nt1 = [1, 2.5]\nt2 = [0.5, 1.5]\nerror = { t1 = 0.003 }\n";
  static constexpr double kPlaces[][2] = {{2, 1}, {2.2, 0.9}, {1.8, 1.3}, {1.7, 1}};

  static Eigen::Vector2d phi(const Eigen::Vector2d& p, double t1, double t2) {
    return {std::pow(p[0] + 0.5 - std::cos(t1), 2) + std::pow(p[1] - std::sin(t1), 2) - 1.5625,
            std::pow(p[0] - 0.5 - std::cos(t2), 2) + std::pow(p[1] - std::sin(t2), 2) - 1.5625};
  }
  static Eigen::Vector2d solve(Eigen::Vector2d p, double t1, double t2) {
    for (int i = 0; i < 30; ++i) {
      Eigen::Matrix2d A;
      A << 2 * (p[0] + 0.5 - std::cos(t1)), 2 * (p[1] - std::sin(t1)),
          2 * (p[0] - 0.5 - std::cos(t2)), 2 * (p[1] - std::sin(t2));
      p -= A.inverse() * phi(p, t1, t2);
    }
    return p;
  }
};

TEST_F(FiveBarOnAWay, HasTheErrorsOfItsConfigurations) {
  const TemporaryDirectory directory;
  std::string table = "t1,t2\n";
  for (const auto& place : kPlaces) table += fmt::format("{},{}\n", place[0], place[1]);
  const WayFile file(table);
  for (const std::size_t freedom : {0U, 1U}) {
    double seen = 0;
    Eigen::Vector2d p(0, 1.6);
    for (std::size_t k = 0; k + 1 < std::size(kPlaces); ++k)
      for (int i = 0; i <= 300; ++i) {
        const double s = i / 300.0;
        const double t1 = kPlaces[k][0] + s * (kPlaces[k + 1][0] - kPlaces[k][0]);
        const double t2 = kPlaces[k][1] + s * (kPlaces[k + 1][1] - kPlaces[k][1]);
        p = solve(p, t1, t2);
        for (const double e : {-0.003, 0.0, 0.003}) {
          constexpr double h = 1e-6;
          const auto rate = [&](double h1, double h2) {
            return (solve(p, t1 + e + h1, t2 + h2)[Eigen::Index(freedom)] -
                    solve(p, t1 + e - h1, t2 - h2)[Eigen::Index(freedom)]) /
                   (2 * h);
          };
          seen = std::fmax(seen, 0.002 * std::fabs(rate(h, 0)) + 0.001 * std::fabs(rate(0, h)));
        }
      }
    const std::string path = (directory.path() / "error").string();
    const ComponentBound found =
        bound_on_way(kModel, file.path(), {words_of("error"), 0.02, "", path, freedom});
    const Case c{"error", {}, freedom, 1, {}};
    expect_bracket(found, seen, c);
    expect_proofs(found, path + certificate_suffix(found.component), kModel, file, 3, "error");
  }
}

/// p = √(1 + x): nothing is bounded where the branch ends, on the second segment.
TEST(BoundsOnAWay, EndWithTheBranch) {
  const std::string model =
      "regulus = 1\nname = \"slider\"\n[pose]\nx = \"m\"\n[closure]\nunknowns = { p = \"m\" }\n"
      "equations = [\"p^2 - x - 1\"]\nstart = { x = 0, p = 1 }\nradius = { p = 0.5 }\n[actuators]\n"
      "error = 0.01\n[motion.m]\nx = [-2, 1]\n";
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "ends").string();
  const WayFile file("x\n0\n1\n-2\n");
  const ComponentBound found =
      bound_on_way(model, file.path(), {words_of("error"), 0.02, "", path});
  EXPECT_TRUE(found.is_unbounded) << found.reason;
  ASSERT_TRUE(found.place);
  EXPECT_THAT(found.place->pose, HasSubstr("segment 2"));
  EXPECT_EQ(verified_way(file_contents(path + certificate_suffix(found.component) + ".singular"),
                         model, file.path())
                .outcome,
            Outcome::kVerified);
  const ComponentBound limit =
      bound_on_way(model, file.path(), {words_of("error"), 0.02, "100", ""});
  EXPECT_EQ(limit.verdict, LimitVerdict::kExceeded);
  // On the way there the error is 0.01/(2p).
  const WayFile before("x\n0\n1\n-0.75\n0\n");
  const ComponentBound bounded =
      bound_on_way(model, before.path(), {words_of("error"), 0.001, "", ""});
  ASSERT_TRUE(bounded.proved && bounded.attained);
  EXPECT_LE(bounded.attained->approx, 0.01);
  EXPECT_GE(bounded.proved->approx, 0.01);
  EXPECT_NEAR(bounded.attained->approx, 0.01, 2e-5);
}

/// The largest torque for the load is that of the samples: limits above it hold the load, others do not.
TEST(LoadsOnAWay, AreHeldWithinWhatVirtualWorkNeeds) {
  const TemporaryDirectory directory;
  for (const RegularWay& way : regular_ways(43, trials(3, 12))) {
    const WayFile file(theta_table(way.places));
    double seen = 0;
    for (std::size_t k = 0; k + 1 < way.places.size(); ++k)
      for (int i = 0; i <= 400; ++i) {
        const double at = way.places[k] + (way.places[k + 1] - way.places[k]) * i / 400;
        seen = std::fmax(seen, largest_work(AtAngle(way.linkage, at).J));
      }
    for (const double part : {0.97, 1.1}) {
      const std::string limits =
          fmt::format("[actuators]\nforce = [-{0:.6f}, {0:.6f}]\n", part * seen);
      const std::string model =
          way.linkage.text(way.places[0], way.places[0] - 0.1, way.places[0] + 0.1, way.tolerance) +
          limits + "[load.L]\nwrench = [[-1, 3], 2]\n";
      ModelOptions options;
      options.motion = "m";
      options.waypoints = file.path();
      PreparedBranchLoad prepared =
          prepare_branch_load(read_request(model, options), 0, "", usual_options(), {});
      const BranchLoadResult result = check_branch_load(prepared, {});
      EXPECT_EQ(result.verdict,
                part < 1 ? FeasibilityVerdict::kInfeasible : FeasibilityVerdict::kFeasible)
          << result.reason;
      const std::string path = (directory.path() / "load").string();
      const ProofStatus proof = certify_load(path, prepared, result, {});
      ASSERT_TRUE(proof.is_written()) << proof.obstacle();
      const std::string text = file_contents(path);
      const verifier::Verification v = verified_way(text, model, file.path());
      EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v);
      EXPECT_EQ(v.pieces, way.places.size() - 1);
      const std::string key = part < 1 ? "wrench = [[-1, 3], 2]" : "force = [-";
      const std::string by = part < 1 ? "wrench = [[-1, 2], 2]" : "force = [-1";
      std::string other = model;
      other.replace(other.find(key), key.size(), by);
      EXPECT_EQ(verified_way(text, other, file.path()).outcome, Outcome::kRejected);
      if (part > 1) continue;
      ASSERT_TRUE(result.shortage);
      const std::size_t k = result.shortage->piece;
      const double s = mid(result.shortage->place[0]);
      const double at = way.places[k] + (way.places[k + 1] - way.places[k]) * s;
      const double room = way.tolerance > 0 ? 0.05 * seen : 1e-4;
      EXPECT_GE(largest_work(AtAngle(way.linkage, at).J), part * seen - room);
    }
  }
}

}  // namespace
}  // namespace regulus::detail::test
