// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/attack.hpp"

namespace regulus::detail::attack {
namespace {

std::string written(const Cell& cell) { return cell.bare ? cell.text : quoted(cell.text); }

template <class Item, class Write>
std::string list_of(const std::vector<Item>& items, Write write) {
  std::string text = "[";
  for (const Item& item : items) {
    if (text.size() > 1) text += ", ";
    text += write(item);
  }
  return text + "]";
}

std::string point(const std::array<Rational, 3>& p) {
  std::string text = "[";
  for (const Rational& x : p) {
    if (text.size() > 1) text += ", ";
    text += x.is_integer() ? x.fraction() : quoted(x.fraction());
  }
  return text + "]";
}

std::string anchors(const std::array<std::array<Rational, 3>, 6>& points) {
  return list_of(std::vector<std::array<Rational, 3>>(points.begin(), points.end()), point);
}

std::string table(const char* title, const std::vector<NamedText>& lines, bool expressions) {
  if (lines.empty()) return "";
  std::string text = std::string("\n[") + title + "]\n";
  for (const NamedText& line : lines)
    text += line.name + " = " + (expressions ? quoted(line.text) : line.text) + '\n';
  return text;
}

std::string robot(const ModelSource& model) {
  std::string text = "\n[pose]\n";
  for (const PoseEntry& entry : model.pose) text += entry.name + " = \"m\"\n";
  text += table("geometry", model.geometry, false) + table("let", model.let, true);
  if (!model.closure.empty()) return text + table("closure", model.closure, false);
  text += "\n[matrix]\nrows = [\n";
  for (const auto& row : model.rows) text += "  " + list_of(row, written) + ",\n";
  text += "]\n";
  if (!model.row_scale.empty()) text += "row_scale = " + list_of(model.row_scale, written) + '\n';
  return text;
}

std::string robot(const Hexapod& hexapod) {
  std::string text = "\n[gough]\norientation = " + quoted(hexapod.orientation) + '\n';
  text += "base = " + anchors(hexapod.base) + '\n';
  text += "platform = " + anchors(hexapod.platform) + '\n';
  for (const NamedText& line : hexapod.toml) text += line.name + " = " + line.text + '\n';
  return text;
}

std::string motion(const ModelSource& model) {
  std::string text = "\n[motion.m]\n";
  if (!model.parameters.empty()) text += "parameters = " + model.parameters + '\n';
  if (!model.way.empty())
    text += "waypoints = \"way.csv\"\n";
  else
    for (const PoseEntry& entry : model.pose) text += entry.name + " = " + entry.toml + '\n';
  if (!model.error.empty())
    text += "error = { " + [&] {
      std::string all;
      for (const NamedText& e : model.error)
        all += (all.empty() ? "" : ", ") + e.name + " = " + e.text;
      return all;
    }() + " }\n";
  if (!model.constraints.empty())
    text += "constraints = " + list_of(model.constraints, quoted) + '\n';
  if (!model.alpha.empty()) text += "alpha = " + model.alpha + '\n';
  return text + model.extra_motion;
}

}  // namespace

const char* name(Truth truth) {
  switch (truth) {
    case Truth::kSingular:
      return "singular";
    case Truth::kRegular:
      return "regular";
    case Truth::kUndefined:
      return "undefined";
    case Truth::kUndefinedOrSingular:
      return "undefined or singular";
    case Truth::kEmpty:
      return "empty";
    case Truth::kRefused:
      return "no model";
  }
  return "";
}

std::string ModelSource::text() const {
  if (!instead.empty()) return instead;
  return "regulus = 1\nname = \"attack\"\n" + (hexapod ? robot(*hexapod) : robot(*this)) +
         motion(*this);
}

}  // namespace regulus::detail::attack
