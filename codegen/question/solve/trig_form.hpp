// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of products of powers, sines and cosines of four unknowns, with coefficients that are enclosed.
#pragma once

#include <array>
#include <compare>
#include <map>
#include <span>
#include <vector>

#include "codegen/question/solve/arm_chain.hpp"

namespace regulus::detail {

inline constexpr std::size_t kFour = 4;

/// A function of one unknown: x^power·cos(w·x) if `wave` ≥ 0, or x^power·sin(w·x) for the wave −w. A wave numbers
/// its frequency: Σ n_r·base_r is the number Σ n_r·kWaveBase^r, so that sums of frequencies are those of numbers.
struct TrigFunction {
  int power = 0;
  long wave = 0;

  friend auto operator<=>(const TrigFunction&, const TrigFunction&) = default;
};
inline constexpr long kWaveBase = 256;  ///< its seventh power is a long

/// Σ c·f₁·f₂·f₃·f₄ with functions f_k of the unknowns.
class TrigForm {
 public:
  using Functions = std::array<TrigFunction, kFour>;

  TrigForm() = default;
  explicit TrigForm(const Interval& constant) { add({}, constant); }

  [[nodiscard]] const std::map<Functions, Interval>& terms() const { return terms_; }
  [[nodiscard]] TrigForm times_cos(std::size_t unknown, long wave) const;
  [[nodiscard]] TrigForm times_sin(std::size_t unknown, long wave) const;
  [[nodiscard]] TrigForm times_unknown(std::size_t unknown) const;

  friend TrigForm operator+(const TrigForm& a, const TrigForm& b);
  friend TrigForm operator*(const Interval& factor, const TrigForm& form);
  friend TrigForm operator-(const TrigForm& a, const TrigForm& b) { return a + Interval(-1.0) * b; }

 private:
  void add(const Functions& functions, const Interval& coefficient);
  void add_cos(Functions functions, std::size_t unknown, long wave, const Interval& coefficient);
  void add_sin(Functions functions, std::size_t unknown, long wave, const Interval& coefficient);

  std::map<Functions, Interval> terms_;
};

/// By unknown: its base frequencies.
using WaveBases = std::array<std::vector<Interval>, kFour>;

/// Forms that are evaluated at the same place, with derivatives.
class TrigForms {
 public:
  TrigForms(std::span<const TrigForm> forms, const WaveBases& bases);

  /// By unknown, and by the order of the derivative: the values of its functions.
  using Values = std::array<std::array<std::vector<Interval>, 3>, kFour>;
  /// Rounding  outward; MXCSR at nearest.
  [[nodiscard]] Values functions_at(std::span<const Interval> unknowns) const;

  /// Encloses a derivative of a form. `by`: how often by each unknown; at most 2.
  [[nodiscard]] Interval value(std::size_t form, const Values& values,
                               const std::array<std::size_t, kFour>& by) const;

 private:
  struct Term {
    std::array<std::size_t, kFour> function;
    Interval factor;
  };
  struct Function {
    TrigFunction kind;
    Interval frequency;
  };
  [[nodiscard]] static Interval sum(std::span<const Term> terms, const Values& values,
                                    const std::array<std::size_t, kFour>& by, std::size_t unknown);

  std::array<std::vector<Function>, kFour> functions_;
  std::vector<std::vector<Term>> forms_;  ///< terms with equal first functions together
};

}  // namespace regulus::detail
