// SPDX-License-Identifier: GPL-3.0-or-later
// How far errors move platforms on legs of variable length, against published figures and against
// poses that Newton's method finds in long doubles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "codegen/question/quantity/platform_closure.hpp"
#include "tests/property/closure/checked_closures.hpp"

namespace regulus::platform_error_test {
namespace {

using verifier::Outcome;

Bound bound(const std::string& text, const std::string& freedom, double gap,
            const std::string& certificate = "") {
  ModelOptions options;
  options.motion = "m";
  const Request request = closure_of_platform(read_request(text, options));
  QuantityOptions words;
  words.quantity = "error", words.is_finite = true, words.freedom = freedom;
  BoundSettings settings;
  settings.gap = gap;
  settings.search = test::usual_options();
  settings.over_branch = bounds_over_branch();
  settings.certificate = certificate;
  return bound_quantity(request, quantity_of(request.model, words), settings,
                        [](const ComponentBound&) {});
}

/// The 3-RPR of ALIAS by its anchors.
std::string planar(const std::string& error, const std::string& motion,
                   const std::string& more = "") {
  return "regulus = 1\nname = \"3-RPR\"\n[legs]\nunit = \"cm\"\n" + more +
         "[[legs.leg]]\ntype = \"RPR\"\nbase = [0, 0]\nplatform = [0, 0]\n"
         "[[legs.leg]]\ntype = \"RPR\"\nbase = [10, 0]\nplatform = [4, 0]\n"
         "[[legs.leg]]\ntype = \"RPR\"\nbase = [3, 10]\nplatform = [2, 2]\n"
         "[actuators]\nerror = " +
         error + "\n[motion.m]\n" + motion;
}

constexpr const char* kMiddle = "x = 5\ny = 5\nphi = 0\n";

/// The figures are those of the legs' lengths at this pose.
TEST(PlatformError, MeetsThePublishedFiguresOfA3Rpr) {
  const struct {
    const char* spread;
    double errors[3];
  } cases[] = {{"0.05", {0.17043, 0.24092, 0.08127}}, {"0.2", {0.93150, 1.03156, 0.44133}}};
  for (const auto& [spread, errors] : cases) {
    const Bound found = bound(planar(spread, kMiddle), "", 0.02);
    ASSERT_EQ(found.components.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const ComponentBound& c = found.components[i];
      ASSERT_TRUE(c.is_closed && c.attained && c.proved) << c.component.label << c.reason;
      EXPECT_LE(c.attained->approx, errors[i] + 1e-5) << c.component.label;
      EXPECT_GE(c.proved->approx, errors[i] - 1e-5) << c.component.label;
    }
  }
}

using Real = long double;
using Vector = std::array<Real, 3>;
using Matrix = std::array<Vector, 3>;

Vector operator+(const Vector& u, const Vector& v) {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}
Vector operator-(const Vector& u, const Vector& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
Vector operator*(const Matrix& A, const Vector& v) {
  Vector result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i] += A[i][j] * v[j];
  return result;
}
Matrix operator*(const Matrix& A, const Matrix& B) {
  Matrix result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) result[i][j] += A[i][k] * B[k][j];
  return result;
}

/// The rotation about axis 0, 1 or 2.
Matrix turn(int axis, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  Matrix R{};
  R[axis][axis] = 1, R[i][i] = R[j][j] = c, R[i][j] = -s, R[j][i] = s;
  return R;
}

constexpr Real kBase[6][3] = {{-9, 9, 0},  {9, 9, 0},    {12, -3, 0},
                              {3, -13, 0}, {-3, -13, 0}, {-12, -3, 0}},
               kPlatform[6][3] = {{-3, 7, 0}, {3, 7, 0},   {7, -1, 0},
                                  {4, -6, 0}, {-4, -6, 0}, {-7, -1, 0}};

/// A hexapod with errors of its legs, and of its anchors at the base.
struct Hexapod {
  std::array<Real, 2> pose{};                 ///< x and theta
  std::array<Real, 6> legs{};                 ///< errors
  std::array<std::array<Real, 3>, 6> base{};  ///< the same

