// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/families/hidden.hpp"

namespace regulus::detail::attack {
namespace {

using Texts = std::vector<std::vector<std::string>>;

std::string small_number(Random& random) {
  return random.pick({"1", "2", "(-1)", "(1/2)", "(-2/3)", "0.1", "3", "(-0.7)"});
}

/// Returns a function that has a value everywhere, of moderate size if x is.
std::string bounded_function(const std::string& x, Random& random) {
  switch (random.below(5)) {
    case 0:
      return "sin(" + x + ")";
    case 1:
      return "cos(" + x + ")";
    case 2:
      return "atan(" + x + ")";
    case 3:
      return "(1/(1 + " + x + "^2))";
    default:
      return "sqrt(1 + " + x + "^2)";
  }
}

/// Returns an entry below the diagonal of L or above the diagonal of U.
std::string entry(const std::vector<std::string>& names, Random& random) {
  if (random.one_in(4)) return "0";
  if (names.empty() || random.one_in(2)) return small_number(random);
  const std::string x = random.pick(names);
  switch (random.below(4)) {
    case 0:
      return x;
    case 1:
      return "(" + x + " + " + small_number(random) + ")";
    case 2:
      return "(" + small_number(random) + "*" + x + ")";
    default:
      return bounded_function(x, random);
  }
}

Texts unit_triangular(std::size_t n, bool lower, const std::vector<std::string>& names,
                      Random& random) {
  Texts t(n, std::vector<std::string>(n, "0"));
  for (std::size_t i = 0; i < n; ++i) {
    t[i][i] = "1";
    for (std::size_t j = 0; j < i; ++j) (lower ? t[i][j] : t[j][i]) = entry(names, random);
  }
  return t;
}

std::string times(const std::string& a, const std::string& b) {
  if (a == "0" || b == "0") return "0";
  if (a == "1") return b;
  if (b == "1") return a;
  return a + "*" + b;
}

template <class T>
void shuffle(std::vector<T>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

std::vector<std::size_t> permutation(std::size_t n, Random& random) {
  std::vector<std::size_t> p(n);
  for (std::size_t i = 0; i < n; ++i) p[i] = i;
  if (random.one_in(2)) shuffle(p, random);
  return p;
}

}  // namespace

std::vector<std::vector<Cell>> hidden_product(std::vector<std::string> factors,
                                              const std::vector<std::string>& names,
                                              Random& random) {
  const std::size_t n = factors.size();
  for (std::string& f : factors) f = "(" + f + ")";
  if (random.one_in(2)) shuffle(factors, random);
  const Texts L = unit_triangular(n, true, names, random);
  const Texts U = unit_triangular(n, false, names, random);
  const std::vector<std::size_t> P = permutation(n, random), Q = permutation(n, random);
  std::vector<std::vector<Cell>> rows(n, std::vector<Cell>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      std::string sum;
      for (std::size_t k = 0; k <= std::min(i, j); ++k) {
        const std::string term = times(times(L[i][k], factors[k]), U[k][j]);
        if (term != "0") sum += (sum.empty() ? "" : " + ") + term;
      }
      rows[P[i]][Q[j]].text = sum.empty() ? "0" : sum;
    }
  return rows;
}

}  // namespace regulus::detail::attack
