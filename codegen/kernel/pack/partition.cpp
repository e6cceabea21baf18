// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/pack/partition.hpp"

#include <algorithm>
#include <set>

#include "codegen/kernel/program/enclose.hpp"
#include "codegen/kernel/program/exact_nodes.hpp"

namespace regulus::detail {
namespace {

constexpr std::uint32_t kNoPart = static_cast<std::uint32_t>(-1);

class Planner {
 public:
  Planner(const Program& program, std::size_t operations_per_part, std::size_t row_length,
          WorkMeter* meter)
      : program_(program),
        limit_(operations_per_part),
        meter_(meter),
        wanted_(program.nodes.size(), false) {
    spend(meter_, program.nodes.size());
    plan_.known = enclose_constant_nodes(program);
    plan_.magnitudes = bound_magnitudes(program, plan_.known);
    plan_.exact = exact_nodes(program, plan_.known, row_length);
  }

  FunctionPlan run() {
    classify();
    for (std::size_t output = 0; output < program_.outputs.size();)
      output = schedule_outputs_from(output);
    plan_.operations = static_cast<std::size_t>(
        std::count_if(plan_.steps.begin(), plan_.steps.end(),
                      [](const Step& step) { return step.kind == Step::Kind::kCompute; }));
    assign_parts();
    count_uses();
    assign_slots();
    return std::move(plan_);
  }

 private:
  [[nodiscard]] const Node& node(NodeId id) const { return program_.nodes[id]; }
  [[nodiscard]] bool is_known(NodeId id) const { return plan_.known[id].has_value(); }

  void classify() {
    for (NodeId id = 0; id < program_.nodes.size(); ++id) {
      const Op op = node(id).op;
      const bool point_leaf = op == Op::kPoint || (op == Op::kNegate && plan_.leaves[node(id).a] &&
                                                   plan_.forms[node(id).a] == Form::kPoint);
      const bool point =
          is_known(id) ? plan_.known[id]->lo == plan_.known[id]->hi : point_leaf || plan_.exact[id];
      plan_.forms.push_back(point ? Form::kPoint : Form::kInterval);
      plan_.leaves.push_back(is_known(id) || point_leaf || op == Op::kInput);
    }
  }

  /// Stores consecutive equal constants together, such as the zeros of a derivative.
  std::size_t schedule_outputs_from(std::size_t first) {
    const NodeId root = program_.outputs[first];
    std::size_t last = first;
    spend(meter_, 1);
    while (is_known(root) && last + 1 < program_.outputs.size() &&
           program_.outputs[last + 1] == root)
      ++last;
    std::size_t group = plan_.steps.size();
    for (const NodeId id : take_unscheduled(root))
      plan_.steps.push_back({Step::Kind::kCompute, id, first, last, false});
    plan_.steps.push_back({Step::Kind::kStore, root, first, last, false});
    plan_.steps[group].opens_group = true;
    return last + 1;
  }

  /// Returns the nodes that `root` needs and no earlier output needed, in the program's order.
  std::vector<NodeId> take_unscheduled(NodeId root) {
    std::vector<NodeId> found;
    std::vector<NodeId> stack{root};
    while (!stack.empty()) {
      const NodeId id = stack.back();
      stack.pop_back();
      if (wanted_[id] || plan_.leaves[id]) continue;
      wanted_[id] = true;
      found.push_back(id);
      spend(meter_, 1);
      const int operands = operand_count(node(id).op);
      if (operands >= 1) stack.push_back(node(id).a);
      if (operands == 2) stack.push_back(node(id).b);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  [[nodiscard]] std::size_t group_end(std::size_t step) const {
    while (plan_.steps[step].kind != Step::Kind::kStore) ++step;
    return step + 1;
  }

  /// A part ends with an output if possible; an output longer than a part is cut.
  void assign_parts() {
    std::size_t first = 0;
    for (std::size_t step = 0; step < plan_.steps.size(); ++step) {
      const bool full = step - first >= limit_;
      const bool group_will_not_fit =
          plan_.steps[step].opens_group && step > first && group_end(step) - first > limit_;
      if (full || group_will_not_fit) {
        plan_.parts.push_back({first, step});
        first = step;
      }
    }
    if (first < plan_.steps.size()) plan_.parts.push_back({first, plan_.steps.size()});
  }

  void use(NodeId id, std::uint32_t part) {
    ++plan_.uses[id];
    plan_.last_part_of[id] = part;
  }

  void count_uses() {
    plan_.uses.assign(program_.nodes.size(), 0);
    plan_.part_of.assign(program_.nodes.size(), kNoPart);
    plan_.last_part_of.assign(program_.nodes.size(), kNoPart);
    for (std::uint32_t part = 0; part < plan_.parts.size(); ++part)
      for (std::size_t i = plan_.parts[part].first_step; i < plan_.parts[part].last_step; ++i) {
        const Step& step = plan_.steps[i];
        if (step.kind == Step::Kind::kStore) {
          use(step.node, part);
          continue;
        }
        plan_.part_of[step.node] = part;
        const int operands = operand_count(node(step.node).op);
        if (operands >= 1) use(node(step.node).a, part);
        if (operands == 2) use(node(step.node).b, part);
      }
  }

  /// A slot is free again after the last part that reads it.
  void assign_slots() {
    plan_.slots.assign(program_.nodes.size(), kNoSlot);
    std::set<int> free;
    std::vector<std::vector<int>> released(plan_.parts.size());
    for (std::uint32_t part = 0; part < plan_.parts.size(); ++part) {
      if (part > 0) free.insert(released[part - 1].begin(), released[part - 1].end());
      for (std::size_t i = plan_.parts[part].first_step; i < plan_.parts[part].last_step; ++i) {
        const Step& step = plan_.steps[i];
        if (step.kind == Step::Kind::kStore || plan_.last_part_of[step.node] == part) continue;
        if (free.empty()) free.insert(plan_.slot_count++);
        plan_.slots[step.node] = *free.begin();
        free.erase(free.begin());
        released[plan_.last_part_of[step.node]].push_back(plan_.slots[step.node]);
      }
    }
  }

  const Program& program_;
  std::size_t limit_;
  WorkMeter* meter_;
  std::vector<bool> wanted_;
  FunctionPlan plan_;
};

}  // namespace

FunctionPlan plan_function(const Program& program, std::size_t operations_per_part,
                           std::size_t row_length, WorkMeter* meter) {
  return Planner(program, operations_per_part, row_length, meter).run();
}

}  // namespace regulus::detail
