// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/pack/select.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "codegen/kernel/pack/part_values.hpp"

namespace regulus::detail {
namespace {

using machine::ValueId;
using Pack = machine::PackOperation;

bool is_arithmetic(const Node& node) {
  switch (node.op) {
    case Op::kNegate:
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kMultiply:
      return true;
    case Op::kPower:
      return node.index == 2;
    default:
      return false;
  }
}

int highest_bit(std::uint32_t n) {
  int bit = 0;
  while (n >>= 1) ++bit;
  return bit;
}

Pack operation_of(Op op) {
  switch (op) {
    case Op::kDivide:
      return Pack::kDiv_IIU;
    case Op::kSqrt:
      return Pack::kSqrt_IU;
    case Op::kSin:
      return Pack::kSin_I;
    case Op::kCos:
      return Pack::kCos_I;
    case Op::kTan:
      return Pack::kTan_IU;
    case Op::kAsin:
      return Pack::kAsin_IU;
    case Op::kAcos:
      return Pack::kAcos_IU;
    case Op::kAtan:
      return Pack::kAtan_I;
    case Op::kAtan2:
      return Pack::kAtan2_IIU;
    case Op::kExp:
      return Pack::kExp_IU;
    case Op::kLog:
      return Pack::kLog_IU;
    case Op::kAbs:
      return Pack::kAbs_I;
    default:
      throw std::invalid_argument("a node that is no function");
  }
}

/// The operations of one program, part by part.
class Selector {
 public:
  Selector(const Program& program, std::size_t operations_per_part, std::size_t row_length,
           WorkMeter* meter)
      : program_(program),
        plan_(plan_function(program, operations_per_part, row_length, meter)),
        values_(program, plan_, meter) {
    find_absorbed();
  }

  SelectedFunction run() {
    for (std::uint32_t part = 0; part < plan_.parts.size(); ++part) select_part(part);
    machine::PackFunction& code = values_.code();
    code.slots = static_cast<std::uint32_t>(plan_.slot_count);
    code.outputs = static_cast<std::uint32_t>(program_.outputs.size());
    return {std::move(plan_), std::move(code), std::move(values_.nodes()), std::move(marks_)};
  }

 private:
  [[nodiscard]] const Node& node(NodeId id) const { return program_.nodes[id]; }
  [[nodiscard]] bool is_interval(NodeId id) const { return plan_.forms[id] == Form::kInterval; }

  // --- which nodes have no operation of their own

  /// True if the only reader of the node, in the same part, can include its operation.
  [[nodiscard]] bool can_be_absorbed(NodeId id) const {
    return !plan_.leaves[id] && plan_.uses[id] == 1 &&
           plan_.last_part_of[id] == plan_.part_of[id] && is_arithmetic(node(id)) &&
           !plan_.magnitudes.needs_check[id];
  }
  [[nodiscard]] bool is_free_product(NodeId id) const {
    return can_be_absorbed(id) && node(id).op == Op::kMultiply;
  }

  /// Returns the product that is fused into the sum. In a − b·c the sign goes to an exact factor,
  /// whose negation is exact and free; with two intervals nothing would be gained.
  [[nodiscard]] std::optional<NodeId> fused_product(NodeId sum) const {
    const Node& n = node(sum);
    if (n.op == Op::kAdd && is_free_product(n.b)) return n.b;
    if (n.op == Op::kAdd && is_free_product(n.a)) return n.a;
    if (n.op == Op::kSubtract && is_free_product(n.b) &&
        (!is_interval(node(n.b).a) || !is_interval(node(n.b).b)))
      return n.b;
    return std::nullopt;
  }

  /// −(b − a) is a − b, and −(p·a) is (−p)·a for an exact p.
  [[nodiscard]] bool takes_sign(NodeId id) const {
    if (!can_be_absorbed(id) || plan_.exact[id]) return false;
    if (node(id).op == Op::kSubtract) return !fused_product(id);
    return node(id).op == Op::kMultiply && !is_interval(node(id).a);
  }

  void find_absorbed() {
    absorbed_.assign(program_.nodes.size(), false);
    for (const Step& step : plan_.steps) {
      if (step.kind != Step::Kind::kCompute) continue;
      const Node& n = node(step.node);
      if (n.op == Op::kAdd || n.op == Op::kSubtract) {
        if (const auto product = fused_product(step.node)) absorbed_[*product] = true;
      } else if (n.op == Op::kNegate && !plan_.exact[step.node] && takes_sign(n.a)) {
        absorbed_[n.a] = true;
      }
    }
  }