  [[nodiscard]] Matrix orientation() const { return turn(2, 0) * turn(0, pose[1]) * turn(2, 0); }
  [[nodiscard]] static Real length(const Vector& v) {
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  [[nodiscard]] Vector position() const { return {pose[0], 1, 47}; }

  /// How far the platform is off its commanded pose: e, and roll, pitch, yaw.
  [[nodiscard]] std::array<Real, 6> deviation() const {
    std::array<Real, 6> p{};
    for (int step = 0; step < 12; ++step) {
      std::array<std::array<Real, 7>, 6> A{};
      const auto value = residuals(p);
      for (int k = 0; k < 6; ++k) {
        auto moved = p;
        const Real h = 1e-7L;
        moved[k] += h;
        const auto there = residuals(moved);
        for (int i = 0; i < 6; ++i) A[i][k] = (there[i] - value[i]) / h;
      }
      for (int i = 0; i < 6; ++i) A[i][6] = value[i];
      solve(A);
      for (int i = 0; i < 6; ++i) p[i] -= A[i][6];
    }
    return p;
  }

 private:
  [[nodiscard]] std::array<Real, 6> residuals(const std::array<Real, 6>& p) const {
    const Matrix R = orientation(), E = turn(2, p[5]) * turn(1, p[4]) * turn(0, p[3]);
    std::array<Real, 6> result{};
    for (int k = 0; k < 6; ++k) {
      const Vector b{kPlatform[k][0], kPlatform[k][1], kPlatform[k][2]};
      const Vector nominal{kBase[k][0], kBase[k][1], kBase[k][2]};
      const Vector a = nominal + Vector{base[k][0], base[k][1], base[k][2]};
      const Real commanded = length(position() + R * b - nominal) + legs[k];
      result[k] = length(position() + Vector{p[0], p[1], p[2]} + E * (R * b) - a) - commanded;
    }
    return result;
  }

  static void solve(std::array<std::array<Real, 7>, 6>& A) {
    for (int k = 0; k < 6; ++k) {
      int best = k;
      for (int i = k; i < 6; ++i)
        if (std::fabs(A[i][k]) > std::fabs(A[best][k])) best = i;
      std::swap(A[k], A[best]);
      for (int i = 0; i < 6; ++i) {
        if (i == k) continue;
        const Real factor = A[i][k] / A[k][k];
        for (int j = k; j < 7; ++j) A[i][j] -= factor * A[k][j];
      }
    }
    for (int k = 0; k < 6; ++k) A[k][6] /= A[k][k];
  }
};

constexpr double kLegs = 0.001, kAnchors = 0.001;

std::string hexapod(const std::string& more = "") {
  std::string base, platform;
  for (int k = 0; k < 6; ++k) {
    base += fmt::format("[{}, {}, 0], ", double(kBase[k][0]), double(kBase[k][1]));
    platform += fmt::format("[{}, {}, 0], ", double(kPlatform[k][0]), double(kPlatform[k][1]));
  }
  return fmt::format(
      "regulus = 1\nname = \"hexapod\"\n[gough]\norientation = \"euler-zxz\"\nunit = \"cm\"\n"
      "base = [{}]\nplatform = [{}]\nbase_tolerance = {}\n[actuators]\nerror = {}\n"
      "[motion.m]\nx = [-1, 1]\ny = 1\nz = 47\npsi = 0\ntheta = [-0.05, 0.05]\nphi = 0\n{}",
      base, platform, kAnchors, kLegs, more);
}

/// Looks for the largest deviation: at corners of the errors, which are changed one after another.
Real largest_seen(std::size_t freedom, int tries) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  Real most = 0;
  for (int i = 0; i < tries; ++i) {
    Hexapod robot;
    robot.pose = {part(random), 0.05 * part(random)};
    std::vector<Real*> signs;
    for (Real& leg : robot.legs) leg = random() % 2 == 0 ? kLegs : -kLegs, signs.push_back(&leg);
    for (auto& anchor : robot.base)
      for (Real& x : anchor) x = random() % 2 == 0 ? kAnchors : -kAnchors, signs.push_back(&x);
    Real value = std::fabs(robot.deviation()[freedom]);
    for (Real* sign : signs) {
      *sign = -*sign;
      const Real other = std::fabs(robot.deviation()[freedom]);
      other > value ? static_cast<void>(value = other) : static_cast<void>(*sign = -*sign);
    }
    most = std::fmax(most, value);
  }
  return most;
}

TEST(PlatformError, BoundsWhatNewtonFindsForAHexapod) {
  for (const auto& [name, freedom] : {std::pair<const char*, std::size_t>{"x_deviation", 0},
                                      {"z_deviation", 2},
                                      {"yaw_deviation", 5}}) {
    const ComponentBound c = bound(hexapod(), name, 0.2).components.at(0);
    ASSERT_TRUE(c.attained && c.proved) << c.reason;
    EXPECT_TRUE(c.is_closed) << c.reason;
    const Real most = largest_seen(freedom, 20);
    EXPECT_LE(most, c.proved->approx) << name;
    EXPECT_GE(most, 0.95 * c.attained->approx) << name;
  }
}

std::string text_of(const EndProof& proof) {
  std::ostringstream text;
  text << std::ifstream(proof.file).rdbuf();
  return text.str();
}

std::string with_other(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Both ends are verified and compared with the file; another file has other proofs.
void expect_compared(const std::string& model, const std::string& freedom, double gap,
                     std::initializer_list<std::pair<const char*, const char*>> changes) {
  const test::TemporaryDirectory directory;
  const ComponentBound c =
      bound(model, freedom, gap, (directory.path() / "bound").string()).components.at(0);
  ASSERT_TRUE(c.attained && c.proved) << c.reason;
  for (const EndProof& proof : {c.proofs.safe(), c.proofs.singular()}) {
    const std::string text = text_of(proof);
    const verifier::Verification v = test::verified(text, model);
    EXPECT_EQ(v.outcome, Outcome::kVerified) << describe(v) << text.substr(0, 4000);
    for (const auto& [from, to] : changes) {
      const verifier::Verification other = test::verified(text, with_other(model, from, to));
      EXPECT_EQ(other.outcome, Outcome::kRejected) << from << describe(other);
    }
  }
}

TEST(PlatformError, IsVerifiedAndComparedWithItsModel) {
  const std::string motion = "x = [4.9, 5.1]\ny = 5\nphi = \"1/10\"\n";
  expect_compared(planar("0.002", motion, "base_tolerance = 0.001\n"), "x_deviation", 0.1,
                  {{"error = 0.002", "error = 0.003"},
                   {"base = [3, 10]", "base = [3, 11]"},
                   {"platform = [2, 2]", "platform = [2, 1]"},
                   {"base_tolerance = 0.001", "base_tolerance = 0.002"},
                   {"x = [4.9", "x = [4.8"},
                   {"y = 5", "y = 4"},
                   {"\ny = 5", "\nerror = { x = \"1/1000\" }\ny = 5"}});
}

/// The equations are about the pose that is commanded, so a proof about one with errors is none.
TEST(PlatformError, HasNoErrorsOfThePose) {
  const std::string model =
      planar("0.002", "x = 5\ny = 5\nphi = \"1/10\"\n", "base_tolerance = 0.001\n");
  const test::TemporaryDirectory directory;
  const ComponentBound c =
      bound(model, "x_deviation", 0.1, (directory.path() / "bound").string()).components.at(0);
  ASSERT_TRUE(c.proved) << c.reason;
  std::string proof = text_of(c.proofs.safe());
  const std::size_t sum = proof.find("\nsha256 ") + 8;
  proof.replace(sum, proof.find('\n', sum) - sum, "-");  // or the file is another by its digest
  proof = with_other(proof, "\npose x = 5\n", "\npose x = 5 +- 1/1000\n");
  proof = with_other(proof, "of the 9 uncertain quantities", "of the 10 uncertain quantities");
  const verifier::Verification v =
      test::verified(proof, with_other(model, "\ny = 5", "\nerror = { x = \"1/1000\" }\ny = 5"));
  EXPECT_EQ(v.outcome, Outcome::kUnfinished) << describe(v);
  EXPECT_NE(describe(v).find("the pose has errors of its own"), std::string::npos) << describe(v);
}

TEST(PlatformError, OfAHexapodIsVerifiedAndComparedWithItsModel) {
  expect_compared(hexapod(), "z_deviation", 0.2,
                  {{"error = 0.001", "error = 0.003"},
                   {"[-9, 9, 0]", "[-9, 8, 0]"},
                   {"base_tolerance = 0.001", "base_tolerance = 0.002"},
                   {"z = 47", "z = 46"}});
}

TEST(PlatformError, IsThatOfLegsAndAnchors) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      ModelOptions options;
      options.motion = "m";
      (void)closure_of_platform(read_request(text, options));
    } catch (const UsageError& why) {
      return why.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(hexapod()), "");
  EXPECT_NE(refusal(hexapod("error = { x = 0.1 }\n")).find("leave the motion's error"),
            std::string::npos);
  EXPECT_NE(refusal("regulus = 1\nname = \"arm\"\n[serial]\njoints = [{ name = \"q\" }]\n"
                    "[motion.m]\nq = 0\n")
                .find("six telescopic legs"),
            std::string::npos);
}

}  // namespace
}  // namespace regulus::platform_error_test
