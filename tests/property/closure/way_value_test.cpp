// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds over a branch along way-points, against closed forms at many places of the way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "codegen/question/closure/branch_load.hpp"
#include "tests/property/closure/checked_ways.hpp"
#include "tests/property/closure/four_bars.hpp"
#include "tests/support/trials.hpp"

namespace regulus::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;

constexpr const char* kData =
    "[actuators]\nerror = 0.01\nspeed = 2\nstiffness = 50\n[load.L]\nwrench = [[-1, 3], 2]\n";

struct AskedOnWay {
  QuantityOptions words;
  double gap = 0.02;
  std::string limit, certificate;
  std::size_t component = 0;
};

ComponentBound bound_on_way(const std::string& model, const std::string& file,
                            const AskedOnWay& asked) {
  ModelOptions options;
  options.motion = "m";
  options.waypoints = file;
  const Request request = read_request(model, options);
  BoundSettings settings;
  settings.gap = asked.gap;
  settings.search = usual_options();
  settings.over_branch = bounds_over_branch();
  settings.certificate = asked.certificate;
  Quantity quantity = quantity_of(request.model, asked.words);
  quantity.components = {quantity.components.at(asked.component)};
  if (!asked.limit.empty()) settings.limit = read_limit(asked.limit, quantity);
  return bound_quantity(request, std::move(quantity), settings, [](const ComponentBound&) {})
      .components.front();
}

QuantityOptions asked(const std::string& quantity, const std::string& norm = "") {
  QuantityOptions words;
  words.quantity = quantity;
  words.norm = norm;
  return words;
}

std::string theta_table(const std::vector<double>& places) {
  std::string text = "theta\n";
  for (const double place : places) text += fmt::format("{:.17g}\n", place);
  return text;
}

std::string text_of_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// What the closed form and differences of it give of a linkage at one angle.
struct AtAngle {
  AtAngle(const FourBar& f, double theta) {
    constexpr double h = 1e-6;
    const FourBar::Angles at = f.at(theta), above = f.at(theta + h), below = f.at(theta - h);
    const auto turned = [](double x) { return std::remainder(x, 2 * std::numbers::pi); };
    J = {turned(above.phi - below.phi) / (2 * h), turned(above.psi - below.psi) / (2 * h)};
    A << -f.b * std::sin(at.phi), f.c * std::sin(at.psi), f.b * std::cos(at.phi),
        -f.c * std::cos(at.psi);
    const Eigen::Vector2d sigma = Eigen::JacobiSVD<Eigen::Matrix2d>(A).singularValues();
    sigma_max = sigma(0), sigma_min = sigma(1);
  }
  Eigen::Vector2d J;  ///< of φ and ψ
  Eigen::Matrix2d A;  ///< the derivatives of the equations
  double sigma_max = 0, sigma_min = 0;
};

/// A quantity, its component, and its largest f for all loads and errors of kData.
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
      {"error of phi", asked("error"), 0, 1,
       [](const AtAngle& v) { return 0.01 * std::fabs(v.J[0]); }},
      {"error of psi", asked("error"), 1, 1,
       [](const AtAngle& v) { return 0.01 * std::fabs(v.J[1]); }},
      {"speed of psi", asked("speed"), 1, 1,
       [](const AtAngle& v) { return 2 * std::fabs(v.J[1]); }},
      {"force", asked("force"), 0, 1, [](const AtAngle& v) { return largest_work(v.J); }},
      {"deflection of phi", asked("deflection"), 0, 1,
       [](const AtAngle& v) { return std::fabs(v.J[0]) / 50 * largest_work(v.J); }},
      {"determinant", asked("determinant"), 0, -1,
       [](const AtAngle& v) { return -std::fabs(v.A.determinant()); }},
      {"condition", asked("condition"), 0, 1,
       [norm](const AtAngle& v) { return norm(v.A) * norm(v.A.inverse()); }},
      {"condition 2", asked("condition", "2"), 0, 1,
       [](const AtAngle& v) { return v.sigma_max / v.sigma_min; }},
      {"sigma-min", asked("sigma-min"), 0, -1, [](const AtAngle& v) { return -v.sigma_min; }},
      {"sigma-max", asked("sigma-max"), 0, 1, [](const AtAngle& v) { return v.sigma_max; }},
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
    const verifier::Verification v = verified_way(text_of_file(path + end), model, file.path());
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
    return linkage.text(places[0], places[0] - 0.1, places[0] + 0.1, tolerance) + kData;
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

