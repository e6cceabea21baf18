// SPDX-License-Identifier: GPL-3.0-or-later
// The part of C++ that kernels are written in, as trees. All names point into the text.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace regulus::codegen::reader {

struct Expression {
  enum class Kind : std::uint8_t {
    kDouble,     ///< number
    kInteger,    ///< integer
    kName,       ///< name
    kElement,    ///< name[integer]
    kOperation,  ///< name(operands…); "+" "-" "*" of one or two operands
    kCount,      ///< static_cast<double>(name), a mask of lanes as a number
  };
  Kind kind = Kind::kName;
  std::string_view name = {};
  double number = 0;
  std::int64_t integer = 0;
  std::vector<Expression> operands = {};
};

struct Statement {
  enum class Kind : std::uint8_t {
    kMask,      ///< unsigned name = 0;
    kClear,     ///< name = 0;
    kArray,     ///< I name[first];
    kPlaces,    ///< I names…;
    kValue,     ///< const type name = expression;
    kKeep,      ///< name[first] = expression;
    kCall,      ///< name |= function(…);
    kEvaluate,  ///< expression;
    kRepeat,    ///< for (int name = first; name <= last; ++name) expression;
    kReturn,    ///< return name;
  };
  Kind kind = Kind::kEvaluate;
  char type = 'I';  ///< of a value: 'I' or 'P'
  std::string_view name = {};
  std::vector<std::string_view> names = {};
  std::int64_t first = 0;
  std::int64_t last = 0;
  Expression expression = {};
};

struct FunctionText {
  std::string_view name;
  bool exported = false;                     ///< extern "C"
  std::vector<std::string_view> parameters;  ///< pointers; empty where unnamed
  std::vector<Statement> body;
};

/// What a constant table is made of: braces, or a name, number or string.
struct Initialiser {
  enum class Kind : std::uint8_t { kList, kName, kInteger, kDouble, kString };
  Kind kind = Kind::kList;
  std::vector<Initialiser> list = {};
  std::string_view text = {};
  double number = 0;
  std::int64_t integer = 0;
};

/// const type name = value; or, an array, const type name[] = value;
struct TableText {
  std::string_view type;
  std::string_view name;
  bool array = false;
  bool exported = false;  ///< extern "C"
  Initialiser value;
};

struct KernelText {
  std::vector<FunctionText> functions;
  std::vector<TableText> tables;
};

}  // namespace regulus::codegen::reader
