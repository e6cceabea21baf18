// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>

#include "codegen/kernel/symbolic/expression.hpp"
#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// The meaning of each GiNaC symbol. Never iterate over it: its order is GiNaC's.
using SymbolMeaning = std::map<GiNaC::ex, Expression, GiNaC::ex_is_less>;

/// Converts GiNaC expressions; shared sub-expressions stay shared.
class GinacReader {
 public:
  /// `meter`: null, or it outlives this object and counts the nodes that are read.
  explicit GinacReader(const SymbolMeaning& symbols, WorkMeter* meter = nullptr)
      : symbols_(symbols), meter_(meter) {}

  /// Ensures   the same function, independent of the order in which GiNaC keeps its terms.
  ///           Throws InputError for floating-point or complex numbers, undeclared symbols,
  ///           unknown functions and exponents that are not rational.
  [[nodiscard]] Expression read(const GiNaC::ex& e);

 private:
  Expression converted(const GiNaC::ex& e);
  Expression read_power(const GiNaC::ex& e);
  Expression read_function(const GiNaC::ex& e);
  Expressions read_operands(const GiNaC::ex& e);

  const SymbolMeaning& symbols_;
  WorkMeter* meter_;
  std::map<GiNaC::ex, Expression, GiNaC::ex_is_less> known_;
};

}  // namespace regulus::detail
