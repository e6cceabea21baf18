// SPDX-License-Identifier: GPL-3.0-or-later
// The forms of one entry of K·A or A·K that the symbolic stage compares, for people.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/formulation/formulation.hpp"

namespace regulus::detail {

struct FormCandidate {
  std::string passes;  ///< "natural", "collect", "horner", "angles + horner" …
  Occurrences occurrences;
  /// The width over the motion's box, with K of its middle; nullopt: it is not defined all over it.
  std::optional<double> width;
};

class FormCandidates {
 public:
  /// `formulation` must outlive this object.
  explicit FormCandidates(const Formulation& formulation, const RewriteOptions& rewriting);
  ~FormCandidates();

  /// Returns the forms that the symbolic stage compares for a function. Only the function as it is
  /// given, if it has roots or quotients.
  [[nodiscard]] std::vector<FormCandidate> of(const Expression& natural);

  /// Returns the width of a form's enclosure over the motion's box.
  [[nodiscard]] std::optional<double> width(const Expression& form) const;

 private:
  void add(std::vector<FormCandidate>& to, const Polynomial& p, const std::string& prefix);
  void find_preconditioner();

  const Formulation& formulation_;
  std::vector<std::string> names_, points_;
  std::vector<Interval> box_, K_;
  std::unique_ptr<Rewriter> rewriter_;
};

}  // namespace regulus::detail
