// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates about a four-bar linkage, and judgements of their answers.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/closure_certificates.hpp"

namespace regulus::detail::test {

using verifier::Outcome;
using verifier::Verification;

inline std::string with_other(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::invalid_argument("there is no '" + old + "'");
  return text.replace(at, old.size(), by);
}

struct Made {
  explicit Made(const ClosureCase& c) : question(closure_question(c)), tree(c) {
    if (!tree.is_made()) throw std::runtime_error("there is no tree");
    text = question + tree.text();
  }
  /// Returns the certificate after a change of its tree.
  [[nodiscard]] std::string again() const { return question + tree.text(); }

  std::string question, text;
  ClosureTree tree;
};

inline ::testing::AssertionResult is(Outcome outcome, const Verification& v,
                                     const std::string& reason) {
  if (v.outcome == outcome && v.reason.find(reason) != std::string::npos)
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << verifier::name(v.outcome) << '\n' << describe(v);
}

inline const Made& bar() {
  static const ClosureCase c = four_bar(100);
  static const Made made(c);
  return made;
}

}  // namespace regulus::detail::test
