// SPDX-License-Identifier: GPL-3.0-or-later
// GiNaC expressions as text in the language of certificates, the same bytes in every process.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "codegen/answer/certificate/canonical_term.hpp"
#include "codegen/support/infix_text.hpp"

namespace regulus::detail {

/// Writes expressions; a part that occurs several times in them becomes a `let` of its own.
class CertificateExpressionWriter {
 public:
  /// `taken`: names that a `let` must not use.
  explicit CertificateExpressionWriter(std::set<std::string> taken) : taken_(std::move(taken)) {}

  /// Announces an expression that will be written, and counts its repeated parts.
  void announce(const GiNaC::ex& e);

  /// Returns the text of an expression. Appends to `lets` the `let` lines that it needs and that
  /// have not been written yet.
  [[nodiscard]] std::string write(const GiNaC::ex& e, std::string& lets);

 private:
  void count(const CanonicalNode& node);
  [[nodiscard]] InfixText text_of(const CanonicalTerm& term, std::string& lets);
  /// Of a node, or of the name that it has been given.
  [[nodiscard]] InfixText node_text(const CanonicalNode& node, std::string& lets);
  [[nodiscard]] InfixText bare_text(const CanonicalNode& node, std::string& lets);
  [[nodiscard]] InfixText sum(const CanonicalNode& node, std::string& lets);
  [[nodiscard]] InfixText power(const CanonicalNode& node, std::string& lets);
  [[nodiscard]] InfixText call(const CanonicalNode& node, std::string& lets);
  [[nodiscard]] InfixText quotient(const GiNaC::numeric& factor,
                                   const std::vector<CanonicalTerm>& factors, std::string& lets);
  [[nodiscard]] std::string unused_name();

  CanonicalReader reader_;
  std::set<std::string> taken_;
  std::map<const CanonicalNode*, int> count_;
  std::map<const CanonicalNode*, std::string> named_;
};

/// Returns the text of an expression, without `let` lines.
[[nodiscard]] std::string expression_text(const GiNaC::ex& e);

}  // namespace regulus::detail
