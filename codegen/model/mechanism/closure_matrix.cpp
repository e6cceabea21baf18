// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/closure_matrix.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::is_a;

struct RootsForAbsoluteValues : GiNaC::map_function {
  ex operator()(const ex& e) override {
    if (!GiNaC::is_the_function<GiNaC::abs_SERIAL>(e)) return e.map(*this);
    return GiNaC::pow(GiNaC::pow(e.op(0).map(*this), 2), GiNaC::numeric(1, 2));
  }
};

/// Nodes of an expression and of its derivative.
struct Sizes {
  double plain = 1, derivative = 0;
};

constexpr double kOuterDerivative = 8;  ///< nodes that the derivative of a function adds

Sizes sizes_of(const ex& e, const ex& symbol) {
  if (e.is_equal(symbol)) return {1, 1};
  Sizes all;
  double varying = 0;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const Sizes part = sizes_of(e.op(i), symbol);
    all.plain += part.plain;
    all.derivative += part.derivative;
    varying += part.derivative > 0;
  }
  if (varying > 0 && is_a<GiNaC::mul>(e)) all.derivative += varying * all.plain;
  if (varying > 0 && !is_a<GiNaC::mul>(e) && !is_a<GiNaC::add>(e))
    all.derivative += varying * (all.plain + kOuterDerivative);
  return all;
}

}  // namespace

ex differentiable(const ex& expression) { return RootsForAbsoluteValues()(expression); }

GiNaC::matrix closure_matrix(const Closure& closure) {
  const auto n = static_cast<unsigned>(closure.unknowns.size());
  GiNaC::matrix result(static_cast<unsigned>(closure.equations.size()), n);
  for (unsigned i = 0; i < result.rows(); ++i) {
    const ex equation = differentiable(closure.equations[i]);
    for (unsigned j = 0; j < n; ++j) result(i, j) = equation.diff(closure.unknowns[j].symbol);
  }
  return result;
}

double derivative_size(const ex& expression, const ex& symbol) {
  return sizes_of(expression, symbol).derivative;
}

}  // namespace regulus::detail
