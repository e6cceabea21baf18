// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/page_data.hpp"

#include <utility>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/page/drawing_json.hpp"
#include "codegen/answer/page/way_json.hpp"
#include "codegen/support/shell_word.hpp"
#include "regulus/version.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

std::string way_option(const ModelOptions& model) {
  return model.waypoints.empty() ? "" : " --waypoints " + shell_word(model.waypoints);
}

Json json_units(const Request& request) {
  Json units = Json::object();
  for (const PoseParameter& p : request.model.pose) units[p.name] = p.unit;
  for (const MotionParameter& p : request.motion.parameters) units[p.name] = p.unit;
  return units;
}

}  // namespace

std::vector<std::string> commands_to_prove_again(const ModelOptions& model) {
  std::string check = "regulus check " + shell_word(model.path);
  if (!model.motion.empty()) check += ' ' + shell_word(model.motion);
  for (const std::string& range : model.ranges) check += " --range " + shell_word(range);
  for (const std::string& tolerance : model.tolerances)
    check += " --tolerance " + shell_word(tolerance);
  if (!model.alpha.empty()) check += " --alpha " + shell_word(model.alpha);
  if (model.beyond_limits) check += " --beyond-limits";
  for (const std::string& tube : model.tubes) check += " --tube " + shell_word(tube);
  return {check + way_option(model) + " --certificate proof.txt", command_to_verify(model)};
}

std::string command_to_verify(const ModelOptions& model) {
  const bool has_changes = !model.ranges.empty() || !model.tolerances.empty() ||
                           !model.alpha.empty() || !model.tubes.empty() || !model.at.empty();
  return "regulus verify proof.txt --model " + shell_word(model.path) + way_option(model) +
         (has_changes ? " --allow-options" : "");
}

void remove_folders(PageData& data, const LocalPaths& paths) {
  for (std::string* text : {&data.command, &data.text, &data.certificate_note})
    paths.remove_from(*text);
  for (std::string& command : data.again) paths.remove_from(command);
  for (Json* report : {&data.report, &data.paving, &data.way, &data.bounds, &data.margins})
    paths.remove_from(*report);
}

void set_question(PageData& data, const Request& request, const std::set<std::string>& uncertain,
                  const ModelOptions& model) {
  const bool is_along_way = request.motion.trajectory != nullptr;
  data.again = commands_to_prove_again(model);
  data.question = is_along_way ? trajectory_question(request, uncertain).text
                               : certified_question(request, uncertain).text;
  // Where its points are follows from its equations, which a page does not solve.
  if (!request.model.closure) data.drawing = json_drawing(request);
  data.units = json_units(request);
  if (is_along_way) data.way = json_way(*request.motion.trajectory);
}

void set_deciding_segment(PageData& data, const Request& request,
                          const std::set<std::string>& uncertain) {
  const std::size_t number = data.report["segment"]["segment"];
  data.way["deciding_question"] =
      certified_question(piece_request(request, number - 1), uncertain).text;
}

std::string json_text(const PageData& data) {
  const Json json = {
      {"format", kFormat},
      {"version", kVersion},
      {"command", data.command},
      {"again", data.again},
      {"kind", data.kind},
      {"headline", data.headline},
      {"text", data.kind == "check" ? "" : data.text},
      {"report", data.report},
      {"units", data.units},
      {"question", data.question},
      {"certificate", data.certificate.empty() ? Json(nullptr) : Json(data.certificate)},
      {"certificate_note", data.certificate_note},
      {"model", {{"file", data.report.value("model_file", "")}, {"text", data.model_text}}},
      {"drawing", data.drawing},
      {"paving", data.paving},
      {"way", data.way},
      {"bounds", data.bounds},
      {"margins", data.margins}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace regulus::detail
