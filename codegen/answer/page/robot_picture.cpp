// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page/robot_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "codegen/answer/page/page_template.hpp"
#include "codegen/model/drawing.hpp"

namespace regulus::detail {
namespace {

using Kind = Drawing::Kind;
using Place = std::array<double, 3>;

constexpr double kWidth = 320, kHeight = 240, kMargin = 26;
/// Lengths of what is drawn about a point, as parts of the robot's size.
constexpr double kJoint = 0.06, kTool = 0.14;
constexpr std::array<const char*, 3> kToolColours = {"#cc79a7", "#009e73", "#0072b2"};

/// The values of expressions at the middle of the motion.
class MiddleOfMotion {
 public:
  explicit MiddleOfMotion(const Request& request) {
    for (const GeometryParameter& g : request.model.geometry) values_[g.symbol] = g.value;
    for (const MotionParameter& p : request.motion.parameters)
      values_[p.symbol] = (p.range.lo + p.range.hi) / 2;
    GiNaC::exmap pose;
    for (std::size_t i = 0; i < request.motion.pose.size(); ++i)
      pose[request.model.pose[i].symbol] = request.motion.pose[i].subs(values_);
    for (const auto& [symbol, value] : pose) values_[symbol] = value;
  }

  /// NaN where there is none.
  [[nodiscard]] Place at(const Point& point) const {
    Place place{};
    for (std::size_t i = 0; i < 3; ++i) {
      const GiNaC::ex value = point[i].subs(values_).evalf();
      const bool is_real =
          GiNaC::is_a<GiNaC::numeric>(value) && value.info(GiNaC::info_flags::real);
      place[i] = is_real ? GiNaC::ex_to<GiNaC::numeric>(value).to_double()
                         : std::numeric_limits<double>::quiet_NaN();
    }
    return place;
  }

 private:
  GiNaC::exmap values_;
};

struct DrawnPart {
  Kind kind;
  std::vector<Place> points;
};

bool is_plate(Kind kind) { return kind == Kind::kBase || kind == Kind::kPlatform; }
bool has_direction(Kind kind) { return kind == Kind::kJoint || kind == Kind::kTool; }

Place combined(const Place& a, double s, const Place& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

const char* colour_of(Kind kind) {
  switch (kind) {
    case Kind::kBase:
    case Kind::kRail:
      return "#8a8f98";
    case Kind::kPlatform:
      return "#aa6f98";
    case Kind::kLeg:
      return "#2f8f9d";
    case Kind::kLink:
      return "#5f7fb8";
    case Kind::kJoint:
    case Kind::kTool:
      return "#3d4450";
  }
  return "";
}

/// From above a robot in the plane, otherwise from the right, before it and above.
class View {
 public:
  explicit View(const std::vector<DrawnPart>& parts) {
    std::vector<Place> places;
    for (const DrawnPart& part : parts)
      places.insert(places.end(), part.points.begin(),
                    has_direction(part.kind) ? part.points.begin() + 1 : part.points.end());
    const auto [low, high] = std::ranges::minmax(places, {}, [](const Place& p) { return p[2]; });
    if (low[2] == high[2]) axes_ = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<double, 2> least{}, most{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto [lo, hi] =
          std::ranges::minmax(places, {}, [&](const Place& p) { return along(axis, p); });
      least[axis] = along(axis, lo);
      most[axis] = along(axis, hi);
      middle_[axis] = (least[axis] + most[axis]) / 2;
    }
    size_ = std::hypot(most[0] - least[0], most[1] - least[1]);
    scale_ = std::min((kWidth - 2 * kMargin) / std::max(most[0] - least[0], 1e-9 * size_),
                      (kHeight - 2 * kMargin) / std::max(most[1] - least[1], 1e-9 * size_));
  }

  [[nodiscard]] bool is_empty() const { return !(size_ > 0) || !std::isfinite(scale_); }
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] double depth(const Place& p) const { return along(2, p); }
  [[nodiscard]] std::string text(const Place& p) const {
    return fmt::format("{:.1f},{:.1f}", kWidth / 2 + scale_ * (along(0, p) - middle_[0]),
                       kHeight / 2 - scale_ * (along(1, p) - middle_[1]));
  }

 private:
  [[nodiscard]] double along(std::size_t axis, const Place& p) const {
    return axes_[axis][0] * p[0] + axes_[axis][1] * p[1] + axes_[axis][2] * p[2];
  }

  /// Across, up, and to the reader: unit vectors.
  std::array<Place, 3> axes_ = {
      {{0.8074, 0.5900, 0}, {-0.2205, 0.3018, 0.9276}, {0.5473, -0.7489, 0.3737}}};
  std::array<double, 2> middle_{};
  double size_ = 0, scale_ = 1;
};

class Picture {
 public:
  explicit Picture(const View& view) : view_(view) {}

