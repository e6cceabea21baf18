// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_load.hpp"

#include <algorithm>
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
      vary(name, middles_[k], spreads_[k]);
      load_.components.push_back(name);
    } else if (!has_spread && around.size() == 1) {
      vary(name, middles_[k], radii_[around.front()]);
      balls[around.front()] += ' ' + name;
      load_.components.push_back(name);
    } else {
      std::string sum = '(' + middles_[k] + ')';
      if (has_spread) vary(name, "0", spreads_[k]), sum += " + " + name;
      for (const std::size_t b : around) {
        const std::string part = free_name(name + "_ball_" + std::to_string(b + 1), lines_);
        vary(part, "0", radii_[b]);
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

  void vary(const std::string& name, const std::string& middle, const std::string& spread) {
    ++load_.count;
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
  set.uncertain += load.count;
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

LimitsQuestion split_limits(const Question& question, const std::vector<std::string>& lines) {
  if (question.load->verdict == format::kInfeasible)
    throw Unfinished("there is no theorem yet about a load that no forces within limits hold");
  static_cast<void>(enclose_load(question));  // the limits are in their order
  const LoadVariables load = load_variables(question, *question.load, lines);
  LimitsQuestion split{question_with(load, question, lines, "load ", ""), {}, {}};
  split.variables.count = question.variables.size() + load.count;
  for (std::size_t k = 0; k < question.variables.size(); ++k) {
    const bool is_error = question.variables[k].kind == VariableKind::kError;
    split.variables.places.push_back(is_error ? k + load.count : k);
  }
  if (rests_of(lines, "scale").empty()) split.more.assign(question.rows, "scale 1");
  for (const std::string& component : load.components) split.more.push_back("load " + component);
  for (const std::string& limits : rests_of(lines, "limits"))
    split.more.push_back("limits " + limits);
  return split;
}

}  // namespace regulus::verifier
