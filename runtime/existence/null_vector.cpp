// SPDX-License-Identifier: Apache-2.0
#include "runtime/existence/null_vector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/existence/branch_tube.hpp"

namespace regulus::detail {
namespace {

constexpr int kMostSteps = 24;
constexpr double kSmallStep = 0x1p-48;
/// Wide boxes leave room for roundings of another reader; narrow ones fit where much curves.
constexpr double kRadii[] = {0x1p-36, 0x1p-40, 0x1p-44};
/// Numbers beyond this have a radius that grows with them.
constexpr double kLarge = 1024;

class Bordered {
 public:
  Bordered(const MatrixFunction& matrix, std::size_t d, std::size_t n)
      : matrix_(matrix), d_(d), n_(n), m_(d + n - 1) {}

  /// Takes v, of which the largest component becomes 1.
  [[nodiscard]] bool begin(std::vector<double> t, const std::vector<double>& v) {
    const auto larger = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
    unit_ = std::size_t(std::max_element(v.begin(), v.end(), larger) - v.begin());
    z_ = std::move(t);
    for (std::size_t j = 0; j < n_; ++j)
      if (j != unit_) z_.push_back(v[j] / v[unit_]);
    return std::ranges::all_of(z_, [](double x) { return std::isfinite(x); });
  }

  /// Newton's method; its last inverse is that of the test.
  [[nodiscard]] bool settle() {
    for (int step = 0; step < kMostSteps; ++step) {
      if (!look()) return false;
      double largest = 0;
      for (std::size_t i = 0; i < m_; ++i) {
        double change = 0;
        for (std::size_t j = 0; j < m_; ++j) change -= inverse_[i * m_ + j] * mid(value_[j]);
        z_[i] += change;
        if (!std::isfinite(z_[i])) return false;
        largest = std::max(largest, std::fabs(change) / scale(i));
      }
      if (largest <= kSmallStep) break;
    }
    return look();
  }

  [[nodiscard]] std::optional<NullVectorBox> enclose(double radius,
                                                     std::span<const Interval> ranges) const {
    BranchTube tube{{}, z_, {}, {}};
    std::vector<Interval> box;
    for (std::size_t i = 0; i < m_; ++i) {
      tube.radius.push_back(radius * scale(i));
      box.push_back(Interval(z_[i]) + Interval(-tube.radius[i], tube.radius[i]));
      if (i < d_ && !certain_subset(box[i], ranges[i])) return std::nullopt;
    }
    const auto over = system(box);
    if (!over) return std::nullopt;
    const TubeSystem krawczyk{value_, over->slopes, {}};
    if (!has_one_solution(tube, image_of(tube, {}, inverse_, krawczyk))) return std::nullopt;
    return NullVectorBox{{box.begin(), box.begin() + std::ptrdiff_t(d_)}, vector_of(box)};
  }

 private:
  struct System {
    std::vector<Interval> value, slopes;  ///< m; m×m, row-major
  };

  [[nodiscard]] double scale(std::size_t i) const {
    return std::max(1.0, std::fabs(z_[i]) / kLarge);
  }

  [[nodiscard]] std::vector<Interval> vector_of(std::span<const Interval> z) const {
    std::vector<Interval> v(z.begin() + std::ptrdiff_t(d_), z.end());
    v.insert(v.begin() + std::ptrdiff_t(unit_), Interval(1.0));
    return v;
  }

  /// A·v and its derivatives: (∂_kA)·v by t_k, and the columns of A by the free components of v.
  [[nodiscard]] std::optional<System> system(std::span<const Interval> z) const {
    const auto A = matrix_(z.first(d_));
    if (!A) return std::nullopt;
    const std::vector<Interval> v = vector_of(z);
    const auto times_v = [&](const std::vector<Interval>& of, std::size_t at) {
      Interval sum(0.0);
      for (std::size_t j = 0; j < n_; ++j) sum = sum + of[at + j] * v[j];
      return sum;
    };
    System result;
    for (std::size_t i = 0; i < m_; ++i) {
      result.value.push_back(times_v(A->entries, i * n_));
      for (std::size_t k = 0; k < d_; ++k)
        result.slopes.push_back(times_v(A->slopes, (k * m_ + i) * n_));
      for (std::size_t j = 0; j < n_; ++j)
        if (j != unit_) result.slopes.push_back(A->entries[i * n_ + j]);
    }
    return result;
  }

  /// Evaluates at z, and inverts the derivatives there.
  [[nodiscard]] bool look() {
    std::vector<Interval> point;
    for (const double x : z_) point.emplace_back(x);
    auto at = system(point);
    if (!at) return false;
    value_ = std::move(at->value);
    std::vector<double> middles;
    for (const Interval& x : at->slopes) middles.push_back(mid(x));
    auto inverse = approx_inverse_of(middles, m_);
    if (inverse) inverse_ = std::move(*inverse);
    return inverse.has_value();
  }

  const MatrixFunction& matrix_;
  const std::size_t d_, n_, m_;
  std::size_t unit_ = 0;
  std::vector<double> z_;  ///< t, and the free components of v
  std::vector<Interval> value_;
  std::vector<double> inverse_;
};

}  // namespace

std::optional<NullVectorBox> enclose_null_vector(const MatrixFunction& matrix,
                                                 std::vector<double> t, std::vector<double> v,
                                                 std::span<const Interval> ranges) {
  Bordered bordered(matrix, t.size(), v.size());
  if (!bordered.begin(std::move(t), v) || !bordered.settle()) return std::nullopt;
  for (const double radius : kRadii)
    if (auto found = bordered.enclose(radius, ranges)) return found;
  return std::nullopt;
}

}  // namespace regulus::detail
