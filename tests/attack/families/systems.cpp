// SPDX-License-Identifier: GPL-3.0-or-later
// Systems of equations all of whose solutions are known: polynomials and sines with planted roots,
// hidden behind a linear map of the unknowns and combinations of the equations.
#include <algorithm>

#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"

namespace regulus::detail::attack {
namespace {

/// An equation in one number u, and all its roots.
struct OneEquation {
  std::string text;  ///< in which @ is u
  std::vector<Value> roots;
  std::vector<bool> is_double;
  bool is_hard = false;  ///< roots are nearly one, real or complex
};

using WholeRow = std::vector<long>;

/// Whole numbers with a determinant that is not 0, and its inverse.
struct WholeMap {
  std::vector<WholeRow> rows;
  std::vector<std::vector<Rational>> inverse;
};

/// Inverts by elimination; nullopt: it cannot.
std::optional<std::vector<std::vector<Rational>>> inverted(const std::vector<WholeRow>& rows) {
  const std::size_t n = rows.size();
  std::vector<std::vector<Rational>> A(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (const long entry : rows[i]) A[i].emplace_back(entry);
    for (std::size_t j = 0; j < n; ++j) A[i].emplace_back(i == j ? 1 : 0);
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t p = c;
    while (p < n && A[p][c].is_zero()) ++p;
    if (p == n) return std::nullopt;
    std::swap(A[p], A[c]);
    const Rational pivot = A[c][c];
    for (Rational& entry : A[c]) entry = entry / pivot;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == c) continue;
      const Rational factor = A[i][c];
      for (std::size_t j = 0; j < 2 * n; ++j) A[i][j] = A[i][j] - factor * A[c][j];
    }
  }
  for (auto& row : A) row.erase(row.begin(), row.begin() + std::ptrdiff_t(n));
  return A;
}

/// `is_unimodular`: the inverse has whole numbers, too.
WholeMap whole_map(Builder& b, std::size_t n, bool is_unimodular) {
  for (;;) {
    WholeMap map;
    for (std::size_t i = 0; i < n; ++i) {
      WholeRow row;
      for (std::size_t j = 0; j < n; ++j) row.push_back(b.random.between(-2, 2));
      map.rows.push_back(std::move(row));
    }
    const auto inverse = inverted(map.rows);
    if (!inverse) continue;
    const bool is_whole = std::ranges::all_of(*inverse, [](const auto& row) {
      return std::ranges::all_of(row, [](const Rational& entry) { return entry.is_integer(); });
    });
    if (is_unimodular && !is_whole) continue;
    map.inverse = *inverse;
    return map;
  }
}

const std::vector<std::string> kNames = {"p", "q", "r"};

/// Returns row·(p, q, r) as an expression.
std::string combination(const WholeRow& row) {
  std::string text;
  for (std::size_t j = 0; j < row.size(); ++j)
    text += (text.empty() ? "" : " + ") + ("(" + std::to_string(row[j]) + ")*") + kNames[j];
  return "(" + text + ")";
}

std::string with_number(const std::string& text, const std::string& u) {
  std::string result;
  for (const char c : text) result += c == '@' ? u : std::string(1, c);
  return result;
}

void plant(OneEquation& equation, const Value& root, bool is_double = false) {
  equation.roots.push_back(root);
  equation.is_double.push_back(is_double);
}

Rational root_of(Builder& b) {
  return b.random.one_in(3) ? b.number() : Rational(b.random.between(-24, 24), 8);
}

bool is_new(const OneEquation& equation, const Rational& root) {
  return std::ranges::none_of(equation.roots,
                              [&](const Value& other) { return other.exact() == root; });
}

/// A product of linear factors, squares, and quadratic factors without real roots.
OneEquation planted_polynomial(Builder& b) {
  OneEquation equation;
  const auto factor = [&equation](const std::string& text) {
    equation.text += (equation.text.empty() ? "" : "*") + text;
  };
  for (long i = b.random.between(1, 2); i > 0; --i) {
    const Rational root = root_of(b);
    if (!is_new(equation, root)) continue;
    const bool is_double = b.random.one_in(10);
    factor("(@ - " + b.text(root) + ")" + (is_double ? "^2" : ""));
    plant(equation, root, is_double);
    if (!b.random.one_in(5)) continue;
    const Rational other =
        root + Rational(b.random.between(1, 9)) * Rational::ten_to(-b.random.between(2, 14));
    if (!is_new(equation, other)) continue;
    factor("(@ - " + b.text(other) + ")");
    plant(equation, other);
    equation.is_hard = true;
  }
  if (b.random.one_in(5)) {
    const long size = b.random.between(0, 18);
    equation.is_hard = equation.is_hard || size > 3;
    factor("((@ - " + b.text(root_of(b)) + ")^2 + " + b.text(Rational::ten_to(-size)) + ")");
  }
  if (b.random.one_in(6)) {  // a root far away
    factor("(1e-12*@ - 1)");
    plant(equation, Rational::ten_to(12));
  }
  return equation;
}

