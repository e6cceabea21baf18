// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of cable robots, judged by closed forms, and by every facet of the set of wrenches that a
// robot can hold.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "codegen/question/load/force_certificate.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

struct Answer {
  FeasibilityResult result;
  ForceProblem forces;
};

PreparedForces prepared(const std::string& text, SearchOptions search = {}) {
  ModelOptions model;
  model.path = "test.toml";
  model.text = text;
  search.engine = Engine::kInterpreted;
  return prepare_forces(model, "", search, {});
}

Answer ask(const std::string& text, unsigned threads = 1, std::uint64_t boxes = 20000) {
  PreparedForces forces = prepared(text);
  FeasibilitySettings settings = settings_of(forces, nullptr);
  settings.threads = threads;
  settings.max_boxes = boxes;
  return {run_forces(
              forces, settings, [](auto, auto) {}, nullptr),
          forces.forces};
}

/// Returns the certificate of a check; empty if it claims nothing.
std::string certificate_of(const std::string& text, unsigned threads) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "proof";
  PreparedForces forces = prepared(text);
  FeasibilitySettings settings = settings_of(forces, nullptr);
  settings.threads = threads;
  settings.max_boxes = 3000;
  ForceCertificate certificate(path, forces, false, 0);
  certificate.finish(run_forces(
      forces, settings, [](auto, auto) {}, certificate.observer()));
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

FeasibilityVerdict verdict(const std::string& text) { return ask(text).result.verdict; }

/// A cart on a rail, 0 ≤ |x| ≤ e, between two pulleys at (±1, 1); tensions in [1, 10].
std::string cart(double e, double push) {
  return fmt::format(R"toml(regulus = 1
name = "cart"
[pose]
x = "m"
[matrix]
twist = ["v_x"]
rows = [["x + 1"], ["x - 1"]]
row_scale = ["1/sqrt((x + 1)^2 + 1)", "1/sqrt((x - 1)^2 + 1)"]
[actuators]
force = [1, 10]
[load.push]
force = [["-{1:.17g}", "{1:.17g}"]]
[motion.m]
x = [-{0}, {0}]
)toml",
                     e, push);
}

TEST(Feasibility, MeetsTheClosedFormOfACart) {
  for (const double e : {0.25, 0.5, 0.75}) {
    // At x = −e the first cable pulls least along the rail.
    const double most = 10 * (1 - e) / std::hypot(1 - e, 1) - (1 + e) / std::hypot(1 + e, 1);
    EXPECT_EQ(verdict(cart(e, most * (1 - 1e-9))), FeasibilityVerdict::kFeasible) << e;
    EXPECT_EQ(verdict(cart(e, most * (1 + 1e-9))), FeasibilityVerdict::kInfeasible) << e;
  }
}

/// A mass on two vertical ropes at x = 0 and x = 1, one of which has a given force of 3.
TEST(Feasibility, TakesAForceThatIsGiven) {
  const auto beam = [](double weight) {
    return fmt::format(R"toml(regulus = 1
name = "beam"
[pose]
z = "m"
[matrix]
twist = ["v_z"]
rows = [[1], [1]]
[actuators]
force = [[3, 3], [0, 2]]
[load.weight]
force = [{}]
[motion.m]
z = [0, 1]
)toml",
                       weight);
  };
  EXPECT_EQ(verdict(beam(4)), FeasibilityVerdict::kFeasible);
  EXPECT_EQ(verdict(beam(5.5)), FeasibilityVerdict::kInfeasible);
  EXPECT_EQ(verdict(beam(2.5)), FeasibilityVerdict::kInfeasible);
}

/// A planar platform, or a point, on cables.
struct Robot {
  std::vector<std::array<double, 2>> anchors, eyes;
  std::array<double, 3> weight{}, spread{};
  double least = 0, largest = 0, half = 0, turn = 0, radius = 0;
  std::size_t freedoms = 2;

