// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/trajectory/margin_checkpoint.hpp"

#include <nlohmann/json.hpp>

#include "codegen/model/ginac_text.hpp"
#include "codegen/model/trajectory.hpp"
#include "codegen/report/question_report.hpp"
#include "codegen/trajectory/trajectory_report.hpp"

namespace regulus::inline trajectory {

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

}  // namespace regulus::trajectory
