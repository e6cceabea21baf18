// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds over branches along way-points, for tests.
#pragma once

#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "tests/property/closure/checked_ways.hpp"
#include "tests/property/closure/four_bars.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {

inline constexpr const char* kDataOfMotors =
    "[actuators]\nerror = 0.01\nspeed = 2\nstiffness = 50\n[load.L]\nwrench = [[-1, 3], 2]\n";

struct AskedOnWay {
  QuantityOptions words;
  double gap = 0.02;
  std::string limit, certificate;
  std::size_t component = 0;
};

inline ComponentBound bound_on_way(const std::string& model, const std::string& file,
                                   const AskedOnWay& asked) {
  ModelOptions options;
  options.motion = "m";
  options.waypoints = file;
  const Request request = read_request(model, options);
  BoundSettings settings;
  settings.gap = asked.gap;
  settings.search = usual_options();
  settings.over_branch = bounds_over_branch();
  settings.certificate = asked.certificate;
  Quantity quantity = quantity_of(request.model, asked.words);
  quantity.components = {quantity.components.at(asked.component)};
  if (!asked.limit.empty()) settings.limit = read_limit(asked.limit, quantity);
  return bound_quantity(request, std::move(quantity), settings, [](const ComponentBound&) {})
      .components.front();
}

inline QuantityOptions words_of(const std::string& quantity, const std::string& norm = "") {
  QuantityOptions words;
  words.quantity = quantity;
  words.norm = norm;
  return words;
}

inline std::string theta_table(const std::vector<double>& places) {
  std::string text = "theta\n";
  for (const double place : places) text += fmt::format("{:.17g}\n", place);
  return text;
}

}  // namespace regulus::detail::test
