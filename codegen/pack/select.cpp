// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/pack/select.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace regulus::codegen {
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
        meter_(meter),
        plan_(plan_function(program, operations_per_part, row_length, meter)) {
    find_absorbed();
  }

  SelectedFunction run() {
    for (std::uint32_t part = 0; part < plan_.parts.size(); ++part) select_part(part);
    code_.slots = static_cast<std::uint32_t>(plan_.slot_count);
    code_.outputs = static_cast<std::uint32_t>(program_.outputs.size());
    return {std::move(plan_), std::move(code_), std::move(nodes_), std::move(marks_)};
  }

 private:
  [[nodiscard]] const Node& node(NodeId id) const { return program_.nodes[id]; }
  [[nodiscard]] bool is_interval(NodeId id) const { return plan_.forms[id] == Form::kInterval; }

  // --- which nodes have no operation of their own

  /// A node that its only reader, in the same part, can take in.
  [[nodiscard]] bool can_be_absorbed(NodeId id) const {
    return !plan_.leaves[id] && plan_.uses[id] == 1 &&
           plan_.last_part_of[id] == plan_.part_of[id] && is_arithmetic(node(id)) &&
           !plan_.magnitudes.needs_check[id];
  }
  [[nodiscard]] bool is_free_product(NodeId id) const {
    return can_be_absorbed(id) && node(id).op == Op::kMultiply;
  }

  /// The product that the sum takes in. From a − b·c the sign goes to a factor that is exact, whose
  /// negation is exact and free; two intervals would gain nothing.
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
    value_of_.clear();
    interval_of_.clear();
    negated_.clear();
    find_partners(range);
    for (std::size_t i = range.first_step; i < range.last_step; ++i) {
      const Step& step = plan_.steps[i];
      if (step.opens_group || i == range.first_step)
        marks_.push_back({static_cast<std::uint32_t>(code_.code.size()), i});
      if (step.kind == Step::Kind::kStore)
        store(step);
      else if (!absorbed_[step.node] && !value_of_.contains(step.node))
        compute(step.node);
    }
    code_.part_ends.push_back(static_cast<std::uint32_t>(code_.code.size()));
  }

  /// A sine and a cosine of one argument cost one operation when the same part computes both.
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

  ValueId add(Pack operation, std::uint32_t a = 0, std::uint32_t b = 0, std::uint32_t c = 0,
              NodeId of = SelectedFunction::kNoNode) {
    spend(meter_, 1);
    code_.code.push_back({operation, a, b, c});
    nodes_.push_back(of);
    return static_cast<ValueId>(code_.code.size() - 1);
  }

  void store(const Step& step) {
    const ValueId value = use_as_interval(step.node);
    add(Pack::kStore, static_cast<std::uint32_t>(step.first_output),
        static_cast<std::uint32_t>(step.last_output), value, step.node);
  }

  /// The value is the node's, checked where it may overflow, and kept for the parts that follow.
  void define(NodeId id, ValueId value) {
    if (plan_.magnitudes.needs_check[id]) value = add(Pack::kChecked_IU, value);
    nodes_[value] = id;
    value_of_[id] = value;
    if (plan_.slots[id] != kNoSlot)
      add(Pack::kKeep, static_cast<std::uint32_t>(plan_.slots[id]), use_as_interval(id));
  }

  void compute(NodeId id) {
    const Node& n = node(id);
    if (partner_.contains(id)) return compute_sine_and_cosine(id);
    if (n.op == Op::kPower && plan_.magnitudes.needs_check[id]) return compute_checked_power(id);
    define(id, value_for(id));
  }

  void compute_sine_and_cosine(NodeId id) {
    const NodeId other = partner_.at(id);
    const NodeId sine = node(id).op == Op::kSin ? id : other;
    const NodeId cosine = node(id).op == Op::kSin ? other : id;
    const ValueId both = add(Pack::kSinCos_I, use_as_interval(node(id).a));
    const ValueId second = add(Pack::kCosine, both);
    define(sine, both);
    define(cosine, second);
  }

  /// By squaring, each step checked: inside pow an infinite factor could meet a 0.
  void compute_checked_power(NodeId id) {
    const std::uint32_t n = node(id).index;
    const ValueId base = use_as_interval(node(id).a);
    ValueId value = base;
    bool is_first = true;
    const auto next = [&](Pack operation, ValueId a, ValueId b) {
      if (!is_first) a = add(Pack::kChecked_IU, a);
      is_first = false;
      value = add(operation, a, b);
    };
    for (int bit = highest_bit(n) - 1; bit >= 0; --bit) {
      next(Pack::kSqr_I, value, 0);
      if ((n >> bit) & 1U) next(Pack::kMultiply_II, value, base);
    }
    define(id, value);
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
      const ValueId left = use(a);
      return add(operation, left, use(b));
    };
    if (n.op == Op::kNegate) return add(Pack::kNegate_P, use(n.a));
    if (n.op == Op::kMultiply) return binary(Pack::kExactMul_PP, n.a, n.b);
    const std::optional<NodeId> fused = fused_product(id);
    if (!fused) return binary(n.op == Op::kAdd ? Pack::kExactAdd_PP : Pack::kExactSub_PP, n.a, n.b);
    const auto [a, b] = factors(*fused);
    const ValueId left = n.op == Op::kSubtract ? use_negated(a) : use(a);
    const ValueId right = use(b);
    return add(Pack::kExactMulAdd_PPP, left, right, use(*fused == n.b ? n.a : n.b));
  }

  ValueId negation(NodeId a) {
    const Node& n = node(a);
    if (!absorbed_[a]) {
      const ValueId value = use(a);
      return add(is_interval(a) ? Pack::kNegate_I : Pack::kNegate_P, value);
    }
    if (n.op == Op::kSubtract) return of_kinds(Pack::kSubtract_II, n.b, n.a);
    const ValueId left = use_negated(n.a);
    const ValueId right = use(n.b);
    return add(is_interval(n.b) ? Pack::kMultiply_PI : Pack::kMultiply_PP, left, right);
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
    const ValueId left = negate_a ? use_negated(a) : use(a);
    const ValueId right = subtract && !negate_a ? use_negated(b) : use(b);
    const ValueId other = use_as_interval(fused == n.b ? n.a : n.b);
    const Pack operation = is_interval(a)
                               ? (is_interval(b) ? Pack::kMulAdd_III : Pack::kMulAdd_IPI)
                               : (is_interval(b) ? Pack::kMulAdd_PII : Pack::kMulAdd_PPI);
    return add(operation, left, right, other);
  }

  ValueId power(NodeId id) {
    const Node& n = node(id);
    if (n.index != 2) return add(Pack::kPow_IN, use_as_interval(n.a), n.index);
    if (is_interval(n.a)) return add(Pack::kSqr_I, use(n.a));
    return of_kinds(Pack::kMultiply_II, n.a, n.a);
  }

  ValueId call(NodeId id) {
    const Node& n = node(id);
    const ValueId a = use_as_interval(n.a);
    const ValueId b = program_operands(id) == 2 ? use_as_interval(n.b) : 0;
    return add(operation_of(n.op), a, b);
  }
  [[nodiscard]] int program_operands(NodeId id) const { return operand_count(node(id).op); }

  /// The operation of a family II, IP, PI, PP that fits the operands.
  ValueId of_kinds(Pack first_of_family, NodeId a, NodeId b) {
    const ValueId left = use(a);
    const ValueId right = use(b);
    const int kinds = (is_interval(a) ? 0 : 2) + (is_interval(b) ? 0 : 1);
    return add(static_cast<Pack>(static_cast<int>(first_of_family) + kinds), left, right);
  }

  /// Packs tell factors apart by the signs of the left one's bounds: a value used often goes there,
  /// since the compiler looks at its signs once.
  [[nodiscard]] std::pair<NodeId, NodeId> factors(NodeId id) const {
    const NodeId a = node(id).a;
    const NodeId b = node(id).b;
    const bool swap = is_interval(a) && is_interval(b) && plan_.uses[b] > plan_.uses[a];
    return swap ? std::pair(b, a) : std::pair(a, b);
  }

  // --- operands

  /// The node's value in this part, of the node's own form.
  ValueId use(NodeId id) {
    if (const auto found = value_of_.find(id); found != value_of_.end()) return found->second;
    const ValueId value = plan_.leaves[id] ? leaf(id) : fetch(id);
    nodes_[value] = id;
    value_of_[id] = value;
    return value;
  }

  ValueId use_as_interval(NodeId id) {
    if (is_interval(id)) return use(id);
    if (const auto found = interval_of_.find(id); found != interval_of_.end()) return found->second;
    const ValueId value = plan_.known[id] ? add(Pack::kConstant, constant(*plan_.known[id]))
                                          : add(Pack::kThin_P, use(id));
    interval_of_[id] = value;
    return value;
  }

  /// −p for exact doubles p.
  ValueId use_negated(NodeId id) {
    if (node(id).op == Op::kNegate && plan_.leaves[id] && !plan_.known[id]) return use(node(id).a);
    if (const auto found = negated_.find(id); found != negated_.end()) return found->second;
    const ValueId value = plan_.known[id]
                              ? add(Pack::kExact, constant(Interval(-plan_.known[id]->lo)))
                              : add(Pack::kNegate_P, use(id));
    negated_[id] = value;
    return value;
  }

  ValueId leaf(NodeId id) {
    const Node& n = node(id);
    if (plan_.known[id]) return known(id);
    if (n.op == Op::kNegate) return add(Pack::kNegate_P, use(n.a));
    return add(n.op == Op::kInput ? Pack::kLoad : Pack::kPoint, n.index);
  }

  ValueId known(NodeId id) {
    const Interval& bounds = *plan_.known[id];
    if (!is_interval(id)) return add(Pack::kExact, constant(bounds));
    const ValueId value = add(Pack::kConstant, constant(bounds));
    return plan_.magnitudes.needs_check[id] ? add(Pack::kChecked_IU, value) : value;
  }

  /// The two zeros are one bound, and one constant.
  std::uint32_t constant(Interval bounds) {
    if (bounds.lo == 0.0) bounds.lo = 0.0;
    if (bounds.hi == 0.0) bounds.hi = 0.0;
    const auto [place, is_new] = constant_index_.try_emplace(
        {bounds.lo, bounds.hi}, static_cast<std::uint32_t>(code_.constants.size()));
    if (is_new) code_.constants.push_back(bounds);
    return place->second;
  }

  ValueId fetch(NodeId id) {
    const ValueId kept = add(Pack::kFetch, static_cast<std::uint32_t>(plan_.slots[id]));
    return is_interval(id) ? kept : add(Pack::kPointOf_I, kept);
  }

  const Program& program_;
  WorkMeter* meter_;
  FunctionPlan plan_;
  machine::PackFunction code_;
  std::vector<NodeId> nodes_;
  std::vector<SelectedFunction::Mark> marks_;
  std::vector<bool> absorbed_;        ///< has no operation: the one that reads it computes it, too
  std::map<NodeId, NodeId> partner_;  ///< the cosine of a sine's argument and the reverse
  // Of this part.
  std::unordered_map<NodeId, ValueId> value_of_, interval_of_, negated_;
  std::map<std::pair<double, double>, std::uint32_t> constant_index_;
};

}  // namespace

SelectedFunction select(const Program& program, std::size_t operations_per_part,
                        std::size_t row_length, WorkMeter* meter) {
  return Selector(program, operations_per_part, row_length, meter).run();
}

}  // namespace regulus::codegen
