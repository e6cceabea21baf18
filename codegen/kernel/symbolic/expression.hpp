// SPDX-License-Identifier: GPL-3.0-or-later
// Immutable shared expressions with exact numbers. Products are not expanded: 2*(x + y) stays a
// product, so that factored forms survive. Operands of sums and products are kept in an order that
// depends on their content alone, never on addresses: equal input gives equal text in any process.
#pragma once

#include <cln/rational.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace regulus::detail {

enum class ExpressionKind : std::uint8_t {
  kConstant,
  kNumberPi,
  kPoint,     // an entry of K: an exact double known when a kernel runs
  kVariable,  // a quantity that ranges over an interval
  kPower,     // integer exponent, not 0 or 1; −n divides
  kCall,
  kProduct,
  kSum,
};

enum class Call : std::uint8_t {
  kSqrt,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan,
  kAtan2,
  kExp,
  kLog,
  kAbs,
};

/// Returns the name of a function in model files and in text: "sqrt", "atan2", …
[[nodiscard]] const char* name_of(Call function) noexcept;

class Expression;
using Expressions = std::vector<Expression>;

/// A count of its owners keeps an expression alive. Like its number, the count belongs to the thread
/// that made it.
class Expression {
 public:
  Expression() : Expression(cln::cl_RA(0)) {}
  Expression(int value) : Expression(cln::cl_RA(value)) {}
  Expression(const cln::cl_RA& value);
  Expression(const Expression& other) noexcept;
  Expression(Expression&& other) noexcept : node_(std::exchange(other.node_, nullptr)) {}
  Expression& operator=(Expression other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~Expression();

  [[nodiscard]] ExpressionKind kind() const noexcept;
  /// Requires  kind() is kConstant.
  [[nodiscard]] const cln::cl_RA& value() const noexcept;
  /// Requires  kind() is kPoint or kVariable.
  [[nodiscard]] const std::string& name() const noexcept;
  /// Returns the operands; for kPower the base alone, for constants and symbols none.
  [[nodiscard]] const Expressions& operands() const noexcept;
  /// Requires  kind() is kPower.
  [[nodiscard]] int exponent() const noexcept;
  /// Requires  kind() is kCall.
  [[nodiscard]] Call function() const noexcept;

  [[nodiscard]] bool is_constant(int value) const;
  [[nodiscard]] bool has_variables() const noexcept;
  /// True if the expression is defined for all values of its symbols: no division, no root …
  [[nodiscard]] bool is_total() const noexcept;
  [[nodiscard]] std::size_t hash() const noexcept;
  /// Equal for copies of one expression. Only for memo tables: its order means nothing.
  [[nodiscard]] const void* identity() const noexcept { return node_; }

 private:
  struct Node;
  friend struct ExpressionFactory;
  /// Takes over a node that has no other owner.
  explicit Expression(std::unique_ptr<Node> node) noexcept;

  Node* node_;
};

struct Expression::Node {
  std::size_t owners = 1;
  ExpressionKind kind = ExpressionKind::kConstant;
  Call function = Call::kSqrt;
  bool has_variables = false;
  bool is_total = true;
  int exponent = 0;
  std::size_t hash = 0;
  cln::cl_RA value = 0;
  std::string name = {};
  Expressions operands = {};
};

inline Expression::Expression(std::unique_ptr<Node> node) noexcept : node_(node.release()) {}
inline Expression::Expression(const Expression& other) noexcept : node_(other.node_) {
  if (node_ != nullptr) ++node_->owners;
}
inline Expression::~Expression() {
  if (node_ != nullptr && --node_->owners == 0) delete node_;
}

inline ExpressionKind Expression::kind() const noexcept { return node_->kind; }
inline const cln::cl_RA& Expression::value() const noexcept { return node_->value; }
inline const std::string& Expression::name() const noexcept { return node_->name; }
inline const Expressions& Expression::operands() const noexcept { return node_->operands; }
inline int Expression::exponent() const noexcept { return node_->exponent; }
inline Call Expression::function() const noexcept { return node_->function; }
inline bool Expression::has_variables() const noexcept { return node_->has_variables; }
inline bool Expression::is_total() const noexcept { return node_->is_total; }
inline std::size_t Expression::hash() const noexcept { return node_->hash; }

[[nodiscard]] Expression pi();
[[nodiscard]] Expression variable(const std::string& name);
[[nodiscard]] Expression point(const std::string& name);

/// Nested sums are merged, rational constants added up, zeros dropped; like terms are not combined.
[[nodiscard]] Expression sum(Expressions terms);

/// Nested products are merged, rational constants multiplied. 0·f is 0 only if f is total.
[[nodiscard]] Expression product(Expressions factors);
[[nodiscard]] Expression product(Expression a, Expression b);

/// base^exponent, any integer exponent.
[[nodiscard]] Expression power(const Expression& base, int exponent);

/// Requires  two arguments for kAtan2 (ordinate, abscissa), one for the others.
[[nodiscard]] Expression call(Call function, Expressions arguments);

[[nodiscard]] Expression operator+(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator-(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator-(const Expression& a);
[[nodiscard]] Expression operator*(const Expression& a, const Expression& b);

/// A total order by content: −1, 0, 1. Digit runs in names compare as numbers: k_1_2 < k_1_10.
[[nodiscard]] int compare(const Expression& a, const Expression& b);
[[nodiscard]] bool operator==(const Expression& a, const Expression& b);

struct ExpressionHash {
  std::size_t operator()(const Expression& e) const noexcept { return e.hash(); }
};

/// The rational factor of a term: 3 for 3*x*y, 1 for x.
[[nodiscard]] cln::cl_RA coefficient_of(const Expression& term);

/// Returns e/c: divides every term of a sum, the rational factor of a product.
/// Requires  c ≠ 0.
[[nodiscard]] Expression divide_by(const Expression& e, const cln::cl_RA& c);

/// A representative of {e, −e} that is the same for both, and the sign: e = sign·form.
struct Signed {
  int sign;
  Expression form;
};
[[nodiscard]] Signed normalize_sign(const Expression& e);

}  // namespace regulus::detail
