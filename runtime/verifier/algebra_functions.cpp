// SPDX-License-Identifier: Apache-2.0
// Roots, angles and exponentials as atoms, by the relations of PROOF.md, "Exact algebra".
#include <fmpz.h>

#include <cstdlib>

#include "runtime/verifier/algebra.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostAtomsOfPairs = 64;          ///< that are searched for a product of arguments
constexpr unsigned long kLargestPrime = 1000;  ///< that is searched for below a root
constexpr long kMostTurns = 16;                ///< of a unit angle, multiplied out
constexpr long kMostTimes = 64;                ///< of a unit exponent

/// An owned fmpz_t.
class Integer {
 public:
  Integer() noexcept { fmpz_init(value_); }
  explicit Integer(const fmpz_t value) noexcept : Integer() { fmpz_set(value_, value); }
  Integer(const Integer&) = delete;
  Integer& operator=(const Integer&) = delete;
  ~Integer() { fmpz_clear(value_); }
  [[nodiscard]] fmpz* get() noexcept { return value_; }

 private:
  fmpz_t value_;
};

Rational rational(const fmpz_t numerator) {
  Rational result;
  fmpz_set(fmpq_numref(result.get()), numerator);
  return result;
}

/// Returns ±1 and a polynomial whose first factor is positive.
std::pair<long, Polynomial> with_sign(const Polynomial& p) {
  const bool negative = !p.is_zero() && p.terms().begin()->second.sign() < 0;
  return {negative ? -1 : 1, negative ? p.scaled(Rational(-1)) : p};
}

/// Returns asin, acos or atan of x, divided by π, if x is 0, ±1 or (not for atan) ±1/2.
std::optional<Rational> part_of_pi(Op op, const Polynomial& x) {
  if (!x.is_constant()) return std::nullopt;
  const Rational twice = x.constant() * Rational(2), size = twice * Rational(twice.sign());
  const bool is_whole = size == Rational(2), is_half = size == Rational(1);
  const Rational sign(twice.sign());
  if (!x.is_zero() && !is_whole && (!is_half || op == Op::kAtan)) return std::nullopt;
  if (op == Op::kAtan) return sign / Rational(4);
  const Rational sine = sign / Rational(is_whole ? 2 : 6);
  return op == Op::kAsin ? sine : Rational(1) / Rational(2) - sine;
}

}  // namespace

/// Returns √p = √c·√(p/c) for c > 0.
Polynomial Algebra::root(const Polynomial& x) {
  if (x.is_zero()) return x;
  if (x.is_constant()) {
    if (x.constant().sign() < 0)
      throw TooLarge("exact algebra meets the root of a negative number");
    return root_of_rational(x.constant());
  }
  Rational size;
  fmpq_abs(size.get(), x.terms().begin()->second.get());
  const Polynomial rest = Polynomial::atom(atom_of(Op::kSqrt, x.scaled(Rational(1) / size)));
  return product(root_of_rational(size), rest);
}

/// Returns √(p/q) = √(p·q)/q.
Polynomial Algebra::root_of_rational(const Rational& x) {
  Integer both(fmpq_numref(x.get()));
  fmpz_mul(both.get(), both.get(), fmpq_denref(x.get()));
  return root_of_integer(both.get()).scaled(Rational(1) / rational(fmpq_denref(x.get())));
}

/// Makes atoms of the roots of small primes, and of the rest; takes squares out of the root.
Polynomial Algebra::root_of_integer(const fmpz_t x) {
  budget_.spend(kLargestPrime * (1 + fmpz_bits(x) / 1024));
  Integer rest(x), outside, prime_part, remainder;
  fmpz_one(outside.get());
  Polynomial result(1);
  for (unsigned long prime = 2; prime < kLargestPrime; ++prime) {
    fmpz_set_ui(prime_part.get(), prime);
    const slong times = fmpz_remove(rest.get(), rest.get(), prime_part.get());
    if (times == 0) continue;
    fmpz_pow_ui(prime_part.get(), prime_part.get(), ulong(times / 2));
    fmpz_mul(outside.get(), outside.get(), prime_part.get());
    if (times % 2 != 0)
      result = product(result, Polynomial::atom(atom_of(Op::kSqrt, Polynomial(long(prime)))));
  }
  if (fmpz_is_square(rest.get()) != 0) {
    fmpz_sqrt(rest.get(), rest.get());
    fmpz_mul(outside.get(), outside.get(), rest.get());
  } else {
    const Polynomial under(rational(rest.get()));
    result = product(result, Polynomial::atom(atom_of(Op::kSqrt, under)));
  }
  return result.scaled(rational(outside.get()));
}

