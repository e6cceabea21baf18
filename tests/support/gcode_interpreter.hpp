// SPDX-License-Identifier: GPL-3.0-or-later
// Interprets a program in G-code as RS274/NGC does, and shares nothing with the readers. It knows more
// than they do: origins (G92), radii (R), further turns (P). Numbers are doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace regulus::detail::test {

/// The way between two points in mm, as places at equal steps.
struct MachineMove {
  static constexpr int kSteps = 4;
  int line = 0;
  std::array<std::array<double, 3>, kSteps + 1> places{};
  double miss = 0;  ///< the difference of the radii at the ends of an arc
};

class GcodeInterpreter {
 public:
  /// Returns the moves from the first whole position on; nullopt if the machine stops with an error,
  /// or if what it does is not in the program alone.
  static std::optional<std::vector<MachineMove>> run(const std::string& text) try {
    GcodeInterpreter machine;
    machine.interpret(text);
    return machine.moves_;
  } catch (const std::domain_error&) {
    return std::nullopt;
  }

 private:
  using Point = std::array<double, 3>;

  static void demand(bool condition) {
    if (!condition) throw std::domain_error("the machine stops");
  }

  void interpret(const std::string& text) {
    std::istringstream lines(text);
    bool framed = false, begun = false;
    for (std::string line; !over_ && std::getline(lines, line);) {
      ++line_;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      std::string bare;
      for (const char c : line)
        if (c != ' ' && c != '\t') bare += c;
      if (bare == "%") {
        demand(!begun || framed);
        if (framed) return;
        framed = true;
      } else if (!bare.empty()) {
        block(line);
      }
      begun = begun || !bare.empty();
    }
  }

  /// Splits a line without its comments, then does what its words say, step by step.
  void block(const std::string& line) {
    codes_.clear();
    values_.clear();
    std::size_t i = 0;
    while (i < line.size()) {
      const char c = char(std::toupper(static_cast<unsigned char>(line[i])));
      if (c == ';' || c == '(') {
        const std::size_t close = c == ';' ? line.size() : line.find_first_of("()", i + 1);
        demand(c == ';' || (close != std::string::npos && line[close] == ')'));
        demand(!is_active(line.substr(i + 1, close - i - 1)));
        i = std::min(close + 1, line.size());
        continue;
      }
      ++i;
      if (c == ' ' || c == '\t') continue;
      demand('A' <= c && c <= 'Z');
      while (i < line.size() && (line[i] == ' ' || line[i] == '\t')) ++i;
      std::string digits;
      while (i < line.size() &&
             (std::isdigit(line[i]) || line[i] == '.' || line[i] == '-' || line[i] == '+'))
        digits += line[i++];
      word(c, digits);
    }
    execute();
  }

  /// LinuxCNC runs Python in comments, and ends a program.
  static bool is_active(const std::string& comment) {
    std::string name;
    for (const char c : comment.substr(0, comment.find(',')))
      if (c != ' ' && c != '\t') name += char(std::toupper(static_cast<unsigned char>(c)));
    return comment.find(',') != std::string::npos && (name == "PY" || name == "ABORT");
  }

  void word(char letter, const std::string& digits) {
    std::size_t used = 0;
    double value = 0;
    try {
      value = std::stod(digits, &used);
    } catch (const std::exception&) {
      demand(false);
    }
    demand(used == digits.size());
    if (letter == 'N') {
      demand(codes_.empty() && values_.empty() && digits.find_first_of("+-.") == std::string::npos);
      demand(values_.emplace('N', value).second);
    } else if (letter == 'G' || letter == 'M') {
      const double tenths = value * 10;
      demand(std::fabs(tenths - std::round(tenths)) < 1e-9);
      const int code = int(std::lround(tenths));
      demand(codes_.insert({letter, code}).second);
    } else {
      demand(values_.emplace(letter, value).second);
    }
  }

  bool has(char letter) const { return values_.count(letter) != 0; }

  /// Returns the code of the line among these; −1: none. Two of them are an error.
  int one_of(char letter, std::initializer_list<int> group) {
    int found = -1;
    for (const int code : group)
      if (codes_.erase({letter, code}) != 0) {
        demand(found < 0);
        found = code;
      }
    return found;
  }

  void execute() {
    const int stop = one_of('M', {0, 10, 20, 300});
    one_of('M', {30, 40, 50});  // the spindle
    one_of('M', {70, 80, 90});  // the coolant
    one_of('M', {480, 490});    // overrides
    one_of('G', {940, 950});    // the feed
    const int spindle = one_of('G', {960, 970});
    const int special = one_of('G', {40, 920});  // group 0: dwell, origin
    if (const int plane = one_of('G', {170, 180, 190}); plane >= 0) plane_ = plane;
    if (const int unit = one_of('G', {200, 210}); unit >= 0) scale_ = unit == 200 ? 25.4 : 1;
    one_of('G', {400});
    one_of('G', {490});
    one_of('G', {540});
    one_of('G', {610});
    if (const int distance = one_of('G', {900, 910}); distance >= 0) relative_ = distance == 910;
    if (const int centres = one_of('G', {901, 911}); centres >= 0) absolute_ = centres == 901;
    const int motion = one_of('G', {0, 10, 20, 30, 800});
    demand(codes_.empty());
    for (const auto& [letter, value] : values_) {
      demand(std::string("NXYZIJKRFSTPD").find(letter) != std::string::npos);
      demand(std::string("FSTPD").find(letter) == std::string::npos || value >= 0);
    }
    demand(!has('T') || values_['T'] == std::floor(values_['T']));
    demand(special != 40 || has('P'));
    demand(!has('D') || spindle == 960);
    const bool axes = has('X') || has('Y') || has('Z');
    const bool centre = has('I') || has('J') || has('K') || has('R');
    if (motion >= 0) motion_ = motion;
    if (special == 920) {
      demand(axes && !centre && motion < 0);
      set_origin();
    } else if (axes || centre || motion == 20 || motion == 30) {
      demand(motion_ >= 0 && motion_ != 800);
      motion_ < 20 ? straight(centre) : arc(special == 40);
    }
    demand(!has('P') || special == 40 || motion_ == 20 || motion_ == 30);
    over_ = stop >= 20;
  }

