// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/legs.hpp"

#include <algorithm>

#include "codegen/model/exact/exact_algebra.hpp"

namespace regulus::detail {
namespace {

constexpr std::array<LegType, 14> kTypes = {{
    {"RPR", LegKind::kTelescopic, true, false},
    {"RRR", LegKind::kCrank, true, false},
    {"PRR", LegKind::kSlider, true, false},
    {"UPS", LegKind::kTelescopic, false, false},
    {"SPS", LegKind::kTelescopic, false, false},
    {"RUS", LegKind::kCrank, false, false},
    {"RSS", LegKind::kCrank, false, false},
    {"PUS", LegKind::kSlider, false, false},
    {"PSS", LegKind::kSlider, false, false},
    {"UPU", LegKind::kTelescopic, false, true},
    {"delta", LegKind::kCrank, false, true},
    {"linear-delta", LegKind::kSlider, false, true},
    {"RPS", LegKind::kTelescopic, false, false, true},
    {"PRS", LegKind::kSlider, false, false, true},
}};

bool is(const Formula& f, const char* text) { return f.text() == text; }

// Sums and products without the terms that are 0 and the factors that are 1, for readable text.

Formula plus(const Formula& a, const Formula& b) { return is(a, "0") ? b : is(b, "0") ? a : a + b; }

Formula minus(const Formula& a, const Formula& b) {
  return is(b, "0") ? a : is(a, "0") ? -b : a - b;
}

Formula times(const Formula& a, const Formula& b) {
  if (is(a, "0") || is(b, "0")) return 0;
  if (is(a, "-1")) return -b;
  if (is(b, "-1")) return -a;
  return is(a, "1") ? b : is(b, "1") ? a : a * b;
}

Formula dot(const FormulaPoint& u, const FormulaPoint& v) {
  return plus(plus(times(u[0], v[0]), times(u[1], v[1])), times(u[2], v[2]));
}

FormulaPoint cross(const FormulaPoint& u, const FormulaPoint& v) {
  return {minus(times(u[1], v[2]), times(u[2], v[1])), minus(times(u[2], v[0]), times(u[0], v[2])),
          minus(times(u[0], v[1]), times(u[1], v[0]))};
}

FormulaPoint times(const Formula& factor, const FormulaPoint& v) {
  return {times(factor, v[0]), times(factor, v[1]), times(factor, v[2])};
}

FormulaPoint plus(const FormulaPoint& u, const FormulaPoint& v) {
  return {plus(u[0], v[0]), plus(u[1], v[1]), plus(u[2], v[2])};
}

FormulaPoint minus(const FormulaPoint& u, const FormulaPoint& v) {
  return {minus(u[0], v[0]), minus(u[1], v[1]), minus(u[2], v[2])};
}

Formula squared(const Formula& f) { return is(f, "0") ? Formula(0) : pow(f, 2); }

Formula squared_norm(const FormulaPoint& v) {
  return plus(plus(squared(v[0]), squared(v[1])), squared(v[2]));
}

/// Writes one leg. Names end in the number of the leg.
class LegWriter {
 public:
  LegWriter(const Legs& robot, std::size_t index, WrittenLegs& out)
      : robot_(robot),
        leg_(robot.legs[index]),
        index_(index),
        number_(std::to_string(index + 1)),
        axes_(robot.planar ? 2 : 3),
        first_row_(out.rows.size()),
        out_(out) {}

  void write() {
    write_joints();
    switch (leg_.type->kind) {
      case LegKind::kTelescopic:
        write_telescopic();
        break;
      case LegKind::kCrank:
        write_crank();
        break;
      case LegKind::kSlider:
        write_slider();
        break;
    }
    if (leg_.type->is_hinged) write_hinge();
    for (std::size_t i = first_row_; i < out_.rows.size(); ++i) out_.rows[i].leg = index_;
    note_points();
  }

 private:
  Formula let(const std::string& letter, const Formula& value) {
    out_.let.emplace_back(letter + number_, value);
    return unplaced(letter + number_);
  }

