// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of poses whose anchors and lengths have tolerances and errors. The oracle is Newton's
// method in doubles, on platforms at corners of the set.
#include <fmt/format.h>

#include <cmath>

#include "tests/property/solve/certified_lists.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::test {
namespace {

using Numbers = std::vector<double>;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Solves n equations in n unknowns; empty: it does not converge.
template <class Equations>
Numbers newton(const Equations& equations, Numbers x) {
  const std::size_t n = x.size();
  for (int step = 0; step < 40; ++step) {
    const Numbers value = equations(x);
    std::vector<Numbers> rows(n);
    for (std::size_t i = 0; i < n; ++i) rows[i].push_back(-value[i]);
    for (std::size_t k = 0; k < n; ++k) {
      Numbers up = x, down = x;
      up[k] += 1e-6, down[k] -= 1e-6;
      const Numbers a = equations(up), b = equations(down);
      for (std::size_t i = 0; i < n; ++i) rows[i].insert(rows[i].end() - 1, (a[i] - b[i]) / 2e-6);
    }
    double size = 0;
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k; i < n; ++i)
        if (std::fabs(rows[i][k]) > std::fabs(rows[pivot][k])) pivot = i;
      std::swap(rows[k], rows[pivot]);
      if (!(std::fabs(rows[k][k]) > 1e-14)) return {};
      for (std::size_t i = 0; i < n; ++i) {
        const double factor = i == k ? 0 : rows[i][k] / rows[k][k];
        for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      const double change = rows[k][n] / rows[k][k];
      x[k] += change;
      size = std::max(size, std::fabs(change));
    }
    if (!(size < 1e3)) return {};
    if (size < 1e-12) return x;
  }
  return {};
}

/// The intervals of each line `solution`.
std::vector<std::vector<Interval>> tubes_of(const std::string& certificate) {
  std::vector<std::vector<Interval>> tubes;
  for (const std::string& line : lines_of(certificate)) {
    if (!line.starts_with("solution ")) continue;
    std::istringstream words(line.substr(9));
    tubes.emplace_back();
    for (std::string word; words >> word;)
      tubes.back().emplace_back(std::stod(word), std::stod(word.substr(word.find(':') + 1)));
  }
  return tubes;
}

bool is_within(const Numbers& x, const std::vector<Interval>& tube) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(tube[i].lo <= x[i] && x[i] <= tube[i].hi)) return false;
  return true;
}

Numbers middle_of(const std::vector<Interval>& tube) {
  Numbers x;
  for (const Interval& part : tube) x.push_back(mid(part));
  return x;
}

std::string planar(const std::string& base_tolerance, const std::string& error) {
  return replaced(
      replaced(library_model("rpr_6"), "[legs]", "[legs]\nbase_tolerance = " + base_tolerance),
      "[motion.legs]", "[motion.legs]\nerror = { legs = " + error + " }");
}

/// Anchors of the library's 3-RPR, moved, and its lengths.
struct PlanarRobot {
  std::array<std::array<double, 2>, 3> a{{{0, 0}, {15.91, 0}, {0, 10}}},
      b{{{0, 0}, {17.04, 0}, {20.84 * std::cos(0.8826031098), 20.84 * std::sin(0.8826031098)}}};
  std::array<double, 3> length{14.98, 15.38, 12};

  Numbers operator()(const Numbers& x) const {
    Numbers value;
    const double c = std::cos(x[2]), s = std::sin(x[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const double u = x[0] + c * b[i][0] - s * b[i][1] - a[i][0],
                   v = x[1] + s * b[i][0] + c * b[i][1] - a[i][1];
      value.push_back(u * u + v * v - length[i] * length[i]);
    }
    return value;
  }
};

TEST(PlanarListsWithTolerances, HaveAPoseInEachTubeAtEachCorner) {
  constexpr double kTolerance = 0.002, kError = 0.001;
  const Certified made = certified(planar("0.002", "0.001"));
  ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
  EXPECT_EQ(made.solutions.completeness, Completeness::kComplete);
  EXPECT_FALSE(made.solutions.is_nominal);
  const auto tubes = tubes_of(made.text);
  ASSERT_EQ(tubes.size(), 6U);
  RandomSource random(3);
  const auto side = [&](double size) { return random.between(-1, 1) < 0 ? -size : size; };
  for (int round = 0; round < 20; ++round) {
    PlanarRobot robot;
    for (auto& anchor : robot.a)
      for (double& x : anchor) x += side(kTolerance);
    for (double& length : robot.length) length += side(kError);
    for (const auto& tube : tubes) {
      const Numbers pose = newton(robot, middle_of(tube));
      ASSERT_EQ(pose.size(), 3U);
      EXPECT_TRUE(is_within(pose, tube));
    }
  }
}

TEST(PlanarListsWithTolerances, AreVerifiedWithTheirFile) {
  const std::string model = planar("0.002", "0.001");
  const Certified made = certified(model);
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(
      v.claim,
      "at every value of the 9 uncertain quantities, a platform on three legs in the plane with "
      "these anchors and lengths has exactly 6 poses, one within each line 'solution'");
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(plain, planar("0.003", "0.001")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, planar("0.002", "0.0011")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, planar("0.002", "0.0009")), Outcome::kVerified);
  EXPECT_EQ(outcome(plain, replaced(model, "[legs]", "[legs]\nplatform_tolerance = 0.001")),
            Outcome::kRejected);
  EXPECT_EQ(outcome(plain, replaced(model, "[legs]", "[legs]\ntolerance_shape = \"ball\"")),
            Outcome::kRejected);
  EXPECT_EQ(outcome(without_sum(certified(library_model("rpr_6")).text), model),
            Outcome::kUnfinished);
}