  // --- parts

  void select_part(std::uint32_t part) {
    const Part& range = plan_.parts[part];
    values_.begin_part();
    find_partners(range);
    for (std::size_t i = range.first_step; i < range.last_step; ++i) {
      const Step& step = plan_.steps[i];
      if (step.opens_group || i == range.first_step)
        marks_.push_back({static_cast<std::uint32_t>(values_.size()), i});
      if (step.kind == Step::Kind::kStore)
        store(step);
      else if (!absorbed_[step.node] && !values_.knows(step.node))
        compute(step.node);
    }
    values_.end_part();
  }

  /// A sine and a cosine of one argument cost one operation if the same part computes both.
  void find_partners(const Part& part) {
    partner_.clear();
    std::map<NodeId, NodeId> first_of;
    for (std::size_t i = part.first_step; i < part.last_step; ++i) {
      const NodeId id = plan_.steps[i].node;
      if (plan_.steps[i].kind != Step::Kind::kCompute) continue;
      if (node(id).op != Op::kSin && node(id).op != Op::kCos) continue;
      const auto [entry, is_first] = first_of.try_emplace(node(id).a, id);
      if (is_first) continue;
      partner_[id] = entry->second;
      partner_[entry->second] = id;
    }
  }

  void store(const Step& step) {
    const ValueId value = values_.use_as_interval(step.node);
    values_.add(Pack::kStore, static_cast<std::uint32_t>(step.first_output),
                static_cast<std::uint32_t>(step.last_output), value, step.node);
  }

  void compute(NodeId id) {
    const Node& n = node(id);
    if (partner_.contains(id)) return compute_sine_and_cosine(id);
    if (n.op == Op::kPower && plan_.magnitudes.needs_check[id]) return compute_checked_power(id);
    values_.define(id, value_for(id));
  }

  void compute_sine_and_cosine(NodeId id) {
    const NodeId other = partner_.at(id);
    const NodeId sine = node(id).op == Op::kSin ? id : other;
    const NodeId cosine = node(id).op == Op::kSin ? other : id;
    const ValueId both = values_.add(Pack::kSinCos_I, values_.use_as_interval(node(id).a));
    const ValueId second = values_.add(Pack::kCosine, both);
    values_.define(sine, both);
    values_.define(cosine, second);
  }

  /// Computes a power by squaring and checks each step, because inside pow an infinite factor could
  /// meet a 0.
  void compute_checked_power(NodeId id) {
    const std::uint32_t n = node(id).index;
    const ValueId base = values_.use_as_interval(node(id).a);
    ValueId value = base;
    bool is_first = true;
    const auto next = [&](Pack operation, ValueId a, ValueId b) {
      if (!is_first) a = values_.add(Pack::kChecked_IU, a);
      is_first = false;
      value = values_.add(operation, a, b);
    };
    for (int bit = highest_bit(n) - 1; bit >= 0; --bit) {
      next(Pack::kSqr_I, value, 0);
      if ((n >> bit) & 1U) next(Pack::kMultiply_II, value, base);
    }
    values_.define(id, value);
  }

  // --- one operation

  ValueId value_for(NodeId id) {
    const Node& n = node(id);
    if (plan_.exact[id]) return exact(id);
    switch (n.op) {
      case Op::kNegate:
        return negation(n.a);
      case Op::kAdd:
      case Op::kSubtract:
        return sum(id);
      case Op::kMultiply:
        return product(id);
      case Op::kPower:
        return power(id);
      default:
        return call(id);
    }
  }

  /// A point computed without rounding.
  ValueId exact(NodeId id) {
    const Node& n = node(id);
    const auto binary = [this](Pack operation, NodeId a, NodeId b) {
      const ValueId left = values_.use(a);
      return values_.add(operation, left, values_.use(b));
    };
    if (n.op == Op::kNegate) return values_.add(Pack::kNegate_P, values_.use(n.a));
    if (n.op == Op::kMultiply) return binary(Pack::kExactMul_PP, n.a, n.b);
    const std::optional<NodeId> fused = fused_product(id);
    if (!fused) return binary(n.op == Op::kAdd ? Pack::kExactAdd_PP : Pack::kExactSub_PP, n.a, n.b);
    const auto [a, b] = factors(*fused);
    const ValueId left = n.op == Op::kSubtract ? values_.use_negated(a) : values_.use(a);
    const ValueId right = values_.use(b);
    return values_.add(Pack::kExactMulAdd_PPP, left, right, values_.use(*fused == n.b ? n.a : n.b));
  }

