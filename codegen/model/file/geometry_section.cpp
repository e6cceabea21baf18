// SPDX-License-Identifier: GPL-3.0-or-later
// [geometry]: a number, or { value, tolerance, group }; a list is a point, in a box or in a ball.
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/file/sections.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMostCoordinates = 16;

/// A constant as in the file, before its coordinates become parameters.
struct Written {
  TomlEntry value;
  GiNaC::ex tolerance = 0;
  std::string group{};
  bool ball = false;
};

class GeometryReader {
 public:
  explicit GeometryReader(ModelReading& reading) : reading_(reading), toml_(reading.toml) {}

  void read(const TomlEntry& entry) {
    const Written written = entry.node->is_table() ? read_table(entry) : Written{entry};
    if (written.value.node->is_array())
      add_point(entry, written);
    else if (written.ball)
      toml_.refuse(entry, "a radius for the single number " + entry.path,
                   "a tolerance, or a list of coordinates as the value");
    else
      add(entry.key, written, written.value, -1);
  }

 private:
  Written read_table(const TomlEntry& entry) {
    static const std::array<std::string, 4> kKeys = {"value", "tolerance", "radius", "group"};
    (void)toml_.entries(entry, kKeys);
    Written written{toml_.required(entry, "value")};
    const TomlEntry tolerance = toml_.optional(entry, "tolerance");
    const TomlEntry radius = toml_.optional(entry, "radius");
    if (tolerance.node && radius.node)
      toml_.refuse(entry, "both a tolerance and a radius in " + entry.path, "one of them");
    written.ball = radius.node != nullptr;
    for (const TomlEntry& given : {tolerance, radius})
      if (given.node) written.tolerance = nonnegative(given);
    const TomlEntry group = toml_.optional(entry, "group");
    if (group.node) written.group = toml_.name(group);
    return written;
  }

  GiNaC::ex nonnegative(const TomlEntry& entry) {
    return checked_nonnegative(constant(entry), toml_.place(entry));
  }

  ParsedExpression constant(const TomlEntry& entry) {
    ParsedExpression term = toml_.constant(entry);
    append(reading_.model.must_be_defined, term.must_be_defined);
    return term;
  }

  void add_point(const TomlEntry& entry, const Written& written) {
    const auto coordinates = toml_.elements(written.value, "a list of coordinates");
    if (coordinates.empty() || coordinates.size() > kMostCoordinates)
      toml_.refuse(entry, std::to_string(coordinates.size()) + " coordinates in " + entry.path,
                   "1 to " + std::to_string(kMostCoordinates));
    Model& model = reading_.model;
    const int index = written.ball ? static_cast<int>(model.balls.size()) : -1;
    ToleranceBall ball{.members = {}, .radius = written.tolerance, .group = written.group};
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      ball.members.push_back(model.geometry.size());
      add(entry.key + "_" + std::to_string(i + 1), written, coordinates[i], index);
    }
    if (written.ball) model.balls.push_back(std::move(ball));
  }

  void add(const std::string& name, const Written& written, const TomlEntry& value, int ball) {
    const GiNaC::realsymbol symbol(name);
    reading_.names.declare(name, variable(symbol), toml_.place(value));
    reading_.model.geometry.push_back(
        {symbol, name, constant(value).value, written.tolerance, written.group, ball});
  }

  ModelReading& reading_;
  const TomlReader& toml_;
};

}  // namespace

void read_geometry(ModelReading& reading, const TomlEntry& geometry) {
  GeometryReader reader(reading);
  for (const TomlEntry& entry : reading.toml.entries(geometry)) reader.read(entry);
}

}  // namespace regulus::detail
