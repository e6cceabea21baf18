// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/margin_checkpoint.hpp"

#include <nlohmann/json.hpp>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {

nlohmann::ordered_json checkpointed_question(const Request& request, const SearchOptions& search) {
  nlohmann::ordered_json question = json_question(request, search);
  question.erase("options");  // they change how long it takes
  if (!request.motion.trajectory) return question;
  question["waypoints"] = json_waypoints(*request.motion.trajectory);
  question["waypoints"].erase("file");
  for (const GiNaC::ex& error : request.motion.error)
    question["tube"].push_back(formula_text(error));
  return question;
}

MarginCheckpoint::MarginCheckpoint(const std::string& path, const Request& request,
                                   const MarginQuestion& question, const SearchOptions& search) {
  if (path.empty()) return;
  nlohmann::ordered_json asked = checkpointed_question(request, search);
  asked["margin"] = describe_quantity(question);
  file_.emplace(path, asked);
  searches_ = file_->searches_of(question, "", "0");
}

}  // namespace regulus::detail
