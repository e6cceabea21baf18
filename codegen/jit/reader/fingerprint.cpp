// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/fingerprint.hpp"

#include <bit>
#include <cstdint>

#include "regulus/codegen/jit/reader/token.hpp"
#include "regulus/codegen/model/sha256.hpp"

namespace regulus::codegen::reader {
namespace {

/// A function as bytes that can be read in one way only. What is declared in it is a number, in the
/// order of declarations. What is called is an operation, and itself, or a function: nothing that
/// is declared here can be called, whatever its name.
class Serialiser {
 public:
  explicit Serialiser(const Symbols& functions) : functions_(functions) {}

  std::string run(const FunctionText& function) {
    add_number(function.parameters.size());
    for (const std::string_view parameter : function.parameters) declare(parameter);
    for (const Statement& statement : function.body) add(statement);
    return std::move(bytes_);
  }

 private:
  void add(const Statement& s) {
    add_kind(s.kind);
    bytes_ += s.type;
    if (s.kind == Statement::Kind::kRepeat) declare(s.name);
    add(s.expression);  // before the name of its value is known
    switch (s.kind) {
      case Statement::Kind::kMask:
      case Statement::Kind::kArray:
      case Statement::Kind::kValue:
        declare(s.name);
        break;
      default:
        break;
    }
    add_name(s.name);
    add_number(s.names.size());
    for (const std::string_view name : s.names) declare(name);
    add_number(static_cast<std::uint64_t>(s.first));
    add_number(static_cast<std::uint64_t>(s.last));
  }

  void add(const Expression& e) {
    add_kind(e.kind);
    if (e.kind == Expression::Kind::kOperation)
      add_called(e.name);
    else
      add_name(e.name);
    add_number(std::bit_cast<std::uint64_t>(e.number));
    add_number(static_cast<std::uint64_t>(e.integer));
    add_number(e.operands.size());
    for (const Expression& operand : e.operands) add(operand);
  }

  void declare(std::string_view name) { declared_[name] = ++declarations_; }

  void add_name(std::string_view name) {
    if (const auto local = declared_.find(name); local != declared_.end()) {
      bytes_ += '#';
      return add_number(local->second);
    }
    bytes_ += '$';
    add_text(name);
  }

  void add_called(std::string_view name) {
    const auto function = functions_.find(name);
    add_text(function == functions_.end() ? name : std::string_view(function->second));
  }

  void add_text(std::string_view text) {
    add_number(text.size());
    bytes_ += text;
  }

  template <class Kind>
  void add_kind(Kind kind) {
    bytes_ += static_cast<char>(kind);
  }

  /// Seven bits a byte, the last without a mark: most numbers are small.
  void add_number(std::uint64_t number) {
    for (; number >= 0x80; number >>= 7) bytes_ += static_cast<char>(number | 0x80);
    bytes_ += static_cast<char>(number);
  }

  const Symbols& functions_;
  std::map<std::string_view, std::uint64_t> declared_;
  std::uint64_t declarations_ = 0;
  std::string bytes_;
};

}  // namespace

Symbols symbols_of(const KernelText& kernel) {
  Symbols symbols;
  for (const FunctionText& function : kernel.functions) {
    std::string symbol = function.exported ? std::string(function.name)
                                           : "kernel." + sha256(Serialiser(symbols).run(function));
    if (!symbols.try_emplace(function.name, std::move(symbol)).second)
      throw OutsideSubset("two functions of one name");
  }
  return symbols;
}

}  // namespace regulus::codegen::reader
