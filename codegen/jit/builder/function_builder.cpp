// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/builder/function_builder.hpp"

#include <utility>

#include "regulus/codegen/jit/reader/token.hpp"

namespace regulus::codegen::builder {
namespace {

using reader::Expression;
using reader::OutsideSubset;
using reader::Statement;
using ExpressionKind = Expression::Kind;
using StatementKind = Statement::Kind;

constexpr std::int64_t kLanes = 8;
constexpr std::int64_t kRowsOfAnInterval = 2;
constexpr std::int64_t kIntervalBytes = 128;

[[noreturn]] void refuse(const char* what, std::string_view name) {
  throw OutsideSubset(std::string(what) + " '" + std::string(name) + "'");
}

/// The operation's name in pack_operations.hpp, without the kinds of its operands.
std::string word_of(const Expression& operation) {
  if (operation.name == "+") return "add";
  if (operation.name == "*") return "multiply";
  if (operation.name == "-") return operation.operands.size() == 1 ? "negate" : "subtract";
  return std::string(operation.name);
}

bool makes_a_point(std::string_view word, std::string_view kinds) {
  return word == "P" || word == "point_of" || word.starts_with("exact_") ||
         (word == "negate" && kinds == "P");
}

std::int64_t integer_of(const Expression& expression) {
  if (expression.kind != ExpressionKind::kInteger)
    throw OutsideSubset("an index that is no number");
  return expression.integer;
}

}  // namespace

FunctionBuilder::FunctionBuilder(Operations& operations, const FunctionTable& functions,
                                 llvm::Function& function, const reader::FunctionText& text)
    : operations_(operations),
      functions_(functions),
      text_(text),
      code_(llvm::BasicBlock::Create(function.getContext(), "", &function)) {
  // A copied instruction keeps its strictness; new ones are loads, stores and casts.
  for (std::size_t i = 0; i < text.parameters.size(); ++i)
    if (!text.parameters[i].empty())
      pointers_[text.parameters[i]] = function.getArg(static_cast<unsigned>(i));
}

void FunctionBuilder::run() {
  bool returned = false;
  for (const Statement& statement : text_.body) {
    if (returned) throw OutsideSubset("a statement after the return");
    returned = statement.kind == StatementKind::kReturn;
    execute(statement);
  }
  if (!returned) throw OutsideSubset("a function that returns nothing");
}

void FunctionBuilder::execute(const Statement& s) {
  switch (s.kind) {
    case StatementKind::kMask:
    case StatementKind::kClear: {
      if (s.kind == StatementKind::kClear) (void)mask(s.name);
      Object zero;
      zero.changes = true;
      zero.components.push_back({0, code_.getInt32(0)});
      masks_[s.name] = std::move(zero);
      return;
    }
    case StatementKind::kArray:
      if (s.first < 1) refuse("an empty array", s.name);
      pointers_[s.name] = operations_.reserve(code_, static_cast<std::uint64_t>(s.first));
      return;
    case StatementKind::kPlaces:
      return;  // sincos gives them their values
    case StatementKind::kValue: {
      Typed& result = value(s.expression);
      if (result.type != s.type) refuse("another type than that of", s.name);
      return define(s.name, result);
    }
    case StatementKind::kKeep: {
      Typed& result = value(s.expression);
      if (result.type != 'I') refuse("no interval is kept in", s.name);
      return operations_.write(code_, result.object, slot_address(s.name, s.first));
    }
    case StatementKind::kCall:
      return call_part(s);
    case StatementKind::kEvaluate:
      return evaluate(s.expression, 0, {});
    case StatementKind::kRepeat:
      for (std::int64_t e = s.first; e <= s.last; ++e) evaluate(s.expression, e, s.name);
      return;
    case StatementKind::kReturn:
      code_.CreateRet(mask(s.name).components.front().value);
      return;
  }
}

void FunctionBuilder::evaluate(const Expression& call, std::int64_t element,
                               std::string_view variable) {
  if (call.name == "store") return store(call, element, variable);
  if (call.name == "sincos") return sine_and_cosine(call);
  (void)value(call);
}

/// store(out, e, value), where e is a number or the variable of the loop around it.
void FunctionBuilder::store(const Expression& call, std::int64_t element,
                            std::string_view variable) {
  if (call.operands.size() != 3) refuse("too few or too many operands of", call.name);
  const Expression& index = call.operands[1];
  const bool counted = index.kind == ExpressionKind::kName && index.name == variable;
  Typed& result = value(call.operands[2]);
  if (result.type != 'I') refuse("no interval for", call.name);
  operations_.apply(code_, "store",
                    {row_address(call.operands[0].name,
                                 kRowsOfAnInterval * (counted ? element : integer_of(index))),
                     &result.object});
}

void FunctionBuilder::sine_and_cosine(const Expression& call) {
  if (call.operands.size() != 3) refuse("too few or too many operands of", call.name);
  Typed& argument = value(call.operands[0]);
  if (argument.type != 'I') refuse("no interval for", call.name);
  Typed& sine = make('I');
  Typed& cosine = make('I');
  operations_.apply(code_, "sincos_I", {&sine.object, &cosine.object, &argument.object});
  define(call.operands[1].name, sine);
  define(call.operands[2].name, cosine);
}

void FunctionBuilder::call_part(const Statement& s) {
  const auto found = functions_.find(s.expression.name);
  if (found == functions_.end()) refuse("no function", s.expression.name);
  llvm::SmallVector<llvm::Value*, 4> arguments;
  for (const Expression& operand : s.expression.operands)
    arguments.push_back(pointer(operand.name));
  if (arguments.size() != found->second->arg_size())
    refuse("too few or too many operands of", s.expression.name);
  Component& lanes = mask(s.name).components.front();
  lanes.value = code_.CreateOr(lanes.value, code_.CreateCall(found->second, arguments));
}

FunctionBuilder::Typed& FunctionBuilder::value(const Expression& expression) {
  switch (expression.kind) {
    case ExpressionKind::kName: {
      const auto found = values_.find(expression.name);
      if (found == values_.end()) refuse("no value", expression.name);
      return *found->second;
    }
    case ExpressionKind::kElement: {
      Typed& result = make('I');
      result.object = operations_.read(code_, slot_address(expression.name, expression.integer));
      return result;
    }
    case ExpressionKind::kCount: {
      Typed& result = make('P');
      operations_.apply(code_, "count_U", {&result.object, &mask(expression.name)});
      return result;
    }
    case ExpressionKind::kOperation:
      return operation(expression);
    case ExpressionKind::kDouble:
    case ExpressionKind::kInteger:
      break;
  }
  throw OutsideSubset("a number that is neither P nor constant");
}

FunctionBuilder::Typed& FunctionBuilder::operation(const Expression& expression) {
  if (expression.name == "load" || expression.name == "point") return row(expression);
  // P(a value) is that value: static_cast<double>(mask), or the copy of a P.
  if (expression.name == "P" && expression.operands.size() == 1 &&
      expression.operands[0].kind == ExpressionKind::kCount)
    return value(expression.operands[0]);
  const std::string word = word_of(expression);
  Typed& result = make('I');
  Operands operands;
  operands.list.push_back(&result.object);
  for (const Expression& operand : expression.operands) {
    if (operand.kind == ExpressionKind::kDouble || operand.kind == ExpressionKind::kInteger ||
        (operand.kind == ExpressionKind::kName && masks_.count(operand.name))) {
      add_operand(operand, word, operands);
      continue;
    }
    Typed& typed = value(operand);
    operands.kinds += typed.type;
    operands.list.push_back(&typed.object);
  }
  if (makes_a_point(word, operands.kinds)) result.type = 'P';
  operations_.apply(code_, word + "_" + operands.kinds, operands.list);
  return result;
}

/// What is no interval and no point: a literal, an exponent, the mask.
void FunctionBuilder::add_operand(const Expression& expression, std::string_view operation,
                                  Operands& operands) {
  if (expression.kind == ExpressionKind::kDouble) {
    operands.kinds += 'D';
    operands.list.push_back(llvm::ConstantFP::get(code_.getDoubleTy(), expression.number));
  } else if (expression.kind == ExpressionKind::kInteger) {
    if (operation != "pow" || expression.integer < 2) refuse("a number of no use to", operation);
    operands.kinds += 'N';
    operands.list.push_back(code_.getInt32(static_cast<std::uint32_t>(expression.integer)));
  } else {
    operands.kinds += 'U';
    operands.list.push_back(&mask(expression.name));
  }
}

/// load(boxes, v) or point(points, p).
FunctionBuilder::Typed& FunctionBuilder::row(const Expression& call) {
  if (call.operands.size() != 2) refuse("too few or too many operands of", call.name);
  const bool interval = call.name == "load";
  const std::int64_t index = integer_of(call.operands[1]);
  Typed& result = make(interval ? 'I' : 'P');
  operations_.apply(code_, std::string(call.name),
                    {&result.object, row_address(call.operands[0].name,
                                                 interval ? kRowsOfAnInterval * index : index)});
  return result;
}

llvm::Value* FunctionBuilder::row_address(std::string_view array, std::int64_t row) {
  if (row < 0) refuse("a negative index into", array);
  return code_.CreateConstInBoundsGEP1_64(code_.getDoubleTy(), pointer(array),
                                          static_cast<std::uint64_t>(kLanes * row));
}

llvm::Value* FunctionBuilder::slot_address(std::string_view array, std::int64_t index) {
  if (index < 0) refuse("a negative index into", array);
  return code_.CreateConstInBoundsGEP1_64(code_.getInt8Ty(), pointer(array),
                                          static_cast<std::uint64_t>(kIntervalBytes * index));
}

llvm::Value* FunctionBuilder::pointer(std::string_view name) const {
  const auto found = pointers_.find(name);
  if (found == pointers_.end()) refuse("no array", name);
  return found->second;
}

Object& FunctionBuilder::mask(std::string_view name) {
  const auto found = masks_.find(name);
  if (found == masks_.end()) refuse("no mask of lanes", name);
  return found->second;
}

void FunctionBuilder::define(std::string_view name, Typed& value) {
  if (!values_.try_emplace(name, &value).second) refuse("two values of the name", name);
}

}  // namespace regulus::codegen::builder
