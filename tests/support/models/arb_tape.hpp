// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates a model's own expressions in Arb, directly from GiNaC. It shares no rewriting, lowering
// or interpreting with the code under test.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "codegen/kernel/program/ball.hpp"

namespace regulus::detail::test {

inline constexpr slong kTapeBits = 320;

/// Whether all operations that a value needs are defined at that point.
enum class Defined { kYes, kUnknown, kNo };

class ArbTape {
 public:
  using Node = std::size_t;

  /// From this call on, the symbol means that node.
  void bind(const GiNaC::ex& symbol, Node node) { known_.insert_or_assign(symbol, node); }

  Node input(std::size_t index) { return push({Kind::kInput, {}, index, {}}); }

  Node sum(Node a, Node b) { return push({Kind::kSum, {a, b}, 0, {}}); }

  /// Returns the node of e. Expressions read earlier keep the former meaning of their symbols.
  Node read(const GiNaC::ex& e) {
    if (const auto found = known_.find(e); found != known_.end()) return found->second;
    const Node node = read_new(e);
    known_.emplace(e, node);
    return node;
  }

  /// Forgets the meaning of expressions; the nodes stay.
  void forget_symbols() { known_.clear(); }

  struct Values {
    std::vector<Ball> of;
    std::vector<Defined> defined;
  };

  [[nodiscard]] Values run(const std::vector<Ball>& inputs) const {
    Values values{std::vector<Ball>(steps_.size()),
                  std::vector<Defined>(steps_.size(), Defined::kYes)};
    for (Node node = 0; node < steps_.size(); ++node) {
      const Step& step = steps_[node];
      for (const Node operand : step.operands)
        values.defined[node] = worse(values.defined[node], values.defined[operand]);
      values.defined[node] =
          worse(values.defined[node], compute(step, inputs, values.of, values.of[node].get()));
    }
    return values;
  }

  static Defined worse(Defined a, Defined b) { return a < b ? b : a; }

 private:
  enum class Kind { kInput, kConstant, kSum, kProduct, kPower, kRoot, kCall };
  struct Step {
    Kind kind;
    std::vector<Node> operands;
    std::size_t index;  ///< of an input
    Ball constant;
    long exponent = 0;  ///< of a power; of a root, in halves
    std::string function{};
  };

  Node push(Step step) {
    steps_.push_back(std::move(step));
    return steps_.size() - 1;
  }

  Node read_new(const GiNaC::ex& e) {
    if (GiNaC::is_a<GiNaC::numeric>(e))
      return push(
          {Kind::kConstant,
           {},
           0,
           Ball(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(e).to_cl_N()), kTapeBits)});
    if (e.is_equal(GiNaC::Pi)) {
      Ball pi;
      arb_const_pi(pi.get(), kTapeBits);
      return push({Kind::kConstant, {}, 0, pi});
    }
    if (GiNaC::is_a<GiNaC::power>(e)) return read_power(e);
    if (GiNaC::is_a<GiNaC::symbol>(e)) throw std::logic_error("a symbol that means nothing");
    Step step{GiNaC::is_a<GiNaC::add>(e)   ? Kind::kSum
              : GiNaC::is_a<GiNaC::mul>(e) ? Kind::kProduct
                                           : Kind::kCall,
              {},
              0,
              {}};
    for (const GiNaC::ex& operand : e) step.operands.push_back(read(operand));
    if (step.kind == Kind::kCall) step.function = GiNaC::ex_to<GiNaC::function>(e).get_name();
    return push(std::move(step));
  }

  Node read_power(const GiNaC::ex& e) {
    const GiNaC::ex twice = 2 * e.op(1);
    if (!twice.info(GiNaC::info_flags::integer)) throw std::logic_error("a power with a variable");
    const long halves = GiNaC::ex_to<GiNaC::numeric>(twice).to_long();
    const Node base = read(e.op(0));
    if (halves % 2 == 0) return push({Kind::kPower, {base}, 0, {}, halves / 2});
    return push({Kind::kRoot, {base}, 0, {}, halves});
  }

  static Defined where(bool certain, bool violated) {
    return certain ? Defined::kYes : violated ? Defined::kNo : Defined::kUnknown;
  }

  static Defined compute(const Step& step, const std::vector<Ball>& inputs,
                         const std::vector<Ball>& of, arb_ptr out) {
    switch (step.kind) {
      case Kind::kInput:
        arb_set(out, inputs[step.index].get());
        return Defined::kYes;
      case Kind::kConstant:
        arb_set(out, step.constant.get());
        return Defined::kYes;
      case Kind::kSum:
        arb_zero(out);
        for (const Node a : step.operands) arb_add(out, out, of[a].get(), kTapeBits);
        return Defined::kYes;
      case Kind::kProduct:
        arb_one(out);
        for (const Node a : step.operands) arb_mul(out, out, of[a].get(), kTapeBits);
        return Defined::kYes;
      case Kind::kPower:
        return power(out, of[step.operands[0]].get(), step.exponent);
      case Kind::kRoot:
        return root(out, of[step.operands[0]].get(), step.exponent);
      case Kind::kCall:
        return call(step, of, out);
    }
    return Defined::kUnknown;
  }

  static Defined power(arb_ptr out, arb_srcptr base, long exponent) {
    arb_pow_ui(out, base, static_cast<ulong>(exponent < 0 ? -exponent : exponent), kTapeBits);
    if (exponent >= 0) return Defined::kYes;
    arb_inv(out, out, kTapeBits);
    return where(arb_is_nonzero(base) != 0, arb_is_zero(base) != 0);
  }

  static Defined root(arb_ptr out, arb_srcptr base, long halves) {
    Ball root;
    arb_sqrt(root.get(), base, kTapeBits);
    const Defined rooted = where(arb_is_nonnegative(base) != 0, arb_is_negative(base) != 0);
    return worse(rooted, power(out, root.get(), halves));
  }

  static Defined call(const Step& step, const std::vector<Ball>& of, arb_ptr out) {
    using Function = void (*)(arb_t, const arb_t, slong);
    static const std::map<std::string, Function> kFunctions{
        {"sin", arb_sin},   {"cos", arb_cos}, {"tan", arb_tan}, {"asin", arb_asin},
        {"acos", arb_acos}, {"exp", arb_exp}, {"log", arb_log}, {"atan", arb_atan}};
    arb_srcptr x = of[step.operands[0]].get();
    if (step.function == "abs") {
      arb_abs(out, x);
      return Defined::kYes;
    }
    if (step.function == "atan2") {
      arb_srcptr second = of[step.operands[1]].get();
      arb_atan2(out, x, second, kTapeBits);
      return where(arb_is_nonzero(x) != 0 || arb_is_positive(second) != 0,
                   arb_is_zero(x) != 0 && arb_is_nonpositive(second) != 0);
    }
    kFunctions.at(step.function)(out, x, kTapeBits);
    if (step.function == "log") return where(arb_is_positive(x) != 0, arb_is_nonpositive(x) != 0);
    if (step.function == "tan") return where(arb_is_finite(out) != 0, false);
    if (step.function == "asin" || step.function == "acos") return within_one(x);
    return Defined::kYes;
  }

  static Defined within_one(arb_srcptr x) {
    Ball distance;
    arb_abs(distance.get(), x);
    arb_sub_ui(distance.get(), distance.get(), 1, kTapeBits);
    return where(arb_is_nonpositive(distance.get()) != 0, arb_is_positive(distance.get()) != 0);
  }

  std::vector<Step> steps_;
  std::map<GiNaC::ex, Node, GiNaC::ex_is_less> known_;
};

}  // namespace regulus::detail::test
