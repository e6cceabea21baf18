// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bound_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/bound/quantity_report.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// True if the bracket is for a least value: its proved end is the lower one.
bool is_least(const Component& c) { return c.sign < 0 || traits_of(c.kind).is_always_least; }

RoundTo side_of_proved(const Component& c) {
  return is_least(c) ? RoundTo::kBelow : RoundTo::kAbove;
}
/// An attained value is shown on the side that claims less.
RoundTo side_of_attained(const Component& c) {
  return is_least(c) ? RoundTo::kAbove : RoundTo::kBelow;
}

/// Returns as many digits as a gap needs to be seen.
int digits_for(const std::optional<double>& gap) {
  if (!gap || !(*gap > 0)) return 5;
  return std::clamp(3 - static_cast<int>(std::floor(std::log10(*gap))), 5, 15);
}

std::optional<double> gap_of(const ComponentBound& c) {
  if (!c.attained || !c.proved) return std::nullopt;
  const double a = std::abs(c.attained->approx), b = std::abs(c.proved->approx);
  return std::abs(c.attained->approx - c.proved->approx) / std::max({a, b, 1e-300});
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit == "1" ? number : number + " " + unit;
}

std::string label_of(const Component& c) { return c.label.empty() ? "" : " (" + c.label + ")"; }

/// Returns the bracket of two ends that may be of different components.
std::string describe_ends(const ComponentBound* attained, const ComponentBound* proved,
                          const std::optional<double>& gap, bool capitals) {
  const auto word = [&](const char* text) {
    std::string result = text;
    if (capitals)
      for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
  };
  const int digits = digits_for(gap);
  const auto attained_text = [&] {
    return rounded_text(*attained->attained, side_of_attained(attained->component), digits);
  };
  const auto proved_text = [&] {
    return rounded_text(*proved->proved, side_of_proved(proved->component), digits);
  };
  if (!attained && !proved) return word("nothing known");
  const Component& c = attained ? attained->component : proved->component;
  const bool least = is_least(c);
  if (!attained) return word(least ? "at least " : "at most ") + with_unit(proved_text(), c.unit);
  if (!proved) return word(least ? "at most " : "at least ") + with_unit(attained_text(), c.unit);
  const std::string low = least ? proved_text() : attained_text();
  const std::string high = least ? attained_text() : proved_text();
  return word("between ") + low + word(" and ") + with_unit(high, c.unit);
}

const ComponentBound* unbounded(const Bound& bound) {
  for (const ComponentBound& c : bound.components)
    if (c.is_unbounded) return &c;
  return nullptr;
}

bool is_empty(const Bound& bound) {
  return std::ranges::any_of(bound.components, &ComponentBound::is_empty);
}

/// Returns the symbol of the quantity in a claim: "|force in leg 3 under payload|".
std::string subject_of(const Bound& bound, const Component& c) {
  const std::string words =
      c.label.empty() ? bound.quantity.name : fmt::format("{} of {}", bound.quantity.name, c.label);
  return in_bars(words, c);
}

std::string claim_words(const Request& request, const Component& c) {
  std::string words = request.motion.where == Where::kReachable
                          ? "for every reachable pose of the motion"
                      : request.motion.where == Where::kWithinRanges
                          ? "for every pose of the motion with the actuated joints in range"
                          : "for every pose of the motion";
  bool is_uncertain = false;
  for (const GeometryParameter& g : request.model.geometry)
    is_uncertain = is_uncertain || !g.tolerance.is_zero();
  if (is_uncertain) words += ", every value of the uncertain quantities";
  if (c.set) words += ", every value of " + c.set->name;
  if (traits_of(c.kind).data == NeededData::kMotorErrors) words += ", every error of the motors";
  const auto is_zero = [](const GiNaC::ex& e) { return e.is_zero(); };
  if (c.kind == QuantityKind::kFiniteError && !std::ranges::all_of(request.motion.error, is_zero))
    words += ", every error within its range";
  return words;
}

const ComponentBound* exceeded(const Bound& bound) {
  for (const ComponentBound& c : bound.components)
    if (c.verdict == LimitVerdict::kExceeded) return &c;
  return nullptr;
}

void say_place(const char* word, const ComponentBound& c, Facts& facts) {
  if (!c.place) return;
  const std::string& label = c.component.label;
  facts.say(word, (label.empty() ? "" : label + ": ") + c.place->pose);
  facts.say_lines(c.place->values);
}