/// Finds two atoms of the same function whose arguments multiply to the argument of the atom.
std::optional<std::pair<int, int>> Algebra::parts_of(int number) {
  const Atom whole = atoms_[std::size_t(number)];
  if (whole.kind != Atom::Kind::kFunction || (whole.op != Op::kSqrt && whole.op != Op::kLog))
    return std::nullopt;
  const int count = std::min(int(atoms_.size()), kMostAtomsOfPairs);
  const auto is_like = [&](int k) {
    const Atom& atom = atoms_[std::size_t(k)];
    return k != number && atom.kind == whole.kind && atom.op == whole.op;
  };
  for (int first = 0; first < count; ++first)
    for (int second = first; is_like(first) && second < count; ++second) {
      if (!is_like(second)) continue;
      const Polynomial f = atoms_[std::size_t(first)].argument;
      if (product(f, atoms_[std::size_t(second)].argument) == whole.argument)
        return std::pair{first, second};
    }
  return std::nullopt;
}

Polynomial Algebra::split_functions(const Polynomial& p) {
  Polynomial result;
  for (const auto& [powers, factor] : p.terms()) {
    Polynomial term(factor);
    for (const auto& [number, exponent] : powers) {
      const auto parts = exponent > 0 ? parts_of(number) : std::nullopt;
      Polynomial atom = Polynomial::atom(number, parts ? 1 : exponent);
      if (parts) {
        const Polynomial first = Polynomial::atom(parts->first);
        const Polynomial second = Polynomial::atom(parts->second);
        const bool is_root = atoms_[std::size_t(number)].op == Op::kSqrt;
        atom = is_root ? product(first, second) : sum(first, second, 1);
        atom = power(atom, exponent);
      }
      term = product(term, atom);
    }
    result.add(term);
  }
  return result;
}

Polynomial Algebra::magnitude(const Polynomial& x) {
  if (x.is_zero()) return x;
  Rational size;
  fmpq_abs(size.get(), x.terms().begin()->second.get());
  if (x.is_constant()) return Polynomial(size);
  const Polynomial one = with_sign(x.scaled(Rational(1) / size)).second;
  return Polynomial::atom(atom_of(Op::kAbs, one)).scaled(size);
}

/// Uses exp Σ c_μμ = ∏ exp(μ/d_μ)^(c_μd_μ), if the exponent is a whole number and not too large.
Polynomial Algebra::exponential(const Polynomial& x) {
  Polynomial result(1);
  for (const auto& [powers, factor] : x.terms()) {
    const Rational unit = Rational(1) / rational(fmpq_denref(factor.get()));
    Rational times = factor / unit;
    Polynomial argument;
    argument.add(powers, unit);
    if (fmpz_cmp_si(fmpq_numref(times.get()), kMostTimes) > 0 ||
        fmpz_cmp_si(fmpq_numref(times.get()), -kMostTimes) < 0) {
      argument = Polynomial();
      argument.add(powers, factor);
      times = Rational(1);
    }
    const int exponent = int(fmpz_get_si(fmpq_numref(times.get())));
    result = product(result, Polynomial::atom(atom_of(Op::kExp, argument), exponent));
  }
  return result;
}

/// Uses f(−x) = −f(x).
Polynomial Algebra::odd_function(Op op, const Polynomial& x) {
  const auto [sign, positive] = with_sign(x);
  return Polynomial::atom(atom_of(op, positive)).scaled(Rational(sign));
}