TEST(BoundsOnAWay, HoldWhatConfigurationsGiveWithProofsOfBothEnds) {
  const TemporaryDirectory directory;
  for (const RegularWay& way : regular_ways(5, trials(3, 20))) {
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
}

TEST(BoundsOnAWay, AreThoseOfRangesThatTheWayCovers) {
  for (const RegularWay& way : regular_ways(17, trials(2, 8))) {
    const auto [from, to] = std::ranges::minmax(way.places);
    const std::string model = way.model();
    std::string over = way.linkage.text(way.places[0], from, to, way.tolerance) + kData;
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
    const std::string text = text_of_file(path + certificate_suffix(found.component) + end);
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
        bound_on_way(kModel, file.path(), {asked("error"), 0.02, "", path, freedom});
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
  const ComponentBound found = bound_on_way(model, file.path(), {asked("error"), 0.02, "", path});
  EXPECT_TRUE(found.is_unbounded) << found.reason;
  ASSERT_TRUE(found.place);
  EXPECT_THAT(found.place->pose, HasSubstr("segment 2"));
  EXPECT_EQ(verified_way(text_of_file(path + certificate_suffix(found.component) + ".singular"),
                         model, file.path())
                .outcome,
            Outcome::kVerified);
  const ComponentBound limit = bound_on_way(model, file.path(), {asked("error"), 0.02, "100", ""});
  EXPECT_EQ(limit.verdict, LimitVerdict::kExceeded);
  // On the way there the error is 0.01/(2p).
  const WayFile before("x\n0\n1\n-0.75\n0\n");
  const ComponentBound bounded =
      bound_on_way(model, before.path(), {asked("error"), 0.001, "", ""});
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
      const std::string text = text_of_file(path);
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

/// Certificates about one linkage, each damaged in one way.
class ADamagedValueOnAWay : public testing::Test {
 protected:
  void SetUp() override {
    const std::string path = (directory_.path() / "end").string();
    const ComponentBound found =
        bound_on_way(model_, file_.path(), {asked("error"), 0.02, "", path});
    suffix_ = certificate_suffix(found.component);
    safe_ = text_of_file(path + suffix_ + ".safe");
    attained_ = text_of_file(path + suffix_ + ".singular");
    ASSERT_EQ(outcome(safe_), Outcome::kVerified);
    ASSERT_EQ(outcome(attained_), Outcome::kVerified);
  }
  [[nodiscard]] Outcome outcome(const std::string& text, const std::string& model = "") const {
    return verified_way(text, model.empty() ? model_ : model, file_.path()).outcome;
  }
  static std::string changed(std::string text, const std::string& key, const std::string& line) {
    const std::size_t at = text.find('\n' + key + ' ') + 1;
    EXPECT_NE(at, 0U) << key;
    return text.replace(at, text.find('\n', at) - at, line);
  }
  static std::string line_of(const std::string& text, const std::string& key) {
    const std::size_t at = text.find('\n' + key + ' ') + 1;
    return text.substr(at, text.find('\n', at) - at);
  }
  void expect_refused(const std::string& text, const char* what) const {
    EXPECT_NE(outcome(text), Outcome::kVerified) << what;
    EXPECT_NE(verified(text).outcome, Outcome::kVerified) << what << ", of itself";
  }

  const FourBar linkage_{0.2, 0.35355, 0.25, 0.45};
  const std::string model_ = linkage_.text(0.5, 0, 2) + kData;
  const WayFile file_{theta_table({0.5, 1.2, 0.1, -0.4})};
  const TemporaryDirectory directory_;
  std::string suffix_, safe_, attained_;
};

TEST_F(ADamagedValueOnAWay, IsNotVerifiedAtAnotherPlace) {
  const std::string value = line_of(attained_, "value");
  std::istringstream words(value);
  std::string word, s;
  std::size_t piece = 0;
  words >> word >> piece >> s;
  EXPECT_GE(piece, 1U);
  for (std::size_t other = 0; other <= 5; ++other)
    if (other != piece)
      expect_refused(changed(attained_, "value", fmt::format("value {} {}", other, s)),
                     "on another piece");
  for (const char* const line : {"value", "value 1", "value 1 0x1p-1 0x1p-1", "value 1 -",
                                 "value 1 0x1p+1", "value -1 0x1p-1", "value x 0x1p-1"})
    expect_refused(changed(attained_, "value", line), line);
  std::string without = attained_;
  without.erase(without.find(value), value.size() + 1);
  expect_refused(without, "without its place");
  std::string safe = safe_;
  safe.insert(safe.find("\ntree\n") + 1, value + '\n');
  expect_refused(safe, "with a place");
}

TEST_F(ADamagedValueOnAWay, IsNotVerifiedWithAnotherBound) {
  const auto with_bound = [](std::string text, const std::string& bound) {
    const std::string old = line_of(text, "bound").substr(6);
    for (std::size_t at = text.find(old); at != std::string::npos && at < text.find("\nproof\n");
         at = text.find(old, at + bound.size()))
      text.replace(at, old.size(), bound);
    return text;
  };
  // Weaker claims are true, and proved by the same trees.
  EXPECT_EQ(outcome(with_bound(safe_, "1")), Outcome::kVerified);
  EXPECT_EQ(outcome(with_bound(attained_, "1/1000")), Outcome::kVerified);
  expect_refused(with_bound(safe_, "1/1000"), "a bound that is exceeded");
  expect_refused(with_bound(attained_, "1"), "a bound that is not attained");
  expect_refused(changed(safe_, "column", "column 2"), "another unknown, by the line alone");
}

TEST_F(ADamagedValueOnAWay, IsNotThatOfAnotherModelOrFile) {
  const auto model_with = [&](const std::string& old, const std::string& by) {
    std::string text = model_;
    EXPECT_NE(text.find(old), std::string::npos) << old;
    return text.replace(text.find(old), old.size(), by);
  };
  for (const std::string* const text : {&safe_, &attained_}) {
    EXPECT_EQ(outcome(*text, model_with("error = 0.01", "error = 0.02")), Outcome::kRejected);
    EXPECT_EQ(outcome(*text, model_with("d = \"0.45", "d = \"0.46")), Outcome::kRejected);
    EXPECT_EQ(outcome(*text, model_with("psi = \"1e-4\"", "psi = \"1e-3\"")), Outcome::kRejected);
    for (const std::vector<double>& places :
         std::vector<std::vector<double>>{{0.5, 1.2, 0.1},
                                          {0.5, 1.2, 0.1, -0.4, 0},
                                          {0.5, 1.3, 0.1, -0.4},
                                          {0.4, 1.2, 0.1, -0.4}}) {
      file_.write(theta_table(places));
      EXPECT_EQ(outcome(*text), Outcome::kRejected) << theta_table(places);
    }
    file_.write(theta_table({0.5, 1.2, 0.1, -0.4}));
    EXPECT_EQ(outcome(*text), Outcome::kVerified);
  }
}

TEST_F(ADamagedValueOnAWay, IsNotVerifiedWithOtherTrees) {
  for (const std::string* const text : {&safe_, &attained_}) {
    // Of the trees one is left out, or two change places.
    std::vector<std::string> parts;
    std::size_t at = 0;
    for (std::size_t next = text->find("\ntree\n"); next != std::string::npos;
         next = text->find("\ntree\n", at + 1)) {
      parts.push_back(text->substr(at, next - at));
      at = next;
    }
    const std::size_t end = text->rfind("\nend ");
    parts.push_back(text->substr(at, end - at));
    ASSERT_EQ(parts.size(), 4U);
    const auto joined = [&](const std::vector<std::size_t>& order) {
      std::string all = parts[0];
      for (const std::size_t k : order) all += parts[k];
      std::size_t leaves = 0;
      for (std::size_t l = all.find("\nl "); l != std::string::npos; l = all.find("\nl ", l + 1))
        ++leaves;
      return all + "\nend " + std::to_string(leaves) + '\n';
    };
    EXPECT_EQ(joined({1, 2, 3}), *text);
    for (const std::vector<std::size_t>& order : std::vector<std::vector<std::size_t>>{
             {1, 2}, {2, 3}, {1, 3}, {2, 1, 3}, {1, 3, 2}, {3, 2, 1}, {1, 1, 3}, {1, 2, 3, 3}, {}})
      expect_refused(joined(order), "with other trees");
  }
}

}  // namespace
}  // namespace regulus::test
