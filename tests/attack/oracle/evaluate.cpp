// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/evaluate.hpp"

#include <algorithm>
#include <numeric>

#include "tests/attack/oracle/hexapod.hpp"

namespace regulus::detail::attack {
namespace {

bool is_digit(char c) { return '0' <= c && c <= '9'; }
bool is_letter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }

class Reader {
 public:
  Reader(std::string_view text, const Point& at, const std::map<std::string, std::string>& lets)
      : text_(text), point_(at), lets_(lets) {}

  Value read() {
    Value value = sum();
    if (here() != '\0') fail();
    return value;
  }

 private:
  char here() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool skip(char c) {
    if (here() != c) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void fail() const {
    throw std::invalid_argument("no expression: " + std::string(text_) + " at " +
                                std::to_string(at_));
  }

  Value sum() {
    Value value = product();
    for (;;) {
      if (skip('+'))
        value = value + product();
      else if (skip('-'))
        value = value - product();
      else
        return value;
    }
  }

  Value product() {
    Value value = factor();
    for (;;) {
      if (skip('*'))
        value = value * factor();
      else if (skip('/'))
        value = value / factor();
      else
        return value;
    }
  }

  Value factor() {
    if (skip('-')) return Value(Rational(0)) - factor();
    if (skip('+')) return factor();
    const Value base = primary();
    return skip('^') ? power(base, factor()) : base;
  }

  Value primary() {
    const char c = here();
    if (is_digit(c) || c == '.') return number();
    if (is_letter(c)) return name();
    if (!skip('(')) fail();
    Value value = sum();
    if (!skip(')')) fail();
    return value;
  }

  std::string digits() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  Value number() {
    std::string all = digits();
    long exponent = 0;
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      const std::string fraction = digits();
      exponent = -static_cast<long>(fraction.size());
      all += fraction;
    }
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      ++at_;
      const bool negative = at_ < text_.size() && text_[at_] == '-';
      if (negative || (at_ < text_.size() && text_[at_] == '+')) ++at_;
      const long written = std::stol(digits());
      exponent += negative ? -written : written;
    }
    return Rational::decimal(all, exponent);
  }

  Value name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_'))
      ++at_;
    const std::string word(text_.substr(begin, at_ - begin));
    if (const auto found = point_.find(word); found != point_.end()) return found->second;
    if (const auto found = lets_.find(word); found != lets_.end())
      return evaluate(found->second, point_, lets_);
    if (word == "pi") return pi();
    if (word == "deg") return pi() / Value(Rational(180));
    return function(word);
  }

  Value function(const std::string& word) {
    if (!skip('(')) fail();
    const Value first = sum();
    const Value second = skip(',') ? sum() : Value();
    if (!skip(')')) fail();
    return call(word, first, second);
  }

  std::string_view text_;
  const Point& point_;
  const std::map<std::string, std::string>& lets_;
  std::size_t at_ = 0;
};

void eliminate(Matrix& m, std::size_t k) {
  for (std::size_t i = k + 1; i < m.size(); ++i) {
    const Value factor = m[i][k] / m[k][k];
    for (std::size_t j = k + 1; j < m.size(); ++j) m[i][j] = m[i][j] - factor * m[k][j];
  }
}

/// Returns the row from k on with the largest entry in column k that is certainly not 0.
std::optional<std::size_t> pivot(const Matrix& m, std::size_t k) {
  std::optional<std::size_t> best;
  for (std::size_t i = k; i < m.size(); ++i) {
    if (m[i][k].sign().value_or(0) == 0) continue;
    if (!best || arb_gt(magnitude(m[i][k]).ball(), magnitude(m[*best][k]).ball())) best = i;
  }
  return best;
}

