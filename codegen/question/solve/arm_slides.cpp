// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/arm_slides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// So that no posture is at an end.
constexpr double kBeyond = 1 + 0x1p-6;

Interval length(const Vector3& v) { return sqrt(dot(v, v)); }

/// The joints that slide move the end by at most so much together.
Interval reach_of(const ArmAtPlace& arm) {
  Interval reach = length(arm.target.d);
  for (const ArmJoint& joint : arm.chain) reach += length(joint.origin.d);
  return reach;
}

/// The directions of joints that slide, seen from the first; empty: a turn is between them, or they are
/// more than three.
std::vector<Vector3> directions_of(const ArmChain& chain, const std::vector<std::size_t>& slides) {
  if (slides.size() > 3) return {};
  std::vector<Vector3> directions;
  LinkFrame frame;
  for (std::size_t n = 0; n < slides.size(); ++n) {
    if (n > 0 && slides[n] != slides[n - 1] + 1) return {};
    if (n > 0) frame = compose(frame, chain[slides[n]].origin);
    directions.push_back(times(frame.R, chain[slides[n]].axis));
  }
  return directions;
}

/// Bounds |s_n| / |Σ s_k·g_k| over all s; nullopt: the directions may depend on each other.
std::optional<Interval> share_of(const std::vector<Vector3>& g, std::size_t n) {
  if (g.size() == 1) return Interval(1.0);
  const std::size_t i = (n + 1) % g.size(), j = (n + 2) % g.size();
  const Vector3 across = cross(g[i], g[j]);
  // This is the part of g_n across the other one of two, or across both others of three.
  const Interval part = g.size() == 2 ? length(cross(g[0], g[1])) : abs(dot(g[n], across)),
                 whole = g.size() == 2 ? Interval(1.0) : length(across);
  return part.lo > 0 ? std::optional(whole / part) : std::nullopt;
}

/// The range of the model, with the value that the motion gives.
Interval range_of(const Request& request, const ArmUnknown& unknown) {
  const Model& model = request.model;
  const PoseParameter& p = model.pose[unknown.pose];
  if (model.limits.empty() && unknown.is_alone)
    throw UsageError(
        "where joints slide with turns between them, give each joint of the arm a range");
  if (model.limits.empty())
    throw UsageError(
        fmt::format("no number of turns of {} is known that brings back what follows it, so it is "
                    "looked for in "
                    "its range; give each joint of the arm a range",
                    p.name));
  const Range& range = model.limits[unknown.pose];
  const GiNaC::ex unit = unknown.turns && is_in_degrees(p.unit) ? one_degree() : GiNaC::ex(1);
  Interval all =
      hull(enclose_constant(range.lo * unit, "range"), enclose_constant(range.hi * unit, "range"));
  if (request.motion.tool.empty())
    all = hull(all,
               enclose_values(request, model, ArmGeometry::kWithinTolerances)[unknown.pose].value);
  const double room = (kBeyond - 1) * width_ru(all);
  return all + Interval(-room, room);
}

/// True if the reach bounds what slides: no unknown slides two joints, or turns one and slides another.
bool slide_alone(const ArmAtPlace& arm) {
  return std::ranges::all_of(arm.chain, [&](const ArmJoint& joint) {
    return joint.turns || arm.unknowns[joint.unknown].is_alone;
  });
}

}  // namespace

std::map<std::size_t, SlideRange> slide_ranges(const ArmAtPlace& arm, const Request& request) {
  std::vector<std::size_t> slides;
  for (std::size_t k = 0; k < arm.chain.size(); ++k)
    if (!arm.chain[k].turns) slides.push_back(k);
  const std::vector<Vector3> directions =
      slide_alone(arm) ? directions_of(arm.chain, slides) : std::vector<Vector3>{};
  const Interval reach = reach_of(arm);
  std::map<std::size_t, SlideRange> ranges;
  for (std::size_t n = 0; n < slides.size(); ++n) {
    const auto share = directions.empty() ? std::nullopt : share_of(directions, n);
    const double most = share ? (Interval(kBeyond) * *share * reach).hi : 0;
    if (share) ranges[arm.chain[slides[n]].unknown] = SlideRange{Interval(-most, most), true};
  }
  for (std::size_t k = 0; k < arm.unknowns.size(); ++k)
    if (!arm.unknowns[k].is_periodic && !ranges.contains(k))
      ranges[k] = SlideRange{range_of(request, arm.unknowns[k]), false};
  return ranges;
}

}  // namespace regulus::detail
