// SPDX-License-Identifier: GPL-3.0-or-later
// The expressions of a PartWriter.
#include <algorithm>

#include "regulus/codegen/emit/constant_text.hpp"
#include "regulus/codegen/emit/literal.hpp"
#include "regulus/codegen/emit/part_writer.hpp"

namespace regulus::codegen {
namespace {

// With "  const I " in front and ";" behind, a line of about 100 columns.
constexpr std::size_t kMaxExpression = 76;

/// Whether the pack's function takes the mask of undefined lanes.
bool is_partial(Op op) {
  return op != Op::kSin && op != Op::kCos && op != Op::kAtan && op != Op::kAbs;
}

}  // namespace

ExpressionText PartWriter::compute(NodeId id) {
  ExpressionText result = render(id);
  while (result.text.size() > kMaxExpression) {
    const std::vector<NodeId> operands = deferred_operands(id);
    if (operands.empty()) break;
    define_deferred(*std::max_element(operands.begin(), operands.end(), [&](NodeId x, NodeId y) {
      return deferred_.at(x).text.size() < deferred_.at(y).text.size();
    }));
    result = render(id);
  }
  return result;
}

/// What can be given a name to make the node's expression shorter. A product that the sum takes in
/// stays where it is; its factors can go.
std::vector<NodeId> PartWriter::deferred_operands(NodeId id) const {
  std::vector<NodeId> found;
  const auto add_operands = [&](NodeId of, std::optional<NodeId> except) {
    const int count = operand_count(node(of).op);
    for (int k = 0; k < count; ++k) {
      const NodeId operand = k == 0 ? node(of).a : node(of).b;
      if (is_deferred(operand) && operand != except) found.push_back(operand);
    }
  };
  const std::optional<NodeId> product = fused_product(id);
  add_operands(id, product);
  if (product) add_operands(*product, std::nullopt);
  return found;
}

ExpressionText PartWriter::render(NodeId id) {
  const Node& n = node(id);
  if (plan_.exact[id]) return render_exact(id);
  switch (n.op) {
    case Op::kNegate:
      return render_negation(n.a);
    case Op::kAdd:
    case Op::kSubtract:
      return render_sum(id);
    case Op::kMultiply:
      return render_product(id);
    case Op::kPower:
      return render_power(id);
    default:
      return render_call(id);
  }
}

/// A point computed without rounding: the operations say so, since + of two points is an interval.
ExpressionText PartWriter::render_exact(NodeId id) {
  const Node& n = node(id);
  if (n.op == Op::kNegate) return negation(use(n.a));
  const auto call = [this](const char* name, NodeId a, NodeId b) {
    const std::string left = use(a).text;
    return atom(concatenate({name, "(", left, ", ", use(b).text, ")"}));
  };
  if (n.op == Op::kMultiply) return call("exact_mul", n.a, n.b);
  const std::optional<NodeId> fused = fused_product(id);
  if (!fused) return call(n.op == Op::kAdd ? "exact_add" : "exact_sub", n.a, n.b);
  const auto [a, b] = factors(*fused);
  const std::string left = n.op == Op::kSubtract ? negated_point(a) : use(a).text;
  const std::string right = use(b).text;
  return atom(concatenate(
      {"exact_mul_add(", left, ", ", right, ", ", use(*fused == n.b ? n.a : n.b).text, ")"}));
}

/// −a, the sign taken into a difference or into a factor that is a P where nothing else reads them.
ExpressionText PartWriter::render_negation(NodeId a) {
  const Node& n = node(a);
  if (is_deferred(a) && n.op == Op::kSubtract && !fused_product(a))
    return combine(difference, n.b, n.a);
  if (is_deferred(a) && n.op == Op::kMultiply && !is_interval(n.a))
    return product(atom(negated_point(n.a)), use(n.b));
  return negation(use(a));
}

/// The left operand first: using a value may print its declaration, and the text must not depend on
/// the order in which the compiler of this file evaluates arguments.
ExpressionText PartWriter::combine(BinaryText operation, NodeId a, NodeId b) {
  const ExpressionText left = use(a);
  const ExpressionText right = use(b);
  return operation(left, right);
}

/// The pack tells factors apart by the signs of the left one's bounds: a value used often goes
/// there, since the compiler looks at its signs once.
std::pair<NodeId, NodeId> PartWriter::factors(NodeId id) const {
  const NodeId a = node(id).a;
  const NodeId b = node(id).b;
  const bool swap = is_interval(a) && is_interval(b) && plan_.uses[b] > plan_.uses[a];
  return swap ? std::pair(b, a) : std::pair(a, b);
}

ExpressionText PartWriter::render_product(NodeId id) {
  const auto [a, b] = factors(id);
  return combine(product, a, b);
}

/// The product that the sum can take in as mul_add. From a − b·c the sign goes to a factor that is
/// a P, whose negation is exact and free; two intervals would gain nothing.
std::optional<NodeId> PartWriter::fused_product(NodeId sum) const {
  const Node& n = node(sum);
  const auto is_free_product = [&](NodeId id) {
    return is_deferred(id) && node(id).op == Op::kMultiply;
  };
  if (n.op == Op::kAdd && is_free_product(n.b)) return n.b;
  if (n.op == Op::kAdd && is_free_product(n.a)) return n.a;
  if (n.op == Op::kSubtract && is_free_product(n.b) &&
      (!is_interval(node(n.b).a) || !is_interval(node(n.b).b)))
    return n.b;
  return std::nullopt;
}

ExpressionText PartWriter::render_sum(NodeId id) {
  const Node& n = node(id);
  if (const std::optional<NodeId> fused = fused_product(id)) return render_mul_add(id, *fused);
  return combine(n.op == Op::kAdd ? sum : difference, n.a, n.b);
}

ExpressionText PartWriter::render_mul_add(NodeId id, NodeId fused) {
  const Node& n = node(id);
  const NodeId other = fused == n.b ? n.a : n.b;
  const auto [a, b] = factors(fused);
  const bool negate_a = n.op == Op::kSubtract && !is_interval(a);
  const bool negate_b = n.op == Op::kSubtract && !negate_a;
  return atom(
      concatenate({"mul_add(", negate_a ? negated_point(a) : use(a).text, ", ",
                   negate_b ? negated_point(b) : use(b).text, ", ", as_interval(other), ")"}));
}

std::string PartWriter::negated_point(NodeId id) {
  if (plan_.known[id]) return concatenate({"P(", literal(-plan_.known[id]->lo), ")"});
  if (node(id).op == Op::kNegate && plan_.leaves[id]) return use(node(id).a).text;
  return negation(use(id)).text;
}

ExpressionText PartWriter::render_power(NodeId id) {
  const Node& n = node(id);
  if (n.index != 2)
    return atom(concatenate({"pow(", as_interval(n.a), ", ", std::to_string(n.index), ")"}));
  if (is_interval(n.a)) return atom(concatenate({"sqr(", use(n.a).text, ")"}));
  return combine(product, n.a, n.a);
}

ExpressionText PartWriter::render_call(NodeId id) {
  const Node& n = node(id);
  const bool binary = operand_count(n.op) == 2;
  return atom(concatenate({n.op == Op::kDivide ? "div" : op_name(n.op), "(", as_interval(n.a),
                           binary ? ", " : "", binary ? as_interval(n.b) : "",
                           is_partial(n.op) ? ", undefined)" : ")"}));
}

std::string PartWriter::as_interval(NodeId id) {
  if (is_interval(id)) return use(id).text;
  if (plan_.known[id]) return constant_literal(*plan_.known[id]);
  return concatenate({"thin(", use(id).text, ")"});
}

ExpressionText PartWriter::use(NodeId id) {
  if (plan_.leaves[id]) return use_leaf(id);
  if (const auto found = deferred_.find(id); found != deferred_.end()) return found->second;
  if (!named_[id]) {
    named_[id] = true;
    usage_.shared = true;
    const std::string slot = concatenate({"shared[", std::to_string(plan_.slots[id]), "]"});
    statements_ += is_interval(id)
                       ? concatenate({"  const I ", names_.of(id), " = ", slot, ";\n"})
                       : concatenate({"  const P ", names_.of(id), " = point_of(", slot, ");\n"});
  }
  return atom(names_.of(id));
}

ExpressionText PartWriter::use_leaf(NodeId id) {
  const Node& n = node(id);
  if (plan_.known[id]) return use_constant(id);
  if (n.op == Op::kNegate) return negation(use(n.a));
  const std::string index = std::to_string(n.index);
  if (n.op == Op::kInput) {
    usage_.boxes = true;
    declare(id, "I", concatenate({"load(boxes, ", index, ")"}), {});
  } else {
    usage_.points = true;
    declare(id, "P", concatenate({"point(points, ", index, ")"}), {});
  }
  return atom(names_.of(id));
}

ExpressionText PartWriter::use_constant(NodeId id) {
  const Interval& value = *plan_.known[id];
  if (!is_interval(id)) return atom(concatenate({"P(", literal(value.lo), ")"}));
  const std::string text = constant_literal(value);
  declare(id, "I",
          plan_.magnitudes.needs_check[id] ? concatenate({"checked(", text, ", undefined)"}) : text,
          constant_text(function_.program, id));
  return atom(names_.of(id));
}

}  // namespace regulus::codegen