  ValueId negation(NodeId a) {
    const Node& n = node(a);
    if (!absorbed_[a]) {
      const ValueId value = values_.use(a);
      return values_.add(is_interval(a) ? Pack::kNegate_I : Pack::kNegate_P, value);
    }
    if (n.op == Op::kSubtract) return of_kinds(Pack::kSubtract_II, n.b, n.a);
    const ValueId left = values_.use_negated(n.a);
    const ValueId right = values_.use(n.b);
    return values_.add(is_interval(n.b) ? Pack::kMultiply_PI : Pack::kMultiply_PP, left, right);
  }

  ValueId sum(NodeId id) {
    const Node& n = node(id);
    if (const std::optional<NodeId> fused = fused_product(id)) return mul_add(id, *fused);
    return of_kinds(n.op == Op::kAdd ? Pack::kAdd_II : Pack::kSubtract_II, n.a, n.b);
  }

  ValueId product(NodeId id) {
    const auto [a, b] = factors(id);
    return of_kinds(Pack::kMultiply_II, a, b);
  }

  ValueId mul_add(NodeId id, NodeId fused) {
    const Node& n = node(id);
    const auto [a, b] = factors(fused);
    const bool subtract = n.op == Op::kSubtract;
    const bool negate_a = subtract && !is_interval(a);
    const ValueId left = negate_a ? values_.use_negated(a) : values_.use(a);
    const ValueId right = subtract && !negate_a ? values_.use_negated(b) : values_.use(b);
    const ValueId other = values_.use_as_interval(fused == n.b ? n.a : n.b);
    const Pack operation = is_interval(a)
                               ? (is_interval(b) ? Pack::kMulAdd_III : Pack::kMulAdd_IPI)
                               : (is_interval(b) ? Pack::kMulAdd_PII : Pack::kMulAdd_PPI);
    return values_.add(operation, left, right, other);
  }

  ValueId power(NodeId id) {
    const Node& n = node(id);
    if (n.index != 2) return values_.add(Pack::kPow_IN, values_.use_as_interval(n.a), n.index);
    if (is_interval(n.a)) return values_.add(Pack::kSqr_I, values_.use(n.a));
    return of_kinds(Pack::kMultiply_II, n.a, n.a);
  }

  ValueId call(NodeId id) {
    const Node& n = node(id);
    const ValueId a = values_.use_as_interval(n.a);
    const ValueId b = program_operands(id) == 2 ? values_.use_as_interval(n.b) : 0;
    return values_.add(operation_of(n.op), a, b);
  }
  [[nodiscard]] int program_operands(NodeId id) const { return operand_count(node(id).op); }

  /// Returns the operation of a family II, IP, PI, PP that fits the operands.
  ValueId of_kinds(Pack first_of_family, NodeId a, NodeId b) {
    const ValueId left = values_.use(a);
    const ValueId right = values_.use(b);
    const int kinds = (is_interval(a) ? 0 : 2) + (is_interval(b) ? 0 : 1);
    return values_.add(static_cast<Pack>(static_cast<int>(first_of_family) + kinds), left, right);
  }

  /// Returns the factors in order. A product selects its case by the signs of the left factor's
  /// bounds, so a value that is used often goes to the left: the compiler tests its signs once.
  [[nodiscard]] std::pair<NodeId, NodeId> factors(NodeId id) const {
    const NodeId a = node(id).a;
    const NodeId b = node(id).b;
    const bool swap = is_interval(a) && is_interval(b) && plan_.uses[b] > plan_.uses[a];
    return swap ? std::pair(b, a) : std::pair(a, b);
  }

  const Program& program_;
  FunctionPlan plan_;
  PartValues values_;
  std::vector<SelectedFunction::Mark> marks_;
  std::vector<bool> absorbed_;        ///< has no operation: its reader computes it, too
  std::map<NodeId, NodeId> partner_;  ///< the cosine of a sine's argument and the reverse
};

}  // namespace

SelectedFunction select(const Program& program, std::size_t operations_per_part,
                        std::size_t row_length, WorkMeter* meter) {
  return Selector(program, operations_per_part, row_length, meter).run();
}

}  // namespace regulus::detail