std::string describe_proved(const Request& request, const Bound& bound, const ComponentBound& c) {
  const char* relation = is_least(c.component) ? ">" : "<";
  if (c.attained && c.attained->exact.is_equal(c.proved->exact)) relation = "=";
  const std::string end =
      rounded_text(*c.proved, side_of_proved(c.component), digits_for(bound.gap()));
  return fmt::format("{} {} {}, {}", subject_of(bound, c.component), relation,
                     with_unit(end, c.component.unit), claim_words(request, c.component));
}

const char* word_of_verdict(LimitVerdict verdict) {
  switch (verdict) {
    case LimitVerdict::kWithin:
      return "within";
    case LimitVerdict::kExceeded:
      return "exceeded";
    case LimitVerdict::kUndecided:
      break;
  }
  return "possible-problem";
}

Json json_end(const std::optional<BoundEnd>& end, RoundTo side) {
  if (!end) return nullptr;
  return rounded_number(*end, side);
}

Json json_exact(const std::optional<BoundEnd>& end) {
  return end ? Json(formula_text(end->exact)) : Json(nullptr);
}

Json json_component(const ComponentBound& c, bool has_limit) {
  Facts facts(Readers::kPrograms);
  facts.add("label", c.component.label).add("unit", c.component.unit);
  if (has_limit) {
    facts.add("verdict", word_of_verdict(c.verdict));
  } else {
    facts.add("attained", json_end(c.attained, side_of_attained(c.component)));
    facts.add("proved", json_end(c.proved, side_of_proved(c.component)));
    facts.add("attained_exact", json_exact(c.attained)).add("proved_exact", json_exact(c.proved));
    facts.add("unbounded", c.is_unbounded).add("closed", c.is_closed);
  }
  facts.add("reason", c.reason).add("nonempty", c.is_empty ? Json(false) : Json(nullptr));
  facts.add("place", c.place ? c.place->json : Json(nullptr));
  facts.add("boxes", c.boxes).add("seconds", json_seconds(c.seconds));
  c.proofs.tell_files(facts);
  return facts.object();
}

/// Tells the verdict about the limit, and where it is exceeded.
void tell_limit(const Request& request, const Bound& bound, const BoundSettings& settings,
                Facts& facts) {
  facts.add("limit", formula_text(*settings.limit));
  facts.add("verdict", word_of_verdict(bound.verdict())).add("claim", nullptr);
  if (const ComponentBound* c = exceeded(bound)) say_place("exceeded", *c, facts);
  if (bound.verdict() != LimitVerdict::kWithin) return;
  const std::string claim = fmt::format("{}, {}", describe_limit(bound.quantity, *settings.limit),
                                        claim_words(request, bound.components.front().component));
  facts.tell("claim", claim, "proved", claim);
}

/// Tells both ends, and where one is attained.
void tell_ends(const Request& request, const Bound& bound, const BoundSettings& settings,
               Facts& facts) {
  const ComponentBound *attained = bound.decisive_attained(), *proved = bound.decisive_proved();
  const ComponentBound* singular = unbounded(bound);
  const bool is_refuted = std::ranges::any_of(bound.components, &ComponentBound::is_singular);
  facts.add("verdict", is_refuted ? "refuted" : bound.is_closed() ? "closed" : "open");
  facts.add("claim", nullptr).add("attained", nullptr).add("attained_by", nullptr);
  facts.add("proved", nullptr);
  if (proved) {
    facts.add("proved", json_end(proved->proved, side_of_proved(proved->component)));
    if (!singular) {
      const std::string claim = describe_proved(request, bound, *proved);
      facts.tell("claim", claim, "proved", claim);
    }
  }
  if (attained)
    facts.add("attained", json_end(attained->attained, side_of_attained(attained->component)))
        .add("attained_by", attained->component.label);
  if (singular)
    say_place("singular", *singular, facts);
  else if (attained)
    say_place("attained", *attained, facts);
  facts.add("gap", or_null(bound.gap())).add("gap_wanted", settings.gap);
  facts.add("closed", bound.is_closed());
}

