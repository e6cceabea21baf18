// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_variety.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace regulus::detail {

PathVariety::PathVariety(const PathBounds& path, const Problem& kernel, std::size_t added)
    : path_(path),
      kernel_(kernel),
      moving_(path.moving().size()),
      added_(added),
      own_(kernel.outer.size() - moving_),
      problem_(kernel) {
  const auto all = double(std::bit_ceil(path.pieces()));
  const bool may_be_idle = !kernel.idle.empty();
  problem_.idle.assign(may_be_idle ? 1 : 0, 0);
  problem_.outer = {Interval(0, all)};
  problem_.inner = {Interval(0, double(path.pieces()))};
  for (std::size_t v = moving_; v < kernel.outer.size(); ++v) {
    problem_.outer.push_back(kernel.outer[v]);
    problem_.inner.push_back(kernel.inner[v]);
    if (may_be_idle) problem_.idle.push_back(kernel.idle[v]);
  }
  for (std::size_t m = 0; m < moving_; ++m) {
    const Interval& error = path.errors()[m];
    error_.push_back(error.hi > 0 ? problem_.outer.size() : 0);
    if (error_.back() == 0) continue;
    if (may_be_idle) problem_.idle.push_back(kernel.idle[m]);
    const double certain = path.certain_errors()[m];
    problem_.outer.push_back(error);
    problem_.inner.emplace_back(Interval(-certain, certain));
  }
}

bool PathVariety::is_beyond(const Box& box) const noexcept {
  return box[0].lo >= double(path_.pieces()) && box[0].hi > box[0].lo;
}

std::size_t PathVariety::piece_of(const Box& box) const noexcept {
  return std::min(std::size_t(box[0].lo), path_.pieces() - 1);
}

Interval PathVariety::commanded(const Interval& u, std::size_t m) const noexcept {
  const std::size_t first = std::min(std::size_t(u.lo), path_.pieces() - 1);
  if (is_group(u)) return path_.over_pieces(first, std::size_t(u.hi - u.lo), m);
  // The part of a double beyond its whole part is a double, so both differences are exact.
  return path_.over(first, m, u.lo - double(first), u.hi - double(first));
}

PathVariety::Box PathVariety::on_kernel(const Box& box) const {
  Box poses = kernel_.outer;
  for (std::size_t m = 0; m < moving_; ++m) {
    Interval pose = commanded(box[0], m);
    if (error_[m] != 0) pose = pose + box[error_[m]];
    poses[m] = intersect(pose, kernel_.outer[m]).value_or(kernel_.outer[m]);
  }
  for (std::size_t k = 0; k < own_; ++k) poses[moving_ + k] = box[1 + k];
  return poses;
}

double PathVariety::error_width(const Box& box, std::size_t m) const noexcept {
  return error_[m] == 0 ? 0.0 : box[error_[m]].hi - box[error_[m]].lo;
}

/// The part of its range that a parameter has; the relative width of another quantity, which is small
/// from the beginning.
double PathVariety::weight_of_width(const Box& box, std::size_t variable) const noexcept {
  if (variable < problem_.idle.size() && problem_.idle[variable] != 0) return 0.0;
  const Interval& range = problem_.outer[variable];
  const double width = box[variable].hi - box[variable].lo;
  const double whole =
      variable <= added_ ? range.hi - range.lo : std::max(std::fabs(range.lo), std::fabs(range.hi));
  return whole > 0 ? width / whole : 0.0;
}

std::vector<double> PathVariety::impact(const Box& box, std::span<const double> kernel) const {
  std::vector<double> impact(box.size(), 0.0);
  if (is_group(box[0])) {
    impact[0] = 1;
    return impact;
  }
  const bool is_known = !kernel.empty();
  for (std::size_t m = 0; m < moving_; ++m) {
    const Interval along = commanded(box[0], m);
    const double path = along.hi - along.lo, error = error_width(box, m);
    const double whole = is_known ? path + error : kernel_.outer[m].hi - kernel_.outer[m].lo;
    if (!(whole > 0)) continue;
    const double weight = (is_known ? kernel[m] : 1.0) / whole;
    impact[0] += path * weight;
    if (error_[m] != 0) impact[error_[m]] = error * weight;
  }
  for (std::size_t k = 0; k < own_; ++k)
    impact[1 + k] = is_known ? kernel[moving_ + k] : weight_of_width(box, 1 + k);
  return impact;
}

std::vector<double> PathVariety::slopes(const Box& box, std::span<const double> kernel) const {
  if (kernel.empty()) return {};
  std::vector<double> slopes(box.size(), 0.0);
  for (std::size_t m = 0; m < moving_; ++m) {
    const double begin = mid(commanded(Interval(box[0].lo), m));
    const std::size_t piece = piece_of(box);
    const double end =
        mid(path_.over(piece, m, box[0].hi - double(piece), box[0].hi - double(piece)));
    slopes[0] += kernel[m] * (end - begin);
    if (error_[m] != 0) slopes[error_[m]] = kernel[m];
  }
  for (std::size_t k = 0; k < own_; ++k) slopes[1 + k] = kernel[moving_ + k];
  return slopes;
}

PathVariety::Box PathVariety::place(const Box& box, std::span<const double> slopes) const {
  Box place = box;
  for (std::size_t v = 0; v < box.size(); ++v) {
    const std::optional<Interval>& inner = problem_.inner[v];
    if (!inner) continue;
    double x = mid(box[v]);
    if (!slopes.empty() && slopes[v] > 0) x = box[v].hi;
    if (!slopes.empty() && slopes[v] < 0) x = box[v].lo;
    place[v] = Interval(std::clamp(x, inner->lo, inner->hi));
  }
  return place;
}

PathVariety::Box PathVariety::on_piece(const Box& place) const {
  Box variables = place;
  variables[0] = place[0] - Interval(double(piece_of(place)));
  return variables;
}

}  // namespace regulus::detail