  /// G92: the place has the coordinates of the words from now on.
  void set_origin() {
    for (int k = 0; k < 3; ++k)
      if (has("XYZ"[k])) {
        demand(!std::isnan(here_[k]));
        origin_[k] = here_[k] - values_["XYZ"[k]] * scale_;
      }
  }

  Point target() {
    Point to = here_;
    for (int k = 0; k < 3; ++k)
      if (has("XYZ"[k])) {
        const double value = values_["XYZ"[k]] * scale_;
        demand(!relative_ || !std::isnan(here_[k]));
        to[k] = relative_ ? here_[k] + value : origin_[k] + value;
      }
    return to;
  }

  static bool is_known(const Point& p) { return !std::isnan(p[0] + p[1] + p[2]); }

  void straight(bool has_centre) {
    demand(!has_centre);
    const Point from = here_, to = target();
    here_ = to;
    if (!is_known(from)) return;
    MachineMove move;
    move.line = line_;
    double length = 0;
    for (int k = 0; k < 3; ++k) length = std::fmax(length, std::fabs(to[k] - from[k]));
    for (int step = 0; step <= MachineMove::kSteps; ++step)
      for (int k = 0; k < 3; ++k)
        move.places[step][k] = from[k] + (to[k] - from[k]) * step / MachineMove::kSteps;
    if (length > 1e-9) moves_.push_back(move);
  }

  void arc(bool dwells) {
    demand(is_known(here_) && !(dwells && has('P')));
    const Point from = here_, to = target();
    const int c = plane_ == 170 ? 2 : plane_ == 180 ? 1 : 0, a = (c + 1) % 3, b = (c + 2) % 3;
    const bool clockwise = motion_ == 20;
    demand(!has("IJK"[c]));
    const auto [x, y] = has('R') ? centre_of_radius(from[a], from[b], to[a], to[b], clockwise)
                                 : centre_of_words(from, a, b);
    const double first = std::hypot(from[a] - x, from[b] - y);
    const double last = std::hypot(to[a] - x, to[b] - y);
    demand(first > 0 && last > 0 && std::fabs(first - last) <= std::fmax(0.5, 1e-2 * first));
    const double begin = std::atan2(from[b] - y, from[a] - x);
    double end = std::atan2(to[b] - y, to[a] - x);
    constexpr double kFuzz = 1e-7;
    if (clockwise)
      while (end - begin > -kFuzz) end -= 2 * M_PI;
    else
      while (end - begin < kFuzz) end += 2 * M_PI;
    if (has('P')) {
      demand(values_['P'] >= 1 && values_['P'] == std::floor(values_['P']));
      end += (clockwise ? -2 : 2) * M_PI * (values_['P'] - 1);
    }
    MachineMove move;
    move.line = line_;
    move.miss = std::fabs(first - last);
    for (int step = 0; step <= MachineMove::kSteps; ++step) {
      const double s = double(step) / MachineMove::kSteps;
      const double angle = begin + (end - begin) * s, radius = first + (last - first) * s;
      move.places[step][a] = x + radius * std::cos(angle);
      move.places[step][b] = y + radius * std::sin(angle);
      move.places[step][c] = from[c] + (to[c] - from[c]) * s;
    }
    moves_.push_back(move);
    here_ = to;
  }

  std::array<double, 2> centre_of_words(const Point& from, int a, int b) {
    demand(has("IJK"[a]) || has("IJK"[b]));
    if (!absolute_)
      return {from[a] + values_["IJK"[a]] * scale_, from[b] + values_["IJK"[b]] * scale_};
    demand(has("IJK"[a]) && has("IJK"[b]));
    return {origin_[a] + values_["IJK"[a]] * scale_, origin_[b] + values_["IJK"[b]] * scale_};
  }

  /// Of the two circles the shorter arc, or the longer one for a negative radius.
  std::array<double, 2> centre_of_radius(double x0, double y0, double x1, double y1,
                                         bool clockwise) {
    demand(!has('I') && !has('J') && !has('K'));
    const double radius = values_['R'] * scale_, half = std::hypot(x1 - x0, y1 - y0) / 2;
    demand(half > 0 && std::fabs(radius) >= half);
    const double height = std::sqrt(radius * radius - half * half) / (2 * half);
    const double side = clockwise == (radius > 0) ? -1 : 1;
    return {(x0 + x1) / 2 - side * height * (y1 - y0), (y0 + y1) / 2 + side * height * (x1 - x0)};
  }

  std::vector<MachineMove> moves_;
  std::set<std::pair<char, int>> codes_;
  std::map<char, double> values_;
  Point here_{NAN, NAN, NAN}, origin_{};
  double scale_ = 1;
  int line_ = 0, motion_ = -1, plane_ = 170;
  bool relative_ = false, absolute_ = false, over_ = false;
};

}  // namespace regulus::detail::test
