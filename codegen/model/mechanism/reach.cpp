// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/reach.hpp"

#include <algorithm>
#include <map>

#include "codegen/model/exact/ginac_text.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::is_a;
using GiNaC::numeric;

/// True for a power whose exponent is half of an odd number.
bool is_root(const ex& e) {
  return is_a<GiNaC::power>(e) && is_a<numeric>(e.op(1)) &&
         e.op(1).info(GiNaC::info_flags::rational) && GiNaC::ex_to<numeric>(e.op(1)).denom() == 2;
}

bool is_nonnegative(const ex& e);

bool are_nonnegative(const ex& sum_or_product) {
  return std::ranges::all_of(sum_or_product, [](const ex& part) { return is_nonnegative(part); });
}

/// True if the form shows it: sums and products of squares and positive numbers.
bool is_nonnegative(const ex& e) {
  if (is_a<numeric>(e)) return !e.info(GiNaC::info_flags::negative);
  if (is_a<GiNaC::add>(e) || is_a<GiNaC::mul>(e)) return are_nonnegative(e);
  return is_a<GiNaC::power>(e) && (e.op(1).info(GiNaC::info_flags::even) || is_root(e));
}

bool depends_on_pose(const Model& model, const ex& e) {
  return std::ranges::any_of(model.pose, [&e](const PoseParameter& p) { return e.has(p.symbol); });
}

class OperandsOfRoots {
 public:
  explicit OperandsOfRoots(const Model& model) : model_(model) {}

  void collect(const ex& e) {
    if (!seen_.insert(e).second) return;
    if (is_root(e) && !is_nonnegative(e.op(0)) && depends_on_pose(model_, e.op(0)))
      found_.emplace(formula_text(e.op(0)), e.op(0));
    for (std::size_t i = 0; i < e.nops(); ++i) collect(e.op(i));
  }

  std::vector<ex> result() const {
    std::vector<ex> operands;
    for (const auto& [text, operand] : found_) operands.push_back(operand);
    return operands;
  }

 private:
  const Model& model_;
  std::set<ex, GiNaC::ex_is_less> seen_;
  std::map<std::string, ex> found_;
};

/// Replaces the roots of the given operands by roots of their absolute values.
struct WithoutNegativeRoots : GiNaC::map_function {
  explicit WithoutNegativeRoots(const std::vector<ex>& given) : operands(given) {}

  ex operator()(const ex& e) override {
    const bool known = is_root(e) && std::ranges::any_of(operands, [&e](const ex& operand) {
                         return operand.is_equal(e.op(0));
                       });
    return known ? pow(GiNaC::abs(e.op(0).map(*this)), e.op(1)) : e.map(*this);
  }

  const std::vector<ex>& operands;
};

}  // namespace

std::vector<ex> operands_of_roots(const Model& model) {
  OperandsOfRoots roots(model);
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j) roots.collect(model.matrix(i, j));
  for (const ex& scale : model.row_scale) roots.collect(scale);
  for (const ex& condition : model.must_be_defined) roots.collect(condition);
  return roots.result();
}

void restrict_to_reach(const Model& model, Motion& motion) {
  motion.reach = operands_of_roots(model);
  WithoutNegativeRoots rewrite(motion.reach);
  for (auto* list : {&motion.constraints, &motion.must_be_defined})
    for (ex& e : *list) e = rewrite(e);
}

}  // namespace regulus::detail
