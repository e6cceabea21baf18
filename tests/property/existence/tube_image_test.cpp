// SPDX-License-Identifier: GPL-3.0-or-later
// The image of a tube is computed by the rounding of the processor: it is that of plain intervals, to
// the bit, also where numbers are unbounded, tiny or 0.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/existence/branch_tube.hpp"

namespace regulus::detail {
namespace {

using Entries = std::vector<Interval>;

struct AnyTube {
  std::size_t n, m;
  BranchTube tube;
  std::vector<Interval> box;
  std::vector<double> inverse;
  Entries value, by_unknown, by_variable, center_unknown, center_variable, rates_unknown,
      rates_variable;

  [[nodiscard]] TubeSystem system(bool is_second_order) const {
    TubeSystem system{value, by_unknown, by_variable};
    if (!is_second_order) return system;
    system.center_by_unknown = center_unknown, system.center_by_variable = center_variable;
    system.rates_by_unknown = rates_unknown, system.rates_by_variable = rates_variable;
    return system;
  }
};

class RandomTubes {
 public:
  double number() {
    const int kind = std::uniform_int_distribution<int>(0, 19)(bits_);
    if (kind == 0) return 0;
    return std::ldexp(std::uniform_real_distribution<double>(-1, 1)(bits_),
                      kind == 1 ? -1000 : std::uniform_int_distribution<int>(-9, 9)(bits_));
  }
  Interval interval() {
    const double x = number();
    const int kind = std::uniform_int_distribution<int>(0, 199)(bits_);
    if (kind == 0) return {-kInfinity, x};
    if (kind == 1) return {x, kInfinity};
    return kind < 40 ? Interval(x) : Interval(x, x + std::fabs(number()));
  }
  Entries matrix(std::size_t count) {
    Entries result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(interval());
    return result;
  }
  std::vector<double> numbers(std::size_t count) {
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(number());
    return result;
  }
  AnyTube next() {
    AnyTube c;
    c.n = std::uniform_int_distribution<std::size_t>(1, 5)(bits_);
    c.m = std::uniform_int_distribution<std::size_t>(0, 4)(bits_);
    c.tube = {numbers(c.m), numbers(c.n), numbers(c.n * c.m), numbers(c.n)};
    for (double& r : c.tube.radius) r = std::fabs(r);
    for (const double x : c.tube.at)
      c.box.push_back(number() > 0.1 ? Interval(x) : Interval(x, x + std::fabs(number())));
    c.inverse = numbers(c.n * c.n);
    c.value = matrix(c.n), c.by_unknown = matrix(c.n * c.n), c.by_variable = matrix(c.n * c.m);
    c.center_unknown = matrix(c.n * c.n), c.center_variable = matrix(c.n * c.m);
    c.rates_unknown = matrix((c.m + c.n) * c.n * c.n);
    c.rates_variable = matrix((c.m + c.n) * c.n * c.m);
    return c;
  }

 private:
  std::mt19937 bits_{7};
};

/// The formulas of branch_tube.hpp, one interval after another.
class PlainImage {
 public:
  PlainImage(const AnyTube& c, bool is_second_order) : c_(c), is_second_order_(is_second_order) {
    for (std::size_t k = 0; k < c.m; ++k) reach_.push_back(mag(c.box[k] - Interval(c.tube.at[k])));
    reach_.insert(reach_.end(), c.tube.radius.begin(), c.tube.radius.end());
    image_.radius.assign(c.n, 0), image_.change.assign(c.n, 0);
    image_.impact.assign(c.n * c.m, 0), image_.spread.assign(c.n * c.n, 0);
    for (std::size_t i = 0; i < c.n; ++i) {
      image_.offset.push_back(mag(times_inverse(i, c.value)));
      image_.radius[i] = image_.offset[i];
    }
    for (std::size_t k = 0; k < c.m + c.n; ++k)
      if (k >= c.m || reach_[k] != 0)
        for (std::size_t i = 0; i < c.n; ++i) add(i, k);
  }
  [[nodiscard]] const TubeImage& image() const { return image_; }

 private:
  [[nodiscard]] Interval times_inverse(std::size_t i, const Entries& column) const {
    Interval sum(0.0);
    for (std::size_t j = 0; j < c_.n; ++j) sum += Interval(c_.inverse[i * c_.n + j]) * column[j];
    return sum;
  }
  /// Column k of (Φ_x + Φ_p S, Φ_p), or of derivative `by` of it.
  [[nodiscard]] Entries column(const Entries& variable, const Entries& unknown, std::size_t k,
                               std::size_t by = 0) const {
    const std::size_t n = c_.n, m = c_.m;
    Entries result;
    for (std::size_t j = 0; j < n; ++j) {
      result.push_back(k < m ? variable[(by * n + j) * m + k] : unknown[(by * n + j) * n + k - m]);
      for (std::size_t q = 0; k < m && q < n; ++q)
        result[j] += unknown[(by * n + j) * n + q] * Interval(c_.tube.slopes[q * m + k]);
    }
    return result;
  }
  void add(std::size_t i, std::size_t k) {
    const auto less = [&](const Entries& values) {
      const Interval sum = times_inverse(i, values);
      return mag(k == c_.m + i ? sum - Interval(1.0) : sum);
    };
    double all = less(column(c_.by_variable, c_.by_unknown, k)), mean = all;
    if (is_second_order_) {
      double change = 0;
      for (std::size_t l = 0; l < c_.m + c_.n; ++l) {
        if (reach_[l] == 0) continue;
        Entries rate = column(c_.rates_variable, c_.rates_unknown, k, l);
        for (std::size_t q = 0; l < c_.m && q < c_.n; ++q) {
          const Entries other = column(c_.rates_variable, c_.rates_unknown, k, c_.m + q);
          for (std::size_t j = 0; j < c_.n; ++j)
            rate[j] += Interval(c_.tube.slopes[q * c_.m + l]) * other[j];
        }
        change = add_ru(change, mul_ru(mag(times_inverse(i, rate)), reach_[l]));
      }
      const double center = less(column(c_.center_variable, c_.center_unknown, k));
      all = std::fmin(all, add_ru(center, change));
      mean = std::fmin(mean, add_ru(center, mul_ru(0.5, change)));
    }
    const double part = mul_ru(mean, reach_[k]);
    if (k < c_.m)
      image_.impact[i * c_.m + k] = part;
    else
      image_.spread[i * c_.n + k - c_.m] = all, image_.change[i] = add_ru(image_.change[i],
                                                                          mul_ru(all, reach_[k]));
    image_.radius[i] = add_ru(image_.radius[i], part);
  }

  const AnyTube& c_;
  const bool is_second_order_;
  std::vector<double> reach_;
  TubeImage image_;
};

TEST(TubeImage, IsThatOfPlainIntervals) {
  RandomTubes random;
  int bounded = 0;
  for (int count = 0; count < 4000; ++count) {
    const AnyTube c = random.next();
    for (const bool is_second_order : {false, true}) {
      const TubeImage image = image_of(c.tube, c.box, c.inverse, c.system(is_second_order));
      const TubeImage plain = PlainImage(c, is_second_order).image();
      EXPECT_EQ(image.radius, plain.radius);
      EXPECT_EQ(image.offset, plain.offset);
      EXPECT_EQ(image.impact, plain.impact);
      EXPECT_EQ(image.spread, plain.spread);
      EXPECT_EQ(image.change, plain.change);
      if (HasFailure()) FAIL() << "case " << count;
      bounded += image.radius[0] < kInfinity ? 1 : 0;
    }
  }
  EXPECT_GT(bounded, 2000);
}

}  // namespace
}  // namespace regulus::detail
