// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/parser.hpp"

#include "regulus/codegen/jit/reader/body_parser.hpp"

namespace regulus::codegen::reader {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : tokens_(text) {}

  KernelText run() {
    while (tokens_.at("#")) include();
    bool in_namespace = false;
    while (!tokens_.at_end()) {
      if (tokens_.accept("namespace")) {
        if (in_namespace) throw OutsideSubset("a namespace in another");
        in_namespace = true;
        tokens_.expect("{");
      } else if (in_namespace && tokens_.accept("}")) {
        in_namespace = false;
      } else if (tokens_.accept("using")) {
        using_the_packs();
      } else if (!in_namespace && tokens_.accept("extern")) {
        exported();
      } else {
        internal();
      }
    }
    return std::move(kernel_);
  }

 private:
  void include() {
    tokens_.expect("#");
    tokens_.expect("include");
    const Token file = tokens_.take();
    if (file.kind != TokenKind::kString ||
        (file.text != "regulus/kernel/abi.hpp" && file.text != "regulus/kernel/pack.hpp"))
      throw OutsideSubset("another header than those of kernels");
  }

  void using_the_packs() {
    for (const char* token : {"namespace", "regulus", ":", ":", "pack", ";"}) tokens_.expect(token);
  }

  /// extern "C", of a function, a declaration or a group of tables.
  void exported() {
    if (const Token language = tokens_.take();
        language.kind != TokenKind::kString || language.text != "C")
      throw OutsideSubset("a linkage other than C");
    if (tokens_.accept("{")) {
      while (!tokens_.accept("}")) declaration_or_table();
      return;
    }
    add_function(true);
  }

  /// `extern const T name;` before `const T name = …;`
  void declaration_or_table() {
    if (!tokens_.accept("extern")) return add_table(true);
    tokens_.expect("const");
    tokens_.name();
    tokens_.name();
    tokens_.expect(";");
  }

  void internal() {
    if (tokens_.at("const")) return add_table(false);
    if (tokens_.accept("__attribute__"))
      for (const char* token : {"(", "(", "noinline", ")", ")"}) tokens_.expect(token);
    add_function(false);
  }

  void add_function(bool exported) {
    FunctionText function;
    function.exported = exported;
    tokens_.expect("unsigned");
    function.name = tokens_.name();
    tokens_.expect("(");
    do function.parameters.push_back(parameter());
    while (tokens_.accept(","));
    tokens_.expect(")");
    if (exported && tokens_.accept(";")) return;
    function.body = parse_body(tokens_);
    kernel_.functions.push_back(std::move(function));
  }

  std::string_view parameter() {
    tokens_.accept("const");
    if (!tokens_.accept("double") && !tokens_.accept("void")) tokens_.expect("I");
    tokens_.expect("*");
    tokens_.accept("__restrict");
    return tokens_.at(",") || tokens_.at(")") ? std::string_view() : tokens_.name();
  }

  void add_table(bool exported) {
    TableText table;
    table.exported = exported;
    tokens_.expect("const");
    table.type = tokens_.at("int") || tokens_.at("double") ? tokens_.take().text : tokens_.name();
    table.name = tokens_.name();
    if (tokens_.accept("[")) {
      tokens_.expect("]");
      table.array = true;
    }
    tokens_.expect("=");
    table.value = initialiser();
    tokens_.expect(";");
    kernel_.tables.push_back(std::move(table));
  }

  Initialiser initialiser() {
    using Kind = Initialiser::Kind;
    Initialiser value;
    if (tokens_.accept("{")) {
      while (!tokens_.accept("}")) {
        value.list.push_back(initialiser());
        if (!tokens_.at("}")) tokens_.expect(",");
      }
      return value;
    }
    if (tokens_.peek().kind == TokenKind::kString) return {Kind::kString, {}, tokens_.take().text};
    tokens_.accept("&");  // of a table: what its name means here anyway
    if (tokens_.peek().kind == TokenKind::kName) return {Kind::kName, {}, tokens_.name()};
    return number();
  }

  Initialiser number() {
    const bool negative = tokens_.accept("-");
    Initialiser value;
    if (is_floating(tokens_.peek().text)) {
      const double size = floating(tokens_.take().text);
      value.kind = Initialiser::Kind::kDouble;
      value.number = negative ? -size : size;
    } else {
      value.kind = Initialiser::Kind::kInteger;
      value.integer = negative ? -tokens_.integer() : tokens_.integer();
    }
    return value;
  }

  TokenStream tokens_;
  KernelText kernel_;
};

}  // namespace

KernelText parse_kernel(std::string_view text) { return Parser(text).run(); }

}  // namespace regulus::codegen::reader
