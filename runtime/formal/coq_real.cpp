// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_real.hpp"

#include <algorithm>

#include "runtime/verifier/infix_reader.hpp"
#include "runtime/verifier/model/model_file.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostCharacters = 20000;

/// How much an operator binds, from the weakest on.
enum class Level { kSum, kProduct, kSign, kPower, kArgument };

struct Text {
  std::string text;
  Level level;
};

class RealWriter {
 public:
  RealWriter(const Graph& graph, const std::vector<std::string>& names)
      : graph_(graph), names_(names) {}

  [[nodiscard]] Text write(NodeId id) const {
    Text result = written(graph_.nodes()[std::size_t(id)]);
    if (result.text.size() > kMostCharacters)
      throw Unfinished("an expression is too long for a theorem about the model file");
    return result;
  }

 private:
  [[nodiscard]] std::string at(NodeId id, Level level) const {
    const Text part = write(id);
    return part.level < level ? '(' + part.text + ')' : part.text;
  }

  [[nodiscard]] static Text number(const Rational& value) {
    const Level level = !value.is_integer() ? Level::kProduct
                        : value.sign() < 0  ? Level::kSign
                                            : Level::kArgument;
    return {value.text(), level};
  }

  /// "*-" may be one word of Coq.
  [[nodiscard]] Text binary(const Node& node, const char* sign, Level level) const {
    const Level right = level == Level::kSum ? Level::kProduct : Level::kPower;
    return {at(node.a, level) + sign + at(node.b, right), level};
  }

  /// The angle of one degree has a name.
  [[nodiscard]] Text quotient(const Node& node) const {
    const Node& b = graph_.nodes()[std::size_t(node.b)];
    if (graph_.nodes()[std::size_t(node.a)].op == Op::kPi && b.op == Op::kConstant &&
        graph_.rational(b.a) == Rational(180))
      return {"deg", Level::kArgument};
    return binary(node, "/", Level::kProduct);
  }

  [[nodiscard]] Text call(const Node& node, const char* function) const {
    return {std::string(function) + ' ' + at(node.a, Level::kArgument), Level::kPower};
  }

  [[nodiscard]] Text written(const Node& node) const {
    switch (node.op) {
      case Op::kConstant:
        return number(graph_.rational(node.a));
      case Op::kPi:
        return {"pi", Level::kArgument};
      case Op::kVariable:
        return {names_.at(std::size_t(node.a)), Level::kArgument};
      case Op::kNegate:
        return {"-" + at(node.a, Level::kPower), Level::kSign};
      case Op::kAdd:
        return binary(node, " + ", Level::kSum);
      case Op::kSubtract:
        return binary(node, " - ", Level::kSum);
      case Op::kMultiply:
        return binary(node, "*", Level::kProduct);
      case Op::kDivide:
        return quotient(node);
      case Op::kPower:
        return {at(node.a, Level::kArgument) + '^' + std::to_string(node.b), Level::kPower};
      case Op::kSqrt:
        return call(node, "sqrt");
      case Op::kSin:
        return call(node, "sin");
      case Op::kCos:
        return call(node, "cos");
      case Op::kTan:
        return call(node, "tan");
      case Op::kAtan:
        return call(node, "atan");
      case Op::kExp:
        return call(node, "exp");
      case Op::kLog:
        return call(node, "ln");
      case Op::kAbs:
        return call(node, "Rabs");
      default:
        throw Unfinished("there is no theorem about a model file with asin, acos or atan2 yet");
    }
  }

  const Graph& graph_;
  const std::vector<std::string>& names_;
};

}  // namespace

std::string coq_real(const Graph& graph, NodeId node, const std::vector<std::string>& names) {
  return RealWriter(graph, names).write(node).text;
}

std::string coq_written_number(std::string_view text, Graph& graph) {
  const NodeId value = number_of_toml(text, graph);
  std::string number;
  for (const char c : text)
    if (c != '_') number += c == 'E' ? 'e' : c;
  if (number.starts_with('+')) number.erase(0, 1);
  const bool is_decimal = number.find_first_not_of("0123456789.e+-") == std::string::npos;
  return is_decimal ? number : coq_real(graph, value, {});
}

std::string coq_argument(const std::string& text) {
  const bool is_word = std::ranges::all_of(text, [](char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '.' || c == '\'';
  });
  return is_word ? text : '(' + text + ')';
}

std::string text_of(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) {
    if (!text.empty()) text += between;
    text += part;
  }
  return text;
}

}  // namespace regulus::verifier
