// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/complex_root.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/solutions/linear_system.hpp"

namespace regulus::detail {

namespace {

constexpr int kNewtonSteps = 6;
constexpr int kInflations = 8;
/// Places whose imaginary parts are smaller, relatively, are first tried as real ones.
constexpr double kAlmostReal = 1e-6;

Rectangle rectangle(Complex center, double radius) {
  const Interval reach(-radius, radius);
  return {Interval(center.re) + reach, Interval(center.im) + reach};
}

double largest_part(const Rectangle& z) { return std::max(mag(z.re), mag(z.im)); }

class KrawczykTest {
 public:
  KrawczykTest(const PolynomialSystem& system, std::span<const Complex> near)
      : system_(system),
        n_(system.size()),
        center_(near.begin(), near.end()),
        values_(n_),
        derivatives_(n_ * n_) {}

  [[nodiscard]] std::optional<RootBox> prove() {
    for (int step = 0; step < kNewtonSteps; ++step) {
      if (!evaluate_at_center()) return std::nullopt;
      const double before = largest_offset();
      if (step > 0 && !(before < last_offset_ / 2)) break;  // as near as doubles lead
      last_offset_ = before;
      move_center();
    }
    return evaluate_at_center() ? inflate() : std::nullopt;
  }

 private:
  /// Makes K and KF(c).
  [[nodiscard]] bool evaluate_at_center() {
    const std::vector<Rectangle> point(center_.begin(), center_.end());
    system_.enclose(point, values_, derivatives_);
    std::vector<Complex> middle(n_ * n_);
    std::ranges::transform(derivatives_, middle.begin(), [](const Rectangle& z) { return mid(z); });
    auto inverse = approx_inverse_of(std::move(middle), n_);
    if (!inverse) return false;
    inverse_ = std::move(*inverse);
    offset_.assign(n_, Rectangle());
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j)
        offset_[i] += Rectangle(inverse_[i * n_ + j]) * values_[j];
    return true;
  }

  [[nodiscard]] double largest_offset() const {
    double largest = 0;
    for (const Rectangle& z : offset_) largest = std::max(largest, largest_part(z));
    return largest;
  }

  void move_center() {
    for (std::size_t i = 0; i < n_; ++i) center_[i] -= mid(offset_[i]);
  }

  /// Tries boxes that grow from the narrowest possible.
  [[nodiscard]] std::optional<RootBox> inflate() {
    std::vector<double> radius(n_), image(n_);
    for (std::size_t i = 0; i < n_; ++i) image[i] = largest_part(offset_[i]);
    for (int step = 0; step < kInflations; ++step) {
      for (std::size_t i = 0; i < n_; ++i)
        radius[i] = (step == 0 ? 1.25 : 2) * image[i] + kLeastRadius;
      if (!is_image_finite(radius, image)) return std::nullopt;
      if (std::ranges::equal(image, radius, std::less<>())) return RootBox{center_, radius, false};
    }
    return std::nullopt;
  }

  /// Makes the left side of the test.
  [[nodiscard]] bool is_image_finite(std::span<const double> radius, std::span<double> image) {
    std::vector<Rectangle> box(n_);
    for (std::size_t i = 0; i < n_; ++i) box[i] = rectangle(center_[i], radius[i]);
    system_.enclose(box, values_, derivatives_);
    for (std::size_t i = 0; i < n_; ++i) {
      image[i] = largest_part(offset_[i]);
      for (std::size_t j = 0; j < n_; ++j)
        image[i] = add_ru(image[i], mul_ru(deviation(i, j), radius[j]));
      if (!std::isfinite(image[i])) return false;
    }
    return true;
  }

  /// e_ij
  [[nodiscard]] double deviation(std::size_t i, std::size_t j) const {
    Rectangle sum(i == j ? Interval(-1.0) : Interval(0.0));
    for (std::size_t k = 0; k < n_; ++k)
      sum += Rectangle(inverse_[i * n_ + k]) * derivatives_[k * n_ + j];
    return mag_ru(sum);
  }

  static constexpr double kLeastRadius = 0x1p-1000;

  const PolynomialSystem& system_;
  const std::size_t n_;
  std::vector<Complex> center_;
  std::vector<Rectangle> values_, derivatives_, offset_;
  std::vector<Complex> inverse_;
  double last_offset_ = kInfinity;
};

bool is_almost_real(std::span<const Complex> z) {
  double real = 0, imaginary = 0;
  for (const Complex& x : z) {
    real = std::max(real, std::abs(x.re));
    imaginary = std::max(imaginary, std::abs(x.im));
  }
  return imaginary <= kAlmostReal * real;
}

/// True if some place of the box differs from its conjugate in a certain way: no place is real.
bool certain_not_real(const RootBox& box) {
  for (std::size_t i = 0; i < box.center.size(); ++i)
    if (std::abs(box.center[i].im) > box.radius[i]) return true;
  return false;
}

}  // namespace

Rectangle RootBox::operator[](std::size_t i) const { return rectangle(center[i], radius[i]); }

std::optional<RootBox> certify_root(const PolynomialSystem& system, std::span<const Complex> near) {
  if (is_almost_real(near)) {
    std::vector<Complex> real(near.begin(), near.end());
    for (Complex& z : real) z.im = 0;
    auto box = KrawczykTest(system, real).prove();
    if (box && std::ranges::all_of(box->center, [](Complex z) { return z.im == 0; })) {
      box->is_real = true;
      return box;
    }
  }
  auto box = KrawczykTest(system, near).prove();
  return box && certain_not_real(*box) ? box : std::nullopt;
}

bool certain_disjoint(const RootBox& a, const RootBox& b) {
  for (std::size_t i = 0; i < a.center.size(); ++i)
    if (certain_disjoint(a[i].re, b[i].re) || certain_disjoint(a[i].im, b[i].im)) return true;
  return false;
}

}  // namespace regulus::detail
