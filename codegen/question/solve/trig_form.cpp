// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/trig_form.hpp"

#include <algorithm>
#include <cstdlib>

#include "runtime/interval/elementary.hpp"

namespace regulus::detail {
namespace {

const Interval kHalf(0.5);

/// Returns the frequency that a wave numbers.
Interval frequency_of(long wave, const std::vector<Interval>& bases) {
  Interval sum(0.0);
  long rest = std::labs(wave);
  for (const Interval& base : bases) {
    long digit = rest % kWaveBase;
    if (digit > kWaveBase / 2) digit -= kWaveBase;  // digits may be negative
    sum += Interval(double(digit)) * base;
    rest = (rest - digit) / kWaveBase;
  }
  return sum;
}

/// x^power and its derivatives.
std::array<Interval, 3> powers_of(const Interval& x, int power) {
  if (power == 0) return {1.0, 0.0, 0.0};
  if (power == 1) return {x, 1.0, 0.0};
  const Interval p(power);
  if (power == 2) return {sqr(x), p * x, p};
  return {pow(x, power), p * pow(x, power - 1), p * (p - Interval(1.0)) * pow(x, power - 2)};
}

}  // namespace

void TrigForm::add(const Functions& functions, const Interval& coefficient) {
  if (coefficient != Interval(0.0)) terms_[functions] += coefficient;
}

void TrigForm::add_cos(Functions functions, std::size_t unknown, long wave,
                       const Interval& coefficient) {
  functions[unknown].wave = std::labs(wave);
  add(functions, coefficient);
}

void TrigForm::add_sin(Functions functions, std::size_t unknown, long wave,
                       const Interval& coefficient) {
  if (wave == 0) return;
  functions[unknown].wave = -std::labs(wave);
  add(functions, wave > 0 ? coefficient : -coefficient);
}

TrigForm TrigForm::times_cos(std::size_t unknown, long wave) const {
  TrigForm result;
  for (const auto& [functions, c] : terms_) {
    const long own = functions[unknown].wave;
    if (own == 0) {
      result.add_cos(functions, unknown, wave, c);
      continue;
    }
    const auto add = own > 0 ? &TrigForm::add_cos : &TrigForm::add_sin;
    (result.*add)(functions, unknown, std::labs(own) + wave, kHalf * c);
    (result.*add)(functions, unknown, std::labs(own) - wave, kHalf * c);
  }
  return result;
}

TrigForm TrigForm::times_sin(std::size_t unknown, long wave) const {
  TrigForm result;
  for (const auto& [functions, c] : terms_) {
    const long own = functions[unknown].wave;
    if (own == 0) {
      result.add_sin(functions, unknown, wave, c);
    } else if (own > 0) {  // cos(own)·sin(wave)
      result.add_sin(functions, unknown, wave + own, kHalf * c);
      result.add_sin(functions, unknown, wave - own, kHalf * c);
    } else {  // sin(−own)·sin(wave)
      result.add_cos(functions, unknown, -own - wave, kHalf * c);
      result.add_cos(functions, unknown, -own + wave, -kHalf * c);
    }
  }
  return result;
}

TrigForm TrigForm::times_unknown(std::size_t unknown) const {
  TrigForm result;
  for (const auto& [functions, c] : terms_) {
    Functions more = functions;
    ++more[unknown].power;
    result.add(more, c);
  }
  return result;
}

TrigForm operator+(const TrigForm& a, const TrigForm& b) {
  TrigForm result = a;
  for (const auto& [functions, c] : b.terms_) result.add(functions, c);
  return result;
}

TrigForm operator*(const Interval& factor, const TrigForm& form) {
  TrigForm result;
  for (const auto& [functions, c] : form.terms_) result.add(functions, factor * c);
  return result;
}

TrigForms::TrigForms(std::span<const TrigForm> forms, const WaveBases& bases) {
  for (const TrigForm& form : forms) {
    std::vector<Term>& terms = forms_.emplace_back();
    for (const auto& [functions, c] : form.terms()) {
      Term& term = terms.emplace_back(Term{{}, c});
      for (std::size_t k = 0; k < kFour; ++k) {
        const TrigFunction& kind = functions[k];
        const auto at = std::ranges::find(functions_[k], kind, &Function::kind);
        term.function[k] = std::size_t(at - functions_[k].begin());
        if (at == functions_[k].end())
          functions_[k].push_back({kind, frequency_of(kind.wave, bases[k])});
      }
    }
  }
}

TrigForms::Values TrigForms::functions_at(std::span<const Interval> unknowns) const {
  Values values;
  for (std::size_t k = 0; k < kFour; ++k)
    for (const auto& [kind, frequency] : functions_[k]) {
      const bool waves = kind.wave != 0, is_sine = kind.wave < 0;
      const SinCos t =
          waves ? sincos(frequency * unknowns[k]) : SinCos{Interval(0.0), Interval(1.0)};
      const Interval wave = is_sine ? t.sin : t.cos, rate = is_sine ? t.cos : -t.sin;
      const std::array<Interval, 3> trig =
          waves ? std::array{wave, frequency * rate, -sqr(frequency) * wave}
                : std::array<Interval, 3>{1.0, 0.0, 0.0};
      const std::array<Interval, 3> power = powers_of(unknowns[k], kind.power);
      values[k][0].push_back(power[0] * trig[0]);
      values[k][1].push_back(power[1] * trig[0] + power[0] * trig[1]);
      values[k][2].push_back(power[2] * trig[0] + Interval(2.0) * power[1] * trig[1] +
                             power[0] * trig[2]);
    }
  return values;
}

Interval TrigForms::value(std::size_t form, const Values& values,
                          const std::array<std::size_t, kFour>& by) const {
  return sum(forms_[form], values, by, 0);
}

Interval TrigForms::sum(std::span<const Term> terms, const Values& values,
                        const std::array<std::size_t, kFour>& by, std::size_t unknown) {
  if (unknown == kFour) return terms.front().factor;
  Interval result(0.0);
  while (!terms.empty()) {
    const std::size_t function = terms.front().function[unknown];
    const auto end = std::ranges::find_if(
        terms, [&](const Term& term) { return term.function[unknown] != function; });
    const auto alike = terms.first(std::size_t(end - terms.begin()));
    const Interval& value = values[unknown][by[unknown]][function];
    if (value != Interval(0.0)) result += value * sum(alike, values, by, unknown + 1);
    terms = terms.subspan(alike.size());
  }
  return result;
}

}  // namespace regulus::detail
