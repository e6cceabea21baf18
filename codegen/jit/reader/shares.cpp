// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/shares.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace regulus::codegen::reader {
namespace {

// Statements below which a second thread costs more than it saves: its start, and the operations of
// the packs read once more.
constexpr std::size_t kShort = 200;

/// A function and all that it calls.
struct Family {
  std::size_t length = 0;
  std::vector<std::string_view> members;
};

/// Functions call only what stands before them, and nothing is called from two places that matter:
/// families that share a function become one.
std::vector<Family> families_of(const KernelText& kernel) {
  std::map<std::string_view, std::size_t> family_of;
  std::vector<Family> families;
  for (const FunctionText& function : kernel.functions) {
    Family family{function.body.size(), {function.name}};
    for (const Statement& statement : function.body) {
      const auto called = statement.kind == Statement::Kind::kCall
                              ? family_of.find(statement.expression.name)
                              : family_of.end();
      if (called == family_of.end()) continue;
      Family& other = families[called->second];
      family.length += std::exchange(other.length, 0);
      family.members.insert(family.members.end(), other.members.begin(), other.members.end());
      other.members.clear();
    }
    for (const std::string_view member : family.members) family_of[member] = families.size();
    families.push_back(std::move(family));
  }
  std::erase_if(families, [](const Family& family) { return family.members.empty(); });
  return families;
}

/// Two shares of about equal length, the second no shorter, or one.
std::vector<Share> halves_of(std::vector<Family> families) {
  std::stable_sort(families.begin(), families.end(),
                   [](const Family& a, const Family& b) { return a.length > b.length; });
  std::vector<Share> shares(2);
  std::size_t lengths[2] = {0, 0};
  for (const Family& family : families) {
    const std::size_t lighter = lengths[1] <= lengths[0] ? 1 : 0;
    lengths[lighter] += family.length;
    shares[lighter].functions.insert(family.members.begin(), family.members.end());
  }
  if (std::min(lengths[0], lengths[1]) < kShort) {
    shares[1].functions.merge(shares[0].functions);
    shares.erase(shares.begin());
  }
  return shares;
}

bool calls_others(const FunctionText& function) {
  return std::ranges::any_of(function.body,
                             [](const Statement& s) { return s.kind == Statement::Kind::kCall; });
}

}  // namespace

std::vector<Share> share_out(const KernelText& kernel) {
  std::vector<Share> shares = halves_of(families_of(kernel));
  shares.back().tables = true;
  return shares;
}

std::vector<Share> share_out_unknown(const KernelText& kernel, const Symbols& symbols,
                                     const std::set<std::string_view>& known) {
  Share last{{}, true};
  std::set<std::string_view> found = known;
  std::vector<Family> unknown;
  for (const FunctionText& function : kernel.functions)
    if (function.exported || calls_others(function))
      last.functions.insert(function.name);
    else if (found.insert(symbols.at(function.name)).second)
      unknown.push_back({function.body.size(), {function.name}});
  std::vector<Share> shares;
  if (!unknown.empty()) shares = halves_of(std::move(unknown));
  shares.push_back(std::move(last));
  return shares;
}

}  // namespace regulus::codegen::reader
