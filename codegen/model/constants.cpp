// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/constants.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

std::string shown(const ex& constant) {
  return fmt::format("{:.12g}", approx_value(constant).value_or(std::nan("")));
}

std::string in(const Place& place) { return place.key.empty() ? "" : " in " + place.key; }

}  // namespace

Range checked_range(const ParsedExpression& lo, const ParsedExpression& hi, const Place& place) {
  const std::string range = "the range " + shown(lo.value) + " to " + shown(hi.value) + in(place);
  switch (lo.value.is_equal(hi.value) ? CertainSign::kZero : certain_sign(hi.value - lo.value)) {
    case CertainSign::kNegative:
      throw InputError::statement(place.file, place.line, range + " is empty",
                                  "its lower end must not be above its upper end", place.key);
    case CertainSign::kUnknown:
      throw InputError::statement(
          place.file, place.line,
          range + " may be empty: 4096 bits do not show which end is the lower one",
          "write ends that differ clearly, or the same expression twice", place.key);
    default:
      return {lo.value, hi.value};
  }
}

ex checked_nonnegative(const ParsedExpression& value, const Place& place) {
  switch (certain_sign(value.value)) {
    case CertainSign::kNegative:
      throw InputError(place.file, place.line,
                       "the negative number " + shown(value.value) + in(place), "a number ≥ 0",
                       place.key);
    case CertainSign::kUnknown:
      throw InputError::statement(
          place.file, place.line,
          "the number" + in(place) + " may be negative: 4096 bits do not show its sign",
          "write a number that is clearly above 0, or 0 itself", place.key);
    default:
      return value.value;
  }
}

Range parse_range(std::string_view text, const Place& place, std::vector<ex>& must_be_defined,
                  NumberUnit unit) {
  const std::size_t colon = text.find(':');
  const ParsedExpression lo = parse_constant(text.substr(0, colon), place, unit);
  const ParsedExpression hi =
      colon == std::string_view::npos ? lo : parse_constant(text.substr(colon + 1), place, unit);
  append(must_be_defined, lo.must_be_defined);
  append(must_be_defined, hi.must_be_defined);
  return checked_range(lo, hi, place);
}

void append(std::vector<ex>& all, const std::vector<ex>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::vector<ex> distinct(const std::vector<ex>& all) {
  std::set<ex, GiNaC::ex_is_less> seen;
  std::vector<ex> result;
  for (const ex& e : all)
    if (seen.insert(e).second) result.push_back(e);
  return result;
}

}  // namespace regulus::detail
