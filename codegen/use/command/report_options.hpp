// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `regulus report`.
#pragma once

#include <string>
#include <vector>

#include "codegen/answer/report/output_options.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/engine/options.hpp"

namespace CLI {
class App;
}

namespace regulus::detail {

struct ReportCommand {
  ModelOptions model;
  SearchOptions search;
  OutputOptions output;
  std::string page;        ///< file
  bool paves = false;      ///< add the boxes of `locate`
  std::string resolution;  ///< of the paving, an expression; empty: by the number of ranges
  std::vector<std::string> bounds;   ///< quantities
  std::string load, twist;           ///< names, as in QuantityOptions
  std::vector<std::string> margins;  ///< "GROUP=LO:HI"
  std::string gap = "0.01";          ///< of bounds and margins
};

/// Adds the options about the page.
void add_report_options(CLI::App& app, ReportCommand& command);

}  // namespace regulus::detail
