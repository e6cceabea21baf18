// SPDX-License-Identifier: GPL-3.0-or-later
// Reports and pictures need names, units and ranges of a search, and no kernel.
#pragma once

#include <string>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/question/engine/report_labels.hpp"

namespace regulus::detail {

struct SearchSubject {
  ReportLabels labels;
  std::string model_file;  ///< as it was opened
  Variety variety;
  bool is_replanned = false;  ///< the ranges or the threshold are not those of the request
};

}  // namespace regulus::detail
