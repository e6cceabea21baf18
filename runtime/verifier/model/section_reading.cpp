// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/section_reading.hpp"

#include "runtime/verifier/model/gough_reading.hpp"
#include "runtime/verifier/model/legs_reading.hpp"
#include "runtime/verifier/model/serial_reading.hpp"

namespace regulus::verifier {
namespace {

bool has_table(const WrittenValues& values, std::string_view table) {
  const auto at = values.lower_bound(table);
  return at != values.end() && at->first.starts_with(table);
}

}  // namespace

std::unique_ptr<SectionReading> read_section(const WrittenValues& values) {
  if (has_table(values, "serial.")) return serial_reading(values);
  if (has_table(values, "gough.")) return gough_reading(values);
  if (has_table(values, "legs.")) return legs_reading(values);
  return nullptr;
}

}  // namespace regulus::verifier
