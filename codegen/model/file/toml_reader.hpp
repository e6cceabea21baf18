// SPDX-License-Identifier: GPL-3.0-or-later
// Typed access to a TOML document: an entry that is missing, misspelt or of the wrong type becomes
// an InputError with its place.
#pragma once

#include <toml++/toml.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/file/source_lines.hpp"

namespace regulus::detail {

/// An entry of a table, with its full key for messages ("motion.small.x").
struct TomlEntry {
  std::string key;
  std::string path;
  const toml::node* node = nullptr;
  int line = 0;
};

class TomlReader {
 public:
  /// `text` is the text that the nodes were parsed from; it must outlive the reader.
  TomlReader(std::string file, std::string_view text) : file_(std::move(file)), source_(text) {}

  /// Returns the entries in the order of the file. TOML tables have no order, but the pose needs
  /// one.
  [[nodiscard]] std::vector<TomlEntry> entries(const TomlEntry& table) const;

  /// Returns the entries; refuses one that is not named in `known`.
  [[nodiscard]] std::vector<TomlEntry> entries(const TomlEntry& table,
                                               std::span<const std::string> known) const;

  /// Returns the entry of that key; refuses a table without it.
  [[nodiscard]] TomlEntry required(const TomlEntry& table, const std::string& key) const;

  /// Returns the entry of that key; its node is null if there is none.
  [[nodiscard]] TomlEntry optional(const TomlEntry& table, const std::string& key) const;

  /// Returns the elements of an array.
  [[nodiscard]] std::vector<TomlEntry> elements(const TomlEntry& array,
                                                const std::string& expected) const;

  [[nodiscard]] std::string text(const TomlEntry& entry, const std::string& expected) const;

  /// Returns a text that can appear in a report: see is_label.
  [[nodiscard]] std::string label(const TomlEntry& entry) const;

  /// Returns a text that is a name and is not reserved.
  [[nodiscard]] std::string name(const TomlEntry& entry) const;

  /// Reads a number, or an expression in a string. A number is exact to the last digit, because it
  /// is read from the text of the file.
  [[nodiscard]] ParsedExpression expression(const TomlEntry& entry, Names& names,
                                            NumberUnit unit = NumberUnit::kPlain) const;
  [[nodiscard]] ParsedExpression constant(const TomlEntry& entry,
                                          NumberUnit unit = NumberUnit::kPlain) const;

  [[nodiscard]] Place place(const TomlEntry& entry) const;

  [[noreturn]] void refuse(const TomlEntry& entry, const std::string& found,
                           const std::string& expected) const;

  /// The same, with the entry itself as the text that was found.
  [[noreturn]] void refuse(const TomlEntry& entry, const std::string& expected) const;

  /// Throws an error that is not one of syntax: "PROBLEM; REMEDY".
  [[noreturn]] void reject(const TomlEntry& entry, const std::string& problem,
                           const std::string& remedy) const;

 private:
  [[nodiscard]] const toml::table& table_of(const TomlEntry& entry) const;
  [[nodiscard]] ParsedExpression number_of(const TomlEntry& entry) const;
  [[nodiscard]] std::string_view literal_of(const TomlEntry& entry) const;

  std::string file_;
  SourceLines source_;
};

}  // namespace regulus::detail
