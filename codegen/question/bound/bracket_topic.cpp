// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bracket_topic.hpp"

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/question/bound/bound_certificate.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

const Component& component_of(const BracketTopic& topic, const Quantity& quantity) {
  if (topic.component >= quantity.components.size()) throw cluster::MalformedMessage();
  return quantity.components[topic.component];
}

/// Forming has no limit of time here: the process that asks ends the search.
SearchOptions without_limit(SearchOptions search) {
  search.time_limit = 0;
  return search;
}

std::optional<MarginValue> value_of(std::optional<double> end) {
  return end ? std::optional(decimal_value(*end)) : std::nullopt;
}

}  // namespace

std::string write_topic(const BracketTopic& topic) {
  cluster::ByteWriter bytes;
  bytes.put(topic.kind);
  bytes.put(std::uint64_t{topic.component});
  bytes.put(topic.reference);
  bytes.put(topic.low);
  bytes.put(topic.high.has_value());
  bytes.put(topic.high.value_or(0));
  return bytes.take();
}

BracketTopic read_topic(std::string_view text) {
  cluster::ByteReader bytes(text);
  BracketTopic topic;
  topic.kind = bytes.take<TopicKind>();
  if (topic.kind > TopicKind::kMatrixWithSlopes) throw cluster::MalformedMessage();
  topic.component = bytes.take<std::uint64_t>();
  topic.reference = bytes.take<double>();
  topic.low = bytes.take<double>();
  const bool has_high = bytes.take<bool>();
  const auto high = bytes.take<double>();
  if (has_high) topic.high = high;
  if (!bytes.at_end()) throw cluster::MalformedMessage();
  return topic;
}

MarginQuestion question_of(const Bordered& bordered, MarginValue low,
                           std::optional<MarginValue> high) {
  MarginQuestion question;
  question.quantity =
      bordered.parameter.empty() ? MarginQuantity::kAlpha : MarginQuantity::kParameter;
  question.groups = bordered.parameter;
  question.is_two_sided = bordered.is_two_sided;
  question.low = std::move(low);
  question.high = std::move(high);
  return question;
}

MarginQuestion question_at_limit(const Bordered& bordered) {
  const Motion& motion = bordered.request.motion;
  const ex end = bordered.parameter.empty() ? motion.alpha : motion.parameters.back().range.hi;
  return question_of(bordered, decimal_value(0),
                     MarginValue{"the limit", end, approx_value(end).value_or(0), {}});
}

MarginQuestion question_within_limit(MarginQuestion question, const Component& component,
                                     const ex& limit) {
  question.about = [component, limit](const Request& grown) {
    return border_at_limit(grown, component, limit).request;
  };
  question.certified = [component, limit](const Request& grown) -> CertifiedMotion {
    const Bordered bordered = border_at_limit(grown, component, limit);
    const Motion& motion = bordered.request.motion;
    const ex end = bordered.parameter.empty() ? motion.alpha : motion.parameters.back().range.hi;
    return {grown, [component, bordered, end](const Request& about,
                                              const std::set<std::string>& uncertain) {
              return certified_bound(about, component, bordered, end, uncertain);
            }};
  };
  return question;
}

PreparedMargin prepare_topic(const BracketTopic& topic, const Request& request,
                             const Quantity& quantity, const std::optional<ex>& limit,
                             const SearchOptions& search) {
  const Component& component = component_of(topic, quantity);
  if (limit) {
    const Bordered bordered = border_at_limit(request, component, *limit);
    return {question_at_limit(bordered), bordered.request, 0, without_limit(search), {}};
  }
  const Bordered bordered = border(request, component, shortest_decimal(topic.reference));
  return {question_of(bordered, decimal_value(topic.low), value_of(topic.high)),
          bordered.request,
          0,
          without_limit(search),
          {}};
}

PreparedMargin prepare_topic(const BracketTopic& topic, const Request& request,
                             MarginQuestion question, const Quantity& quantity, const ex& limit,
                             const SearchOptions& search) {
  question = question_within_limit(std::move(question), component_of(topic, quantity), limit);
  const bool same_high = question.high && topic.high && question.high->approx == *topic.high;
  if (question.low.approx != topic.low) question.low = decimal_value(topic.low);
  if (!same_high) question.high = value_of(topic.high);
  return {question, request, 0, without_limit(search), {}};
}

}  // namespace regulus
