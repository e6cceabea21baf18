// SPDX-License-Identifier: GPL-3.0-or-later
// [matrix]: m rows of n entries, m ≥ n, and the row scales.
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/edited_note.hpp"
#include "codegen/model/exact/domain.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/reduced_note.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kLargestMatrix = 64;

ParsedExpression read_entry(ModelReading& reading, const TomlEntry& entry) {
  ParsedExpression term = reading.toml.expression(entry, reading.names);
  reading.count(term, entry);
  append(reading.model.must_be_defined, term.must_be_defined);
  return term;
}

void check_shape(const TomlReader& toml, const TomlEntry& rows, std::size_t m, std::size_t n) {
  const std::string shape = std::to_string(m) + " rows of " + std::to_string(n) + " entries";
  if (n == 0 || m > kLargestMatrix || n > kLargestMatrix)
    toml.refuse(rows, shape + " in " + rows.path, "1 to " + std::to_string(kLargestMatrix));
  if (m < n) toml.refuse(rows, shape + " in " + rows.path, "at least as many rows as columns");
}

void read_rows(ModelReading& reading, const TomlEntry& entry) {
  const TomlReader& toml = reading.toml;
  const auto rows = toml.elements(entry, "a list of rows");
  const std::size_t n =
      rows.empty() ? 0 : toml.elements(rows.front(), "a row: a list of entries").size();
  check_shape(toml, entry, rows.size(), n);
  reading.model.matrix =
      GiNaC::matrix(static_cast<unsigned>(rows.size()), static_cast<unsigned>(n));
  for (unsigned i = 0; i < rows.size(); ++i) {
    const auto entries = toml.elements(rows[i], "a row: a list of entries");
    if (entries.size() != n)
      toml.refuse(rows[i], std::to_string(entries.size()) + " entries in " + rows[i].path,
                  std::to_string(n) + ", as in the first row");
    for (unsigned j = 0; j < n; ++j)
      reading.model.matrix(i, j) = read_entry(reading, entries[j]).value;
  }
}

/// A scale that is 0 or changes sign would make J⁻¹ singular at points where the matrix is regular.
void require_positive_scale(ModelReading& reading, const TomlEntry& entry,
                            const ParsedExpression& scale) try {
  ParsedExpression conditions;
  require_positive(conditions, scale.value, scale.constant);
  append(reading.model.must_be_defined, conditions.must_be_defined);
} catch (const ParseRefusal&) {
  reading.toml.refuse(entry, "a factor that is not positive in " + entry.path,
                      "a positive row scale");
}

void read_row_scale(ModelReading& reading, const TomlEntry& entry) {
  const auto scales = reading.toml.elements(entry, "a list of factors, one per row");
  if (scales.size() != reading.model.matrix.rows())
    reading.toml.refuse(entry, std::to_string(scales.size()) + " factors in " + entry.path,
                        std::to_string(reading.model.matrix.rows()) + ", one per row");
  for (const TomlEntry& scale : scales) {
    const ParsedExpression term = read_entry(reading, scale);
    require_positive_scale(reading, scale, term);
    reading.model.row_scale.push_back(term.value);
  }
}

/// The number of rows that motors drive; they come first.
void read_motors(ModelReading& reading, const TomlEntry& entry) {
  const std::size_t rows = reading.model.matrix.rows();
  const auto* const number = entry.node->as_integer();
  if (!number || number->get() < 1 || std::size_t(number->get()) > rows)
    reading.toml.refuse(entry,
                        "the number of rows that motors drive, 1 to " + std::to_string(rows));
  reading.model.motors.emplace();
  for (std::size_t i = 1; i <= std::size_t(number->get()); ++i)
    reading.model.motors->push_back({i, ""});
}

}  // namespace

void read_matrix(ModelReading& reading, const TomlEntry& matrix) {
  static const std::array<std::string, 6> kKeys = {"rows",    "row_scale", "twist",
                                                   "reduced", "edited",    "motors"};
  (void)reading.toml.entries(matrix, kKeys);
  read_rows(reading, reading.toml.required(matrix, "rows"));
  const TomlEntry scale = reading.toml.optional(matrix, "row_scale");
  if (scale.node) read_row_scale(reading, scale);
  const TomlEntry motors = reading.toml.optional(matrix, "motors");
  if (motors.node) read_motors(reading, motors);
  const TomlEntry twist = reading.toml.optional(matrix, "twist");
  if (twist.node) read_twist_names(reading, twist);
  const TomlEntry reduced = reading.toml.optional(matrix, "reduced");
  if (reduced.node)
    reading.model.matrix_notes.push_back(std::string(kReduced) + reading.toml.label(reduced));
  const TomlEntry edited = reading.toml.optional(matrix, "edited");
  if (edited.node)
    reading.model.matrix_notes.push_back(std::string(kEdited) + reading.toml.label(edited));
}

}  // namespace regulus::detail
