// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/exact_orientation.hpp"

#include "codegen/model/constants.hpp"
#include "codegen/model/mechanism/rotation.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

std::vector<ex> constants(ModelReading& reading, const TomlEntry& list, std::size_t count) {
  std::vector<ex> result;
  for (const TomlEntry& given : elements_of(reading.toml, list, count)) {
    const ParsedExpression term = reading.toml.constant(given);
    append(reading.model.must_be_defined, term.must_be_defined);
    result.push_back(term.value);
  }
  return result;
}

/// Returns the sum of the squares; refuses a vector that is not proved to differ from zero.
ex squared_length(const TomlReader& toml, const TomlEntry& list, const std::vector<ex>& v) {
  ex square = 0;
  for (const ex& component : v) square += pow(component, 2);
  square = reduced(square);
  if (!is_certainly_nonzero(square))
    toml.reject(list, list.path + " is zero, or cannot be told from zero",
                "it must have a direction");
  return square;
}

}  // namespace

std::vector<TomlEntry> elements_of(const TomlReader& toml, const TomlEntry& list,
                                   std::size_t count) {
  const std::string expected = std::to_string(count) + " numbers";
  auto found = toml.elements(list, expected);
  if (found.size() != count)
    toml.refuse(list, std::to_string(found.size()) + " numbers in " + list.path, expected);
  return found;
}

Point read_unit_vector(ModelReading& reading, const TomlEntry& list) {
  const std::vector<ex> v = constants(reading, list, 3);
  const ex length = GiNaC::sqrt(squared_length(reading.toml, list, v));
  return reduced(Point{v[0] / length, v[1] / length, v[2] / length});
}

GiNaC::matrix read_quaternion(ModelReading& reading, const TomlEntry& list) {
  const std::vector<ex> q = constants(reading, list, 4);
  const ex square = squared_length(reading.toml, list, q);
  GiNaC::matrix R = scaled_rotation_quaternion(q[0], q[1], q[2], q[3]);
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j) R(i, j) = reduced(reduced(R(i, j)) / square);
  return R;
}

GiNaC::matrix read_rotation(ModelReading& reading, const TomlEntry& list) {
  const auto rows = reading.toml.elements(list, "3 rows of 3 numbers");
  if (rows.size() != 3)
    reading.toml.refuse(list, std::to_string(rows.size()) + " rows in " + list.path, "3 rows");
  GiNaC::matrix R(3, 3);
  for (unsigned i = 0; i < 3; ++i) {
    const std::vector<ex> row = constants(reading, rows[i], 3);
    for (unsigned j = 0; j < 3; ++j) R(i, j) = row[j];
  }
  const GiNaC::matrix product = R.mul(R.transpose());
  bool rotation = is_certainly_zero(R.determinant() - 1);
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j)
      rotation = rotation && is_certainly_zero(product(i, j) - (i == j ? 1 : 0));
  if (!rotation)
    reading.toml.reject(list, list.path + " is not proved to be a rotation",
                        "its numbers must be exact; rpy and quaternion always give a rotation");
  return R;
}

}  // namespace regulus::detail