  [[nodiscard]] std::string text() const {
    std::string rows, scales;
    for (std::size_t i = 0; i < anchors.size(); ++i) {
      const auto [a, b] = anchors[i];
      const auto [u, v] = eyes[i];
      const std::string bx = fmt::format("({}*cos(phi) - {}*sin(phi))", u, v);
      const std::string by = fmt::format("({}*sin(phi) + {}*cos(phi))", u, v);
      const std::string dx = fmt::format("(x + {} - ax{})", bx, i);
      const std::string dy = fmt::format("(y + {} - ({}))", by, b);
      rows += fmt::format("[\"{0}\", \"{1}\"{2}],", dx, dy,
                          freedoms == 2 ? "" : fmt::format(", \"{}*{} - {}*{}\"", bx, dy, by, dx));
      scales += fmt::format("\"1/sqrt({0}^2 + {1}^2)\",", dx, dy);
      static_cast<void>(a);
    }
    std::string text =
        "regulus = 1\nname = \"cables\"\n[pose]\nx = \"m\"\ny = \"m\"\nphi = \"rad\"\n";
    text += "[geometry]\n";
    for (std::size_t i = 0; i < anchors.size(); ++i)
      text += fmt::format("ax{} = {{ value = {}, tolerance = {} }}\n", i, anchors[i][0], radius);
    text += fmt::format("[matrix]\ntwist = [\"v_x\", \"v_y\"{}]\nrows = [{}]\nrow_scale = [{}]\n",
                        freedoms == 2 ? "" : ", \"w\"", rows, scales);
    text += fmt::format("[actuators]\nforce = [{}, {}]\n[load.weight]\nwrench = [", least, largest);
    for (std::size_t j = 0; j < freedoms; ++j)
      text += fmt::format("[{}, {}],", weight[j] - spread[j], weight[j] + spread[j]);
    return text +
           fmt::format("]\n[motion.m]\nx = [-{0}, {0}]\ny = [-{0}, {0}]\nphi = [-{1}, {1}]\n", half,
                       turn);
  }

