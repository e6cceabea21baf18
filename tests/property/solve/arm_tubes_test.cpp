// SPDX-License-Identifier: GPL-3.0-or-later
// The tubes of postures while lengths and angles are within tolerances. The oracle is Newton's method in doubles, on
// arms with other numbers.
#include <algorithm>

#include "tests/property/solve/puma_rows.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test::coupled_arms {
namespace {

struct Sizes {
  double length, angle;
};

Rows rows_within(const Sizes& sizes, RandomSource& random) {
  Rows rows = kPuma;
  for (auto& row : rows) {
    row[0] += deviation(random, sizes.length);
    row[1] += deviation(random, sizes.angle);
    row[2] += deviation(random, sizes.length);
  }
  return rows;
}

/// Each posture of the nominal arm leads to one in a tube of its own, whatever the numbers are.
void expect_tubes(const Solutions& tubes, const Solutions& points, const Numbers& q,
                  const Sizes& sizes, RandomSource& random) {
  ASSERT_TRUE(is_complete(tubes)) << tubes.obstacle;
  ASSERT_EQ(tubes.found.size(), points.found.size());
  const Frame end = end_of(kPuma, q);
  for (int other = 0; other < 30; ++other) {
    const Rows rows = rows_within(sizes, random);
    for (const CertainSolution& point : points.found) {
      const Numbers posture = newton(RowsGap{rows, end}, middle_of(point.values));
      ASSERT_FALSE(posture.empty());
      EXPECT_EQ(tubes_with(tubes, posture), 1);
    }
  }
}

/// The PUMA 560 with each of its lengths, those that are 0 too, within 1 mm, and then with its angles.
TEST(PosturesOfAnArmWithEveryLengthUncertain, AreInTheirTubes) {
  RandomSource random(71);
  for (int round = 0; round < trials(1, 12); ++round) {
    const Numbers q = {random.between(-3, 3), random.between(-1, 1),    random.between(-1, 1),
                       random.between(-3, 3), random.between(0.7, 1.5), random.between(-3, 3)};
    const Solutions points = solved(text_of(kPuma, q, ""));
    ASSERT_TRUE(is_complete(points));
    if (std::ranges::any_of(points.found, [](const auto& s) { return s.condition > 14; })) continue;
    const Solutions lengths = solved(text_of(kPuma, q, "length_tolerance = 0.0005\n"));
    expect_tubes(lengths, points, q, {0.0005, 0}, random);
    const Solutions all =
        solved(text_of(kPuma, q, "length_tolerance = 1e-4\nangle_tolerance = 1e-4\n"));
    expect_tubes(all, points, q, {1e-4, 1e-4}, random);
  }
}

/// Which was shown of four postures only while each row took a length for another one.
TEST(PosturesOfThePumaWithinAMillimetre, AreEight) {
  RandomSource random(72);
  const Numbers q = {0.3, 0.4, -0.7, 0.3, 0.9, -1.4};
  const Solutions points = solved(text_of(kPuma, q, "")),
                  tubes = solved(text_of(kPuma, q, "length_tolerance = 0.001\n"));
  ASSERT_EQ(points.found.size(), 8U);
  expect_tubes(tubes, points, q, {0.001, 0}, random);
  for (const CertainSolution& s : tubes.found) {
    EXPECT_NE(s.sign, 0);
    for (const Interval& value : s.values) EXPECT_LT(width_ru(value), 0.065);
  }
}

/// Follows a posture of the nominal arm to one with other rows.
Numbers followed(const Rows& rows, const Frame& end, Numbers posture) {
  constexpr int kSteps = 16;
  for (int step = 1; step <= kSteps && !posture.empty(); ++step) {
    Rows between = kPuma;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        between[i][k] += (rows[i][k] - kPuma[i][k]) * step / kSteps;
    posture = newton(RowsGap{between, end}, posture);
  }
  return posture;
}

/// Tolerances within which one test does not tell the postures apart, so that they are followed.
TEST(PosturesWithinCentimetres, StayInTheirTubes) {
  RandomSource random(73);
  const Numbers q = {0.3, 0.4, -0.7, 0.3, 0.9, -1.4};
  const Frame end = end_of(kPuma, q);
  const Solutions points = solved(text_of(kPuma, q, ""));
  for (const Sizes sizes : {Sizes{0.005, 0}, Sizes{0.003, 0.003}, Sizes{0, 0.01}}) {
    const Solutions tubes = solved(text_of(
        kPuma, q,
        fmt::format("{}{}",
                    sizes.length == 0 ? "" : fmt::format("length_tolerance = {}\n", sizes.length),
                    sizes.angle == 0 ? "" : fmt::format("angle_tolerance = {}\n", sizes.angle))));
    ASSERT_TRUE(is_complete(tubes)) << tubes.obstacle;
    ASSERT_EQ(tubes.found.size(), 8U);
    EXPECT_NE(tubes.how.find("of the nominal arm"), std::string::npos) << tubes.how;
    for (int other = 0; other < trials(40, 1000); ++other) {
      const Rows rows = rows_within(sizes, random);
      for (const CertainSolution& point : points.found) {
        const Numbers posture = followed(rows, end, middle_of(point.values));
        ASSERT_FALSE(posture.empty());
        EXPECT_EQ(tubes_with(tubes, posture), 1);
      }
    }
  }
}

/// The interval of one joint of one line, narrower or moved.
std::string with_interval(const std::string& certificate, std::size_t joint, double from,
                          double to) {
  Lines lines = lines_of(certificate);
  std::string& line = lines[first(lines, "solution")];
  const std::vector<Interval> tube = tubes_of(certificate).front();
  line = "solution";
  for (std::size_t k = 0; k < tube.size(); ++k) {
    const double lo = tube[k].lo, width = tube[k].hi - lo;
    line += k == joint ? fmt::format(" {:a}:{:a}", lo + from * width, lo + to * width)
                       : fmt::format(" {:a}:{:a}", lo, tube[k].hi);
  }
  return joined(lines);
}

TEST(PosturesThatAreFollowed, AreVerifiedAndForgeriesAreNot) {
  const Numbers q = {0.3, 0.4, -0.7, 0.3, 0.9, -1.4};
  const std::string model =
      text_of(kPuma, q, "length_tolerance = 0.003\nangle_tolerance = 0.003\n");
  const Certified made = certified(model);
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, 8U);
  ASSERT_NE(made.text.find("\nfrom "), std::string::npos);
  const std::string plain = without_sum(made.text);
  ASSERT_EQ(outcome(plain), Outcome::kVerified);
  EXPECT_EQ(
      outcome(plain, text_of(kPuma, q, "length_tolerance = 0.0031\nangle_tolerance = 0.003\n")),
      Outcome::kRejected);