  FormulaPoint let(const std::string& letter, const FormulaPoint& value) {
    FormulaPoint names;
    for (std::size_t i = 0; i < axes_; ++i) {
      const std::string name = letter + number_ + "_" + kCoordinates[i];
      out_.let.emplace_back(name, value[i]);
      names[i] = unplaced(name);
    }
    return names;
  }

  /// r = R·B and e = AB, and X − A: r × (X − A) = r × AB has fewer occurrences of the pose.
  void write_joints() {
    for (std::size_t i = 0; i < axes_; ++i)
      from_base_[i] = unplaced(kCoordinates[i]) - leg_.base[i];
    FormulaPoint AB = from_base_;
    if (!robot_.point) {
      FormulaPoint turned;
      for (std::size_t i = 0; i < axes_; ++i) turned[i] = dot(robot_.rotation[i], leg_.platform);
      r_ = let("r", turned);
      for (std::size_t i = 0; i < axes_; ++i)
        AB[i] = unplaced(kCoordinates[i]) + r_[i] - leg_.base[i];
    }
    e_ = let("e", AB);
    if (leg_.type->keeps_orientation) from_base_ = e_;  // r is constant
  }

  void note_points() {
    FormulaPoint A = {0, 0, 0}, B = A, C = A;
    for (std::size_t i = 0; i < axes_; ++i) {
      A[i] = leg_.base[i];
      B[i] = plus(A[i], e_[i]);
      if (leg_.type->kind != LegKind::kTelescopic) C[i] = minus(B[i], d_[i]);
    }
    LegPoints leg{leg_.type->kind, {A, B}};
    if (leg_.type->kind != LegKind::kTelescopic) leg.points.insert(leg.points.begin() + 1, C);
    if (leg_.actuated != 0)
      leg.row = static_cast<int>(std::ranges::count(out_.rows, true, &LegRow::motor)) - 1;
    out_.points.push_back(std::move(leg));
  }

  /// A motor between joints that lie on the line through Q, at `to_line` from the platform's origin:
  /// the force along it is all that the leg transmits.
  void write_force(const FormulaPoint& force, const FormulaPoint& moment, const Formula& scale) {
    if (leg_.actuated == 0) return;
    out_.rows.push_back({row(force, moment), scale, true});
  }

  void write_moment(const FormulaPoint& moment) {
    out_.rows.push_back({row({}, moment), 1, false});
  }

  /// The hinge along h and the joint B transmit the forces at B across h × d, d from the hinge to B.
  /// Beside that of the motor this is the force along h; of a rail u that is not across h, the part
  /// of it that has no power with the carriage.
  void write_hinge() {
    const FormulaPoint& h = leg_.hinge;
    const bool has_oblique_rail = leg_.type->kind == LegKind::kSlider && !leg_.hinge_is_across;
    (void)let("off_", dot(has_oblique_rail ? d_ : e_, h));  // d·h = e·h for a rail across h
    FormulaPoint force = h;
    if (has_oblique_rail) {
      const FormulaPoint& u = leg_.axis.direction;
      force = minus(times(dot(d_, u), h), times(dot(h, u), d_));
    }
    out_.rows.push_back({row(force, cross(r_, force)), 1, false});
  }

  std::vector<Formula> row(const FormulaPoint& force, const FormulaPoint& moment) const {
    std::vector<Formula> entries(force.begin(), force.begin() + std::ptrdiff_t(axes_));
    if (robot_.point) return entries;
    if (robot_.planar)
      entries.push_back(moment[2]);
    else
      entries.insert(entries.end(), moment.begin(), moment.end());
    return entries;
  }

  void write_telescopic() {
    const Formula rho = let("rho_", sqrt(squared_norm(e_)));
    const FormulaPoint turned = {-e_[1], e_[0], 0};
    if (leg_.actuated == 1)
      write_force(turned, cross(r_, turned), 1 / squared(rho));
    else if (leg_.actuated == 3)  // the line through A
      write_force(turned, minus(cross(r_, turned), {0, 0, squared_norm(e_)}), 1 / squared(rho));
    else
      write_force(e_, cross(r_, from_base_), 1 / rho);
    if (leg_.type->keeps_orientation) write_moment(across_axis());
    if (!leg_.range) return;
    if (leg_.actuated == 2)
      write_length_range(squared_norm(e_), true);
    else if (leg_.actuated == 1)
      write_angle_range(e_[0], e_[1], rho);
    else
      write_angle_range_of_platform(e_, rho);
  }

