// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bound_question.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/names.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/quantity/platform_closure.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

bool is_word(const std::string& text) {
  return std::ranges::all_of(text, [](char c) { return c == '-' || ('a' <= c && c <= 'z'); });
}

}  // namespace

/// A text that is neither a quantity nor an expression may be a mistyped word.
Request read_asked(ModelOptions model, const QuantityOptions& quantity, const FormingWatch& watch) {
  const std::string& text = quantity.quantity;
  if (!is_quantity(text)) model.asked = text;
  try {
    Request request = read_request(model, &watch);
    return is_finite_error(quantity) && !request.model.closure ? closure_of_platform(request)
                                                               : request;
  } catch (const UsageError&) {
    if (model.asked.empty() || !is_word(text)) throw;
  }
  throw UsageError("QUANTITY: there is no " + in_quotes(text) + "; " +
                   suggestion(text, quantity_words(),
                              fmt::format("it is {}, or an expression of the model",
                                          fmt::join(quantity_words(), ", "))));
}

bool has_finite_errors(const Request& request) {
  const auto is_zero = [](const GiNaC::ex& e) { return e.is_zero(); };
  return !std::ranges::all_of(request.motion.error, is_zero) ||
         !std::ranges::all_of(request.model.geometry, is_zero, &GeometryParameter::tolerance);
}

void require_errors_in_ranges(const Request& request, const Quantity& quantity) {
  if (quantity.kind != QuantityKind::kFiniteError) return;
  for (const GeometryParameter& g : request.model.geometry)
    if (g.ball >= 0 && !request.model.balls.at(std::size_t(g.ball)).radius.is_zero())
      throw UsageError("finite errors take tolerances that are ranges; the point of '" + g.name +
                       "' lies in a ball");
}

void require_finite_errors(const Request& request, const Quantity& quantity) {
  require_errors_in_ranges(request, quantity);
  if (quantity.kind == QuantityKind::kFiniteError && !has_finite_errors(request))
    throw UsageError(
        "nothing has an error: give the motion an `error`, the legs [actuators] error, or the "
        "geometry tolerances");
}

namespace {

/// A limit is a number of degrees if the component is in degrees. One limit with a degree in its text has
/// two values if it is for components in degrees and for others.
NumberUnit unit_of_limit(const std::string& text, const Place& place, const Quantity& quantity) {
  const auto in_degrees = [](const Component& c) { return is_in_degrees(c.unit); };
  if (std::ranges::none_of(quantity.components, in_degrees)) return NumberUnit::kPlain;
  if (std::ranges::all_of(quantity.components, in_degrees)) return NumberUnit::kDegrees;
  const bool is_plain = parse_constant(text, place, NumberUnit::kDegrees)
                            .value.is_equal(parse_constant(text, place, NumberUnit::kPlain).value);
  if (!is_plain)
    throw UsageError("--limit: '" + text +
                     "' is an angle, and not all of the bounded quantities are; choose one by "
                     "--freedom, or write a number");
  return NumberUnit::kPlain;
}

}  // namespace

GiNaC::ex read_limit(const std::string& text, const Quantity& quantity) {
  GiNaC::ex limit;
  from_option("--limit", [&] {
    const Place place{.file = "", .key = "--limit"};
    limit = parse_constant(text, place, unit_of_limit(text, place, quantity)).value;
  });
  const bool must_be_positive =
      std::ranges::any_of(quantity.components, [](const Component& c) { return c.is_absolute; });
  if (must_be_positive && certain_sign(limit) != CertainSign::kPositive)
    throw UsageError("--limit: found " + text + ", expected a positive number");
  return limit;
}

BoundQuestion read_bound_question(const ModelOptions& model, const QuantityOptions& words,
                                  const std::string& limit, const FormingWatch& watch) {
  if (words.quantity.empty())
    throw UsageError(fmt::format("bound: no QUANTITY; it is {}, or an expression of the model",
                                 fmt::join(quantity_words(), ", ")));
  refuse_threshold(model);
  BoundQuestion question{read_asked(model, words, watch), {}, {}};
  question.quantity = quantity_of(question.request.model, words);
  require_finite_errors(question.request, question.quantity);
  if (!limit.empty()) question.limit = read_limit(limit, question.quantity);
  return question;
}

}  // namespace regulus::detail