/// Dietmaier's platform with other lengths.
std::string other_lengths() {
  return replaced(library_model("dietmaier"), "1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071",
                  "1.0729, 1.1026, 1.4031, 1.7041, 2.679, 1.4815");
}

std::string in_space(const std::string& base_tolerance, const std::string& error) {
  return replaced(
      replaced(other_lengths(), "[gough]",
               "[gough]\nplatform_tolerance = 1e-8\nbase_tolerance = " + base_tolerance),
      "[motion.legs]", "[motion.legs]\nerror = { legs = " + error + " }");
}

struct SpatialRobot {
  std::array<std::array<double, 3>, 6> a{{{0, 0, 0},
                                          {1.107915, 0, 0},
                                          {0.549094, 0.756063, 0},
                                          {0.735077, -0.223935, 0.525991},
                                          {0.514188, -0.526063, -0.368418},
                                          {0.590473, 0.094733, -0.205018}}},
      b{{{0, 0, 0},
         {0.542805, 0, 0},
         {0.956919, -0.528915, 0},
         {0.665885, -0.353482, 1.402538},
         {0.478359, 1.158742, 0.107672},
         {-0.137087, -0.235121, 0.353913}}};
  std::array<double, 6> length{1.0729, 1.1026, 1.4031, 1.7041, 2.679, 1.4815};

  /// x, y, z and a quaternion of length 1.
  Numbers operator()(const Numbers& x) const {
    const double w = x[3], p = x[4], q = x[5], r = x[6];
    const double R[3][3] = {{1 - 2 * (q * q + r * r), 2 * (p * q - w * r), 2 * (p * r + w * q)},
                            {2 * (p * q + w * r), 1 - 2 * (p * p + r * r), 2 * (q * r - w * p)},
                            {2 * (p * r - w * q), 2 * (q * r + w * p), 1 - 2 * (p * p + q * q)}};
    Numbers value;
    for (std::size_t i = 0; i < 6; ++i) {
      double square = -length[i] * length[i];
      for (std::size_t k = 0; k < 3; ++k) {
        double part = x[k] - a[i][k];
        for (std::size_t j = 0; j < 3; ++j) part += R[k][j] * b[i][j];
        square += part * part;
      }
      value.push_back(square);
    }
    value.push_back(w * w + p * p + q * q + r * r - 1);
    return value;
  }
};

TEST(ListsWithTolerancesInSpace, HaveAPoseInEachTubeAtEachCorner) {
  const std::string model = in_space("1e-8", "1e-8");
  const Certified made = certified(model);
  ASSERT_TRUE(made.status.is_written()) << made.status.obstacle();
  const auto tubes = tubes_of(made.text);
  ASSERT_GE(tubes.size(), 2U);
  RandomSource random(4);
  const auto side = [&](double size) { return random.between(-1, 1) < 0 ? -size : size; };
  for (int round = 0; round < 5; ++round) {
    SpatialRobot robot;
    for (auto* anchors : {&robot.a, &robot.b})
      for (auto& anchor : *anchors)
        for (double& x : anchor) x += side(1e-8);
    for (double& length : robot.length) length += side(1e-8);
    for (const auto& tube : tubes) {
      const Numbers pose = newton(robot, middle_of(tube));
      ASSERT_EQ(pose.size(), 7U);
      EXPECT_TRUE(is_within(pose, tube));
    }
  }
}

TEST(ListsWithTolerancesInSpace, AreVerifiedWithTheirFileAndForgeriesAreNot) {
  const std::string model = in_space("1e-8", "1e-8");
  const Certified made = certified(model);
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, 40U);
  EXPECT_EQ(made.solutions.completeness, Completeness::kComplete);
  const std::string plain = without_sum(made.text);
  EXPECT_EQ(outcome(plain, in_space("2e-8", "1e-8")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, in_space("1e-8", "2e-8")), Outcome::kRejected);
  EXPECT_EQ(outcome(plain, other_lengths()), Outcome::kRejected);
  const Lines genuine = lines_of(made.text);
  Lines fewer = genuine;
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "solution")));
  const std::string claim = joined(fewer);
  const std::size_t count = made.solutions.found.size();
  EXPECT_EQ(outcome(replaced(claim, fmt::format("exactly {}", count),
                             fmt::format("exactly {}", count - 1))),
            Outcome::kRejected);
  // The tube of one pose is narrower than where it can be.
  Lines narrow = genuine;
  std::string& line = narrow[first(narrow, "solution")];
  const std::size_t colon = line.find(':'), end = line.find(' ', colon);
  line = line.substr(0, colon + 1) + line.substr(9, colon - 9) + line.substr(end);
  EXPECT_NE(outcome(joined(narrow)), Outcome::kVerified);
  // A wider set than that in which the poses stay apart.
  EXPECT_NE(outcome(replaced(plain, "+- 1/100000000\n", "+- 1/10\n")), Outcome::kVerified);
}

}  // namespace
}  // namespace regulus::test
