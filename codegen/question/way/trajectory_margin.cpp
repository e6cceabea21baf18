// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_margin.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

void tell_trajectory_margin(const TrajectoryMargin& found, const MarginQuestion& question,
                            const SearchOptions& search, double gap, Facts& facts) {
  const Margin& margin = found.margin;
  tell_trajectory_question(found.refuted ? *found.refuted : found.last, search, facts);
  facts.say("margin", fmt::format("{}: {} boxes at {} values", describe_range(question),
                                  margin.boxes, margin.steps.size()));
  add_bracket(question, margin, facts);
  for (const auto* step : {&margin.empty, &margin.certified, &margin.refuted})
    say_end(*step, facts);
  facts.add("segment", nullptr).add("witness", nullptr);
  if (found.refuted) tell_deciding_piece(*found.refuted, facts);
  tell_gap(margin, gap, facts);
  found.proofs.tell(facts);
}

}  // namespace regulus
