// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/file_expressions.hpp"

#include "runtime/verifier/model/model_expression.hpp"

namespace regulus::verifier {
namespace {

constexpr int kMostLets = 100;

}  // namespace

NodeId FileExpressions::at(const std::string& place, const Scope& scope, bool is_in_degrees) {
  const WrittenValue& written = values_.at(place);
  if (!written.is_string) return number_of_toml(written.text, q_.graph);
  const NameMeaning of_name = [&](std::string_view name) { return meaning(name, scope); };
  return parse_model_expression(written.text, of_name, q_.graph, depth_, degrees_, is_in_degrees);
}

/// A name of [let] comes first: the certificate cannot give it another meaning.
NodeId FileExpressions::meaning(std::string_view name, const Scope& scope) {
  if (values_.contains("let." + std::string(name))) return let(name, scope);
  if (const auto known = scope.find(name); known != scope.end() && !hidden_.contains(name))
    return known->second;
  if (const NodeId other = others_(name, scope); other != kNoNode) return other;
  throw Unfinished("the name " + std::string(name) + " is not known");
}

NodeId FileExpressions::let(std::string_view name, const Scope& scope) {
  auto& known = lets_[&scope];
  if (const auto found = known.find(name); found != known.end()) return found->second;
  if (open_lets_ == kMostLets) throw Unfinished("[let] is nested too deeply");
  ++open_lets_;
  const NodeId result = at("let." + std::string(name), scope);
  --open_lets_;
  known.emplace(name, result);
  return result;
}

}  // namespace regulus::verifier
