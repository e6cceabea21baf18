// SPDX-License-Identifier: Apache-2.0
// The poses p ↦ Rp + t of a platform on six legs: RᵀR = I, det R = 1, |t + R·b − a|² = ρ² for each leg.
#include <cmath>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/counted_system.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/linear_algebra.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kLegsOfPlatform = 6, kUnknowns = 12, kPosition = 9;
constexpr std::size_t kMostPoses = 40, kMostPosesOfPairs = 16;
constexpr long kBitsOfPlatform = 1088, kBitsOfRoots = 256;
constexpr std::uint64_t kProductsOfAnchor = 1 << 16;  ///< to show that two anchors are one

/// R row by row.
constexpr std::size_t entry(std::size_t row, std::size_t column) { return 3 * row + column; }

/// An owned acb_t.
class Complex {
 public:
  Complex() noexcept { acb_init(value_); }
  Complex(const Complex&) = delete;
  Complex& operator=(const Complex&) = delete;
  ~Complex() { acb_clear(value_); }
  [[nodiscard]] acb_ptr get() noexcept { return value_; }

 private:
  acb_t value_;
};

class PlatformSystem final : public CountedSystem {
 public:
  PlatformSystem(Question& q, const Box& places) : legs_(q.solutions->legs) {
    std::vector<NodeId> nodes;
    for (const LegLine& leg : legs_) {
      nodes.insert(nodes.end(), leg.base.begin(), leg.base.end());
      nodes.insert(nodes.end(), leg.platform.begin(), leg.platform.end());
      nodes.push_back(leg.square);
    }
    std::vector<Ball> variables;
    for (const Interval x : places) variables.emplace_back(x, kBitsOfPlatform);
    auto values = verifier::evaluate(q.graph, nodes, variables, kBitsOfPlatform);
    if (!values) throw Unfinished("a number of the legs has no certain value");
    numbers_ = std::move(*values);
    for (const Ball& number : numbers_) {
      enclosures_.push_back(number.enclosure());
      if (!is_bounded(enclosures_.back())) throw Unfinished("a number of the legs is too large");
    }
    are_in_pairs_ =
        meet_in_pairs(q.graph, &LegLine::base) || meet_in_pairs(q.graph, &LegLine::platform);
    for (std::size_t i = 0; i < kLegsOfPlatform; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        size_ = std::max({size_, mag(enclosure(i, axis)), mag(enclosure(i, 3 + axis))});
    if (!places.empty()) one_ = std::make_unique<PlatformSystem>(*this, AtMiddle());
  }

  struct AtMiddle {};
  /// The platform in the middle of those of another system.
  PlatformSystem(const PlatformSystem& other, AtMiddle)
      : legs_(other.legs_),
        numbers_(other.numbers_),
        enclosures_(other.enclosures_),
        are_in_pairs_(other.are_in_pairs_),
        size_(other.size_) {
    for (Ball& number : numbers_) arb_get_mid_arb(number.get(), number.get());
  }

  [[nodiscard]] std::size_t unknowns() const override { return kUnknowns; }
  [[nodiscard]] std::size_t most() const override {
    return are_in_pairs_ ? kMostPosesOfPairs : kMostPoses;
  }
  [[nodiscard]] const ComplexSystem* one() const override { return one_.get(); }
  [[nodiscard]] std::size_t numbers() const override { return 7; }

  void evaluate(const ComplexMatrix& z, ComplexMatrix& values, ComplexMatrix& derivatives,
                long bits) const override {
    acb_mat_zero(values.get());
    acb_mat_zero(derivatives.get());
    std::size_t row = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) columns(z, i, j, row++, values, derivatives, bits);
    for (std::size_t i = 0; i < kLegsOfPlatform; ++i) leg(z, i, row++, values, derivatives, bits);
  }

  /// From t and a quaternion up to a factor: R = I + 2(w[v]× + [v]×²)/q·q.
  [[nodiscard]] ComplexMatrix place_of(const ComplexMatrix& z) const override {
    ComplexMatrix place(kUnknowns, 1);
    Complex square, part;
    for (std::size_t i = 3; i < 7; ++i) acb_addmul(square.get(), z.at(i), z.at(i), kBitsOfRoots);
    const auto q = [&](std::size_t i) { return z.at(3 + i); };
    for (std::size_t i = 0; i < 3; ++i) {
      acb_set(place.at(kPosition + i), z.at(i));
      for (std::size_t j = 0; j < 3; ++j) {
        acb_ptr R = place.at(entry(i, j));
        acb_mul(R, q(1 + i), q(1 + j), kBitsOfRoots);
        if (i == j)
          for (std::size_t k = 1; k < 4; ++k) acb_submul(R, q(k), q(k), kBitsOfRoots);
        else if ((i + 1) % 3 == j)
          acb_submul(R, q(0), q(1 + 3 - i - j), kBitsOfRoots);
        else
          acb_addmul(R, q(0), q(1 + 3 - i - j), kBitsOfRoots);
        acb_mul_2exp_si(R, R, 1);
        acb_div(R, R, square.get(), kBitsOfRoots);
        if (i == j) acb_add_ui(R, R, 1, kBitsOfRoots);
      }
    }
    acb_mat_get_mid(place.get(), place.get());
    return place;
  }

