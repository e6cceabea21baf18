// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/certificate_expression_writer.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>

#include <sstream>

namespace regulus::detail {
namespace {

using Form = CanonicalNode::Form;
using GiNaC::ex;
using GiNaC::numeric;

using enum Precedence;

std::string integer_text(const numeric& n) {
  std::ostringstream text;
  cln::print_integer(text, 10U, cln::the<cln::cl_I>(n.to_cl_N()));
  return text.str();
}

std::string rational_text(const numeric& n) {
  return integer_text(n.numer()) + (n.is_integer() ? "" : '/' + integer_text(n.denom()));
}

}  // namespace

void CertificateExpressionWriter::announce(const ex& e) { count(*reader_.read(e).node); }

void CertificateExpressionWriter::count(const CanonicalNode& node) {
  if (!node.is_compound() || count_[&node]++ > 0) return;
  for (const CanonicalTerm& operand : node.operands) count(*operand.node);
}

std::string CertificateExpressionWriter::write(const ex& e, std::string& lets) {
  return text_of(reader_.read(e), lets).text;
}

InfixText CertificateExpressionWriter::text_of(const CanonicalTerm& term, std::string& lets) {
  if (term.factor == 1) return node_text(*term.node, lets);
  const bool negative = term.factor.is_negative();
  const numeric magnitude = GiNaC::abs(term.factor);
  // The factors of a product that has a name stay together.
  const bool open = term.node->form == Form::kProduct && count_[term.node] < 2;
  const InfixText text = quotient(
      magnitude, open ? term.node->operands : std::vector<CanonicalTerm>{{1, term.node}}, lets);
  return negative ? InfixText{'-' + text.text, kSum} : text;
}

InfixText CertificateExpressionWriter::node_text(const CanonicalNode& node, std::string& lets) {
  if (const auto known = named_.find(&node); known != named_.end())
    return {known->second, kPrimary};
  const InfixText text = bare_text(node, lets);
  if (!node.is_compound() || count_[&node] < 2) return text;
  const std::string name = unused_name();
  lets += "let " + name + " = " + text.text + '\n';
  named_.emplace(&node, name);
  return {name, kPrimary};
}

InfixText CertificateExpressionWriter::bare_text(const CanonicalNode& node, std::string& lets) {
  switch (node.form) {
    case Form::kOne:
      return {"1", kPrimary};
    case Form::kName:
      return {node.name, kPrimary};
    case Form::kSum:
      return sum(node, lets);
    case Form::kProduct:
      return quotient(1, node.operands, lets);
    case Form::kPower:
      return power(node, lets);
    case Form::kCall:
      break;
  }
  return call(node, lets);
}

/// What is added comes before what is subtracted.
InfixText CertificateExpressionWriter::sum(const CanonicalNode& node, std::string& lets) {
  std::string plus, minus;
  for (const CanonicalTerm& term : node.operands) {
    const InfixText text = text_of({GiNaC::abs(term.factor), term.node}, lets);
    const std::string summand = text.at_least(kProduct);
    if (term.factor.is_negative())
      minus += " - " + summand;
    else
      plus += (plus.empty() ? "" : " + ") + summand;
  }
  if (plus.empty()) return {'-' + minus.substr(3), kSum};
  return {plus + minus, kSum};
}

/// Negative powers go below the line, one after the other.
InfixText CertificateExpressionWriter::quotient(const numeric& factor,
                                                const std::vector<CanonicalTerm>& factors,
                                                std::string& lets) {
  std::string above = factor == 1 ? "" : rational_text(factor);
  std::string below;
  for (const CanonicalTerm& operand : factors) {
    if (operand.node->form == Form::kOne) continue;
    const InfixText text = text_of(operand, lets);
    if (text.precedence == kProduct && text.text.starts_with("1/"))
      below += text.text.substr(1);
    else
      above += (above.empty() ? "" : "*") + (text.at_least(kProduct));
  }
  if (above.empty()) above += '1';
  const bool one_number = factors.size() == 1 && factors[0].node->form == Form::kOne;
  return {above + below, one_number && factor.is_integer() ? kPrimary : kProduct};
}

/// x^(n/2) is sqrt(x)^n.
InfixText CertificateExpressionWriter::power(const CanonicalNode& node, std::string& lets) {
  const bool whole = node.exponent.is_integer();
  const numeric times = GiNaC::abs(whole ? node.exponent : node.exponent * 2);
  const InfixText base = text_of(node.operands.front(), lets);
  std::string text = !whole                        ? "sqrt" + in_parentheses(base.text)
                     : base.precedence == kPrimary ? base.text
                                                   : in_parentheses(base.text);
  if (times != 1) text += '^' + integer_text(times);
  if (node.exponent.is_negative()) return {"1/" + text, kProduct};
  return {text, times != 1 ? kPower : kPrimary};
}

InfixText CertificateExpressionWriter::call(const CanonicalNode& node, std::string& lets) {
  std::string arguments;
  for (const CanonicalTerm& argument : node.operands)
    arguments += (arguments.empty() ? "" : ", ") + text_of(argument, lets).text;
  return {node.name + in_parentheses(arguments), kPrimary};
}

std::string CertificateExpressionWriter::unused_name() {
  for (std::size_t i = named_.size() + 1;; ++i) {
    std::string name("e");
    name += std::to_string(i);
    if (taken_.insert(name).second) return name;
  }
}

std::string expression_text(const ex& e) {
  std::string lets;
  return CertificateExpressionWriter({}).write(e, lets);
}

}  // namespace regulus::detail