/// An equation of an angle.
OneEquation of_turns(Builder& b) {
  const Rational t(b.random.between(-15, 15), static_cast<unsigned long>(b.random.between(4, 9)));
  const Rational one(1), norm = one + t * t, c = (one - t * t) / norm, s = Rational(2) * t / norm;
  const Value angle = Value(Rational(2)) * call("atan", t, Value());
  OneEquation equation;
  switch (b.random.below(t.is_zero() ? 2 : 5)) {
    case 0:  // a root that is touched
      equation.text = "(cos(@) - 1)";
      plant(equation, Rational(0), true);
      return equation;
    case 1: {  // two that are nearly one
      const Rational small = Rational::ten_to(-b.random.between(4, 20));
      const Value at = call("acos", one - small, Value());
      equation.text = "(cos(@) - 1 + " + b.text(small) + ")";
      plant(equation, at);
      plant(equation, -one * at);
      equation.is_hard = true;
      return equation;
    }
    case 2:
      equation.text = "(cos(@) - " + b.text(c) + ")";
      plant(equation, angle);
      plant(equation, Value(-one) * angle);
      return equation;
    case 3:
      equation.text = "(" + b.text(c) + "*sin(@) - " + b.text(s) + "*cos(@))";
      plant(equation, angle);
      plant(equation, angle + pi());
      return equation;
    default:  // none
      equation.text = "(cos(@) + " + b.text(one + Rational::ten_to(-b.random.between(1, 9))) + ")";
      equation.is_hard = true;
      return equation;
  }
}

/// All combinations of roots, in the unknowns.
struct Grid {
  std::vector<Solution> solutions;
  std::vector<bool> is_double;
};

Grid grid_of(const std::vector<OneEquation>& equations, const WholeMap& map, const Value& unit) {
  Grid grid;
  const std::size_t n = equations.size();
  std::vector<std::size_t> at(n, 0);
  if (std::ranges::any_of(equations, [](const OneEquation& e) { return e.roots.empty(); }))
    return grid;
  for (;;) {
    Solution solution;
    bool is_double = false;
    for (std::size_t i = 0; i < n; ++i) {
      Value x = Rational(0);
      for (std::size_t j = 0; j < n; ++j)
        x = x + Value(map.inverse[i][j]) * equations[j].roots[at[j]];
      solution[kNames[i]] = x * unit;
      is_double = is_double || equations[i].is_double[at[i]];
    }
    grid.solutions.push_back(std::move(solution));
    grid.is_double.push_back(is_double);
    std::size_t digit = 0;
    while (digit < n && ++at[digit] == equations[digit].roots.size()) at[digit++] = 0;
    if (digit == n) return grid;
  }
}

std::string system_text(std::size_t n, const std::string& unit,
                        const std::vector<std::string>& equations, const std::string& reach) {
  std::string names, listed, starts = "t = 0", ranges;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string comma = i == 0 ? "" : ", ";
    names += comma + kNames[i] + " = " + quoted(unit);
    starts += ", " + kNames[i] + " = 0";
    ranges += comma + kNames[i] + " = [" + quoted("-" + reach) + ", " + quoted(reach) + "]";
  }
  for (const std::string& equation : equations) listed += "  " + quoted(equation) + ",\n";
  return "regulus = 1\nname = \"system\"\n\n[pose]\nt = \"1\"\n\n[closure]\nunknowns = { " + names +
         " }\nequations = [\n" + listed + "]\nstart = { " + starts + " }\nrange = { " + ranges +
         " }\n\n[motion.m]\nt = 0\n";
}

