// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_force.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "runtime/formal/coq_load.hpp"
#include "runtime/formal/coq_question.hpp"
#include "runtime/verifier/infix_reader.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

[[noreturn]] void refuse_force(const std::string& why) {
  throw Unfinished("there is no theorem about a force for this certificate: " + why);
}

/// A name, a number or another character of an expression, and the parentheses around it.
struct Token {
  std::size_t begin = 0, end = 0;
  int depth = 0;
};

bool is_part_of_name(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

/// Returns the end of the name or number that begins here, or of one character.
std::size_t end_of_token(std::string_view text, std::size_t at) {
  const auto skip = [&](auto is_part) {
    while (at < text.size() && is_part(text[at])) ++at;
  };
  const std::size_t begin = at;
  if (is_letter(text[at])) {
    skip(is_part_of_name);
  } else if (is_digit(text[at]) || text[at] == '.') {
    const auto is_part = [](char c) { return is_digit(c) || c == '.'; };
    skip(is_part);
    if (at < text.size() && text[at] == 'e') {
      ++at;
      if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
      skip(is_part);
    }
  }
  return std::max(at, begin + 1);
}

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  int depth = 0;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == ' ') {
      ++at;
      continue;
    }
    if (text[at] == ')') --depth;
    const std::size_t end = end_of_token(text, at);
    tokens.push_back({at, end, depth});
    if (text[at] == '(') ++depth;
    at = end;
  }
  return tokens;
}

/// A term of a sum, or a factor of a product, with the operator before it.
struct Operand {
  char operation;
  std::string text;
};

bool is_among(char c, std::string_view characters) {
  return characters.find(c) != std::string_view::npos;
}

/// Splits a text at these operators, + and - or * and /, outside parentheses. A sign after another
/// operator is part of an operand.
std::vector<Operand> split(std::string_view text, std::string_view operators) {
  std::vector<Operand> operands{{operators.front(), ""}};
  std::size_t begin = 0;
  char before = operators.front();
  const auto finish = [&](std::size_t end) {
    std::string_view operand = text.substr(begin, end - begin);
    while (operand.ends_with(' ')) operand.remove_suffix(1);
    while (operand.starts_with(' ')) operand.remove_prefix(1);
    operands.back().text = operand;
  };
  for (const Token& t : tokens_of(text)) {
    const char c = text[t.begin];
    if (t.depth == 0 && is_among(c, operators) && !is_among(before, "+-*/^")) {
      finish(t.begin);
      operands.push_back({c, ""});
      begin = t.end;
    }
    before = c;
  }
  finish(text.size());
  return operands;
}

std::vector<Operand> terms_of(std::string_view text) {
  if (!text.starts_with('-')) return split(text, "+-");
  std::vector<Operand> terms = split(text.substr(1), "+-");
  terms.front().operation = '-';
  return terms;
}

std::string sum_of(const std::vector<Operand>& terms) {
  std::string sum;
  for (const Operand& term : terms) {
    if (!sum.empty())
      sum.append(1, ' ').append(1, term.operation).append(1, ' ');
    else if (term.operation == '-')
      sum += '-';
    sum += term.text;
  }
  return sum.empty() ? "0" : sum;
}

/// Returns a product without its factor r, which must be there once.
std::string without_factor(std::string_view product, const std::string& r) {
  std::vector<Operand> factors = split(product, "*/");
  const auto found = std::ranges::find_if(
      factors, [&r](const Operand& f) { return f.operation == '*' && f.text == r; });
  if (found == factors.end())
    refuse_force("'" + std::string(product) + "' is not a multiple of " + r);
  factors.erase(found);
  std::string rest;
  for (const Operand& f : factors)
    rest += rest.empty() ? (f.operation == '/' ? "1/" : "") + f.text : f.operation + f.text;
  if (mentions(rest, r)) refuse_force("'" + std::string(product) + "' is not linear in " + r);
  return rest.empty() ? "1" : rest;
}

struct Entry {
  std::string plain, load;
};

/// Splits m - r·v.
Entry split_entry(std::string_view text, const std::string& r) {
  std::vector<Operand> plain, load;
  for (Operand& term : terms_of(text)) {
    if (!mentions(term.text, r)) {
      plain.push_back(std::move(term));
      continue;
    }
    load.push_back({term.operation == '-' ? '+' : '-', without_factor(term.text, r)});
  }
  return {sum_of(plain), sum_of(load)};
}

bool is_number(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, is_digit);
}

/// Returns 1/R.
std::string reciprocal(std::string_view R) {
  std::string_view denominator = R;
  const std::string numerator(take_until(denominator, "/"));
  if (!is_number(numerator) || !is_number(denominator)) return "1/(" + std::string(R) + ")";
  return numerator == "1" ? std::string(denominator) : std::string(denominator) + "/" + numerator;
}

/// Reads the lines of a certificate.
class ForceReader {
 public:
  ForceReader(const Question& bordered, const std::vector<std::string>& lines) : q_(bordered) {
    if (q_.singular || q_.has_threshold) refuse_force("its claim is not NO SINGULARITY");
    if (q_.is_piecewise) refuse_force("it is about a trajectory");
    if (q_.rows != q_.columns) refuse_force("its matrix is not square");
    find_parameter(lines);
    force_.load.assign(q_.columns, "0");
    for (const std::string& line : lines) read(line);
    if (!has_row_) refuse_force("no row of its matrix depends on " + r_);
  }

