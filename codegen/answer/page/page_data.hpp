// SPDX-License-Identifier: GPL-3.0-or-later
// The data of a page: the question, an answer with its proof, and what else was asked.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "codegen/answer/page/local_paths.hpp"
#include "codegen/model/model_options.hpp"

namespace regulus::detail {
struct Request;

struct PageData {
  std::string command;             ///< the command line that makes the page
  std::vector<std::string> again;  ///< command lines that prove the verdict again
  std::string kind;      ///< of the first answer: "check", "closure", "paving", "bound", …
  std::string headline;  ///< "NO SINGULARITY"
  std::string text;      ///< the report for people
  nlohmann::ordered_json report;   ///< as --json prints it
  std::string question;            ///< of the certificate, from `model` on
  std::string certificate;         ///< the whole text; empty: there is none
  std::string certificate_note;    ///< why there is none
  std::string model_text;          ///< the model file
  nlohmann::ordered_json drawing;  ///< as json_drawing(), or at solutions
  nlohmann::ordered_json paving;   ///< header, summary, tree of a paving; null: none
  nlohmann::ordered_json way;      ///< of a motion along way-points (way_json.hpp); null: none
  nlohmann::ordered_json bounds = nlohmann::ordered_json::array();   ///< as `bound --json`
  nlohmann::ordered_json margins = nlohmann::ordered_json::array();  ///< as `margin --json`
  nlohmann::ordered_json units =
      nlohmann::ordered_json::object();  ///< of the motion and pose parameters, by name
};

/// Sets the parts that follow from the question alone. `uncertain`: the constants of the robot that
/// vary.
void set_question(PageData& data, const Request& request, const std::set<std::string>& uncertain,
                  const ModelOptions& model);

/// Adds the question about the segment that decides the report, which the certificate is about.
///
/// Requires  data.report is a report along way-points with a segment.
void set_deciding_segment(PageData& data, const Request& request,
                          const std::set<std::string>& uncertain);

/// Returns one JSON object in ASCII. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string json_text(const PageData& data);

/// Replaces the paths of files by their names, except in what a proof is compared with.
void remove_folders(PageData& data, const LocalPaths& paths);

/// Returns the commands `check` and `verify` for the question of these options.
[[nodiscard]] std::vector<std::string> commands_to_prove_again(const ModelOptions& model);
/// Returns the command `verify` for the proof of an answer to a question of these options.
[[nodiscard]] std::string command_to_verify(const ModelOptions& model);

}  // namespace regulus::detail
