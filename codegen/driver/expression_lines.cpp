// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/expression_lines.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>

#include <algorithm>
#include <sstream>

#include "regulus/codegen/model/errors.hpp"

namespace regulus::codegen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr int kSum = 0, kProduct = 1, kPower = 2, kAtom = 3;

bool is_compound(const ex& e) { return e.nops() > 0; }

std::string integer_text(const numeric& n) {
  std::ostringstream text;
  cln::print_integer(text, 10U, cln::the<cln::cl_I>(n.to_cl_N()));
  return text.str();
}

[[noreturn]] void refuse(const ex& e) {
  std::ostringstream found;
  found << e;
  throw InputError("", 0, "'" + found.str() + "'", "an expression that a certificate can hold");
}

/// Terms and factors come in an order that changes with addresses; by their texts they do not.
void sort_texts(std::vector<std::string>& texts) { std::sort(texts.begin(), texts.end()); }

}  // namespace

void ExpressionLines::announce(const ex& e) {
  if (!is_compound(e)) return;
  if (count_[e]++ > 0) return;
  for (std::size_t i = 0; i < e.nops(); ++i) announce(e.op(i));
}

std::string ExpressionLines::write(const ex& e, std::string& lets) { return text_of(e, lets).text; }

ExpressionLines::Text ExpressionLines::text_of(const ex& e, std::string& lets) {
  if (const auto known = named_.find(e); known != named_.end()) return {known->second, kAtom};
  const Text text = bare_text(e, lets);
  const auto count = count_.find(e);
  // -x and 2*x are as short as a name.
  const bool trivial = GiNaC::is_a<GiNaC::mul>(e) && e.nops() == 2 &&
                       GiNaC::is_a<numeric>(e.op(1)) && !is_compound(e.op(0));
  if (count == count_.end() || count->second < 2 || trivial) return text;
  const std::string name = unused_name();
  lets += "let " + name + " = " + text.text + '\n';
  named_.emplace(e, name);
  return {name, kAtom};
}

ExpressionLines::Text ExpressionLines::bare_text(const ex& e, std::string& lets) {
  if (GiNaC::is_a<numeric>(e)) {
    const auto& n = GiNaC::ex_to<numeric>(e);
    if (!n.is_rational()) refuse(e);
    if (n.is_integer()) return {integer_text(n), n.is_negative() ? kSum : kAtom};
    return {integer_text(n.numer()) + '/' + integer_text(n.denom()),
            n.is_negative() ? kSum : kProduct};
  }
  if (GiNaC::is_a<GiNaC::symbol>(e)) return {GiNaC::ex_to<GiNaC::symbol>(e).get_name(), kAtom};
  if (e.is_equal(GiNaC::Pi)) return {"pi", kAtom};
  if (GiNaC::is_a<GiNaC::add>(e)) return sum(e, lets);
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(e, lets);
  if (GiNaC::is_a<GiNaC::power>(e)) return power(e, lets);
  if (GiNaC::is_a<GiNaC::function>(e)) return call(e, lets);
  refuse(e);
}

ExpressionLines::Text ExpressionLines::sum(const ex& e, std::string& lets) {
  std::vector<std::string> plus, minus;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const Text term = text_of(e.op(i), lets);
    if (term.text.front() == '-')
      minus.push_back(term.text.substr(1));
    else
      plus.push_back(term.text);
  }
  sort_texts(plus);
  sort_texts(minus);
  std::string text;
  for (const std::string& term : plus) text += (text.empty() ? "" : " + ") + term;
  for (const std::string& term : minus) text += (text.empty() ? "-" : " - ") + term;
  return {text, kSum};
}

/// A negative factor goes to the front: -2/3*x. Negative powers go below the line.
ExpressionLines::Text ExpressionLines::product(const ex& e, std::string& lets) {
  std::vector<std::string> above, below;
  std::string number;
  bool negative = false;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const ex& factor = e.op(i);
    if (GiNaC::is_a<numeric>(factor)) {
      const auto& n = GiNaC::ex_to<numeric>(factor);
      negative = n.is_negative();
      const Text magnitude = bare_text(GiNaC::abs(n), lets);
      if (magnitude.text != "1") number = magnitude.text;
      continue;
    }
    const Text text = text_of(factor, lets);
    if (text.text.starts_with("1/"))
      below.push_back(text.text.substr(2));
    else
      above.push_back(text.strength > kSum ? text.text : '(' + text.text + ')');
  }
  sort_texts(above);
  sort_texts(below);
  std::string text = number;
  for (const std::string& factor : above) text += (text.empty() ? "" : "*") + factor;
  if (text.empty()) text = "1";
  for (const std::string& factor : below) text += '/' + factor;
  return {negative ? '-' + text : text, negative ? kSum : kProduct};
}

/// x^(n/2) is sqrt(x)^n.
ExpressionLines::Text ExpressionLines::power(const ex& e, std::string& lets) {
  if (!GiNaC::is_a<numeric>(e.op(1))) refuse(e);
  const numeric exponent = GiNaC::ex_to<numeric>(e.op(1));
  const bool whole = exponent.is_integer();
  const numeric times = whole ? GiNaC::abs(exponent) : GiNaC::abs(exponent * 2);
  if (!times.is_integer()) refuse(e);
  const Text base = text_of(e.op(0), lets);
  std::string text = whole ? (base.strength == kAtom ? base.text : '(' + base.text + ')')
                           : "sqrt(" + base.text + ')';
  if (times != 1) text += '^' + integer_text(times);
  if (exponent.is_negative()) return {"1/" + text, kProduct};
  return {text, times != 1 ? kPower : kAtom};
}

ExpressionLines::Text ExpressionLines::call(const ex& e, std::string& lets) {
  std::string text = GiNaC::ex_to<GiNaC::function>(e).get_name() + '(';
  for (std::size_t i = 0; i < e.nops(); ++i)
    text += (i == 0 ? "" : ", ") + text_of(e.op(i), lets).text;
  return {text + ')', kAtom};
}

std::string ExpressionLines::unused_name() {
  for (std::size_t i = named_.size() + 1;; ++i) {
    std::string name("e");
    name += std::to_string(i);
    if (taken_.insert(name).second) return name;
  }
}

std::string expression_text(const ex& e) {
  std::string lets;
  return ExpressionLines({}).write(e, lets);
}

}  // namespace regulus::codegen
