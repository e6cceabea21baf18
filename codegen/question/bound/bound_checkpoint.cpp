// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bound_checkpoint.hpp"

#include <nlohmann/json.hpp>

#include "codegen/question/bound/quantity_report.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"

namespace regulus::detail {

nlohmann::ordered_json checkpointed_question(const Request& request, const Quantity& quantity,
                                             const SearchOptions& search) {
  nlohmann::ordered_json question = checkpointed_question(request, search);
  question["quantity"] = json_quantity(request.model, quantity);
  return question;
}

}  // namespace regulus::detail
