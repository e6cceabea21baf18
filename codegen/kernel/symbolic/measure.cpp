// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/measure.hpp"

#include <limits>
#include <unordered_map>
#include <vector>

namespace regulus::detail {
namespace {

std::uint64_t add(std::uint64_t a, std::uint64_t b) noexcept {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  return a > kMost - b ? kMost : a + b;
}

std::uint64_t saturated_product(std::uint64_t a, std::uint64_t b) noexcept {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  return b != 0 && a > kMost / b ? kMost : a * b;
}

/// The number of times that a node of the shared graph appears in the printed form.
struct Appearances {
  std::uint64_t outside = 0;  ///< not inside a sine or cosine
  std::uint64_t inside = 0;
};

/// The distinct nodes below some roots, operands before their users.
class Graph {
 public:
  explicit Graph(const Expressions& roots) {
    for (const Expression& root : roots) {
      visit(root);
      auto& count = at(root);
      count.outside = add(count.outside, 1);
    }
    for (std::size_t i = nodes_.size(); i-- > 0;) spread(nodes_[i]);
  }

  [[nodiscard]] const std::vector<Expression>& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const Appearances& operator[](std::size_t i) const { return appearances_[i]; }

 private:
  Appearances& at(const Expression& e) { return appearances_[index_.at(e.identity())]; }

  void visit(const Expression& e) {
    if (index_.count(e.identity()) != 0) return;
    for (const Expression& operand : e.operands()) visit(operand);
    index_.emplace(e.identity(), nodes_.size());
    nodes_.push_back(e);
    appearances_.emplace_back();
  }

  void spread(const Expression& e) {
    const Appearances from = at(e);
    const bool circular = e.kind() == ExpressionKind::kCall &&
                          (e.function() == Call::kSin || e.function() == Call::kCos);
    for (const Expression& operand : e.operands()) {
      Appearances& to = at(operand);
      to.outside = add(to.outside, circular ? 0 : from.outside);
      to.inside = add(to.inside, circular ? add(from.inside, from.outside) : from.inside);
    }
  }

  std::vector<Expression> nodes_;
  std::vector<Appearances> appearances_;
  std::unordered_map<const void*, std::size_t> index_;
};

std::uint64_t operations_of(const Expression& e) {
  switch (e.kind()) {
    case ExpressionKind::kPower:
      return e.exponent() < -1 ? 2 : 1;
    case ExpressionKind::kCall:
      return 1;
    case ExpressionKind::kProduct:
    case ExpressionKind::kSum:
      return e.operands().size() - 1;
    default:
      return 0;
  }
}

}  // namespace

Occurrences count_occurrences(const Expressions& expressions) {
  const Graph graph(expressions);
  Occurrences occurrences;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    const Expression& e = graph.nodes()[i];
    if (e.kind() != ExpressionKind::kVariable) continue;
    std::uint64_t& count = occurrences[e.name()];
    count = add(count, add(graph[i].outside, graph[i].inside));
  }
  return occurrences;
}

Occurrences count_occurrences(const Expression& expression) {
  return count_occurrences(Expressions{expression});
}

std::uint64_t total(const Occurrences& occurrences) noexcept {
  std::uint64_t result = 0;
  for (const auto& [name, count] : occurrences) result = add(result, count);
  return result;
}

std::uint64_t printed_size(const Expression& expression) {
  const Graph graph({expression});
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i)
    size = add(size, add(graph[i].outside, graph[i].inside));
  return size;
}

std::uint64_t count_operations(const Expressions& expressions) {
  // Equal nodes at two addresses count once, as they do in the program.
  std::unordered_map<Expression, bool, ExpressionHash> seen;
  std::uint64_t result = 0;
  const Graph graph(expressions);
  for (const Expression& e : graph.nodes())
    if (seen.emplace(e, true).second) result = add(result, operations_of(e));
  return result;
}

std::uint64_t width_cost(const Expression& expression, const Weights& weights) {
  const Graph graph({expression});
  std::uint64_t cost = 0;
  for (std::size_t i = 0; i < graph.nodes().size(); ++i) {
    const Expression& e = graph.nodes()[i];
    if (e.kind() != ExpressionKind::kVariable) continue;
    const auto weight = weights.find(e.name());
    const std::uint64_t once = add(add(graph[i].outside, graph[i].outside), graph[i].inside);
    cost = add(cost, saturated_product(once, weight == weights.end() ? 1 : weight->second));
  }
  return cost;
}

}  // namespace regulus::detail