/// Expands along the first row. Used if no pivot is certain.
Value expanded(const Matrix& m) {
  if (m.empty()) return Rational(1);
  Value sum = Rational(0);
  for (std::size_t j = 0; j < m.size(); ++j) {
    if (m[0][j].exact() && m[0][j].exact()->is_zero()) continue;
    Matrix minor;
    for (std::size_t i = 1; i < m.size(); ++i) {
      minor.emplace_back(m[i]);
      minor.back().erase(minor.back().begin() + static_cast<long>(j));
    }
    const Value term = m[0][j] * expanded(minor);
    sum = j % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

Matrix chosen_rows(const Matrix& matrix, const std::vector<bool>& chosen) {
  Matrix rows;
  for (std::size_t i = 0; i < matrix.size(); ++i)
    if (chosen[i]) rows.push_back(matrix[i]);
  return rows;
}

bool all_defined(const Matrix& matrix) {
  return std::ranges::all_of(matrix, [](const std::vector<Value>& row) {
    return std::ranges::all_of(row, [](const Value& v) { return v.defined(); });
  });
}

}  // namespace

Value evaluate(std::string_view text, const Point& at,
               const std::map<std::string, std::string>& lets) {
  return Reader(text, at, lets).read();
}

Rational toml_number(std::string_view text) {
  std::string plain;
  for (const char c : text)
    if (c != '_') plain += c;
  const bool negative = plain.starts_with('-');
  if (negative || plain.starts_with('+')) plain.erase(0, 1);
  const auto in_base = [&](int base) { return Rational::integer(plain.substr(2), base); };
  const Rational magnitude = plain.starts_with("0x")   ? in_base(16)
                             : plain.starts_with("0o") ? in_base(8)
                             : plain.starts_with("0b") ? in_base(2)
                                                       : *evaluate(plain, {}).exact();
  return negative ? -magnitude : magnitude;
}

Value determinant(Matrix m) {
  Value result = Rational(1);
  const Matrix original = m;
  for (std::size_t k = 0; k < m.size(); ++k) {
    const std::optional<std::size_t> row = pivot(m, k);
    if (!row) return expanded(original);
    if (*row != k) {
      std::swap(m[k], m[*row]);
      result = result * Value(Rational(-1));
    }
    result = result * m[k][k];
    eliminate(m, k);
  }
  return result;
}

Value Sample::determinant() const {
  const std::size_t columns = matrix.front().size();
  Value product = Rational(1);
  for (const Value& s : scale) product = product * s;
  if (matrix.size() == columns) return product * attack::determinant(matrix);
  Value sum = Rational(0);
  std::vector<bool> chosen(matrix.size(), false);
  std::fill(chosen.end() - static_cast<long>(columns), chosen.end(), true);
  do {
    const Value minor = attack::determinant(chosen_rows(matrix, chosen));
    sum = sum + minor * minor;
  } while (std::next_permutation(chosen.begin(), chosen.end()));
  return sum;
}

bool Sample::certain_inside() const {
  return std::ranges::all_of(constraints,
                             [](const Value& c) { return c.certain_at_most(Rational(0)); });
}

bool Sample::certain_outside() const {
  return std::ranges::any_of(constraints, [](const Value& c) { return c.sign() == 1; });
}

Point planted(const Planted& at) {
  Point point;
  for (const auto& [name, text] : at) point.emplace(name, evaluate(text, {}));
  return point;
}

Sample sample(const Attack& attack, const Point& axes) {
  const ModelSource& model = attack.model;
  Point point = axes;
  for (const PoseEntry& entry : model.pose) {
    Value value = entry.expression.empty() ? axes.at(entry.name) : evaluate(entry.expression, axes);
    if (const auto error = axes.find(entry.name + "_error"); error != axes.end())
      value = value + error->second;
    point.insert_or_assign(entry.name, value);
  }
  std::map<std::string, std::string> lets;
  for (const NamedText& let : model.let) lets.emplace(let.name, let.text);

  Sample result;
  if (model.hexapod) result = sample_of(*model.hexapod, point);
  for (const auto& row : model.rows) {
    result.matrix.emplace_back();
    for (const Cell& cell : row)
      result.matrix.back().push_back(cell.bare ? Value(toml_number(cell.text))
                                               : evaluate(cell.text, point, lets));
  }
  for (const Cell& cell : model.row_scale) {
    result.scale.push_back(cell.bare ? Value(toml_number(cell.text))
                                     : evaluate(cell.text, point, lets));
    result.defined = result.defined && result.scale.back().sign() == 1;
  }
  for (const std::string& constraint : model.constraints)
    result.constraints.push_back(evaluate(constraint, point, lets));
  result.defined = result.defined && all_defined(result.matrix);
  return result;
}

}  // namespace regulus::detail::attack
