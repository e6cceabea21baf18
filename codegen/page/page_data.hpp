// SPDX-License-Identifier: GPL-3.0-or-later
// The data of a page: the question, the report and the proof of a check, and what else was asked.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "codegen/engine/pipeline.hpp"

namespace regulus::inline page {

struct PageData {
  std::string command;             ///< the command line that makes the page
  std::vector<std::string> again;  ///< command lines that prove the verdict again
  nlohmann::ordered_json report;   ///< as `check --json` prints it
  std::string question;            ///< of the certificate, from `model` on
  std::string certificate;         ///< the whole text; empty: there is none
  std::string certificate_note;    ///< why there is none
  std::string model_text;          ///< the model file
  nlohmann::ordered_json drawing;  ///< as json_drawing()
  nlohmann::ordered_json paving;   ///< header, summary, tree of a paving; null: none
  nlohmann::ordered_json bounds = nlohmann::ordered_json::array();   ///< as `bound --json`
  nlohmann::ordered_json margins = nlohmann::ordered_json::array();  ///< as `margin --json`
  nlohmann::ordered_json units;  ///< of the motion and pose parameters, by name
};

/// Returns the parts that follow from the question alone.
[[nodiscard]] PageData begin_page(const PreparedSearch& preparation, const ModelOptions& model);

/// Returns one JSON object in ASCII. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string json_text(const PageData& data);

/// Returns the commands `check` and `verify` for the question of these options.
[[nodiscard]] std::vector<std::string> commands_to_prove_again(const ModelOptions& model);

}  // namespace regulus::page
