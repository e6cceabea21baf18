// SPDX-License-Identifier: GPL-3.0-or-later
// Reads arithmetic from untrusted text. No part of the text reaches another parser or a compiler.
//
//   sum     = [+|-] product { (+|-) product }
//   product = factor { (*|/) factor }
//   factor  = (+|-) factor | power
//   power   = primary [ ^ factor ]                 so -x^2 = -(x^2) and 2^3^2 = 2^9
//   primary = number [deg|°] | name | name ( sum {, sum} ) | ( sum )
//
// Numbers are exact decimals with an optional exponent. pi and deg are known everywhere: deg is
// pi/180, but 1 in a value that is a number of degrees (see degrees.hpp), outside the arguments of
// sin, cos and tan. So 10*deg, 10deg and 10° are ten degrees in every place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/parsed_expression.hpp"

namespace regulus::detail {

/// The names an expression may use.
class Names {
 public:
  virtual ~Names() = default;

  /// Returns the meaning of a name, nullptr if it has none. `depth` is the nesting depth of the
  /// expression with this name; an implementation that parses another expression must pass it on.
  [[nodiscard]] virtual const ParsedExpression* find(const std::string& name, int depth) = 0;

  /// Returns all names, for suggestions in messages.
  [[nodiscard]] virtual std::vector<std::string> all() const = 0;
};

/// The position of an expression, for messages.
struct Place {
  std::string file;
  int line = 0;       ///< 0 = not in a file
  std::string key{};  ///< e.g. "let.rho_1"; empty if it has none
};

constexpr std::size_t kLongestExpression = 65536;

/// Reads the expression in `text`. Takes time linear in its length.
///
/// Ensures   numbers in the result are exact rationals, constants are pi or unevaluated; throws
///           InputError with file, line and column for anything else than arithmetic on `names`,
///           and beyond the limits of parsed_expression.hpp or kLongestExpression bytes.
[[nodiscard]] ParsedExpression parse_expression(std::string_view text, Names& names,
                                                const Place& place, int depth = 0,
                                                NumberUnit unit = NumberUnit::kPlain);

/// The same for an expression with no names except pi and deg, and with a finite value.
[[nodiscard]] ParsedExpression parse_constant(std::string_view text, const Place& place,
                                              NumberUnit unit = NumberUnit::kPlain);

}  // namespace regulus::detail
