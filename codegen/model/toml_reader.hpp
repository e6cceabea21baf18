// SPDX-License-Identifier: GPL-3.0-or-later
// Typed access to a TOML document: whatever is missing, misspelt or of the wrong type becomes an
// InputError that says where.
#pragma once

#include <toml++/toml.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/expression_parser.hpp"
#include "codegen/model/source_lines.hpp"

namespace regulus::inline model {

/// An entry of a table, with its full key for messages ("motion.small.x").
struct TomlEntry {
  std::string key;
  std::string path;
  const toml::node* node = nullptr;
  int line = 0;
};

class TomlReader {
 public:
  /// `text`, which must outlive the reader, is what the nodes were parsed from.
  TomlReader(std::string file, std::string_view text) : file_(std::move(file)), source_(text) {}

  /// The entries in the order of the file, which the pose relies on; TOML tables have none.
  [[nodiscard]] std::vector<TomlEntry> entries(const TomlEntry& table) const;

  /// The entries, all of which must be named in `known`.
  [[nodiscard]] std::vector<TomlEntry> entries(const TomlEntry& table,
                                               std::span<const std::string> known) const;

  /// The entry of that key; refused when missing.
  [[nodiscard]] TomlEntry required(const TomlEntry& table, const std::string& key) const;

  /// The entry of that key; its node is null when missing.
  [[nodiscard]] TomlEntry optional(const TomlEntry& table, const std::string& key) const;

  /// The elements of an array.
  [[nodiscard]] std::vector<TomlEntry> elements(const TomlEntry& array,
                                                const std::string& expected) const;

  [[nodiscard]] std::string text(const TomlEntry& entry, const std::string& expected) const;

  /// A text that can stand in a report: see is_label.
  [[nodiscard]] std::string label(const TomlEntry& entry) const;

  /// A text that is a name and is not taken by the language.
  [[nodiscard]] std::string name(const TomlEntry& entry) const;

  /// A number, or an expression in a string. A number is the one that is written, to the last
  /// digit: it is read from the text of the file.
  [[nodiscard]] ParsedExpression expression(const TomlEntry& entry, Names& names) const;
  [[nodiscard]] ParsedExpression constant(const TomlEntry& entry) const;

  [[nodiscard]] Place place(const TomlEntry& entry) const;

  [[noreturn]] void refuse(const TomlEntry& entry, const std::string& found,
                           const std::string& expected) const;

  /// The same, what was found being the entry itself.
  [[noreturn]] void refuse(const TomlEntry& entry, const std::string& expected) const;

 private:
  [[nodiscard]] const toml::table& table_of(const TomlEntry& entry) const;
  [[nodiscard]] ParsedExpression number_of(const TomlEntry& entry) const;
  [[nodiscard]] std::string_view literal_of(const TomlEntry& entry) const;

  std::string file_;
  SourceLines source_;
};

}  // namespace regulus::inline model