void tell_components(const Bound& bound, bool has_limit, Facts& facts) {
  Json components = Json::array(), proofs = Json::array();
  for (const ComponentBound& c : bound.components) {
    components.push_back(json_component(c, has_limit));
    c.proofs.add_to(proofs, c.component.label);
    facts.say_lines(c.proofs.lines());
  }
  facts.add("components", std::move(components));
  if (!proofs.empty()) facts.add("proof", std::move(proofs));
}

}  // namespace

StageSeconds seconds_of(const Bound& bound) {
  StageSeconds sum;
  for (const ComponentBound& c : bound.components) sum += c.seconds;
  return sum;
}

std::uint64_t boxes_of(const Bound& bound) {
  std::uint64_t sum = 0;
  for (const ComponentBound& c : bound.components) sum += c.boxes;
  return sum;
}

std::string describe_bound(const Bound& bound, const BoundSettings& settings) {
  if (is_empty(bound)) return "NO POSE REMAINS";
  if (settings.limit) {
    if (bound.verdict() == LimitVerdict::kWithin) return "WITHIN";
    if (const ComponentBound* c = exceeded(bound)) return "EXCEEDED" + label_of(c->component);
    return "POSSIBLE PROBLEM";
  }
  if (const ComponentBound* c = unbounded(bound)) return "UNBOUNDED" + label_of(c->component);
  const ComponentBound *attained = bound.decisive_attained(), *proved = bound.decisive_proved();
  const ComponentBound* named = attained ? attained : proved;
  return describe_ends(attained, proved, bound.gap(), true) +
         (named ? label_of(named->component) : "");
}

EndTexts end_texts(const ComponentBound& c) {
  const int digits = digits_for(gap_of(c));
  std::string attained, proved;
  if (c.attained) attained = rounded_text(*c.attained, side_of_attained(c.component), digits);
  if (c.proved) proved = rounded_text(*c.proved, side_of_proved(c.component), digits);
  if (is_least(c.component)) return {proved, attained};
  return {attained, proved};
}

std::string format_asked(const Request& request, const Quantity& quantity,
                         const std::optional<GiNaC::ex>& limit) {
  Facts bound(Readers::kPeople);
  bound.say("bound", quantity.name);
  if (limit) bound.say("limit", describe_limit(quantity, *limit));
  return describe_request(request) + bound.text();
}

std::string format_component(const ComponentBound& c, bool has_limit) {
  std::string words = has_limit        ? word_of_verdict(c.verdict)
                      : c.is_unbounded ? "unbounded"
                                       : describe_ends(c.attained ? &c : nullptr,
                                                       c.proved ? &c : nullptr, gap_of(c), false);
  if (!c.reason.empty()) words += "; " + c.reason;
  return fmt::format("{:<10} {:<44} {:>7} {:<5} {:>7.2f} s\n", c.component.label, words, c.boxes,
                     c.boxes == 1 ? "box" : "boxes",
                     c.seconds.before_search() - c.seconds.model + c.seconds.search);
}

void tell_bracket(const Request& request, const Bound& bound, const BoundSettings& settings,
                  Facts& facts) {
  facts.add("bound", bound.quantity.name).add("result", describe_bound(bound, settings));
  facts.add("quantity", json_quantity(request.model, bound.quantity));
  facts.add("least", bound.quantity.is_least).add("unit", bound.quantity.unit);
  if (request.motion.trajectory) facts.add("waypoints", json_waypoints(*request.motion.trajectory));
  if (settings.limit)
    tell_limit(request, bound, settings, facts);
  else
    tell_ends(request, bound, settings, facts);
  tell_components(bound, settings.limit.has_value(), facts);
  facts.tell("boxes", boxes_of(bound), "boxes", fmt::format("{} evaluated", boxes_of(bound)));
  tell_time(seconds_of(bound), facts);
  if (const auto gap = bound.gap(); gap && !settings.limit)
    facts.say("gap", *gap > settings.gap && bound.is_closed()
                         ? "both ends are nearly 0"
                         : fmt::format("{:.3g} % of the larger end", 100 * *gap));
}

void tell_bound(const Request& request, const Bound& bound, const BoundSettings& settings,
                Facts& facts) {
  tell_bracket(request, bound, settings, facts);
  add_model(request, facts);
  if (facts.are_for_programs())
    add_search(settings.search, json_question(request, settings.search), facts);
}

}  // namespace regulus::detail