Polynomial Algebra::function(Op op, const Polynomial& x) {
  const bool is_full = form_ == Form::kFull;
  switch (op) {
    case Op::kSqrt:
      return root(x);
    case Op::kAbs:
      return magnitude(x);
    case Op::kExp:
      if (is_full) return exponential(x);
      break;
    case Op::kSin:
      if (is_full) return turn(x).sine;
      break;
    case Op::kCos:
      if (is_full) return turn(x).cosine;
      break;
    case Op::kTan:
      if (is_full) {
        const Turn angle = turn(x);
        return product(angle.sine, inverse(angle.cosine));
      }
      break;
    case Op::kAsin:
    case Op::kAcos:
    case Op::kAtan:
      if (const auto turns = part_of_pi(op, x)) return pi().scaled(*turns);
      if (op == Op::kAcos) {  // π/2 − asin x
        Polynomial angle = pi().scaled(Rational(1) / Rational(2));
        angle.add(function(Op::kAsin, x).scaled(Rational(-1)));
        return angle;
      }
      return odd_function(op, x);
    case Op::kLog:
      if (x == Polynomial(1)) return {};
      break;
    default:
      break;
  }
  return Polynomial::atom(atom_of(op, x));
}

Polynomial Algebra::pi() {
  return Polynomial::atom(number_of({Atom::Kind::kPi, Op::kPi, 0, {}, {}}, "pi"));
}

Polynomial Algebra::angle_of_two(const Polynomial& y, const Polynomial& x) {
  return Polynomial::atom(atom_of(Op::kAtan2, y, x));
}

bool Algebra::is_pi(const PowerProduct& product) const {
  return product.size() == 1 && product[0].second == 1 &&
         atoms_[std::size_t(product[0].first)].kind == Atom::Kind::kPi;
}

/// Computes sin and cos of Σ c_μμ from those of each c_μμ by the addition theorem.
Algebra::Turn Algebra::turn(const Polynomial& angle) {
  Turn result{Polynomial(), Polynomial(1)};
  for (const auto& [powers, factor] : angle.terms()) {
    if (is_pi(powers)) {
      result = add(result, turn_of_pi(factor));
      continue;
    }
    Rational& unit = units_.try_emplace(powers, Rational(1)).first->second;
    if (finding_)
      fmpz_lcm(fmpq_numref(unit.get()), fmpq_numref(unit.get()), fmpq_denref(factor.get()));
    const Rational times = factor * unit;
    Polynomial argument;
    const bool is_whole = times.is_integer() &&
                          fmpz_cmp_si(fmpq_numref(times.get()), kMostTurns) <= 0 &&
                          fmpz_cmp_si(fmpq_numref(times.get()), -kMostTurns) >= 0;
    argument.add(powers, is_whole ? Rational(1) / unit : factor);
    const long count = is_whole ? fmpz_get_si(fmpq_numref(times.get())) : 1;
    result = add(result, multiple(turn_of_unit(argument), count));
  }
  return result;
}

/// Sine and cosine of asin, acos and atan are algebraic; otherwise they are two atoms.
Algebra::Turn Algebra::turn_of_unit(const Polynomial& unit) {
  const auto& [powers, factor] = *unit.terms().begin();
  const auto [sign, positive] = with_sign(unit);
  if (powers.size() == 1 && powers[0].second == 1 &&
      positive.terms().begin()->second == Rational(1)) {
    const Atom inner = atoms_[std::size_t(powers[0].first)];
    const Rational turned(sign);
    const auto cathetus = [&] {
      Polynomial rest(1);
      rest.add(product(inner.argument, inner.argument).scaled(Rational(-1)));
      return root(rest);
    };
    if (inner.kind == Atom::Kind::kFunction && inner.op == Op::kAsin)
      return {inner.argument.scaled(turned), cathetus()};
    if (inner.kind == Atom::Kind::kFunction && inner.op == Op::kAtan) {
      Polynomial norm(1);
      norm.add(product(inner.argument, inner.argument));
      const Polynomial cosine = inverse(root(norm));
      return {product(inner.argument, cosine).scaled(turned), cosine};
    }
  }
  const int sine = atom_of(Op::kSin, positive), cosine = atom_of(Op::kCos, positive);
  atoms_[std::size_t(cosine)].sine = sine;
  return {Polynomial::atom(sine).scaled(Rational(sign)), Polynomial::atom(cosine)};
}

