// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/read_trajectory.hpp"

namespace regulus::detail {

std::optional<Request> read_trajectory(const ModelOptions& options, const FormingWatch& watch) {
  const std::string text = model_text(options);
  // Most models have no way-points: then the model need not be read before the cache is asked.
  if (options.waypoints.empty() && text.find("waypoints") == std::string::npos) return std::nullopt;
  Request request = read_request(text, options, &watch);
  return request.motion.trajectory ? std::optional(std::move(request)) : std::nullopt;
}

}  // namespace regulus::detail
