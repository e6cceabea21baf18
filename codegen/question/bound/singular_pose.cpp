// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/singular_pose.hpp"

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/question/bound/way_place.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/way/path_run.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

std::optional<SingularPose> find_on_way(const Request& request, const SearchOptions& search,
                                        const BoundSettings& settings, std::uint64_t& boxes) {
  SearchDisplay display(settings.output);
  TrajectoryCheck check =
      check_trajectory(request, 0, search, false, {settings.interrupt, display.observer()});
  boxes += check.path.statistics.boxes;
  if (check.verdict != Verdict::kSingularity) return std::nullopt;
  DecidingPiece& piece = *check.deciding;
  return SingularPose{
      place_on_way(*request.motion.trajectory, piece.index, *piece.preparation, piece.result, ""),
      piece.result, uncertain_names(piece.preparation->labels), piece.index};
}

}  // namespace

std::optional<SingularPose> find_singular_pose(const Request& request,
                                               const BoundSettings& settings, double seconds,
                                               std::uint64_t& boxes) {
  Request regularity = request;
  regularity.motion.alpha = 0;
  SearchOptions search = settings.search;
  search.time_limit = seconds;
  search.workers = nullptr;  // they have another kernel
  if (request.motion.trajectory) return find_on_way(regularity, search, settings, boxes);
  PreparedSearch prepared =
      prepare(regularity, 0, search, forming_watch(settings.output, settings.interrupt));
  Result result = run_search(prepared, search, settings_of(prepared, search, settings.interrupt));
  boxes += result.statistics.boxes;
  if (result.verdict != Verdict::kSingularity) return std::nullopt;
  AttainedPlace place = attained_place(prepared, result, "");
  return SingularPose{std::move(place), std::move(result), uncertain_names(prepared.labels)};
}

}  // namespace regulus::detail