  using Row = std::array<double, 3>;
  /// Returns J⁻¹, from geometry; `shift`: of the anchors in x.
  [[nodiscard]] std::vector<Row> inverse(double x, double y, double phi,
                                         const std::vector<double>& shift) const {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < anchors.size(); ++i) {
      const double bx = eyes[i][0] * std::cos(phi) - eyes[i][1] * std::sin(phi);
      const double by = eyes[i][0] * std::sin(phi) + eyes[i][1] * std::cos(phi);
      const double dx = x + bx - anchors[i][0] - shift[i], dy = y + by - anchors[i][1];
      const double length = std::hypot(dx, dy);
      rows.push_back({dx / length, dy / length, (bx * dy - by * dx) / length});
    }
    return rows;
  }

  /// Returns how far the wrench is inside the set that the robot holds, least over its facets. Each
  /// facet is normal to freedoms − 1 rows.
  [[nodiscard]] double reserve(const std::vector<Row>& rows, const Row& w) const {
    double least_reserve = 1e300;
    const auto look = [&](Row n) {
      double length = 0;
      for (std::size_t j = 0; j < freedoms; ++j) length += n[j] * n[j];
      length = std::sqrt(length);
      if (length < 1e-9) return;
      for (const double side : {-1.0, 1.0}) {
        double sum = 0;
        for (std::size_t j = 0; j < freedoms; ++j) sum -= side * n[j] * w[j];
        for (const Row& row : rows) {
          double along = 0;
          for (std::size_t j = 0; j < freedoms; ++j) along += side * row[j] * n[j];
          sum += along > 0 ? along * largest : along * least;
        }
        least_reserve = std::fmin(least_reserve, sum / length);
      }
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Row& a = rows[i];
      if (freedoms == 2) {
        look({-a[1], a[0], 0});
        continue;
      }
      for (std::size_t k = 0; k < i; ++k) {
        const Row& b = rows[k];
        look({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
      }
    }
    return least_reserve;
  }

  [[nodiscard]] double reserve_at_corners(const std::vector<Row>& rows) const {
    double worst = 1e300;
    for (unsigned corner = 0; corner < 1U << freedoms; ++corner) {
      Row w{};
      for (std::size_t j = 0; j < freedoms; ++j)
        w[j] = weight[j] + ((corner >> j & 1U) != 0 ? spread[j] : -spread[j]);
      worst = std::fmin(worst, reserve(rows, w));
    }
    return worst;
  }
};

/// Rounds to few digits, so that the text and the numbers of a robot agree.
double rounded(double x) { return std::stod(fmt::format("{:.4f}", x)); }

Robot random_robot(std::mt19937& random) {
  const auto between = [&](double a, double b) {
    return rounded(std::uniform_real_distribution<double>(a, b)(random));
  };
  Robot robot;
  robot.freedoms = random() % 2 == 0 ? 2 : 3;
  const std::size_t cables = robot.freedoms + 1 + random() % 2;
  for (std::size_t i = 0; i < cables; ++i) {
    const double angle = 2 * 3.14159 * (double(i) + between(0.1, 0.9)) / double(cables);
    robot.anchors.push_back({rounded(3 * std::cos(angle)), rounded(3 * std::sin(angle))});
    if (robot.freedoms == 2)
      robot.eyes.push_back({0, 0});
    else
      robot.eyes.push_back({between(-0.5, 0.5), between(-0.5, 0.5)});
  }
  robot.least = between(0.1, 1);
  robot.largest = between(5, 30);
  for (std::size_t j = 0; j < robot.freedoms; ++j) {
    const double arm = j == 2 ? 0.2 : 1;
    robot.weight[j] = rounded(arm * between(-2, 2));
    robot.spread[j] = rounded(arm * between(0, 1));
  }
  robot.half = between(0.05, 0.8);
  robot.turn = robot.freedoms == 2 ? 0 : between(0, 0.3);
  robot.radius = random() % 2 == 0 ? 0 : 0.01;
  return robot;
}

void expect_held_everywhere(const Robot& robot, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1, 1);
  for (int sample = 0; sample < 200; ++sample) {
    std::vector<double> shift;
    for (std::size_t i = 0; i < robot.anchors.size(); ++i)
      shift.push_back(part(random) > 0 ? robot.radius : -robot.radius);
    const auto rows = robot.inverse(robot.half * part(random), robot.half * part(random),
                                    robot.turn * part(random), shift);
    ASSERT_GT(robot.reserve_at_corners(rows), -1e-9) << robot.text();
  }
}

void expect_not_held(const Robot& robot, const ForceWitness& witness) {
  const auto value = [&](std::size_t v) { return mid(witness.variables[v]); };
  std::vector<double> shift;
  for (std::size_t i = 0; i < robot.anchors.size(); ++i) {
    const std::size_t variable = 3 + i;
    shift.push_back(robot.radius > 0 ? value(variable) - robot.anchors[i][0] : 0);
    EXPECT_LE(std::fabs(shift.back()), robot.radius * (1 + 1e-9));
  }
  EXPECT_LE(std::fabs(value(0)), robot.half);
  EXPECT_LE(std::fabs(value(1)), robot.half);
  EXPECT_LE(std::fabs(value(2)), robot.turn);
  const auto rows = robot.inverse(value(0), value(1), value(2), shift);
  EXPECT_LT(robot.reserve_at_corners(rows), 1e-9) << robot.text();
}

