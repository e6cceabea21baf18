// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/ask.hpp"

namespace regulus::inline answer {

std::unique_ptr<Answer> ask(const Asked& asked, const Services& services) {
  return std::visit(
      [&services](const auto& one) -> std::unique_ptr<Answer> { return ask(one, services); },
      asked);
}

}  // namespace regulus::answer