  void add(const DrawnPart& part) {
    const std::vector<Place>& p = part.points;
    if (is_plate(part.kind)) return add_plate(part);
    if (part.kind == Kind::kTool) {
      for (std::size_t k = 0; k < 3; ++k)
        add_line(p[0], from(p[0], p[k + 1], kTool), kToolColours[k], 2.5);
    } else if (part.kind == Kind::kJoint) {
      add_line(from(p[0], p[1], -kJoint), from(p[0], p[1], kJoint), colour_of(part.kind), 8);
    } else {
      for (std::size_t i = 0; i + 1 < p.size(); ++i)
        add_line(p[i], p[i + 1], colour_of(part.kind), part.kind == Kind::kRail ? 2 : 4);
    }
  }

  [[nodiscard]] std::string text(const std::string& name) {
    std::ranges::stable_sort(shapes_, {}, &Shape::depth);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
        "height=\"{1}\" role=\"img\" aria-label=\"{2}\" stroke-linecap=\"round\">",
        kWidth, kHeight, html_text(name));
    for (const Shape& shape : shapes_) svg += shape.text;
    return svg + "</svg>";
  }

 private:
  struct Shape {
    double depth;
    std::string text;
  };

  /// The point before or behind `a` in the direction of `b`, one unit of length away.
  [[nodiscard]] Place from(const Place& a, const Place& b, double part) const {
    return combined(a, part * view_.size(), combined(b, -1, a));
  }

  void add_line(const Place& a, const Place& b, const char* colour, double width) {
    shapes_.push_back({(view_.depth(a) + view_.depth(b)) / 2,
                       fmt::format("<polyline points=\"{} {}\" stroke=\"{}\" stroke-width=\"{}\"/>",
                                   view_.text(a), view_.text(b), colour, width)});
  }

  void add_plate(const DrawnPart& part) {
    std::string corners;
    double depth = std::numeric_limits<double>::infinity();
    for (const Place& p : part.points) {
      corners += (corners.empty() ? "" : " ") + view_.text(p);
      depth = std::min(depth, view_.depth(p));
    }
    shapes_.push_back(
        {depth, fmt::format("<polygon points=\"{0}\" fill=\"{1}\" fill-opacity=\"0.35\" "
                            "stroke=\"{1}\" stroke-width=\"3\"/>",
                            corners, colour_of(part.kind))});
  }

  const View& view_;
  std::vector<Shape> shapes_;
};

bool is_finite(const DrawnPart& part) {
  return std::ranges::all_of(part.points, [](const Place& p) {
    return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
  });
}

}  // namespace

std::string robot_picture(const Request& request) {
  const bool has_pose = !request.motion.trajectory && !request.motion.has_no_pose();
  if (!request.model.drawing || request.model.closure || !has_pose) return "";
  const MiddleOfMotion middle(request);
  std::vector<DrawnPart> parts;
  for (const Drawing::Part& part : request.model.drawing->parts) {
    DrawnPart drawn{part.kind, {}};
    for (const Point& point : part.points) drawn.points.push_back(middle.at(point));
    if (is_finite(drawn)) parts.push_back(std::move(drawn));
  }
  if (parts.empty()) return "";
  const View view(parts);
  if (view.is_empty()) return "";
  Picture picture(view);
  for (const DrawnPart& part : parts) picture.add(part);
  return picture.text(request.model.name);
}

}  // namespace regulus::detail