/// Combines the equations without a change of their common zeros.
std::vector<std::string> mixed(Builder& b, const std::vector<OneEquation>& equations,
                               const WholeMap& map) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < equations.size(); ++i)
    texts.push_back(with_number(equations[i].text, combination(map.rows[i])));
  for (std::size_t i = 0; i + 1 < texts.size(); ++i) {
    const std::string factor =
        b.random.pick({"", "0*", "2*", "p*", "(q - 1/3)*", "p*q*", "1/7*", "-5*"});
    if (factor != "0*") texts[i] += " + " + factor + "(" + texts[i + 1] + ")";
  }
  if (b.coin() && texts.size() > 1) texts.back() += " - 3*(" + texts.front() + ")";
  return texts;
}

void state_system(Builder& b, const std::string& argument) {
  SolveTruth& truth = *b.attack.solve;
  b.attack.truth = truth.is_degenerate ? Truth::kSingular
                   : truth.count == 0U ? Truth::kEmpty
                                       : Truth::kRegular;
  b.attack.argument = argument;
}

}  // namespace

Attack solved_polynomials(std::uint64_t seed) {
  Builder b("solve_system", seed);
  const std::size_t n = b.random.one_in(4) ? 3 : 2;
  const WholeMap map = whole_map(b, n, false);
  std::vector<OneEquation> equations;
  bool is_hard = false;
  for (std::size_t i = 0; i < n; ++i) {
    equations.push_back(planted_polynomial(b));
    is_hard = is_hard || equations.back().is_hard;
  }
  const Rational reach(b.random.pick(std::vector<long>{4, 17, 100, 1001, 100003}));
  SolveTruth truth;
  const Grid grid = grid_of(equations, map, Rational(1));
  for (std::size_t i = 0; i < grid.solutions.size(); ++i) {
    bool is_inside = true, is_at_border = false;
    for (const auto& [name, value] : grid.solutions[i]) {
      const Rational size = value.exact()->magnitude();
      is_inside = is_inside && size < reach;
      is_at_border = is_at_border || (size - reach).magnitude() < reach / Rational(100000);
    }
    if (is_at_border) return solved_polynomials(seed + 500'000'000'000);
    if (!is_inside) continue;
    truth.known.push_back(grid.solutions[i]);
    truth.is_degenerate = truth.is_degenerate || grid.is_double[i];
  }
  truth.count = truth.known.size();
  truth.equations = mixed(b, equations, map);
  b.attack.model.instead = system_text(n, "m", truth.equations, reach.fraction());
  b.attack.decidable = !truth.is_degenerate && !is_hard && n == 2 && reach < Rational(200);
  b.attack.solve = std::move(truth);
  state_system(b, "its roots are planted");
  return b.finish();
}

Attack solved_turns(std::uint64_t seed) {
  Builder b("solve_turns", seed);
  const std::size_t n = b.random.between(1, 2);
  const WholeMap map = whole_map(b, n, true);
  std::vector<OneEquation> equations;
  SolveTruth truth;
  const bool in_degrees = b.coin();
  bool is_hard = false;
  for (std::size_t i = 0; i < n; ++i) {
    equations.push_back(of_turns(b));
    is_hard = is_hard || equations.back().is_hard;
    truth.periods[kNames[i]] = in_degrees ? "360" : "2*pi";
  }
  const Value unit = in_degrees ? Value(Rational(180)) / pi() : Value(Rational(1));
  const Grid grid = grid_of(equations, map, unit);
  truth.known = grid.solutions;
  truth.is_degenerate = std::ranges::find(grid.is_double, true) != grid.is_double.end();
  truth.count = truth.known.size();
  std::vector<std::string> texts = mixed(b, equations, map);
  // The factors p and q of a combination would end the period.
  if (std::ranges::any_of(texts, [](const std::string& text) {
        return text.find("p*(") != std::string::npos || text.find("p*q*") != std::string::npos ||
               text.find("(q - 1/3)*") != std::string::npos;
      }))
    return solved_turns(seed + 500'000'000'000);
  if (!in_degrees) truth.equations = texts;  // in degrees a name is another number
  b.attack.model.instead = system_text(n, in_degrees ? "deg" : "rad", texts,
                                       in_degrees ? b.random.pick({"180", "200", "1000"})
                                                  : b.random.pick({"3.2", "4", "pi", "100"}));
  b.attack.decidable = !truth.is_degenerate && !is_hard;
  b.attack.solve = std::move(truth);
  state_system(b, "its angles are planted");
  return b.finish();
}

}  // namespace regulus::detail::attack
