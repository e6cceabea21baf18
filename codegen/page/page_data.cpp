// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/page/page_data.hpp"

#include <algorithm>
#include <utility>

#include "codegen/certificate/certificate_question.hpp"
#include "codegen/page/drawing_json.hpp"
#include "regulus/version.hpp"

namespace regulus::inline page {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

bool is_plain(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') ||
         std::string_view("_-./,:=+@%").find(c) != std::string_view::npos;
}

/// Returns the word as a shell reads it.
std::string shell_word(const std::string& word) {
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

Json json_units(const ReportLabels& labels) {
  Json units = Json::object();
  for (const PoseLabel& p : labels.pose) units[p.name] = p.unit;
  for (const VariableLabel& v : labels.variables) units[v.name] = v.unit;
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
  for (const std::string& tube : model.tubes) check += " --tube " + shell_word(tube);
  return {check + " --certificate proof.txt",
          "regulus verify proof.txt --model " + shell_word(model.path)};
}

PageData begin_page(const PreparedSearch& preparation, const ModelOptions& model) {
  const Request& request = preparation.stages->request();
  PageData data;
  data.again = commands_to_prove_again(model);
  data.question = certified_question(preparation).text;
  data.drawing = json_drawing(request);
  data.units = json_units(preparation.labels);
  return data;
}

std::string json_text(const PageData& data) {
  const Json json = {
      {"format", kFormat},
      {"version", kVersion},
      {"command", data.command},
      {"again", data.again},
      {"report", data.report},
      {"units", data.units},
      {"question", data.question},
      {"certificate", data.certificate.empty() ? Json(nullptr) : Json(data.certificate)},
      {"certificate_note", data.certificate_note},
      {"model", {{"file", data.report.value("model_file", "")}, {"text", data.model_text}}},
      {"drawing", data.drawing},
      {"paving", data.paving},
      {"bounds", data.bounds},
      {"margins", data.margins}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace regulus::page
