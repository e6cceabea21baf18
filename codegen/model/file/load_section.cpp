// SPDX-License-Identifier: GPL-3.0-or-later
// [load.NAME] and [twist.NAME]: sets of wrenches and of twists; the names of the matrix's columns.
#include <algorithm>
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/twist.hpp"

namespace regulus::detail {
namespace {

using TwistKind = TwistComponent::Kind;

/// The words of a set: the whole vector, its linear part, and its angular part.
struct SetWords {
  const char* section;
  const char* whole;
  const char* linear;
  const char* angular;
};

constexpr SetWords kLoadWords{"load", "wrench", "force", "moment"};
constexpr SetWords kTwistWords{"twist", "twist", "velocity", "rotation"};

/// Reads one set. Coordinates that it does not give are 0.
class SetReader {
 public:
  SetReader(ModelReading& reading, const SetWords& words, const TomlEntry& entry)
      : reading_(reading), toml_(reading.toml), words_(words), entry_(entry) {}

  VectorSet read() {
    require_free_name(entry_.key, toml_.place(entry_));
    set_.name = entry_.key;
    const std::size_t columns = reading_.model.matrix.cols();
    for (std::size_t i = 0; i < columns; ++i) add_zero(i);
    const std::array<std::string, 3> keys = {words_.whole, words_.linear, words_.angular};
    if (toml_.entries(entry_, keys).empty())
      toml_.refuse(entry_, "nothing in " + entry_.path, alternatives(keys));
    std::vector<std::size_t> all(columns);
    for (std::size_t i = 0; i < columns; ++i) all[i] = i;
    read_part(words_.whole, all);
    read_part(words_.linear, columns_of(TwistKind::kLinear, words_.linear));
    read_part(words_.angular, columns_of(TwistKind::kAngular, words_.angular));
    return std::move(set_);
  }

 private:
  void add_zero(std::size_t column) {
    const std::string name =
        std::string(words_.section) + "_" + set_.name + "_" + std::to_string(column + 1);
    set_.entries.push_back({GiNaC::realsymbol(name), name, 0, 0, set_.name, -1});
  }

  std::vector<std::size_t> columns_of(TwistKind kind, const char* key) const {
    std::vector<std::size_t> columns;
    const TomlEntry part = toml_.optional(entry_, key);
    if (!part.node) return columns;
    const std::vector<TwistComponent> twist = twist_of(reading_.model);
    if (twist.empty())
      toml_.reject(part, "the columns of the matrix have no names",
                   "name them, [matrix] twist = [\"v_x\", …], or write " +
                       std::string(words_.whole) + " = [one value for each column]");
    for (std::size_t i = 0; i < twist.size(); ++i)
      if (twist[i].kind == kind) columns.push_back(i);
    return columns;
  }

  void read_part(const char* key, const std::vector<std::size_t>& columns) {
    const TomlEntry part = toml_.optional(entry_, key);
    if (!part.node) return;
    if (part.node->is_table()) return read_spread(part, columns);
    const auto values = values_of(part, columns);
    for (std::size_t i = 0; i < columns.size(); ++i) read_value(values[i], columns[i]);
  }

  std::vector<TomlEntry> values_of(const TomlEntry& list, const std::vector<std::size_t>& columns) {
    auto values = toml_.elements(list, "a list of values or ranges");
    if (values.size() != columns.size())
      toml_.refuse(list, std::to_string(values.size()) + " values in " + list.path,
                   std::to_string(columns.size()) + ", as many as the matrix has such columns");
    return values;
  }

  /// Reads { value = […], radius = R } or { value = […], tolerance = E }.
  void read_spread(const TomlEntry& part, const std::vector<std::size_t>& columns) {
    static const std::array<std::string, 3> kKeys = {"value", "radius", "tolerance"};
    (void)toml_.entries(part, kKeys);
    const TomlEntry radius = toml_.optional(part, "radius");
    const TomlEntry tolerance = toml_.optional(part, "tolerance");
    if ((radius.node != nullptr) == (tolerance.node != nullptr))
      toml_.refuse(part, "both or neither of radius and tolerance in " + part.path, "one of them");
    const TomlEntry& given = radius.node ? radius : tolerance;
    const GiNaC::ex spread = checked_nonnegative(constant(given), toml_.place(given));
    const auto values = values_of(toml_.required(part, "value"), columns);
    ToleranceBall ball{.members = {}, .radius = spread, .group = set_.name};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      GeometryParameter& entry = set_.entries[columns[i]];
      entry.value = constant(values[i]).value;
      entry.tolerance = spread;
      if (radius.node) entry.ball = static_cast<int>(set_.balls.size());
      ball.members.push_back(columns[i]);
    }
    if (radius.node) set_.balls.push_back(std::move(ball));
  }

  void read_value(const TomlEntry& value, std::size_t column) {
    GeometryParameter& entry = set_.entries[column];
    if (!value.node->is_array()) {
      entry.value = constant(value).value;
      return;
    }
    const auto ends = toml_.elements(value, "a range [lower, upper]");
    if (ends.size() != 2)
      toml_.refuse(value, std::to_string(ends.size()) + " numbers in " + value.path,
                   "a range [lower, upper]");
    const Range range = checked_range(constant(ends[0]), constant(ends[1]), toml_.place(value));
    entry.value = (range.lo + range.hi) / 2;
    entry.tolerance = (range.hi - range.lo) / 2;
  }

  ParsedExpression constant(const TomlEntry& entry) {
    ParsedExpression term = toml_.constant(entry);
    append(reading_.model.must_be_defined, term.must_be_defined);
    return term;
  }

  ModelReading& reading_;
  const TomlReader& toml_;
  const SetWords& words_;
  const TomlEntry& entry_;
  VectorSet set_;
};

void read_sets(ModelReading& reading, const SetWords& words, const TomlEntry& sets,
               std::vector<VectorSet>& all) {
  if (reading.model.matrix_kind != MatrixKind::kInverse)
    reading.toml.reject(sets,
                        "a serial robot's Jacobian is written in a frame of its own, so it "
                        "has no " +
                            std::string(words.section) + "s",
                        "remove the table");
  for (const TomlEntry& entry : reading.toml.entries(sets))
    all.push_back(SetReader(reading, words, entry).read());
}

}  // namespace

void read_loads(ModelReading& reading, const TomlEntry& loads) {
  read_sets(reading, kLoadWords, loads, reading.model.loads);
}

void read_twists(ModelReading& reading, const TomlEntry& twists) {
  read_sets(reading, kTwistWords, twists, reading.model.twists);
}

void read_twist_names(ModelReading& reading, const TomlEntry& names) {
  const TomlReader& toml = reading.toml;
  const auto words = toml.elements(names, "a name for each column");
  if (words.size() != reading.model.matrix.cols())
    toml.refuse(names, std::to_string(words.size()) + " names in " + names.path,
                std::to_string(reading.model.matrix.cols()) + ", one for each column");
  for (const TomlEntry& entry : words) {
    const std::string word = toml.name(entry);
    if (word.front() != 'v' && word.front() != 'w')
      toml.refuse(entry, "a name that begins with v (a velocity) or w (an angular velocity)");
    const bool linear = word.front() == 'v';
    reading.model.twist.push_back({linear ? TwistKind::kLinear : TwistKind::kAngular, word,
                                   linear ? length_unit(reading.model) : "rad"});
  }
}

}  // namespace regulus::detail
