// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/measure.hpp"

#include <limits>
#include <unordered_map>
#include <unordered_set>
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

/// The distinct nodes below some roots, operands before their users. The roots outlive it.
class Graph {
 public:
  explicit Graph(const Expressions& roots) {
    for (const Expression& root : roots) {
      Appearances& count = appearances_[visit(root)];
      count.outside = add(count.outside, 1);
    }
    for (std::size_t i = nodes_.size(); i-- > 0;) spread(i);
  }

  [[nodiscard]] std::size_t size() const noexcept { return nodes_.size(); }
  [[nodiscard]] const Expression& node(std::size_t i) const { return *nodes_[i].expression; }
  [[nodiscard]] const Appearances& operator[](std::size_t i) const { return appearances_[i]; }

 private:
  struct Node {
    const Expression* expression;
    std::size_t operands;  ///< where they begin in operands_
  };

  std::size_t visit(const Expression& e) {
    if (const auto known = index_.find(e.identity()); known != index_.end()) return known->second;
    const auto first = std::ptrdiff_t(path_.size());
    for (const Expression& operand : e.operands()) path_.push_back(visit(operand));
    const std::size_t number = nodes_.size();
    index_.emplace(e.identity(), number);
    nodes_.push_back({&e, operands_.size()});
    operands_.insert(operands_.end(), path_.begin() + first, path_.end());
    path_.resize(std::size_t(first));
    appearances_.emplace_back();
    return number;
  }

  void spread(std::size_t number) {
    const Appearances from = appearances_[number];
    const Expression& e = node(number);
    const bool circular = e.kind() == ExpressionKind::kCall &&
                          (e.function() == Call::kSin || e.function() == Call::kCos);
    for (std::size_t k = 0; k < e.operands().size(); ++k) {
      Appearances& to = appearances_[operands_[nodes_[number].operands + k]];
      to.outside = add(to.outside, circular ? 0 : from.outside);
      to.inside = add(to.inside, circular ? add(from.inside, from.outside) : from.inside);
    }
  }

  std::vector<Node> nodes_;
  std::vector<std::size_t> operands_;
  std::vector<std::size_t> path_;  // operands of the nodes that are being visited
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
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const Expression& e = graph.node(i);
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
  const Expressions roots{expression};
  const Graph graph(roots);
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < graph.size(); ++i)
    size = add(size, add(graph[i].outside, graph[i].inside));
  return size;
}

std::uint64_t count_operations(const Expressions& expressions) {
  // Equal nodes at two addresses count once, as they do in the program.
  struct Hash {
    std::size_t operator()(const Expression* e) const noexcept { return e->hash(); }
  };
  struct Equal {
    bool operator()(const Expression* a, const Expression* b) const { return *a == *b; }
  };
  std::unordered_set<const Expression*, Hash, Equal> seen;
  std::uint64_t result = 0;
  const Graph graph(expressions);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const std::uint64_t own = operations_of(graph.node(i));
    if (own != 0 && seen.insert(&graph.node(i)).second) result = add(result, own);
  }
  return result;
}

std::uint64_t width_cost(const Expression& expression, const Weights& weights) {
  const Expressions roots{expression};
  const Graph graph(roots);
  std::uint64_t cost = 0;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const Expression& e = graph.node(i);
    if (e.kind() != ExpressionKind::kVariable) continue;
    const auto weight = weights.find(e.name());
    const std::uint64_t once = add(add(graph[i].outside, graph[i].outside), graph[i].inside);
    cost = add(cost, saturated_product(once, weight == weights.end() ? 1 : weight->second));
  }
  return cost;
}

}  // namespace regulus::detail
