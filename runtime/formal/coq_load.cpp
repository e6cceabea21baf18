// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_load.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "runtime/formal/coq_question.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/infix_reader.hpp"
#include "runtime/verifier/load_lines.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

class LoadWriter {
 public:
  LoadWriter(const VectorSetLines& set, const std::vector<std::string>& lines)
      : set_(set), lines_(lines) {
    for (const std::string& rest : rests_of(lines, "wrench")) {
      std::string_view spread = rest;
      middles_.emplace_back(take_until(spread, " +- "));
      spreads_.emplace_back(spread);
    }
    for (const std::string& rest : rests_of(lines, "wrench-ball")) {
      std::string_view radius = rest;
      radii_.emplace_back(take_until(radius, " in "));
    }
  }

  LoadVariables variables() {
    std::vector<std::string> balls(set_.balls.size(), "ball");
    for (std::size_t k = 0; k < middles_.size(); ++k) component(k, balls);
    for (std::size_t b = 0; b < balls.size(); ++b)
      if (radii_[b] != "0") load_.lines += balls[b] + '\n';
    return std::move(load_);
  }

 private:
  /// A component that varies in one way is one quantity about its middle; otherwise it is a sum.
  void component(std::size_t k, std::vector<std::string>& balls) {
    std::vector<std::size_t> around;
    for (std::size_t b = 0; b < balls.size(); ++b)
      if (radii_[b] != "0" && std::ranges::count(set_.balls[b].members, k) > 0) around.push_back(b);
    const bool has_spread = spreads_[k] != "0";
    const std::string name =
        free_name(coq_free("load_" + set_.name + '_' + std::to_string(k + 1)), lines_);
    if (has_spread && around.empty()) {
      vary(name, middles_[k], spreads_[k], {k, std::nullopt, true});
      load_.components.push_back(name);
    } else if (!has_spread && around.size() == 1) {
      vary(name, middles_[k], radii_[around.front()], {k, around.front(), true});
      balls[around.front()] += ' ' + name;
      load_.components.push_back(name);
    } else {
      std::string sum = '(' + middles_[k] + ')';
      if (has_spread) vary(name, "0", spreads_[k], {k, std::nullopt}), sum += " + " + name;
      for (const std::size_t b : around) {
        const std::string part = free_name(name + "_ball_" + std::to_string(b + 1), lines_);
        vary(part, "0", radii_[b], {k, b});
        balls[b] += ' ' + part;
        sum += " + " + part;
      }
      const bool is_zero = middles_[k] == "0" && !has_spread && around.empty();
      load_.components.push_back(is_zero ? "0" : '(' + sum + ')');
    }
  }

  static std::string coq_free(std::string name) {
    std::ranges::replace(name, '-', '_');
    return name;
  }

  void vary(const std::string& name, const std::string& middle, const std::string& spread,
            const LoadVariable& variable) {
    load_.variables.push_back(variable);
    load_.lines += "uncertain " + name + " = " + middle + " +- " + spread + '\n';
  }

  const VectorSetLines& set_;
  const std::vector<std::string>& lines_;
  std::vector<std::string> middles_, spreads_, radii_;
  LoadVariables load_;
};

}  // namespace

std::string free_name(std::string name, const std::vector<std::string>& lines) {
  while (std::ranges::any_of(lines, [&](const std::string& line) { return mentions(line, name); }))
    name += '_';
  return name;
}

std::vector<std::string> rests_of(const std::vector<std::string>& lines, std::string_view key) {
  std::vector<std::string> found;
  for (const std::string_view line : lines)
    if (line.starts_with(key) && line.size() > key.size() && line[key.size()] == ' ')
      found.emplace_back(line.substr(key.size() + 1));
  return found;
}

void require_vectors(const Question& question, const std::vector<NodeId>& sizes) {
  constexpr long kBits = 128;
  for (const NodeId node : sizes) {
    const auto value = evaluate(question.graph, {node}, {}, kBits);
    if (!value || !((*value)[0].enclosure().lo >= 0.0))
      throw Rejection("a spread or a radius is not certainly at least 0");
  }
}

LoadVariables load_variables(const Question& question, const VectorSetLines& set,
                             const std::vector<std::string>& lines) {
  require_vectors(question, set.spread);
  for (const WrenchBall& ball : set.balls) require_vectors(question, {ball.radius});
  return LoadWriter(set, lines).variables();
}

std::string question_with(const LoadVariables& load, const Question& question,
                          const std::vector<std::string>& lines, std::string_view end,
                          const std::string& before_matrix) {
  format::ClaimedSet set = question.claimed_set();
  set.uncertain += load.variables.size();
  std::string uncertain = load.lines, text;
  for (const std::string& line : lines) {
    if (line.starts_with(end)) break;
    if (line.starts_with("pose ") || line.starts_with("let ") || line.starts_with("matrix "))
      text += std::exchange(uncertain, "");
    if (line.starts_with("matrix ")) text += before_matrix;
    if (line.starts_with("claim "))
      text += "claim " + format::describe_claim(set, false);
    else
      text += line.starts_with("verdict ") ? "verdict NO SINGULARITY" : line;
    text += '\n';
  }
  return text + "proof\n";
}

std::vector<std::string> farthest_load(const Question& question,
                                       const std::vector<LoadVariable>& variables,
                                       const std::vector<double>& direction) {
  constexpr double kInside = 1.0 - 0x1p-20;  // of a ball, whatever is rounded
  constexpr long kBitsOfLoad = 128;
  const LoadLines& load = *question.load;
  const auto number = [&](NodeId node) {
    const auto value = evaluate(question.graph, {node}, {}, kBitsOfLoad);
    return value ? mid((*value)[0].enclosure()) : 0.0;
  };
  std::vector<std::string> coordinates;
  for (const LoadVariable& variable : variables) {
    const double along = direction.at(variable.column);
    if (!variable.ball) {
      coordinates.emplace_back(along < 0 ? "lower" : "upper");
      continue;
    }
    const WrenchBall& ball = load.balls[*variable.ball];
    double squares = 0.0;
    for (const std::size_t k : ball.members) squares += direction.at(k) * direction.at(k);
    const double length = std::sqrt(squares);
    const double step =
        length > 0.0 ? kInside * number(ball.radius) * std::abs(along) / length : 0.0;
    char text[40];
    std::snprintf(text, sizeof text, "%a",
                  (variable.has_middle ? number(load.middle[variable.column]) : 0.0) +
                      (along < 0 ? -step : step));
    coordinates.emplace_back(text);
  }
  return coordinates;
}

LimitsQuestion split_limits(const Question& question, const std::vector<std::string>& lines) {
  static_cast<void>(enclose_load(question));  // the limits are in their order
  const LoadVariables load = load_variables(question, *question.load, lines);
  LimitsQuestion split{question_with(load, question, lines, "load ", ""), {}, {}, load.variables};
  const std::size_t more = load.variables.size();
  split.variables.count = question.variables.size() + more;
  for (std::size_t k = 0; k < question.variables.size(); ++k) {
    const bool is_error = question.variables[k].kind == VariableKind::kError;
    split.variables.places.push_back(is_error ? k + more : k);
  }
  if (rests_of(lines, "scale").empty()) split.more.assign(question.rows, "scale 1");
  for (const std::string& component : load.components) split.more.push_back("load " + component);
  for (const std::string& limits : rests_of(lines, "limits"))
    split.more.push_back("limits " + limits);
  return split;
}

}  // namespace regulus::verifier
