// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/expression_parser.hpp"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/lexer.hpp"
#include "codegen/model/exact/real_functions.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/units.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

class Parser {
 public:
  Parser(std::string_view text, Names& names, const Place& place, int depth, NumberUnit unit)
      : text_(text), names_(names), place_(place), lexer_(text), depth_(depth), unit_(unit) {}

  ParsedExpression parse() {
    advance();
    ParsedExpression result = parse_sum();
    if (token_.kind != Token::Kind::kEnd)
      refuse(token_, "an operator or the end of the expression");
    return result;
  }

 private:
  using Kind = Token::Kind;

  /// One level of recursion, counted so that nesting cannot exhaust the stack.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kMostDepth)
        parser_.fail("an expression nested too deeply at " + parser_.describe(parser_.token_),
                     "at most " + std::to_string(kMostDepth) + " levels");
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  ParsedExpression parse_sum() {
    const Level level(*this);
    std::vector<Operand> operands;
    operands.push_back({parse_product()});
    while (token_.is('+') || token_.is('-')) {
      const bool inverted = token_.is('-');
      advance();
      operands.push_back({parse_product(), inverted});
    }
    return combine(sum, std::move(operands));
  }

  ParsedExpression parse_product() {
    std::vector<Operand> operands;
    operands.push_back({parse_factor()});
    while (token_.is('*') || token_.is('/')) {
      const bool inverted = token_.is('/');
      advance();
      operands.push_back({parse_factor(), inverted});
    }
    return combine(product, std::move(operands));
  }

  ParsedExpression combine(ParsedExpression (*operation)(std::vector<Operand>),
                           std::vector<Operand> operands) {
    if (operands.size() == 1 && !operands.front().inverted) return std::move(operands.front().term);
    return guarded(token_, [&] { return operation(std::move(operands)); });
  }

  ParsedExpression parse_factor() {
    if (!token_.is('+') && !token_.is('-')) return parse_power();
    const Level level(*this);
    const Token sign = token_;
    advance();
    std::vector<Operand> operand;
    operand.push_back({parse_factor(), sign.is('-')});
    return guarded(sign, [&] { return sum(std::move(operand)); });
  }

  ParsedExpression parse_power() {
    ParsedExpression base = parse_primary();
    if (!token_.is('^')) return base;
    const Level level(*this);
    const Token caret = token_;
    advance();
    const ParsedExpression exponent = parse_factor();
    return guarded(caret, [&] { return power(base, exponent); });
  }

  ParsedExpression parse_primary() {
    const Token start = token_;
    if (start.kind == Kind::kNumber) return parse_number();
    if (start.kind == Kind::kName) return parse_name();
    if (!start.is('(')) refuse(start, "a number, a name or '('");
    advance();
    ParsedExpression inner = parse_sum();
    expect(')', start);
    return inner;
  }

  ParsedExpression parse_number() {
    const auto value = exact_decimal(token_.text);
    if (!value) refuse(token_, kNumberLimits);
    const Token start = token_;
    advance();
    if (token_.text != "deg" && token_.text != "°") {
      refuse_unit_behind(start);
      return number(*value);
    }
    advance();
    return guarded(start, [&] { return product({{number(*value)}, {degree()}}); });
  }

  /// "5mm": the place of a number says its unit, and only degrees may be written.
  void refuse_unit_behind(const Token& before) const {
    if (token_.kind != Kind::kName) return;
    const std::string digits(before.text), unit(token_.text);
    if (is_like_degrees(unit)) reject(token_, "degrees are written deg; write " + digits + "deg");
    if (is_unit(unit) && names_.find(unit, depth_) == nullptr)
      reject(token_,
             "numbers are in the unit that the model gives, and only deg is written behind "
             "one; write " +
                 digits + " if that is its unit");
  }

  /// True where a number that stands alone is a number of degrees.
  [[nodiscard]] bool is_among_degrees() const {
    return unit_ == NumberUnit::kDegrees && circular_calls_ == 0;
  }

  [[nodiscard]] ParsedExpression degree() const {
    return constant(is_among_degrees() ? GiNaC::ex(1) : one_degree());
  }

  ParsedExpression parse_name() {
    const Token name = token_;
    advance();
    if (is_function(name.text)) return parse_call(name);
    if (name.text == "pi" && is_among_degrees())
      reject(name, "this is a number of degrees, and pi is one of radians; write 180");
    if (name.text == "pi") return constant(GiNaC::Pi);
    if (name.text == "deg") return degree();
    const std::string key(name.text);
    const ParsedExpression* meaning = is_name(key) ? names_.find(key, depth_) : nullptr;
    if (!meaning) refuse_undeclared(name);
    return meaning->is_angle_in_degrees ? angle(name, *meaning) : *meaning;
  }

  /// Returns the angle inside sin, cos and tan, and its number of degrees in `name/deg` and in
  /// values that are degrees. Anywhere else, degrees or radians may be meant.
  ParsedExpression angle(const Token& name, const ParsedExpression& meaning) {
    if (circular_calls_ > 0) return meaning;
    if (unit_ == NumberUnit::kPlain) {
      if (!token_.is('/') || Lexer(lexer_).next().text != "deg")
        reject(name, "this angle is in degrees; outside sin, cos and tan write " +
                         std::string(name.text) + "/deg, its number of degrees");
      return meaning;  // the division by deg follows
    }
    ParsedExpression degrees = meaning;
    degrees.value = meaning.value / one_degree();
    return degrees;
  }

