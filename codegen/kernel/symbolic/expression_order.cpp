// SPDX-License-Identifier: GPL-3.0-or-later
// The order that makes every result independent of addresses and of creation order.
#include <cctype>
#include <compare>

#include "codegen/kernel/symbolic/expression.hpp"

namespace regulus::detail {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::size_t end_of_digits(const std::string& s, std::size_t i) {
  while (i < s.size() && is_digit(s[i])) ++i;
  return i;
}

std::size_t skip_zeros(const std::string& s, std::size_t i, std::size_t end) {
  while (i < end && s[i] == '0') ++i;
  return i;
}

/// Digit runs by value: fewer significant digits first, then digit by digit.
int compare_digits(const std::string& a, std::size_t& i, const std::string& b, std::size_t& j) {
  const std::size_t end_a = end_of_digits(a, i), end_b = end_of_digits(b, j);
  const std::size_t first_a = skip_zeros(a, i, end_a), first_b = skip_zeros(b, j, end_b);
  i = end_a;
  j = end_b;
  if (end_a - first_a != end_b - first_b) return end_a - first_a < end_b - first_b ? -1 : 1;
  return a.compare(first_a, end_a - first_a, b, first_b, end_b - first_b);
}

int compare_names(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      if (const int order = compare_digits(a, i, b, j); order != 0) return order < 0 ? -1 : 1;
    } else {
      if (a[i] != b[j]) return a[i] < b[j] ? -1 : 1;
      ++i;
      ++j;
    }
  }
  const int by_length = static_cast<int>(i < a.size()) - static_cast<int>(j < b.size());
  if (by_length != 0) return by_length;
  const int exactly = a.compare(b);  // k_01 and k_1 have equal values but are two names
  return exactly < 0 ? -1 : (exactly > 0 ? 1 : 0);
}

template <class T>
int compare_values(T a, T b) {
  return a < b ? -1 : (b < a ? 1 : 0);
}

int compare_operands(const Expressions& a, const Expressions& b) {
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    if (const int order = compare(a[i], b[i]); order != 0) return order;
  return compare_values(a.size(), b.size());
}

/// Compares the factors first and the rational factor last, so that terms that differ only in sign
/// are neighbours and keep their places if all signs change.
int compare_products(const Expressions& a, const Expressions& b) {
  const std::size_t skip_a = a[0].kind() == ExpressionKind::kConstant,
                    skip_b = b[0].kind() == ExpressionKind::kConstant;
  for (std::size_t i = 0; i + skip_a < a.size() && i + skip_b < b.size(); ++i)
    if (const int order = compare(a[i + skip_a], b[i + skip_b]); order != 0) return order;
  if (const int order = compare_values(a.size() - skip_a, b.size() - skip_b); order != 0)
    return order;
  return compare(skip_a != 0 ? a[0] : Expression(1), skip_b != 0 ? b[0] : Expression(1));
}

}  // namespace

int compare(const Expression& a, const Expression& b) {
  if (a.identity() == b.identity()) return 0;
  if (a.kind() != b.kind()) return compare_values(a.kind(), b.kind());
  switch (a.kind()) {
    case ExpressionKind::kConstant: {
      const int order = cln::compare(a.value(), b.value());
      return compare_values(order, 0);
    }
    case ExpressionKind::kNumberPi:
      return 0;
    case ExpressionKind::kPoint:
    case ExpressionKind::kVariable:
      return compare_names(a.name(), b.name());
    case ExpressionKind::kPower:
      if (const int order = compare(a.operands()[0], b.operands()[0]); order != 0) return order;
      return compare_values(a.exponent(), b.exponent());
    case ExpressionKind::kCall:
      if (a.function() != b.function()) return compare_values(a.function(), b.function());
      break;
    case ExpressionKind::kProduct:
      return compare_products(a.operands(), b.operands());
    default:
      break;
  }
  return compare_operands(a.operands(), b.operands());
}

bool operator==(const Expression& a, const Expression& b) {
  return a.identity() == b.identity() || (a.hash() == b.hash() && compare(a, b) == 0);
}

}  // namespace regulus::detail