  Lines fewer = lines_of(plain);
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "solution")));
  fewer.erase(fewer.begin() + std::ptrdiff_t(first(fewer, "from")));
  EXPECT_EQ(outcome(replaced(joined(fewer), "exactly 8", "exactly 7")), Outcome::kRejected);
  Lines swapped = lines_of(plain);
  const std::size_t from = first(swapped, "from");
  std::swap(swapped[from], swapped[from + 1]);
  EXPECT_EQ(outcome(joined(swapped)), Outcome::kRejected);

  // Each interval is needed: of joints that are searched, and of those that follow.
  for (std::size_t joint = 0; joint < 6; ++joint) {
    EXPECT_EQ(outcome(with_interval(plain, joint, -0.01, 1.01)), Outcome::kVerified) << joint;
    EXPECT_NE(outcome(with_interval(plain, joint, 0.48, 1)), Outcome::kVerified) << joint;
    EXPECT_NE(outcome(with_interval(plain, joint, 0, 0.52)), Outcome::kVerified) << joint;
    EXPECT_NE(outcome(with_interval(plain, joint, 0.45, 0.55)), Outcome::kVerified) << joint;
  }
}

/// Some of the postures are certain, and each is followed by itself.
TEST(PosturesThatAreFollowed, AreVerifiedWhereOthersMayMeet) {
  const Numbers q = {0.3, 0.4, -0.7, 0.3, 0.9, -1.4};
  const std::string model =
      text_of(kPuma, q, "length_tolerance = 0.006\nangle_tolerance = 0.006\n");
  const Certified made = certified(model);
  ASSERT_FALSE(is_complete(made.solutions));
  const verifier::Verification v = verified(made.text, model);
  ASSERT_EQ(v.outcome, Outcome::kVerified) << describe(v);
  EXPECT_EQ(v.roots, made.solutions.found.size());
  EXPECT_GT(v.roots, 0U);
  const std::string plain = without_sum(made.text);
  ASSERT_NE(plain.find("\nfrom "), std::string::npos);
  for (std::size_t joint = 0; joint < 6; ++joint)
    EXPECT_NE(outcome(with_interval(plain, joint, 0.48, 1)), Outcome::kVerified) << joint;
}

