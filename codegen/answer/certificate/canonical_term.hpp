// SPDX-License-Identifier: GPL-3.0-or-later
// GiNaC expressions in a form that is the same in every process. GiNaC itself uses addresses and
// hashes to order terms and factors, and to choose the sign of a factor such as x - y.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <vector>

namespace regulus::detail {

struct CanonicalNode;

/// The value is factor · node.
struct CanonicalTerm {
  GiNaC::numeric factor;
  const CanonicalNode* node = nullptr;
};

/// Has no rational factor of its own, so that x, -x and 2*x share one node.
struct CanonicalNode {
  enum class Form {
    kOne,
    kName,     ///< a symbol, or pi
    kSum,      ///< of its operands
    kProduct,  ///< of its operands, whose factors are 1
    kPower,    ///< of its operand; a whole or half exponent, not 0 or 1
    kCall,
  };
  Form form = Form::kOne;
  std::string name;  ///< of a kName, of the function of a kCall
  GiNaC::numeric exponent;
  std::vector<CanonicalTerm> operands;
  std::string key;  ///< identifies the node; sums and products have their operands in its order

  [[nodiscard]] bool is_compound() const noexcept { return !operands.empty(); }
};

/// Reads expressions by their exact arithmetic alone, independently of the pipeline that the solver
/// uses: a certificate is then about what the model says, even if that pipeline misreads it.
class CanonicalReader {
 public:
  /// Returns a term whose node lives as long as the reader. Equal expressions have one node. Throws
  /// InputError if this is not an exact expression of real functions.
  [[nodiscard]] CanonicalTerm read(const GiNaC::ex& e);

 private:
  [[nodiscard]] CanonicalTerm converted(const GiNaC::ex& e);
  [[nodiscard]] CanonicalTerm read_sum(const GiNaC::ex& e);
  [[nodiscard]] CanonicalTerm read_product(const GiNaC::ex& e);
  [[nodiscard]] CanonicalTerm read_power(const GiNaC::ex& e);
  [[nodiscard]] CanonicalTerm fractional_power(CanonicalTerm base, GiNaC::numeric exponent);
  [[nodiscard]] CanonicalTerm read_call(const GiNaC::ex& e);
  [[nodiscard]] CanonicalTerm without_content(const CanonicalTerm& sum);
  [[nodiscard]] const CanonicalNode* shared(CanonicalNode node);

  std::map<std::string, CanonicalNode> nodes_;
  std::map<GiNaC::ex, CanonicalTerm, GiNaC::ex_is_less> known_;
};

}  // namespace regulus::detail
