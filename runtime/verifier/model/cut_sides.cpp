// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/cut_sides.hpp"

#include <algorithm>
#include <set>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/infix_reader.hpp"
#include "runtime/verifier/model/equality.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostSigns = 16;

using NameSet = std::set<std::string, std::less<>>;

/// Returns true for names and digits that are none of these, in balanced parentheses.
bool is_free_of(std::string_view text, const NameSet& names) {
  int open = 0;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_of_name(text[end])) ++end;
    if (names.contains(text.substr(i, end - i))) return false;
    if (end == i) {
      open += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
      ++end;
    }
    if (open < 0) return false;
    i = end;
  }
  return open == 0;
}

/// Returns the names that depend on the signs: these, and those of lines "KEY NAME = …" with one of
/// them.
NameSet depending_on(const std::vector<std::string>& signs, std::string_view lines) {
  NameSet names(signs.begin(), signs.end());
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(line.size() + 1, lines.size()));
    const std::size_t equals = line.find(" = ");
    if (equals == std::string_view::npos || is_free_of(line.substr(equals), names)) continue;
    const std::string_view before = line.substr(0, equals);
    names.emplace(before.substr(before.rfind(' ') + 1));
  }
  return names;
}

}  // namespace

bool end_in_sides(const std::string& lines, const std::vector<std::string>& names) {
  const NameSet varying = depending_on(names, lines);
  std::string_view rest = lines;
  const auto take_last_line = [&rest] {
    rest.remove_suffix(std::size_t{rest.ends_with('\n')});
    const std::string_view line = rest.substr(rest.rfind('\n') + 1);
    rest.remove_suffix(line.size());
    return line;
  };
  if (take_last_line() != "proof") return false;
  for (std::size_t i = names.size(); i-- > 0;) {
    const std::string_view line = take_last_line();
    const std::string start = "constraint -" + names[i] + "*(";
    if (!line.starts_with(start) || !line.ends_with(')') || line.size() < start.size() + 2)
      return false;
    if (!is_free_of(line.substr(start.size(), line.size() - start.size() - 1), varying))
      return false;
  }
  return true;
}

bool are_all_signs(const std::vector<std::vector<std::string>>& values) {
  const std::size_t signs = values.front().size();
  if (signs > kMostSigns || values.size() != std::size_t{1} << signs) return false;
  const auto is_sign = [](const std::string& value) { return value == "1" || value == "-1"; };
  const auto are_signs = [&](const auto& piece) { return std::ranges::all_of(piece, is_sign); };
  return std::ranges::all_of(values, are_signs) &&
         std::set<std::vector<std::string>>(values.begin(), values.end()).size() == values.size();
}

CutSides::CutSides(Question& question, const std::vector<std::string>& signs) : q_(question) {
  std::size_t count = 0;
  while (q_.stated.contains("constraint " + std::to_string(count))) ++count;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    keys_.push_back("constraint " + std::to_string(count - signs.size() + i));
    const NodeId constraint = q_.stated.find(keys_.back())->second.node;
    const bool is_upper = signs[i] == "1";
    const NodeId one = q_.graph.number("1");
    const NodeId sign = is_upper ? one : q_.graph.add(Op::kNegate, one);
    sides_.push_back({sign, is_upper ? q_.graph.add(Op::kNegate, constraint) : constraint});
  }
}

const CutSides::Side* CutSides::side_of(NodeId ordinate) {
  if (const auto known = known_.find(ordinate); known != known_.end()) return known->second;
  const auto found = std::ranges::find_if(sides_, [&](const Side& side) {
    return equality(q_, ordinate, side.ordinate) == Equality::kEqual;
  });
  return known_.emplace(ordinate, found == sides_.end() ? nullptr : &*found).first->second;
}

NodeId CutSides::on_sides(NodeId expression) {
  Graph& graph = q_.graph;
  std::map<NodeId, NodeId> made;
  for (const NodeId id : ingredients(graph, {expression})) {
    const Node node = graph.nodes()[std::size_t(id)];
    NodeId result = id;
    if (operands(node.op) == 1) result = graph.add(node.op, made.at(node.a), node.b);
    if (operands(node.op) == 2) {
      const Side* const side = node.op == Op::kAtan2 ? side_of(node.a) : nullptr;
      const NodeId a = made.at(node.a), b = made.at(node.b);
      if (side == nullptr) {
        result = graph.add(node.op, a, b);
      } else {
        const NodeId quarter = graph.add(Op::kDivide, graph.add(Op::kPi), graph.number("2"));
        const NodeId turned = graph.add(Op::kAtan2, graph.add(Op::kNegate, b),
                                        graph.add(Op::kMultiply, side->sign, a));
        result = graph.add(Op::kMultiply, side->sign, graph.add(Op::kAdd, quarter, turned));
      }
    }
    made.emplace(id, result);
  }
  return made.at(expression);
}

}  // namespace regulus::verifier
