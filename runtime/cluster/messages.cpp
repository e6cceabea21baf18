// SPDX-License-Identifier: Apache-2.0
#include "runtime/cluster/messages.hpp"

namespace regulus::detail::cluster {

std::string write_grant(const Grant& grant) {
  ByteWriter bytes;
  bytes.put_count(grant.number);
  bytes.put_count(grant.budget);
  bytes.put_each(grant.units, [&bytes](const Unit& unit) { put(bytes, unit); });
  return bytes.take();
}

Grant read_grant(std::string_view text) {
  ByteReader reader(text);
  Grant grant;
  grant.number = reader.take_count();
  grant.budget = reader.take_count();
  reader.take_each([&] { grant.units.push_back(take_unit(reader)); });
  return grant;
}

std::string write_answer(const Answer& answer) {
  ByteWriter bytes;
  bytes.put_count(answer.grant);
  bytes.put(answer.seconds);
  bytes.put_each(answer.results, [&bytes](const UnitResult& result) {
    bytes.put_count(result.unit);
    bytes.put_text(result.outcome);
  });
  return bytes.take();
}

Answer read_answer(std::string_view text) {
  ByteReader reader(text);
  Answer answer;
  answer.grant = reader.take_count();
  answer.seconds = reader.take<double>();
  reader.take_each([&] {
    const std::uint64_t unit = reader.take_count();
    answer.results.push_back({unit, std::string(reader.take_text())});
  });
  return answer;
}

}  // namespace regulus::detail::cluster
