// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/margin/end_proofs.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace regulus::inline bracketing {
namespace {

std::string line_of(const EndProof& end, const char* name) {
  if (!end.file.empty()) return fmt::format("{}: {}\n", end.file, end.words);
  return fmt::format("none for the {} end: {}\n", name, end.words);
}

}  // namespace

std::string EndProofs::lines() const {
  if (!wanted) return "";
  const bool has_none = safe.file.empty() && singular.file.empty();
  if (has_none && safe.words == singular.words) return "certificate none: " + safe.words + '\n';
  return "certificate " + line_of(safe, safe_name) + "           " +
         line_of(singular, singular_name);
}

void EndProofs::add_to(nlohmann::ordered_json& report) const {
  if (!wanted) return;
  for (const auto& [name, end] : {std::pair("safe", &safe), std::pair("singular", &singular)}) {
    nlohmann::ordered_json& file = report["certificates"][name];
    if (end->file.empty())
      report["certificate_obstacles"][name] = end->words;
    else
      file = end->file;
  }
}

}  // namespace regulus::bracketing