  /// The part of e across the outer axes t of a UPU leg. Its inner axes are along t × e.
  FormulaPoint across_axis() const {
    const FormulaPoint& t = leg_.axis.direction;
    if (leg_.axis.across) {
      const auto& [f, g] = *leg_.axis.across;
      return plus(times(dot(e_, f), f), times(dot(e_, g), g));
    }
    return minus(times(squared_norm(t), e_), times(dot(t, e_), t));
  }

  Formula signed_by_mode(const Formula& f) const { return leg_.mode ? f : -f; }

  /// The unit vector c along the crank is (k·e′ ± w·n×e)/q, where e′ is the part of e across the
  /// axis n, q = |e′|², and k = c·e follows from the length of the rod. For an axis of any length,
  /// N = |n|², N·e′ stands for e′ and |n × e|² for q.
  void write_crank() {
    const Formula square = squared_norm(e_), crank = leg_.crank;
    const FormulaPoint& n = leg_.axis.direction;
    const Formula e2 = let("square_", square);
    Formula q = e2, N = 1, along, N_root = 1;
    FormulaPoint e_across = e_, n_cross_e = {-e_[1], e_[0], 0};
    if (!robot_.planar && leg_.axis.across) {
      const auto& [f, g] = *leg_.axis.across;
      const Formula ef = let("f", dot(e_, f)), eg = let("g", dot(e_, g));
      q = let("across_", squared(ef) + squared(eg));
      const Formula k = write_root(e2, q, N);
      const Formula u = crank * (k * ef - signed_by_mode(w_) * eg) / q;
      const Formula v = crank * (k * eg + signed_by_mode(w_) * ef) / q;
      d_ = let("d", minus(e_, plus(times(u, f), times(v, g))));
    } else {
      if (!robot_.planar) {
        N = let("norm_", squared_norm(n));
        N_root = sqrt(N);
        along = let("en", dot(e_, n));
        q = let("across_", N * e2 - squared(along));
        e_across = minus(times(N, e_), times(along, n));
        n_cross_e = cross(n, e_);
      }
      const Formula k = write_root(e2, q, N);
      FormulaPoint d;
      for (std::size_t i = 0; i < axes_; ++i)
        d[i] = e_[i] - crank * (k * e_across[i] + signed_by_mode(w_) * n_cross_e[i]) / q;
      d_ = let("d", d);
    }
    write_crank_rows(N_root / (crank * w_));
    if (leg_.range) write_crank_range();
  }

  /// k and w, and the radicand of w.
  Formula write_root(const Formula& e2, const Formula& q, const Formula& N) {
    const Formula k = let("k", (e2 + squared(leg_.crank) - squared(leg_.rod)) / (2 * leg_.crank));
    w_ = let("w", sqrt(q - times(N, squared(k))));
    return k;
  }

  void write_crank_rows(const Formula& scale) {
    if (leg_.actuated == 2)  // the line through A and B
      write_force(e_, cross(r_, from_base_), scale);
    else if (leg_.actuated == 3)  // the line of the crank, at C
      write_force(minus(e_, d_), cross(minus(r_, d_), minus(e_, d_)), scale);
    else
      write_force(d_, cross(r_, d_), scale);
    if (leg_.type->keeps_orientation) write_moment(cross(leg_.bar, d_));
  }

  void write_crank_range() {
    const FormulaPoint crank = minus(e_, d_);
    if (!robot_.planar) return write_spatial_range(crank);
    if (leg_.actuated == 1)
      write_angle_range(crank[0], crank[1], leg_.crank);
    else if (leg_.actuated == 2)
      write_angle_range(dot(crank, d_), cross(crank, d_)[2], leg_.crank * leg_.rod);
    else
      write_angle_range_of_platform(d_, leg_.rod);
  }

