// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/canonical_term.hpp"

#include <cln/integer.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

using Form = CanonicalNode::Form;
using GiNaC::ex;
using GiNaC::numeric;

/// The key of a node repeats the text of shared parts. A long key is replaced by its digest.
constexpr std::size_t kLongestKey = 160;

/// The largest exponent of a certificate.
constexpr int kMostPower = format::kMostPower;

[[noreturn]] void refuse(const ex& e) {
  std::ostringstream found;
  found << e;
  throw InputError("", 0, "'" + found.str() + "'", "an expression that a certificate can hold");
}

std::string key_of(const numeric& n) {
  std::ostringstream text;
  text << n;
  return text.str();
}

std::string key_of(const CanonicalTerm& term) {
  return term.node->key + (term.factor == 1 ? "" : '*' + key_of(term.factor));
}

/// Returns a key. Names sort before operations on them, and a rational number sorts last.
std::string key_of(const CanonicalNode& node) {
  if (node.form == Form::kOne) return "~";
  if (node.form == Form::kName) return node.name;
  std::string key = std::string(1, "1nspwc"[std::size_t(node.form)]) + node.name;
  if (node.form == Form::kPower) key += key_of(node.exponent);
  for (const CanonicalTerm& operand : node.operands) key += ' ' + key_of(operand);
  return key.size() > kLongestKey ? '|' + sha256(key) : '{' + key + '}';
}

/// Compares by content, then by the factor. So terms keep their places when all signs change.
bool comes_before(const CanonicalTerm& a, const CanonicalTerm& b) {
  if (a.node != b.node) return a.node->key < b.node->key;
  return a.factor < b.factor;
}

bool is_whole(const numeric& exponent) { return exponent.is_integer(); }

/// The denominator is a power of two, and both parts are within the limits of a certificate.
bool is_root(const numeric& exponent) {
  return cln::logcount(cln::the<cln::cl_I>(exponent.denom().to_cl_N())) == 1 &&
         exponent.denom() <= kMostPower && GiNaC::abs(exponent.numer()) <= kMostPower;
}

}  // namespace

const CanonicalNode* CanonicalReader::shared(CanonicalNode node) {
  if (node.form == Form::kSum || node.form == Form::kProduct)
    std::sort(node.operands.begin(), node.operands.end(), comes_before);
  node.key = key_of(node);
  std::string key = node.key;
  return &nodes_.emplace(std::move(key), std::move(node)).first->second;
}

CanonicalTerm CanonicalReader::read(const ex& e) {
  if (const auto found = known_.find(e); found != known_.end()) return found->second;
  const CanonicalTerm term = converted(e);
  known_.emplace(e, term);
  return term;
}

CanonicalTerm CanonicalReader::converted(const ex& e) {
  if (GiNaC::is_a<numeric>(e)) {
    const auto& n = GiNaC::ex_to<numeric>(e);
    if (!n.is_rational()) refuse(e);
    return {n, shared({})};
  }
  if (GiNaC::is_a<GiNaC::symbol>(e))
    return {1, shared({Form::kName, GiNaC::ex_to<GiNaC::symbol>(e).get_name(), 0, {}, ""})};
  if (e.is_equal(GiNaC::Pi)) return {1, shared({Form::kName, "pi", 0, {}, ""})};
  if (GiNaC::is_a<GiNaC::add>(e)) return read_sum(e);
  if (GiNaC::is_a<GiNaC::mul>(e)) return read_product(e);
  if (GiNaC::is_a<GiNaC::power>(e)) return read_power(e);
  if (GiNaC::is_a<GiNaC::function>(e)) return read_call(e);
  refuse(e);
}

CanonicalTerm CanonicalReader::read_sum(const ex& e) {
  CanonicalNode node{Form::kSum, "", 0, {}, ""};
  for (std::size_t i = 0; i < e.nops(); ++i) node.operands.push_back(read(e.op(i)));
  return {1, shared(std::move(node))};
}

/// Returns a sum as c·s: the factors of s are whole, without common divisor, the first positive.
CanonicalTerm CanonicalReader::without_content(const CanonicalTerm& sum) {
  if (sum.node->form != Form::kSum) return sum;
  CanonicalNode node = *sum.node;
  numeric numerator = 0, denominator = 1;
  for (const CanonicalTerm& term : node.operands) {
    numerator = GiNaC::gcd(numerator, term.factor.numer());
    denominator = GiNaC::lcm(denominator, term.factor.denom());
  }
  numeric content = numerator / denominator;
  if (node.operands.front().factor.is_negative()) content = -content;
  for (CanonicalTerm& term : node.operands) term.factor /= content;
  return {sum.factor * content, shared(std::move(node))};
}

CanonicalTerm CanonicalReader::read_product(const ex& e) {
  numeric factor = 1;
  CanonicalNode node{Form::kProduct, "", 0, {}, ""};
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const CanonicalTerm term = without_content(read(e.op(i)));
    factor *= term.factor;
    if (term.node->form != Form::kOne) node.operands.push_back({1, term.node});
  }
  if (node.operands.size() == 1) return {factor, node.operands.front().node};
  return {factor, shared(std::move(node))};
}

/// Takes the factor of the base out of a whole power. A root keeps it below the root sign.
CanonicalTerm CanonicalReader::read_power(const ex& e) {
  if (!e.op(1).info(GiNaC::info_flags::rational)) refuse(e);
  const numeric exponent = GiNaC::ex_to<numeric>(e.op(1));
  if (GiNaC::abs(exponent) > kMostPower) refuse(e);
  if (!is_whole(exponent)) return fractional_power(read(e.op(0)), exponent);
  const CanonicalTerm base = without_content(read(e.op(0)));
  const numeric factor = base.factor.power(exponent);
  return {factor, shared({Form::kPower, "", exponent, {{1, base.node}}, ""})};
}

/// Nests square roots if the denominator is a power of two; others, such as 1/3, use exp and log.
CanonicalTerm CanonicalReader::fractional_power(CanonicalTerm base, numeric exponent) {
  if (!is_root(exponent)) {
    const CanonicalTerm log{1, shared({Form::kCall, "log", 0, {base}, ""})};
    return {1, shared({Form::kCall, "exp", 0, {{exponent, log.node}}, ""})};
  }
  for (; exponent.denom() > 2; exponent *= 2)
    base = {1, shared({Form::kPower, "", numeric(1, 2), {base}, ""})};
  return {1, shared({Form::kPower, "", exponent, {base}, ""})};
}

CanonicalTerm CanonicalReader::read_call(const ex& e) {
  CanonicalNode node{Form::kCall, GiNaC::ex_to<GiNaC::function>(e).get_name(), 0, {}, ""};
  for (std::size_t i = 0; i < e.nops(); ++i) node.operands.push_back(read(e.op(i)));
  return {1, shared(std::move(node))};
}

}  // namespace regulus::detail
