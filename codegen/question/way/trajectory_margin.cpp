// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_margin.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/report_parts.hpp"
#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/way/path_attempts.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus {

TrajectoryMargin margin_of_trajectory(const MarginRequest& request, const MarginQuestion& question,
                                      const SearchOptions& search, double gap,
                                      const OutputOptions& output, BracketSettings settings,
                                      EndProofs proofs) {
  settings.limits = limits_of(search, gap);
  PathAttempts attempts(request, search, output, settings.interrupt, std::move(proofs));
  TrajectoryMargin found{close_bracket(attempts, question, settings), {}, {}, attempts.proofs()};
  found.refuted = attempts.take_refuted();
  if (std::optional<TrajectoryCheck> last = attempts.take_last())
    found.last = std::move(*last);
  else
    found.last.request = request.nominal();
  return found;
}

std::string format_trajectory_margin(const TrajectoryMargin& found, const MarginQuestion& question,
                                     const SearchOptions& search) {
  const Margin& margin = found.margin;
  const TrajectoryCheck& check = found.refuted ? *found.refuted : found.last;
  std::string text = format_trajectory_question(check, search);
  text += fmt::format("margin     {}, from {} to {}: {} boxes at {} values\n",
                      describe_quantity(question), question.low.text,
                      question.high ? question.high->text : "where it ends", margin.boxes,
                      margin.steps.size());
  for (const auto* step : {&margin.empty, &margin.certified, &margin.refuted})
    if (*step) text += fmt::format("at {}: {}\n", (*step)->value.text, (*step)->claim);
  if (found.refuted) text += format_deciding_piece(*found.refuted);
  if (margin.gap) text += fmt::format("gap        {:.3g} % of the upper end\n", 100 * *margin.gap);
  return text;
}

nlohmann::ordered_json json_trajectory_margin(const TrajectoryMargin& found,
                                              const MarginQuestion& question,
                                              const SearchOptions& search, double gap) {
  nlohmann::ordered_json report = json_bracket(question, found.margin, gap);
  add_trajectory_question(report, found.refuted ? *found.refuted : found.last, search);
  report["boxes"] = found.margin.boxes;
  report["segment"] =
      found.refuted ? json_trajectory(*found.refuted, search)["segment"] : nlohmann::ordered_json();
  found.proofs.add_to(report);
  return report;
}

}  // namespace regulus
