// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the closed form of the determinant with determinants by Arb of the matrix itself, at
// random poses and over random boxes around them.
#include <gtest/gtest.h>

#include <random>

#include "codegen/question/engine/arb_oracle.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/evaluation/batch.hpp"

namespace regulus::detail {
namespace {

struct Case {
  const char* model;
  const char* motion;
};

constexpr Case kCases[] = {{"robot_1", "wide_40"},
                           {"robot_1", "T2_errors"},
                           {"robot_2", "table5_30"},
                           {"planar_3rpr", "crossing"}};

class ClosedFormOf : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    ModelOptions model;
    model.path = std::string(REGULUS_SOURCE_DIR "/models/") + GetParam().model + ".toml";
    model.motion = GetParam().motion;
    search_.method = Method::kClosedForm;
    search_.engine = Engine::kInterpreted;
    preparation_.emplace(prepare(model, search_));
    problem_ = preparation_->problem();
  }

  std::vector<Interval> random_box() {
    std::vector<Interval> box;
    const double size = std::ldexp(1.0, -static_cast<int>(random_() % 12));
    for (const Interval& range : problem_.outer) {
      const double half = 0.5 * size * (range.hi - range.lo);
      const double middle = range.lo + half + part() * (range.hi - range.lo - 2 * half);
      box.push_back(*intersect(Interval(middle - half, middle + half), range));
    }
    return box;
  }

  std::vector<Interval> random_point(const std::vector<Interval>& box) {
    std::vector<Interval> point;
    for (const Interval& range : box) {
      const double at = random_() % 4 == 0 ? range.lo : range.lo + part() * (range.hi - range.lo);
      point.push_back(*intersect(Interval(at), range));
    }
    return point;
  }

  double part() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  SearchOptions search_;
  std::optional<PreparedSearch> preparation_;
  Problem problem_;
  std::mt19937_64 random_{23};
};

TEST_P(ClosedFormOf, HoldsArbsDeterminantOverEveryBox) {
  const Settings settings = settings_from(search_);
  const RowStructure none;
  Batch batch(problem_, settings, none);
  ArbOracle oracle(preparation_->stages->matrix(), preparation_->labels.rows, 424);
  for (int repetition = 0; repetition < 40; ++repetition) {
    const std::vector<Interval> box = random_box();
    batch.clear();
    batch.load(0, box);
    batch.seal(1);
    const ConstIntervalVector natural = batch.natural_determinant();
    const ConstIntervalVector monotone = batch.monotone_determinant();
    const Interval by_value{natural.lower(0, 0), natural.upper(0, 0)};
    const Interval by_slope{monotone.lower(0, 0), monotone.upper(0, 0)};
    EXPECT_TRUE(is_bounded(by_value));
    EXPECT_TRUE(certain_subset(by_slope, by_value));
    for (int sample = 0; sample < 5; ++sample) {
      const auto exact = oracle.enclose(random_point(box));
      ASSERT_TRUE(exact);
      // Arb's ball is about 10^-25 wide. If both meet, the bound contains the value up to that.
      EXPECT_TRUE(intersect(*exact, by_slope))
          << exact->lo << " outside " << by_slope.lo << ", " << by_slope.hi;
    }
  }
}

TEST_P(ClosedFormOf, IsCloseToArbsDeterminantAtAPoint) {
  const Settings settings = settings_from(search_);
  const RowStructure none;
  Batch batch(problem_, settings, none);
  ArbOracle oracle(preparation_->stages->matrix(), preparation_->labels.rows, 424);
  const auto determinant_at = [&](const std::vector<Interval>& point) {
    batch.clear();
    batch.load(0, point);
    batch.seal(1);
    const ConstIntervalVector natural = batch.natural_determinant();
    return Interval{natural.lower(0, 0), natural.upper(0, 0)};
  };
  for (int repetition = 0; repetition < 20; ++repetition) {
    const std::vector<Interval> point = random_point(problem_.outer);
    const Interval closed = determinant_at(point);
    const auto exact = oracle.enclose(point);
    ASSERT_TRUE(exact && intersect(*exact, closed));
    EXPECT_LT(closed.hi - closed.lo, 1e-9 * mag(determinant_at(problem_.outer)));
  }
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.model) + "_" + info.param.motion;
}

INSTANTIATE_TEST_SUITE_P(Models, ClosedFormOf, testing::ValuesIn(kCases), case_name);

}  // namespace
}  // namespace regulus::detail