TEST(Feasibility, AgreesWithEveryFacetOfRandomCableRobots) {
  std::mt19937 random(7);
  std::array<int, 3> verdicts{};
  for (int trial = 0; trial < 60; ++trial) {
    const Robot robot = random_robot(random);
    SCOPED_TRACE(robot.text());
    const Answer answer = ask(robot.text(), 1, 3000);
    ++verdicts[static_cast<std::size_t>(answer.result.verdict)];
    if (answer.result.verdict == FeasibilityVerdict::kFeasible)
      expect_held_everywhere(robot, random);
    ASSERT_EQ(answer.result.verdict == FeasibilityVerdict::kInfeasible,
              answer.result.witness.has_value());
    if (answer.result.witness) expect_not_held(robot, *answer.result.witness);
  }
  EXPECT_GE(verdicts[0], 10);
  EXPECT_GE(verdicts[1], 10);
  EXPECT_LE(verdicts[2], 6);
}

/// The verifier chooses forces of its own, by another method.
TEST(Feasibility, IsProvedAgainForRandomCableRobots) {
  std::mt19937 random(13);
  int proofs = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const std::string text = random_robot(random).text();
    const std::string certificate = certificate_of(text, 1);
    EXPECT_EQ(certificate, certificate_of(text, 3));
    if (certificate.empty()) continue;
    std::istringstream file(certificate);
    const verifier::Verification v = verifier::verify(file);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << v.reason << text;
    ++proofs;
  }
  EXPECT_GE(proofs, 20);
}

TEST(Feasibility, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 5; ++trial) {
    const std::string text = random_robot(random).text();
    const Answer one = ask(text, 1, 2000), three = ask(text, 3, 2000);
    EXPECT_EQ(one.result.verdict, three.result.verdict);
    EXPECT_EQ(one.result.boxes, three.result.boxes);
    EXPECT_EQ(one.result.witness.has_value(), three.result.witness.has_value());
    if (one.result.witness) {
      EXPECT_EQ(one.result.witness->variables, three.result.witness->variables);
    }
  }
}

TEST(Feasibility, ClaimsNothingAboutNoPose) {
  const std::string text = cart(0.5, 1) + "constraints = [\"x^2 + 1\"]\n";
  const Answer answer = ask(text);
  EXPECT_EQ(answer.result.verdict, FeasibilityVerdict::kPossibleProblem);
  EXPECT_EQ(answer.result.reason, Reason::kEmptyVariety);
}

TEST(Feasibility, IgnoresPosesOutsideTheConstraints) {
  // |x| ≤ 2 alone is not feasible: beyond |x| = 1 both cables pull to one side.
  EXPECT_EQ(verdict(cart(2, 2)), FeasibilityVerdict::kInfeasible);
  EXPECT_EQ(verdict(cart(2, 2) + "constraints = [\"x^2 - 0.25\"]\n"),
            FeasibilityVerdict::kFeasible);
}

TEST(Feasibility, CountsThePartOfALoadInABall) {
  const auto disc = [](double radius) {
    return fmt::format(R"toml(regulus = 1
name = "point on four cables"
[pose]
x = "m"
y = "m"
[matrix]
twist = ["v_x", "v_y"]
rows = [[1, 0], [-1, 0], [0, 1], [0, -1]]
[actuators]
force = [0, 2]
[load.any]
force = {{ value = [0, 0], radius = {} }}
[motion.m]
x = [0, 1]
y = [0, 1]
)toml",
                       radius);
  };
  // The wrenches that are held are the square |w_x|, |w_y| ≤ 2.
  EXPECT_EQ(verdict(disc(1.999999)), FeasibilityVerdict::kFeasible);
  EXPECT_EQ(verdict(disc(2.000001)), FeasibilityVerdict::kInfeasible);
}

TEST(Feasibility, IsRefusedWithoutLimits) {
  std::string text = cart(0.5, 1);
  text.erase(text.find("[actuators]"), text.find("[load") - text.find("[actuators]"));
  EXPECT_THROW(static_cast<void>(prepared(text)), UsageError);
}

}  // namespace
}  // namespace regulus::detail::test
