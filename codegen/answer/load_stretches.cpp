// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/load_stretches.hpp"

#include <nlohmann/json.hpp>
#include <ostream>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/question/load/feasibility_report.hpp"
#include "codegen/question/way/trajectory_paving.hpp"

namespace regulus::detail {

std::vector<StretchOfLoad> stretches_of_load(const Trajectory& trajectory,
                                             const std::vector<PathStretch>& stretches) {
  std::vector<StretchOfLoad> result;
  for (const PathStretch& stretch : stretches)
    for (const ForceClaim claim : kEveryForceClaim)
      if (stand_in(claim) == stretch.claim)
        result.push_back({claim, stretch.begin.piece + 1, stretch.end.piece + 1, stretch.begin.s,
                          stretch.end.s,
                          report_text(json_stretch_of(trajectory, stretch, word_of_stand_in))});
  return result;
}

void write_stretches(const std::vector<StretchOfLoad>& stretches,
                     const nlohmann::ordered_json& summary, LinesFile& lines) {
  if (!lines.is_wanted()) return;
  for (const StretchOfLoad& stretch : stretches) lines.stream() << stretch.line << '\n';
  lines.stream() << report_text({{"summary", summary}}) << '\n';
  lines.finish();
}

}  // namespace regulus::detail
