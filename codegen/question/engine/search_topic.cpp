// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/search_topic.hpp"

#include <span>

#include "codegen/model/way/trajectory.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {
namespace {

template <typename Number>
void put(cluster::ByteWriter& bytes, const std::optional<Number>& number) {
  bytes.put(number.has_value());
  bytes.put(number.value_or(Number{}));
}

template <typename Number>
std::optional<Number> take(cluster::ByteReader& bytes) {
  const bool has_number = bytes.take_flag();
  const auto number = bytes.take<Number>();
  return has_number ? std::optional(number) : std::nullopt;
}

}  // namespace

std::string write_topic(const SearchTopic& topic) {
  cluster::ByteWriter bytes;
  bytes.put(topic.kind);
  bytes.put_text(topic.part);
  bytes.put_text(topic.component);
  bytes.put(topic.reference);
  bytes.put(topic.low);
  put(bytes, topic.high);
  bytes.put_text(topic.waypoints);
  put(bytes, topic.value);
  put(bytes, topic.piece);
  bytes.put_list(std::span<const double>(topic.start));
  return bytes.take();
}

SearchTopic read_topic(std::string_view text) {
  cluster::ByteReader bytes(text);
  SearchTopic topic;
  topic.kind = bytes.take<TopicKind>();
  if (topic.kind > TopicKind::kBranchWithNominal) throw cluster::MalformedMessage();
  topic.part = bytes.take_text();
  topic.component = bytes.take_text();
  topic.reference = bytes.take<double>();
  topic.low = bytes.take<double>();
  topic.high = take<double>(bytes);
  topic.waypoints = bytes.take_text();
  topic.value = take<double>(bytes);
  topic.piece = take<std::uint64_t>(bytes);
  topic.start = bytes.take_list<double>();
  if (!bytes.at_end()) throw cluster::MalformedMessage();
  return topic;
}

void turn_to(cluster::Workers* workers, SearchTopic topic, const Motion& motion) {
  if (workers == nullptr) return;
  if (motion.trajectory) topic.waypoints = motion.trajectory->sha256;
  workers->turn_to(write_topic(topic));
}

void turn_to_piece(cluster::Workers* workers, SearchTopic topic, const Motion& motion,
                   std::optional<std::uint64_t> piece) {
  topic.piece = piece;
  turn_to(workers, std::move(topic), motion);
}

}  // namespace regulus::detail
