// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/body_parser.hpp"

#include <limits>
#include <utility>

namespace regulus::codegen::reader {
namespace {

using ExpressionKind = Expression::Kind;
using StatementKind = Statement::Kind;

class BodyParser {
 public:
  explicit BodyParser(TokenStream& tokens) : tokens_(tokens) {}

  std::vector<Statement> run() {
    std::vector<Statement> body;
    tokens_.expect("{");
    while (!tokens_.accept("}")) body.push_back(statement());
    return body;
  }

 private:
  Statement statement() {
    if (tokens_.at("unsigned")) return mask();
    if (tokens_.at("const")) return value();
    if (tokens_.at("for")) return repeat();
    if (tokens_.accept("return")) {
      Statement result = named(StatementKind::kReturn);
      tokens_.expect(";");
      return result;
    }
    Statement result;
    if (tokens_.accept("(")) {
      tokens_.expect("void");
      tokens_.expect(")");
    } else if (tokens_.accept("I")) {
      return array_or_places();
    }
    const std::string_view name = tokens_.name();
    if (tokens_.at("[")) return keep(name);
    if (tokens_.accept("|=")) {
      result = {StatementKind::kCall, 'I', name};
      result.expression = call(tokens_.name());
    } else if (tokens_.accept("=")) {
      result = {StatementKind::kClear, 'I', name};
      tokens_.expect("0");
    } else {
      result.expression = call(name);
    }
    tokens_.expect(";");
    return result;
  }

  Statement named(StatementKind kind) {
    Statement result;
    result.kind = kind;
    result.name = tokens_.name();
    return result;
  }

  Statement mask() {
    tokens_.expect("unsigned");
    Statement result = named(StatementKind::kMask);
    for (const char* token : {"=", "0", ";"}) tokens_.expect(token);
    return result;
  }

  Statement array_or_places() {
    Statement result = named(StatementKind::kPlaces);
    result.names.push_back(result.name);
    if (tokens_.at("[")) {
      result.kind = StatementKind::kArray;
      result.first = index();
    }
    while (result.kind == StatementKind::kPlaces && tokens_.accept(","))
      result.names.push_back(tokens_.name());
    tokens_.expect(";");
    return result;
  }

  Statement value() {
    tokens_.expect("const");
    const char type = tokens_.accept("P") ? 'P' : 'I';
    if (type == 'I') tokens_.expect("I");
    Statement result = named(StatementKind::kValue);
    result.type = type;
    tokens_.expect("=");
    result.expression = sum();
    tokens_.expect(";");
    return result;
  }

  Statement keep(std::string_view name) {
    Statement result{StatementKind::kKeep, 'I', name};
    result.first = index();
    tokens_.expect("=");
    result.expression = sum();
    tokens_.expect(";");
    return result;
  }

  Statement repeat() {
    for (const char* token : {"for", "(", "int"}) tokens_.expect(token);
    Statement result = named(StatementKind::kRepeat);
    tokens_.expect("=");
    result.first = tokens_.integer();
    tokens_.expect(";");
    tokens_.expect(result.name);
    tokens_.expect("<=");
    result.last = tokens_.integer();
    for (const std::string_view token :
         {std::string_view(";"), std::string_view("++"), result.name, std::string_view(")")})
      tokens_.expect(token);
    result.expression = call(tokens_.name());
    tokens_.expect(";");
    return result;
  }

  std::int64_t index() {
    tokens_.expect("[");
    const std::int64_t result = tokens_.integer();
    tokens_.expect("]");
    return result;
  }

  // sum: product {(+|-) product}; product: signed {* signed}; signed: - signed | primary.
  Expression sum() {
    Expression left = product();
    while (tokens_.at("+") || tokens_.at("-")) left = joined(std::move(left), &BodyParser::product);
    return left;
  }

  Expression product() {
    Expression left = signed_operand();
    while (tokens_.at("*")) left = joined(std::move(left), &BodyParser::signed_operand);
    return left;
  }

  Expression joined(Expression left, Expression (BodyParser::*operand)()) {
    Expression result{ExpressionKind::kOperation, tokens_.take().text};
    result.operands.push_back(std::move(left));
    result.operands.push_back((this->*operand)());
    return result;
  }

  Expression signed_operand() {
    if (!tokens_.at("-")) return primary();
    const std::string_view minus = tokens_.take().text;
    Expression operand = signed_operand();
    if (operand.kind == ExpressionKind::kDouble) {
      operand.number = -operand.number;
      return operand;
    }
    Expression result{ExpressionKind::kOperation, minus};
    result.operands.push_back(std::move(operand));
    return result;
  }

  Expression primary() {
    if (tokens_.accept("(")) {
      Expression inner = sum();
      tokens_.expect(")");
      return inner;
    }
    if (tokens_.peek().kind == TokenKind::kNumber) return number();
    if (tokens_.accept("static_cast")) return count();
    const std::string_view name = tokens_.name();
    if (tokens_.at("(")) return call(name);
    if (!tokens_.at("[")) return {ExpressionKind::kName, name};
    return {ExpressionKind::kElement, name, 0, index()};
  }

  Expression number() {
    if (is_floating(tokens_.peek().text))
      return {ExpressionKind::kDouble, {}, floating(tokens_.take().text)};
    return {ExpressionKind::kInteger, {}, 0, tokens_.integer()};
  }

  Expression count() {
    for (const char* token : {"<", "double", ">", "("}) tokens_.expect(token);
    const std::string_view mask = tokens_.name();
    tokens_.expect(")");
    return {ExpressionKind::kCount, mask};
  }

  Expression call(std::string_view name) {
    Expression result{ExpressionKind::kOperation, name};
    tokens_.expect("(");
    if (!tokens_.at(")")) do
        result.operands.push_back(sum());
      while (tokens_.accept(","));
    tokens_.expect(")");
    if (name == "__builtin_huge_val" && result.operands.empty())
      return {ExpressionKind::kDouble, {}, std::numeric_limits<double>::infinity()};
    return result;
  }

  TokenStream& tokens_;
};

}  // namespace

std::vector<Statement> parse_body(TokenStream& tokens) { return BodyParser(tokens).run(); }

}  // namespace regulus::codegen::reader