  [[nodiscard]] std::vector<double> scale_at(const ComplexMatrix& place) const override {
    double turn = 1, shift = size_;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      const double part = std::hypot(arf_get_d(arb_midref(acb_realref(place.at(i))), ARF_RND_NEAR),
                                     arf_get_d(arb_midref(acb_imagref(place.at(i))), ARF_RND_NEAR));
      double& scale = i < kPosition ? turn : shift;
      if (part > scale) scale = part;
    }
    std::vector<double> scale(kUnknowns, turn);
    for (std::size_t i = kPosition; i < kUnknowns; ++i) scale[i] = shift > 0 ? shift : 1;
    return scale;
  }

  /// RᵀR = I leaves 1 and −1 for det R.
  void require_solution(const ComplexRoot& root) const override {
    const ComplexMatrix z = root.enclosure();
    ComplexMatrix R(3, 3);
    for (std::size_t i = 0; i < kPosition; ++i) acb_set(R.at(i / 3, i % 3), z.at(i));
    Complex determinant, one;
    acb_mat_det(determinant.get(), R.get(), kBitsOfRoots);
    acb_one(one.get());
    const bool may_be_turn = acb_contains(determinant.get(), one.get()) != 0;
    acb_neg(one.get(), one.get());
    const bool may_be_mirror = acb_contains(determinant.get(), one.get()) != 0;
    if (!may_be_turn) throw Rejection("the root is a reflection, and no pose");
    if (may_be_mirror) throw Unfinished("the root may be a reflection");
  }

  [[nodiscard]] Certainty is_within(const ComplexRoot& root,
                                    const SolutionLine& line) const override {
    const ComplexMatrix z = root.enclosure();
    Certainty of_position = Certainty::kYes;
    for (std::size_t i = 0; i < 3; ++i)
      take(of_position, real_part(z, kPosition + i).enclosure(), line.values[i]);
    const std::vector<Interval> q = quaternion_of(z);
    Certainty of_turn = Certainty::kNo;
    for (const bool is_negative : {false, true}) {
      Certainty one = Certainty::kYes;
      for (std::size_t i = 0; i < 4; ++i) take(one, is_negative ? -q[i] : q[i], line.values[3 + i]);
      if (one == Certainty::kYes || of_turn == Certainty::kNo) of_turn = one;
    }
    if (of_position == Certainty::kNo || of_turn == Certainty::kNo) return Certainty::kNo;
    return of_position == Certainty::kYes ? of_turn : Certainty::kUnknown;
  }

  void require_possible(const SolutionLine& line) const override {
    const auto& x = line.values;
    const auto q = [&](std::size_t i) { return x[3 + i]; };
    const auto twice = [&](std::size_t i, std::size_t j) { return 2.0 * (q(i) * q(j)); };
    const auto on = [&](std::size_t i, std::size_t j) {
      return point(1.0) - 2.0 * (square(q(i)) + square(q(j)));
    };
    const std::array<std::array<Interval, 3>, 3> R = {
        {{on(2, 3), twice(1, 2) - twice(0, 3), twice(1, 3) + twice(0, 2)},
         {twice(1, 2) + twice(0, 3), on(1, 3), twice(2, 3) - twice(0, 1)},
         {twice(1, 3) - twice(0, 2), twice(2, 3) + twice(0, 1), on(1, 2)}}};
    for (std::size_t i = 0; i < kLegsOfPlatform; ++i) {
      Interval excess = -enclosure(i, 6);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Interval part = x[axis] - enclosure(i, axis);
        for (std::size_t j = 0; j < 3; ++j) part = part + R[axis][j] * enclosure(i, 3 + j);
        excess = excess + square(part);
      }
      if (is_bounded(excess) && !contains(excess, 0.0))
        throw Rejection("no pose is within this line: leg " + std::to_string(i + 1) +
                        " has another length there");
    }
  }

 private:
  /// Number `part` of a leg: of its base, of its platform, and its squared length.
  [[nodiscard]] arb_srcptr number(std::size_t leg, std::size_t part) const {
    return numbers_[7 * leg + part].get();
  }
  [[nodiscard]] Interval enclosure(std::size_t leg, std::size_t part) const {
    return enclosures_[7 * leg + part];
  }

  /// Each leg has one other with the same anchor there.
  bool meet_in_pairs(Graph& graph, std::array<NodeId, 3> LegLine::*anchor) const {
    for (std::size_t i = 0; i < kLegsOfPlatform; ++i) {
      std::size_t partners = 0;
      for (std::size_t k = 0; k < kLegsOfPlatform; ++k) {
        bool is_same = k != i;
        for (std::size_t axis = 0; is_same && axis < 3; ++axis)
          is_same = certain_equal(graph, (legs_[i].*anchor)[axis], (legs_[k].*anchor)[axis],
                                  kProductsOfAnchor);
        partners += is_same;
      }
      if (partners != 1) return false;
    }
    return true;
  }

  /// Columns i and j of R are orthogonal; those of one number have the length 1.
  static void columns(const ComplexMatrix& z, std::size_t i, std::size_t j, std::size_t row,
                      ComplexMatrix& values, ComplexMatrix& derivatives, long bits) {
    for (std::size_t k = 0; k < 3; ++k) {
      acb_srcptr a = z.at(entry(k, i)), b = z.at(entry(k, j));
      acb_addmul(values.at(row), a, b, bits);
      acb_add(derivatives.at(row, entry(k, i)), derivatives.at(row, entry(k, i)), b, bits);
      acb_add(derivatives.at(row, entry(k, j)), derivatives.at(row, entry(k, j)), a, bits);
    }
    if (i == j) acb_sub_ui(values.at(row), values.at(row), 1, bits);
  }

  /// s·s − ρ² with s = t + R·b − a.
  void leg(const ComplexMatrix& z, std::size_t leg, std::size_t row, ComplexMatrix& values,
           ComplexMatrix& derivatives, long bits) const {
    Complex s;
    for (std::size_t i = 0; i < 3; ++i) {
      acb_sub_arb(s.get(), z.at(kPosition + i), number(leg, i), bits);
      for (std::size_t j = 0; j < 3; ++j)
        acb_addmul_arb(s.get(), z.at(entry(i, j)), number(leg, 3 + j), bits);
      acb_addmul(values.at(row), s.get(), s.get(), bits);
      acb_mul_2exp_si(s.get(), s.get(), 1);
      acb_set(derivatives.at(row, kPosition + i), s.get());
      for (std::size_t j = 0; j < 3; ++j)
        acb_mul_arb(derivatives.at(row, entry(i, j)), s.get(), number(leg, 3 + j), bits);
    }
    acb_sub_arb(values.at(row), values.at(row), number(leg, 6), bits);
  }

  static Ball real_part(const ComplexMatrix& z, std::size_t i) {
    Ball result;
    arb_set(result.get(), acb_realref(z.at(i)));
    return result;
  }

  /// The unit quaternion of R, up to its sign: 4q_k² = 1 ± R₀₀ ± R₁₁ ± R₂₂, and 4q_iq_k from others.
  static std::vector<Interval> quaternion_of(const ComplexMatrix& z) {
    std::array<Ball, 4> squares;  // 4q_k²
    for (std::size_t k = 0; k < 4; ++k) {
      arb_one(squares[k].get());
      for (std::size_t i = 0; i < 3; ++i) {
        arb_srcptr R = acb_realref(z.at(entry(i, i)));
        if (k == 0 || k == i + 1)
          arb_add(squares[k].get(), squares[k].get(), R, kBitsOfRoots);
        else
          arb_sub(squares[k].get(), squares[k].get(), R, kBitsOfRoots);
      }
    }
    std::size_t largest = 0;
    for (std::size_t k = 1; k < 4; ++k)
      if (arf_cmp(arb_midref(squares[k].get()), arb_midref(squares[largest].get())) > 0)
        largest = k;
    Ball twice;  // 2q of the largest
    arb_sqrt(twice.get(), squares[largest].get(), kBitsOfRoots);
    std::vector<Interval> result;
    for (std::size_t k = 0; k < 4; ++k) {
      Ball part;
      if (k == largest)
        arb_set(part.get(), twice.get());
      else
        arb_div(part.get(), product_of_parts(z, largest, k).get(), twice.get(), kBitsOfRoots);
      arb_mul_2exp_si(part.get(), part.get(), -1);
      result.push_back(part.enclosure());
    }
    return result;
  }

  /// 4q_iq_k.
  static Ball product_of_parts(const ComplexMatrix& z, std::size_t i, std::size_t k) {
    if (i > k) std::swap(i, k);
    const auto R = [&](std::size_t row, std::size_t column) {
      return acb_realref(z.at(entry(row, column)));
    };
    Ball result;
    if (i > 0) {
      arb_add(result.get(), R(i - 1, k - 1), R(k - 1, i - 1), kBitsOfRoots);
    } else {
      const std::size_t a = k % 3, b = (k + 1) % 3;
      arb_sub(result.get(), R(b, a), R(a, b), kBitsOfRoots);
    }
    return result;
  }

  /// `all`: of the parts before.
  static void take(Certainty& all, Interval part, Interval within) {
    if (!is_bounded(part))
      all = all == Certainty::kNo ? all : Certainty::kUnknown;
    else if (part.hi < within.lo || part.lo > within.hi)
      all = Certainty::kNo;
    else if (all == Certainty::kYes && !(within.lo <= part.lo && part.hi <= within.hi))
      all = Certainty::kUnknown;
  }

  const std::vector<LegLine>& legs_;
  std::vector<Ball> numbers_;  ///< of each leg base, platform, squared length
  std::vector<Interval> enclosures_;
  bool are_in_pairs_ = false;
  double size_ = 0;
  std::unique_ptr<PlatformSystem> one_;
};

}  // namespace

std::unique_ptr<CountedSystem> platform_system(Question& question, const Box& places) {
  return std::make_unique<PlatformSystem>(question, places);
}

}  // namespace regulus::verifier
