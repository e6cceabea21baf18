// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_margin.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/set_facts.hpp"
#include "codegen/question/margin/margin_report.hpp"
#include "codegen/question/way/path_attempts.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {

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

void tell_growing_way(const Request& request, const MarginQuestion& question, Facts& facts) {
  const Request before = before_growth(request, question);
  tell_way(before, facts);
  const SearchSubject geometry = geometry_along_way(before);
  if (question.quantity == MarginQuantity::kTolerance)
    say_growing(geometry, geometry_along_way(grown(request, question, forming_value(question))),
                facts);
  else
    say_uncertain_geometry(geometry, facts);
}

void tell_trajectory_margin(const TrajectoryMargin& found, const MarginQuestion& question,
                            const SearchOptions& search, double gap, Facts& facts) {
  const Margin& margin = found.margin;
  const TrajectoryCheck& shown = found.refuted ? *found.refuted : found.last;
  tell_growing_way(shown.request, question, facts);
  tell_trajectory_work(shown, search, facts);
  facts.say("margin", fmt::format("{}: {} at {}", describe_range(question),
                                  counted(margin.boxes, "box", "boxes"),
                                  counted(margin.steps.size(), "value", "values")));
  add_bracket(question, margin, facts);
  for (const auto* step : {&margin.empty, &margin.certified, &margin.refuted})
    say_end(question, *step, facts);
  facts.add("segment", nullptr).add("witness", nullptr);
  if (found.refuted) tell_deciding_piece(*found.refuted, facts);
  tell_gap(margin, gap, facts);
  found.proofs.tell(facts);
}

}  // namespace regulus::detail