/// Within larger ones their number changes, and the report says for which numbers of the arm.
TEST(PosturesWithinDecimetres, AreNotAlwaysAsMany) {
  const Numbers q = {0.3, 0.4, -0.7, 0.3, 0.9, -1.4};
  const Solutions tubes = solved(text_of(kPuma, q, "length_tolerance = 0.05\n"));
  EXPECT_FALSE(is_complete(tubes));
  EXPECT_TRUE(tubes.changes);
  ASSERT_TRUE(tubes.obstacle.starts_with("the nominal arm has 8 postures, and there are "))
      << tubes.obstacle;
  // The oracle: no start leads Newton's method to more of them than the report says.
  const std::string numbers = tubes.obstacle.substr(tubes.obstacle.find(" with ") + 6);
  Rows rows = kPuma;
  std::istringstream parts(numbers);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t at = part.find("a_"), d = part.find("d_");
    ASSERT_TRUE(at != std::string::npos || d != std::string::npos) << part;
    const std::size_t name = at != std::string::npos ? at : d;
    const std::size_t row = std::size_t(part[name + 2] - '1');
    rows.at(row)[at != std::string::npos ? 0 : 2] = std::stod(part.substr(part.find('=') + 1));
  }
  const Frame end = end_of(kPuma, q);
  RandomSource random(74);
  std::vector<Numbers> found;
  for (int start = 0; start < 400; ++start) {
    Numbers x(6);
    for (double& angle : x) angle = random.between(-3.14, 3.14);
    x = newton(RowsGap{rows, end}, x);
    if (x.empty()) continue;
    const Frame T = end_of(rows, x);
    double trace = 0;
    for (std::size_t i = 0; i < 3; ++i) trace += inner(T.R[i], end.R[i]);
    if (trace < 2.9) continue;  // a half turn
    const bool is_new = std::ranges::none_of(found, [&](const Numbers& y) {
      double gap = 0;
      for (std::size_t i = 0; i < 6; ++i)
        gap = std::max(gap, std::fabs(std::remainder(x[i] - y[i], 2 * std::numbers::pi)));
      return gap < 1e-6;
    });
    if (is_new) found.push_back(x);
  }
  const std::size_t said =
      std::stoul(tubes.obstacle.substr(tubes.obstacle.find("there are ") + 10));
  EXPECT_EQ(found.size(), said);
  EXPECT_NE(said, 8U);
}

/// The wrist is stretched: the report says what is wrong with the nominal arm, and no limit that nobody has set.
TEST(PosturesOfAnArmThatIsSingular, AreNotFollowed) {
  const Numbers q = {0.3, 0.4, -0.7, 0.3, 0, -1.4};
  for (const char* tolerance : {"1e-6", "0.01"}) {
    const Solutions tubes =
        solved(text_of(kPuma, q, fmt::format("length_tolerance = {}\n", tolerance)));
    EXPECT_FALSE(is_complete(tubes));
    EXPECT_TRUE(tubes.obstacle.starts_with("of the nominal arm, several postures meet"))
        << tubes.obstacle;
    EXPECT_FALSE(tubes.stopped_by);
  }
}

}  // namespace
}  // namespace regulus::detail::test::coupled_arms