  /// The angle from `zero`, projected across the axis n, to the crank, about n.
  void write_spatial_range(const FormulaPoint& crank) {
    const FormulaPoint &n = leg_.axis.direction, &z = *leg_.zero;
    const Formula N = leg_.axis.across ? Formula(1) : squared_norm(n);
    const Formula projected = sqrt(squared_norm(z) - squared(dot(z, n)) / N);
    write_angle_range(dot(crank, z), dot(crank, cross(n, z)) / sqrt(N), leg_.crank * projected);
  }

  /// C = A + s·n. The rod's length gives s = e·n ± w for an axis n of length 1.
  void write_slider() {
    const FormulaPoint& n = leg_.axis.direction;
    const Formula N = leg_.axis.across ? Formula(1) : let("norm_", squared_norm(n));
    const Formula along = let("en", dot(e_, n));
    const Formula rest = squared_norm(e_) - squared(leg_.rod);
    w_ = let("w", sqrt(squared(along) - times(N, rest)));
    Formula parameter = along + signed_by_mode(w_);
    if (!leg_.axis.across) parameter = parameter / N;
    const Formula root = leg_.axis.across ? Formula(1) : sqrt(N);
    const Formula s = let("s_", times(parameter, root));
    d_ = let("d", minus(e_, times(parameter, n)));
    // The rail's direction enters the force of a joint that turns, and its power, alike.
    write_slider_rows(n, (leg_.actuated == 1 ? root : Formula(1)) / w_);
    if (!leg_.range) return;
    if (leg_.actuated == 1) {
      write_length_range(s, false);
    } else if (leg_.actuated == 2) {
      write_angle_range(dot(n, d_), cross(n, d_)[2], root * leg_.rod);
    } else {
      write_angle_range_of_platform(d_, leg_.rod);
    }
  }

  void write_slider_rows(const FormulaPoint& n, const Formula& scale) {
    const FormulaPoint turned = {-n[1], n[0], 0};  // what a joint at C can push along
    if (leg_.actuated == 2)
      write_force(turned, cross(r_, turned), scale);
    else if (leg_.actuated == 3)
      write_force(turned, cross(minus(r_, d_), turned), scale);
    else
      write_force(d_, cross(r_, d_), scale);
    if (leg_.type->keeps_orientation) write_moment(cross(leg_.bar, d_));
  }

  /// lo ≤ length ≤ hi; of the square of a length, whose ends are not negative.
  void write_length_range(const Formula& length, bool is_square) {
    const auto end = [is_square](const Formula& f) { return is_square ? squared(f) : f; };
    out_.ranges.push_back(end(leg_.range->lo) - length);
    out_.ranges.push_back(length - end(leg_.range->hi));
  }

  /// The angle of (size·cos, size·sin) is in the range: it is at most half of the range's width away
  /// from the middle.
  void write_angle_range(const Formula& cosine, const Formula& sine, const Formula& size) {
    const Formula middle = (leg_.range->lo + leg_.range->hi) / 2;
    const Formula half = (leg_.range->hi - leg_.range->lo) / 2;
    out_.ranges.push_back(size * cos(half) - cosine * cos(middle) - sine * sin(middle));
  }

  /// The angle from a direction of the leg to the platform's first axis.
  void write_angle_range_of_platform(const FormulaPoint& from, const Formula& size) {
    if (robot_.point) return;
    const FormulaPoint x = {robot_.rotation[0][0], robot_.rotation[1][0], 0};
    write_angle_range(dot(from, x), cross(from, x)[2], size);
  }

  const Legs& robot_;
  const Leg& leg_;
  std::size_t index_;
  std::string number_;
  std::size_t axes_, first_row_;
  WrittenLegs& out_;
  FormulaPoint from_base_, r_, e_, d_;
  Formula w_;
};

}  // namespace

std::span<const LegType> leg_types() { return kTypes; }

WrittenLegs write_legs(const Legs& robot) {
  WrittenLegs out;
  for (std::size_t i = 0; i < robot.legs.size(); ++i) LegWriter(robot, i, out).write();
  std::stable_partition(out.rows.begin(), out.rows.end(),
                        [](const LegRow& row) { return row.motor; });
  return out;
}

}  // namespace regulus::detail
