// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/symbolic/exact_rank.hpp"

#include <cstdlib>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "codegen/model/exact/exact_algebra.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using ExactNumbers = std::vector<ex>;  ///< a matrix, row-major

/// The most terms of a number, and of all products before like terms are combined: about a second.
constexpr std::size_t kMostTerms = 256, kMostTermsOfProducts = 50'000;
constexpr int kMostPower = 64;

struct TooLong : std::runtime_error {
  TooLong() : std::runtime_error("a number has too many terms, or a function that is not read") {}
};

std::size_t terms_of(const ex& e) { return GiNaC::is_a<GiNaC::add>(e) ? e.nops() : 1; }

/// Multiplies, as long as there are not too many terms in all.
class Products {
 public:
  ex operator()(const ex& x, const ex& y) {
    terms_ += terms_of(x) * terms_of(y);
    if (terms_ > kMostTermsOfProducts) throw TooLong();
    return x * y;
  }

 private:
  std::size_t terms_ = 0;
};

ex short_number(const ex& e) {
  const ex result = reduced(e);
  if (terms_of(result) > kMostTerms) throw TooLong();
  return result;
}

/// Evaluates expressions at one point.
class ExactValues {
 public:
  ExactValues(const std::map<std::string, ex>& values, Products& product)
      : values_(values), product_(product) {}

  const ex& of(const Expression& e) {
    if (const auto known = known_.find(e.identity()); known != known_.end()) return known->second;
    const ex value = short_number(computed(e));
    return known_.emplace(e.identity(), value).first->second;
  }

 private:
  ex computed(const Expression& e) {
    switch (e.kind()) {
      case ExpressionKind::kConstant:
        return GiNaC::numeric(e.value());
      case ExpressionKind::kNumberPi:
        return GiNaC::Pi;
      case ExpressionKind::kVariable:
        return values_.at(e.name());
      case ExpressionKind::kPoint:
        break;
      case ExpressionKind::kPower:
        return power(of(e.operands()[0]), e.exponent());
      case ExpressionKind::kCall:
        return called(e.function(), of(e.operands()[0]));
      case ExpressionKind::kProduct:
        return folded(e, 1,
                      [this](const ex& x, const ex& y) { return short_number(product_(x, y)); });
      case ExpressionKind::kSum:
        return folded(e, 0, [](const ex& x, const ex& y) { return ex(x + y); });
    }
    throw TooLong();
  }

  template <class Operation>
  ex folded(const Expression& e, ex result, Operation operation) {
    for (const Expression& operand : e.operands()) result = operation(result, of(operand));
    return result;
  }

  ex power(const ex& base, int exponent) {
    if (exponent > kMostPower || -exponent > kMostPower) throw TooLong();
    ex result = 1;
    for (int i = std::abs(exponent); i > 0; --i) result = short_number(product_(result, base));
    return exponent < 0 ? 1 / result : result;
  }

  static ex called(Call function, const ex& x) {
    switch (function) {
      case Call::kSqrt:
        return sqrt(x);
      case Call::kSin:
        return sin(x);
      case Call::kCos:
        return cos(x);
      default:
        throw TooLong();
    }
  }

  const std::map<std::string, ex>& values_;
  Products& product_;
  std::unordered_map<const void*, ex> known_;
};

/// Returns AᵀA.
ExactNumbers gram(const ExactNumbers& A, std::size_t rows, std::size_t columns, Products& product) {
  ExactNumbers result(columns * columns);
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      ex sum = 0;
      for (std::size_t row = 0; row < rows; ++row)
        sum += product(A[row * columns + i], A[row * columns + j]);
      result[i * columns + j] = result[j * columns + i] = short_number(sum);
    }
  return result;
}

/// Expands along the rows, the last one first: minors[S] is that of the last |S| rows and the columns
/// of the set S.
ex determinant(const ExactNumbers& A, std::size_t order, Products& product) {
  std::vector<ex> minors(std::size_t{1} << order, 0);
  minors[0] = 1;
  for (std::size_t set = 1; set < minors.size(); ++set) {
    const auto size = static_cast<std::size_t>(__builtin_popcountll(set));
    ex sum = 0;
    int sign = 1;
    for (std::size_t column = 0; column < order; ++column) {
      const std::size_t bit = std::size_t{1} << column;
      if ((set & bit) == 0) continue;
      sum += sign * product(A[(order - size) * order + column], minors[set & ~bit]);
      sign = -sign;
    }
    minors[set] = short_number(sum);
  }
  return minors.back();
}

}  // namespace

bool is_rank_lost(const Expressions& A, std::size_t rows, std::size_t columns,
                  const std::map<std::string, ex>& values) try {
  Products product;
  ExactValues exact(values, product);
  ExactNumbers numbers;
  for (const Expression& e : A) numbers.push_back(exact.of(e));
  const ExactNumbers square = rows == columns ? numbers : gram(numbers, rows, columns, product);
  return determinant(square, columns, product).is_zero();
} catch (const TooLong&) {
  return false;
} catch (const GiNaC::pole_error&) {
  return false;
}

}  // namespace regulus::detail