  ForceQuestion take() { return std::move(force_); }

 private:
  /// r is the last parameter.
  void find_parameter(const std::vector<std::string>& lines) {
    std::string_view ends;
    for (const std::string& line : lines)
      if (line.starts_with("parameter ")) {
        ends = std::string_view(line).substr(line.find(' ') + 1);
        r_ = take_until(ends, " in ");
      }
    const std::string_view lower = take_until(ends, " : ");
    force_.is_two_sided = lower.starts_with('-') && lower.substr(1) == ends;
    if (r_.empty() || (lower != "0" && !force_.is_two_sided))
      refuse_force("its last parameter is not in a range 0 : R or -R : R");
    force_.limit = reciprocal(ends);
  }

  void read(const std::string& line) {
    if (line.starts_with("parameter " + r_ + " in ") || line == "pose " + r_ + " = " + r_) return;
    std::string_view rest = line;
    const std::string_view key = take_until(rest, " ");
    if (key == "entry")
      force_.question += "entry " + entry(rest);
    else if (key == "model" || key == "motion" || key == "claim" || key == "verdict" ||
             !mentions(rest, r_))
      force_.question += line;
    else
      refuse_force(
          "the line '" + line + "' depends on " + r_ +
          " (there is no theorem yet about a largest force below 0 or a least one above 0)");
    force_.question += '\n';
  }

  std::string entry(std::string_view text) {
    const std::size_t row = entries_ / q_.columns, column = entries_ % q_.columns;
    ++entries_;
    if (!mentions(text, r_)) return std::string(text);
    if (has_row_ && row != force_.row) refuse_force("two rows of its matrix depend on " + r_);
    has_row_ = true;
    force_.row = row;
    const Entry parts = split_entry(text, r_);
    force_.load[column] = parts.load;
    return parts.plain;
  }

  const Question& q_;
  ForceQuestion force_;
  std::string r_;
  std::size_t entries_ = 0;
  bool has_row_ = false;
};

/// Reads the lines of a certificate that states its quantity.
class ClaimedForceReader {
 public:
  ClaimedForceReader(const Question& question, const std::vector<std::string>& lines)
      : claimed_(*question.quantity), lines_(lines) {
    if (claimed_.kind != format::kForce) refuse_force("it bounds another quantity");
    if (question.singular) refuse_force("its claim is that a value is attained");
    if (!is_zero_number(question.graph, claimed_.reference))
      refuse_force("there is no theorem yet about a largest force below 0 or a least one above 0");
    force_.row = claimed_.row;
    force_.is_two_sided =
        claimed_.side == format::kAbsolute && !is_symmetric(question.graph, *claimed_.set);
    for (const std::string& line : lines_) read(line);
    const LoadVariables load = load_variables(question, *claimed_.set, lines_);
    for (const std::string& w : load.components)
      force_.load.push_back(w == "0" ? "0" : of_side(over_scale(w)));
    force_.question = question_with(load, question, lines_, "quantity ", line_of_factor());
  }

  ForceQuestion take() { return std::move(force_); }

 private:
  void read(const std::string& line) {
    std::string_view rest = line;
    const std::string_view key = take_until(rest, " ");
    if (key == "scale" && scales_++ == force_.row) scale_ = rest;
    if (key == "bound") force_.limit = of_side(std::string(rest));
  }

  [[nodiscard]] std::string of_side(const std::string& value) const {
    return claimed_.side == format::kLeast ? "-(" + value + ')' : value;
  }

  /// Returns w/s for a component of the load.
  [[nodiscard]] std::string over_scale(const std::string& w) const {
    return scale_.empty() ? w : w + '*' + name_of_factor();
  }

  [[nodiscard]] std::string name_of_factor() const {
    return free_name("factor_" + std::to_string(force_.row + 1), lines_);
  }

  /// Returns the line that gives 1/s its name.
  [[nodiscard]] std::string line_of_factor() const {
    if (scale_.empty()) return "";
    const std::vector<Operand> factors = split(scale_, "*/");
    const bool is_reciprocal =
        factors.size() == 2 && factors[0].text == "1" && factors[1].operation == '/';
    return "let " + name_of_factor() + " = " +
           (is_reciprocal ? factors[1].text : "1/(" + scale_ + ')') + '\n';
  }

  const QuantityLines& claimed_;
  const std::vector<std::string>& lines_;
  std::string scale_;  ///< of the row
  std::size_t scales_ = 0;
  ForceQuestion force_;
};

}  // namespace

ForceQuestion split_force(const Question& question, const std::vector<std::string>& lines) {
  if (question.closure) throw Unfinished("a claim about a closure cannot be written as a theorem");
  if (question.quantity) return ClaimedForceReader(question, lines).take();
  return ForceReader(question, lines).take();
}

std::string describe(const ForceQuestion& force) {
  return std::string(force.is_two_sided ? "the absolute force" : "the force") + " of row " +
         std::to_string(force.row + 1) + " is below " + force.limit +
         " at every pose and value of the uncertain quantities of the variety";
}

}  // namespace regulus::verifier