  ParsedExpression parse_call(const Token& name) {
    const std::string_view arcs[] = {"asin", "acos", "atan", "atan2"};
    if (is_among_degrees() && std::ranges::find(arcs, name.text) != std::end(arcs))
      reject(name,
             "this is a number of degrees, and the function gives radians; give the pose "
             "parameter the unit rad");
    const bool is_circular = name.text == "sin" || name.text == "cos" || name.text == "tan";
    if (is_circular) ++circular_calls_;
    ParsedExpression result = parse_arguments(name);
    if (is_circular) --circular_calls_;
    return result;
  }

  ParsedExpression parse_arguments(const Token& name) {
    const Token bracket = token_;
    if (!bracket.is('(')) refuse(bracket, "'(' after the function " + std::string(name.text));
    advance();
    std::vector<ParsedExpression> arguments;
    arguments.push_back(parse_sum());
    while (token_.is(',')) {
      advance();
      arguments.push_back(parse_sum());
    }
    expect(')', bracket);
    return guarded(name, [&] { return call(name.text, std::move(arguments)); });
  }

  /// Runs an operation; its refusal, or GiNaC's (a pole, 0^0), becomes an error with the place.
  template <typename Operation>
  ParsedExpression guarded(const Token& at, Operation operation) try {
    ParsedExpression result = operation();
    if (result.constant && GiNaC::is_a<GiNaC::numeric>(result.value) &&
        !result.value.info(GiNaC::info_flags::rational))
      throw ParseRefusal{"a value that is not real", "a real value"};
    return result;
  } catch (const ParseRefusal& refusal) {
    fail(refusal.found + " at " + describe(at), refusal.expected);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    fail(std::string("an operation that has no value (") + error.what() + ") at " + describe(at),
         "an operation that is defined");
  }

  void advance() { token_ = lexer_.next(); }

  void expect(char symbol, const Token& opening) {
    if (!token_.is(symbol))
      refuse(token_, std::string("'") + symbol + "' for the '(' at character " +
                         std::to_string(opening.column));
    advance();
  }

  [[nodiscard]] std::string describe(const Token& token) const {
    const std::string what = token.kind == Kind::kEnd ? "the end" : in_quotes(token.text);
    return what + " (character " + std::to_string(token.column) + " of " + in_quotes(text_) + ")";
  }

  [[noreturn]] void refuse(const Token& found, const std::string& expected) const {
    fail(describe(found), expected, found.kind == Kind::kName ? std::string(found.text) : "");
  }

  /// `why`: the problem and the remedy, with a semicolon between them.
  [[noreturn]] void reject(const Token& at, const std::string& why) const {
    const std::size_t semicolon = why.rfind("; ");
    throw InputError::statement(place_.file, place_.line,
                                with_key(describe(at)) + ": " + why.substr(0, semicolon),
                                why.substr(semicolon + 2), std::string(at.text));
  }

  [[noreturn]] void refuse_undeclared(const Token& name) const {
    const std::vector<std::string> known = names_.all();
    throw InputError::statement(
        place_.file, place_.line, with_key("undeclared name " + describe(name)),
        known.empty()
            ? "only a constant expression is allowed here"
            : suggestion(name.text, known, "the declared names are: " + enumeration(known)),
        std::string(name.text));
  }

  [[noreturn]] void fail(const std::string& found, const std::string& expected,
                         const std::string& symbol = {}) const {
    throw InputError(place_.file, place_.line, with_key(found), expected,
                     symbol.empty() ? place_.key : symbol);
  }

  [[nodiscard]] std::string with_key(const std::string& found) const {
    return found + (place_.key.empty() ? "" : " in " + place_.key);
  }

  std::string_view text_;
  Names& names_;
  const Place& place_;
  Lexer lexer_;
  Token token_;
  int depth_;
  NumberUnit unit_;
  int circular_calls_ = 0;  ///< of sin, cos or tan around the current token
};

class NoNames final : public Names {
 public:
  const ParsedExpression* find(const std::string&, int) override { return nullptr; }
  std::vector<std::string> all() const override { return {}; }
};

}  // namespace

ParsedExpression parse_expression(std::string_view text, Names& names, const Place& place,
                                  int depth, NumberUnit unit) {
  if (text.size() > kLongestExpression)
    throw InputError(place.file, place.line,
                     "an expression of " + std::to_string(text.size()) + " bytes" +
                         (place.key.empty() ? "" : " in " + place.key),
                     "at most " + std::to_string(kLongestExpression) + " bytes", place.key);
  return Parser(text, names, place, depth, unit).parse();
}

ParsedExpression parse_constant(std::string_view text, const Place& place, NumberUnit unit) {
  NoNames names;
  ParsedExpression result = parse_expression(text, names, place, 0, unit);
  if (!approx_value(result.value))
    throw InputError(place.file, place.line,
                     in_quotes(text) + (place.key.empty() ? "" : " in " + place.key),
                     "a finite real number", place.key);
  return result;
}

}  // namespace regulus::detail
