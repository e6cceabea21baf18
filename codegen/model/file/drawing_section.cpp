// SPDX-License-Identifier: GPL-3.0-or-later
// [drawing]: the points that show a robot whose matrix is given, and the parts between them.
#include <array>
#include <map>
#include <memory>

#include "codegen/model/drawing.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

using Kind = Drawing::Kind;

class DrawingReader {
 public:
  DrawingReader(ModelReading& reading, const TomlEntry& entry)
      : reading_(reading), toml_(reading.toml), entry_(entry) {}

  Drawing read() {
    static const std::array<std::string, 5> kKeys = {"points", "base", "platform", "legs", "links"};
    (void)toml_.entries(entry_, kKeys);
    for (const TomlEntry& given : toml_.entries(toml_.required(entry_, "points")))
      read_point(given);
    read_body("base", Kind::kBase);
    read_body("platform", Kind::kPlatform);
    read_lines("legs", Kind::kLeg, true);
    read_lines("links", Kind::kLink, false);
    if (drawing_.parts.empty())
      toml_.reject(entry_, "[drawing] has points but no parts",
                   "add one of base, platform, legs and links");
    return std::move(drawing_);
  }

 private:
  void read_point(const TomlEntry& given) {
    const auto coordinates = toml_.elements(given, "2 or 3 coordinates");
    if (coordinates.size() != 2 && coordinates.size() != 3)
      toml_.refuse(given, std::to_string(coordinates.size()) + " coordinates in " + given.path,
                   "2 or 3");
    Point point = {0, 0, 0};
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      const ParsedExpression term = toml_.expression(coordinates[i], reading_.names);
      reading_.count(term, coordinates[i]);
      point[i] = term.value;
    }
    points_.emplace(given.key, point);
  }

  std::vector<Point> read_points(const TomlEntry& list, std::size_t least) {
    const std::string expected = "a list of at least " + std::to_string(least) + " names of points";
    std::vector<Point> result;
    for (const TomlEntry& given : toml_.elements(list, expected)) {
      const std::string word = toml_.text(given, "the name of a point");
      const auto found = points_.find(word);
      if (found == points_.end())
        toml_.reject(given, "there is no point " + in_quotes(word),
                     "declare it in points of [drawing]");
      result.push_back(found->second);
    }
    if (result.size() < least)
      toml_.refuse(list, std::to_string(result.size()) + " points in " + list.path, expected);
    return result;
  }

  void read_body(const char* key, Kind kind) {
    if (const TomlEntry list = toml_.optional(entry_, key); list.node)
      drawing_.parts.push_back({kind, read_points(list, 1)});
  }

  /// `of_rows`: the first line belongs to the first row of the matrix, and so on.
  void read_lines(const char* key, Kind kind, bool of_rows) {
    const TomlEntry lists = toml_.optional(entry_, key);
    if (!lists.node) return;
    int row = 0;
    const int rows = static_cast<int>(reading_.model.matrix.rows());
    for (const TomlEntry& list : toml_.elements(lists, "a list of lists of points")) {
      drawing_.parts.push_back({kind, read_points(list, 2), of_rows && row < rows ? row : -1});
      ++row;
    }
  }

  ModelReading& reading_;
  const TomlReader& toml_;
  const TomlEntry& entry_;
  std::map<std::string, Point> points_;
  Drawing drawing_;
};

}  // namespace

void read_drawing(ModelReading& reading, const TomlEntry& drawing) {
  reading.model.drawing = std::make_shared<Drawing>(DrawingReader(reading, drawing).read());
}

}  // namespace regulus::detail
