// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/model/constants.hpp"

#include <cmath>
#include <set>
#include <string>

#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/model/names.hpp"
#include "regulus/codegen/model/sign.hpp"

namespace regulus::codegen {
namespace {

using GiNaC::ex;

/// Exact for rationals; for other constants certain but for rounding, which is left a margin.
bool clearly_negative(const ex& value, double scale) {
  if (value.info(GiNaC::info_flags::rational)) return value.info(GiNaC::info_flags::negative);
  const auto approximate = approx_value(value);
  return approximate && *approximate < -1e-12 * scale;
}

std::string shown(const ex& constant) {
  return std::to_string(approx_value(constant).value_or(std::nan("")));
}

std::string in(const Place& place) { return place.key.empty() ? "" : " in " + place.key; }

}  // namespace

Range checked_range(const Term& lo, const Term& hi, const Place& place) {
  const double scale =
      std::fabs(approx_value(lo.value).value_or(0)) + std::fabs(approx_value(hi.value).value_or(0));
  if (clearly_negative(hi.value - lo.value, scale))
    throw InputError(place.file, place.line,
                     "the empty range " + shown(lo.value) + " to " + shown(hi.value) + in(place),
                     "a lower end that is not above the upper end", place.key);
  return {lo.value, hi.value};
}

ex checked_nonnegative(const Term& value, const Place& place) {
  if (clearly_negative(value.value, 1))
    throw InputError(place.file, place.line,
                     "the negative number " + shown(value.value) + in(place), "a number ≥ 0",
                     place.key);
  return value.value;
}

Range parse_range(std::string_view text, const Place& place, std::vector<ex>& must_be_defined) {
  const std::size_t colon = text.find(':');
  const Term lo = parse_constant(text.substr(0, colon), place);
  const Term hi =
      colon == std::string_view::npos ? lo : parse_constant(text.substr(colon + 1), place);
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

}  // namespace regulus::codegen
