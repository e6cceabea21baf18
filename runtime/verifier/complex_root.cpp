// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/complex_root.hpp"

#include <cmath>

#include "runtime/verifier/interval.hpp"

namespace regulus::verifier {
namespace {

constexpr long kLeastBits = 128;
constexpr int kMostStepsOfRoot = 40;
/// Distances that are tried for the reach, in parts of the scale: from 2^-20 on, each by 2^-12 smaller.
constexpr int kFirstExponent = -20, kNextExponent = -12;
constexpr int kMostContractions = 12;
/// The reach of a family grows by this factor over what the last one needed.
constexpr double kMoreReach = 1.125;
constexpr int kMostGrowths = 24;

double double_ru(const mag_struct* x) {
  arf_t exact;
  arf_init(exact);
  arf_set_mag(exact, x);
  const double result = arf_get_d(exact, ARF_RND_CEIL);
  arf_clear(exact);
  return result;
}

double double_rd(const mag_struct* x) {
  arf_t exact;
  arf_init(exact);
  arf_set_mag(exact, x);
  const double result = arf_get_d(exact, ARF_RND_FLOOR);
  arf_clear(exact);
  return result;
}

/// Bounds |x| for every x of the rectangle.
Interval modulus(acb_srcptr x) {
  mag_t least, most;
  mag_init(least), mag_init(most);
  acb_get_mag_lower(least, x);
  acb_get_mag(most, x);
  const Interval result{double_rd(least), double_ru(most)};
  mag_clear(least), mag_clear(most);
  return result;
}

void widen(acb_ptr x, double radius) {
  mag_t most;
  mag_init(most);
  mag_set_d(most, radius);
  acb_add_error_mag(x, most);
  mag_clear(most);
}

ComplexMatrix polydisc(const ComplexMatrix& center, std::span<const double> radius) {
  ComplexMatrix result(center);
  for (std::size_t i = 0; i < radius.size(); ++i) widen(result.at(i), radius[i]);
  return result;
}

class RootTest {
 public:
  RootTest(const ComplexSystem& system, const ComplexMatrix& start, std::span<const double> scale,
           long bits)
      : system_(&system),
        n_(system.unknowns()),
        scale_(scale),
        bits_(bits),
        center_(start),
        values_(n_, 1),
        offset_(n_, 1),
        derivatives_(n_, n_),
        inverse_(n_, n_) {}

  [[nodiscard]] std::optional<ComplexRoot> prove() {
    if (!approach()) return std::nullopt;
    for (long exponent = kFirstExponent; exponent > -bits_ / 2; exponent += kNextExponent) {
      std::vector<double> reach;
      for (const double size : scale_) reach.push_back(std::ldexp(size, int(exponent)));
      const std::vector<double> image = image_of(reach);
      if (is_inside(image, reach)) return ComplexRoot{center_, reach, contracted(image)};
    }
    return std::nullopt;
  }

  /// The reach grows from what the centre needs, until the test holds or the reach is too wide.
  [[nodiscard]] std::optional<ComplexRoot> prove_all(const ComplexSystem& family) {
    if (!approach()) return std::nullopt;
    family.evaluate(center_, values_, derivatives_, bits_);
    acb_mat_mul(offset_.get(), inverse_.get(), values_.get(), bits_);
    system_ = &family;
    std::vector<double> reach;
    for (std::size_t i = 0; i < n_; ++i)
      reach.push_back(kMoreReach * modulus(offset_.at(i)).hi +
                      std::ldexp(scale_[i], kNextExponent * 5));
    for (int step = 0; step < kMostGrowths; ++step) {
      const std::vector<double> image = image_of(reach);
      if (is_inside(image, reach)) return ComplexRoot{center_, reach, contracted(image)};
      for (std::size_t i = 0; i < n_; ++i) {
        if (!(image[i] < scale_[i])) return std::nullopt;
        reach[i] = std::max(reach[i], kMoreReach * image[i]);
      }
    }
    return std::nullopt;
  }

 private:
  /// Newton's method, until half of the digits are right, and a step more.
  [[nodiscard]] bool approach() {
    bool is_last = false;
    for (int step = 0; !is_last; ++step) {
      if (step == kMostStepsOfRoot || !evaluate_center()) return false;
      is_last = is_near();
      acb_mat_sub(center_.get(), center_.get(), offset_.get(), bits_);
      acb_mat_get_mid(center_.get(), center_.get());
    }
    return evaluate_center();
  }

  /// Takes K ≈ F′(c)⁻¹ (any other K would be as sound), and bounds KF(c).
  [[nodiscard]] bool evaluate_center() {
    if (acb_mat_is_finite(center_.get()) == 0) return false;
    system_->evaluate(center_, values_, derivatives_, bits_);
    acb_mat_get_mid(derivatives_.get(), derivatives_.get());
    if (acb_mat_approx_inv(inverse_.get(), derivatives_.get(), bits_) == 0) return false;
    acb_mat_get_mid(inverse_.get(), inverse_.get());
    acb_mat_mul(offset_.get(), inverse_.get(), values_.get(), bits_);
    return acb_mat_is_finite(offset_.get()) != 0;
  }

