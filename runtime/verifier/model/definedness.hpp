// SPDX-License-Identifier: Apache-2.0
// Where the expressions of a model file have values, and whether the certificate says so: it may have
// been written after x/x had become 1.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/model/certain_form.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// A condition for an operation to have a value.
struct Need {
  enum class Kind { kNonzero, kNonnegative, kPositive, kWithinOne, kNoPole, kOffCut } kind;
  NodeId operand = kNoNode, second = kNoNode;  ///< the second one of kOffCut
};

/// Collects the conditions of the file and of the certificate. Two conditions are the same if their
/// operands are proportional, by exact algebra; a product is not 0 if no factor is.
class Definedness {
 public:
  explicit Definedness(Question& question) : q_(question), form_(question.graph) {}

  /// The certificate claims that this expression has a value at every point.
  void claim(NodeId root) { claims_.push_back(needs_of(root)); }
  /// The claim is about points where this is not negative.
  void claim_nonnegative(NodeId operand) {
    claims_.push_back({{Need::Kind::kNonnegative, operand}});
  }
  /// A line of the certificate that the file must give rise to.
  void expect_in_file(const std::string& line, NodeId root) {
    lines_.push_back({line, needs_of(root)});
  }
  /// The file means nothing where this expression has no value. `from`: its place.
  void require(const std::string& from, NodeId root) {
    wanted_.push_back({from, needs_of(root)});
    roots_.push_back(root);
  }
  void require_positive(const std::string& from, NodeId operand) {
    wanted_.push_back({from, {{Need::Kind::kPositive, operand}}});
  }

  /// Returns, as sentences, what the file needs and the certificate does not state, and the lines of
  /// the certificate that the file does not need.
  [[nodiscard]] std::vector<std::string> missing();

 private:
  using Keys = std::set<std::string>;
  struct Named {
    std::string name;
    std::vector<Need> needs;
  };

  [[nodiscard]] std::vector<Need> needs_of(NodeId root);
  [[nodiscard]] std::vector<Need> all_needs_of(NodeId root);
  /// Adds what the file's expressions need and what they have for certain: the certificate may state
  /// the latter in a form that hides it.
  void add_certain_keys(Keys& keys);
  [[nodiscard]] bool is_certain(const Need& need);
  [[nodiscard]] bool has_value(NodeId constant) const;
  void find_keys_of(const std::vector<Need>& needs, Keys& keys);
  [[nodiscard]] Keys keys_of(const Need& need);
  [[nodiscard]] std::string key(const char* kind, NodeId operand, bool any_sign);
  [[nodiscard]] std::string even_key(const char* kind, NodeId operand);
  void add_factors(NodeId operand, Keys& keys);
  void add_factors(const Polynomial& p, Keys& keys);
  [[nodiscard]] const Polynomial* polynomial(NodeId node);
  void begin_algebra();
  void restart_algebra();

  Question& q_;
  CertainForm form_;
  std::vector<std::vector<Need>> claims_;
  std::vector<Named> lines_, wanted_;
  std::vector<NodeId> roots_;  ///< of the file's expressions
  std::set<NodeId> too_large_;
  std::vector<NodeId> no_values_;
  std::unique_ptr<AlgebraBudget> budget_;
  std::unique_ptr<Algebra> algebra_;
};

}  // namespace regulus::verifier