Algebra::Turn Algebra::add(const Turn& x, const Turn& y) {
  Turn result{product(x.sine, y.cosine), product(x.cosine, y.cosine)};
  result.sine.add(product(x.cosine, y.sine));
  result.cosine.add(product(x.sine, y.sine).scaled(Rational(-1)));
  return result;
}

Algebra::Turn Algebra::multiple(Turn unit, long times) {
  if (times < 0) unit.sine = unit.sine.scaled(Rational(-1));
  Turn result = unit;
  for (long i = 1; i < std::labs(times); ++i) result = add(result, unit);
  return result;
}

/// For an angle between 0 and π/4: sin π/10 = (√5 − 1)/4 and cos π/10 = √((5 + √5)/8), and π/5 is the
/// double; the others stay as they are.
Algebra::Turn Algebra::turn_of_small_part(const Rational& factor) {
  const auto with_root5 = [&](long whole, long of_root, long divisor) {
    Polynomial sum = root(Polynomial(5)).scaled(Rational(of_root));
    sum.add(Polynomial(whole));
    return sum.scaled(Rational(1) / Rational(divisor));
  };
  const bool is_tenth = factor == Rational(1) / Rational(10);
  if (is_tenth || factor == Rational(1) / Rational(5)) {
    const Turn tenth{with_root5(-1, 1, 4), root(with_root5(5, 1, 8))};
    if (is_tenth) return tenth;
    return {product(tenth.sine, tenth.cosine).scaled(Rational(2)), with_root5(1, 1, 4)};
  }
  Polynomial angle;
  angle.add({{numbers_.at("pi"), 1}}, factor);
  return turn_of_unit(angle);
}

/// The angle is that of a number of quarter turns and of an angle up to π/4, or its complement.
Algebra::Turn Algebra::turn_of_part(const Rational& factor) {
  const Rational quarters = factor * Rational(2);
  Integer whole;
  fmpz_fdiv_q(whole.get(), fmpq_numref(quarters.get()), fmpq_denref(quarters.get()));
  Rational rest;
  fmpq_sub_fmpz(rest.get(), quarters.get(), whole.get());
  const bool is_complement = (rest - Rational(1) / Rational(2)).sign() > 0;
  if (is_complement) rest = Rational(1) - rest;
  Turn result = turn_of_small_part(rest / Rational(2));
  if (is_complement) std::swap(result.sine, result.cosine);
  for (ulong i = fmpz_fdiv_ui(whole.get(), 4); i > 0; --i)
    result = {result.cosine, result.sine.scaled(Rational(-1))};
  return result;
}

/// Exact for the multiples of π/4 and π/6.
Algebra::Turn Algebra::turn_of_pi(const Rational& factor) {
  const Rational twelfths = factor * Rational(12);
  if (!twelfths.is_integer()) return turn_of_part(factor);
  Integer turns(fmpq_numref(twelfths.get()));
  const long parts = long(fmpz_fdiv_ui(turns.get(), 24));
  const Polynomial half(Rational(1) / Rational(2));
  const Polynomial of2 = root(half);                                   // cos π/4
  const Polynomial of3 = root(Polynomial(Rational(3) / Rational(4)));  // cos π/6
  const Turn eighth{of2, of2}, twelfth{half, of3}, quarter{Polynomial(1), Polynomial()};
  Turn result{Polynomial(), Polynomial(1)};
  for (long i = 0; i < parts / 6; ++i) result = add(result, quarter);
  switch (parts % 6) {
    case 1:  // π/12 = π/4 − π/6
      return add(add(result, eighth), {half.scaled(Rational(-1)), of3});
    case 2:
      return add(result, twelfth);
    case 3:
      return add(result, eighth);
    case 4:
      return add(add(result, twelfth), twelfth);
    case 5:
      return add(add(result, eighth), twelfth);
    default:
      return result;
  }
}

void Algebra::find_units(const std::vector<NodeId>& roots) {
  finding_ = true;
  for (const NodeId root : roots) static_cast<void>(of(root));
  finding_ = false;
  known_.clear();
}

}  // namespace regulus::verifier
