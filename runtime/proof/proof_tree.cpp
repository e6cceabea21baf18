// SPDX-License-Identifier: Apache-2.0
#include "runtime/proof/proof_tree.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace regulus::detail {
namespace {

constexpr std::size_t kMostBoxes = 0xffffffffU;

}  // namespace

bool ProofTree::add(const std::string& line, std::uint64_t offset) {
  if (line.starts_with("s "))
    split(line.c_str() + 2);
  else if (line.starts_with("l "))
    leave(line.c_str() + 2, offset);
  else if (line.starts_with("end "))
    return false;
  else
    throw std::runtime_error("be cut: it is damaged");
  return true;
}

void ProofTree::split(const char* words) {
  char* rest = nullptr;
  const std::uint64_t box = std::strtoull(words, &rest, 10);
  const auto variable = static_cast<std::uint16_t>(std::strtoul(rest, &rest, 10));
  const double at = std::strtod(rest, &rest);
  if (nodes_.size() + 2 > kMostBoxes)
    throw std::runtime_error("be cut: it has more than " + std::to_string(kMostBoxes) + " boxes");
  nodes_.at(box) = {{at}, static_cast<std::uint32_t>(nodes_.size()), variable, 0};
  nodes_.resize(nodes_.size() + 2);
}

void ProofTree::leave(const char* words, std::uint64_t offset) {
  char* rest = nullptr;
  const std::uint64_t box = std::strtoull(words, &rest, 10);
  const std::string rule(*rest == ' ' ? rest + 1 : rest);
  Node& leaf = nodes_.at(box) = {};
  leaf.offset = offset;
  if (rule.find(' ') != std::string::npos) {
    leaf.rule = kTube;
    return;
  }
  const auto known = std::find(rules_.begin(), rules_.end(), rule);
  leaf.rule = static_cast<std::uint16_t>(known - rules_.begin());
  if (known == rules_.end()) rules_.push_back(rule);
}

}  // namespace regulus::detail
