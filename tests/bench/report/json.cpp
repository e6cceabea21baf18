// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include "tests/bench/report/writers.hpp"

namespace regulus::detail::bench {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json describe(const std::optional<Target>& target) {
  if (!target) return nullptr;
  const char* of = target->of == Target::Of::kRatio ? "ratio" : "value";
  const char* sense = target->sense == Target::Sense::kAtLeast ? "at_least" : "at_most";
  return {{"of", of}, {sense, target->bound}};
}

Json describe(const Section& section, const Row& row) {
  Json ratio, quartiles;
  if (row.ratio) {
    ratio = row.ratio->median;
    quartiles = {row.ratio->low, row.ratio->high};
  }
  return {{"section", section.name},
          {"name", row.name},
          {"value", or_null(row.value)},
          {"unit", row.unit},
          {"ratio", ratio},
          {"ratio_quartiles", quartiles},
          {"target", describe(row.target)},
          {"met", or_null(met(row))},
          {"explanation", row.explanation},
          {"skipped", row.skipped.empty() ? Json() : Json(row.skipped)}};
}

}  // namespace

std::string to_json(const Report& report) {
  Json rows = Json::array();
  for (const Section& section : report.sections)
    for (const Row& row : section.rows) rows.push_back(describe(section, row));
  const Machine& m = report.machine;
  const Json json = {{"machine",
                      {{"processor", m.processor},
                       {"processors", m.processors},
                       {"load", m.load},
                       {"compiler", m.compiler},
                       {"compiler_in_process", m.in_process}}},
                     {"rows", rows}};
  constexpr int kIndent = 2;
  return json.dump(kIndent) + "\n";
}

}  // namespace regulus::detail::bench
