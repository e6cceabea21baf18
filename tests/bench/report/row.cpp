// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/report/row.hpp"

namespace regulus::detail::bench {

std::optional<bool> met(const Row& row) {
  if (!row.target) return std::nullopt;
  std::optional<double> figure = row.value;
  if (row.target->of == Target::Of::kRatio)
    figure = row.ratio ? std::optional(row.ratio->median) : std::nullopt;
  if (!figure) return std::nullopt;
  return row.target->sense == Target::Sense::kAtLeast ? *figure >= row.target->bound
                                                      : *figure <= row.target->bound;
}

Row timed_row(std::string name, const Timing& timing, double scale, std::string unit,
              std::string explanation) {
  Row row;
  row.name = std::move(name);
  row.value = timing.seconds.median * scale;
  row.unit = std::move(unit);
  row.ratio = timing.ratio;
  row.explanation = std::move(explanation);
  return row;
}

Row skipped_row(std::string name, std::string reason, std::string explanation) {
  Row row;
  row.name = std::move(name);
  row.skipped = std::move(reason);
  row.explanation = std::move(explanation);
  return row;
}

}  // namespace regulus::detail::bench
