// SPDX-License-Identifier: GPL-3.0-or-later
// Runs one cell of the paper's tables, from the model file to the verdict.
#pragma once

#include <string>

#include "paper/tables/paper_tables.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "regulus/search/solver.hpp"

namespace regulus::test {

/// At most `seconds` of search, 0: no limit.
inline Result run(const PaperTable& table, const PaperCell& cell, double seconds) {
  codegen::ModelOptions model;
  model.path = std::string(REGULUS_SOURCE_DIR "/models/") + table.model + ".toml";
  model.motion = cell.motion;
  if (*cell.tolerance != '\0')
    model.tolerances.push_back(std::string("base,platform=") + cell.tolerance);
  codegen::SearchOptions search;
  search.method = cell.method;
  search.uncertainty = cell.uncertainty;
  search.time_limit = seconds;
  const codegen::Preparation preparation = codegen::prepare(model, search);
  return solve(preparation.problem(), codegen::settings_from(search));
}

}  // namespace regulus::test
