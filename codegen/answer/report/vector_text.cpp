// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/vector_text.hpp"

#include <fmt/format.h>

#include "codegen/answer/report/number_text.hpp"

namespace regulus::detail {

std::string vector_text(const std::vector<double>& values, const std::vector<std::string>& units) {
  const auto unit = [&](std::size_t i) { return i < units.size() ? units[i] : std::string("1"); };
  std::string text = "(";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0)
      text += unit(i) == unit(i - 1) ? ", " : fmt::format("){}, (", unit_suffix(unit(i - 1)));
    text += fmt::format("{:.5g}", values[i]);
  }
  return text + ")" + (values.empty() ? "" : unit_suffix(unit(values.size() - 1)));
}

}  // namespace regulus::detail