  /// Half of the digits are right: a step more leads to all of them.
  [[nodiscard]] bool is_near() const {
    for (std::size_t i = 0; i < n_; ++i)
      if (!(modulus(offset_.at(i)).hi < std::ldexp(scale_[i], int(-bits_ / 2)))) return false;
    return true;
  }

  /// Bounds |G(z)_i − c_i| for all z within `reach` of c, G(z) = z − KF(z).
  [[nodiscard]] std::vector<double> image_of(std::span<const double> reach) {
    ComplexMatrix values(n_, 1), derivatives(n_, n_), deviation(n_, n_);
    system_->evaluate(polydisc(center_, reach), values, derivatives, bits_);
    acb_mat_mul(deviation.get(), inverse_.get(), derivatives.get(), bits_);
    std::vector<double> image;
    for (std::size_t i = 0; i < n_; ++i) {
      acb_sub_ui(deviation.at(i, i), deviation.at(i, i), 1, bits_);
      Interval sum = point(modulus(offset_.at(i)).hi);
      for (std::size_t j = 0; j < n_; ++j) {
        const double e = modulus(deviation.at(i, j)).hi;
        if (!std::isfinite(e)) return std::vector<double>(n_, kInfinity);
        sum = sum + point(e) * point(reach[j]);
      }
      image.push_back(is_bounded(sum) ? sum.hi : kInfinity);
    }
    return image;
  }

  [[nodiscard]] static bool is_inside(std::span<const double> image,
                                      std::span<const double> reach) {
    for (std::size_t i = 0; i < image.size(); ++i)
      if (!(image[i] < reach[i])) return false;
    return true;
  }

  /// The root is in the image of each polydisc that it is in.
  [[nodiscard]] std::vector<double> contracted(std::vector<double> radius) {
    bool is_better = true;
    for (int step = 0; is_better && step < kMostContractions; ++step) {
      const std::vector<double> image = image_of(radius);
      is_better = false;
      for (std::size_t i = 0; i < n_; ++i) {
        is_better = is_better || image[i] < radius[i] / 2;
        radius[i] = std::min(radius[i], image[i]);
      }
    }
    return radius;
  }

  const ComplexSystem* system_;
  const std::size_t n_;
  const std::span<const double> scale_;
  const long bits_;
  ComplexMatrix center_, values_, offset_, derivatives_, inverse_;
};

/// Bounds |x − y|.
Interval distance(acb_srcptr x, acb_srcptr y) {
  acb_t difference;
  acb_init(difference);
  acb_sub(difference, x, y, kLeastBits);
  const Interval result = modulus(difference);
  acb_clear(difference);
  return result;
}

/// Of the center from its conjugate.
Interval distance_of_conjugate(acb_srcptr x) {
  acb_t conjugate;
  acb_init(conjugate);
  acb_conj(conjugate, x);
  const Interval result = distance(x, conjugate);
  acb_clear(conjugate);
  return result;
}

}  // namespace

ComplexMatrix ComplexRoot::enclosure() const { return polydisc(center, radius); }

std::optional<ComplexRoot> prove_root(const ComplexSystem& system, const ComplexMatrix& start,
                                      std::span<const double> scale, long most_bits) {
  for (long bits = kLeastBits; bits <= most_bits; bits *= 2)
    if (auto root = RootTest(system, start, scale, bits).prove()) return root;
  return std::nullopt;
}

std::optional<ComplexRoot> prove_tube(const ComplexSystem& one, const ComplexSystem& family,
                                      const ComplexMatrix& start, std::span<const double> scale) {
  return RootTest(one, start, scale, kLeastBits).prove_all(family);
}

Certainty is_same(const ComplexRoot& a, const ComplexRoot& b) {
  bool is_within = true;
  for (std::size_t i = 0; i < a.reach.size(); ++i) {
    const Interval apart = distance(a.center.at(i), b.center.at(i));
    if (apart.lo > (point(a.radius[i]) + point(b.radius[i])).hi) return Certainty::kNo;
    is_within = is_within && (point(apart.hi) + point(b.radius[i])).hi <= a.reach[i];
  }
  return is_within ? Certainty::kYes : Certainty::kUnknown;
}

/// The conjugate of a root is a root. Where it is within reach, it is the root itself.
Certainty is_real(const ComplexRoot& root) {
  bool is_within = true;
  for (std::size_t i = 0; i < root.reach.size(); ++i) {
    const Interval apart = distance_of_conjugate(root.center.at(i));
    if (apart.lo > (point(root.radius[i]) + point(root.radius[i])).hi) return Certainty::kNo;
    is_within = is_within && (point(apart.hi) + point(root.radius[i])).hi <= root.reach[i];
  }
  return is_within ? Certainty::kYes : Certainty::kUnknown;
}

}  // namespace regulus::verifier
