// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/bound/bound_checkpoint.hpp"

#include <nlohmann/json.hpp>

#include "codegen/bound/quantity_report.hpp"
#include "codegen/trajectory/margin_checkpoint.hpp"

namespace regulus::inline bounding {

nlohmann::ordered_json checkpointed_question(const Request& request, const Quantity& quantity,
                                             const SearchOptions& search) {
  nlohmann::ordered_json question = checkpointed_question(request, search);
  question["quantity"] = json_quantity(request.model, quantity);
  return question;
}

}  // namespace regulus::bounding
