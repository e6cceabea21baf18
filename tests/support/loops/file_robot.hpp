// SPDX-License-Identifier: GPL-3.0-or-later
// Robots with loops as a file describes them, in doubles: where their links are, by how much their
// loops are open, Newton's method that closes them, and what moves while the motors are locked. For
// tests, with none of the code under test.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/serial/forward_kinematics.hpp"

namespace regulus::detail::test {

enum class Moves { kNot, kTurns, kSlides, kAsABall };

struct FileRule {
  std::string leader;
  double multiplier = 1, offset = 0;
};

/// The frame of `child` is origin · T(anchor) · motion · T(−anchor) in that of `parent`.
struct FileJoint {
  std::string name, parent, child;
  Moves moves = Moves::kTurns;
  Frame origin{};
  Vec axis{0, 0, 1};
  Vec anchor{};
  std::optional<FileRule> rule{};
};

/// Two frames, or their origins, that are one.
struct FileLoop {
  std::string first, second;
  Frame at_first{}, at_second{};
  bool holds_frames = true;
};

/// What may move: a joint that follows none, or one of the three turns of a ball.
struct Freedom {
  std::size_t joint = 0, turn = 0;
};

/// Values by joint, and the turns of balls.
struct Configuration {
  std::vector<double> values;
  std::vector<Mat> balls;
};

inline Vec crossed(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec& v) { return std::sqrt(inner(v, v)); }
inline Mat transposed(const Mat& A) {
  return {Vec{A[0][0], A[1][0], A[2][0]}, Vec{A[0][1], A[1][1], A[2][1]},
          Vec{A[0][2], A[1][2], A[2][2]}};
}
inline Frame inverted(const Frame& f) {
  const Mat R = transposed(f.R);
  return {R, -1.0 * (R * f.p)};
}
/// The rotation vector of a rotation.
inline Vec turn_of(const Mat& R) {
  const Vec s = {R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]};
  const double sine = norm(s) / 2, cosine = (R[0][0] + R[1][1] + R[2][2] - 1) / 2;
  const double angle = std::atan2(sine, cosine);
  if (sine > 1e-7) return angle / (2 * sine) * s;
  if (cosine > 0) return 0.5 * s;
  for (std::size_t i = 0; i < 3; ++i)  // half a turn
    if (R[i][i] > -0.4) {
      Vec a = {R[i][0], R[i][1], R[i][2]};
      a[i] += 1;
      return 3.141592653589793 / norm(a) * a;
    }
  return {};
}

/// By rows.
struct Dense {
  std::size_t rows = 0, columns = 0;
  std::vector<double> a{};
  double& operator()(std::size_t i, std::size_t j) { return a[i * columns + j]; }
  double operator()(std::size_t i, std::size_t j) const { return a[i * columns + j]; }
};
inline Dense dense(std::size_t rows, std::size_t columns) {
  return {rows, columns, std::vector<double>(rows * columns, 0.0)};
}

/// Solves (AᵀA + d·I)s = −Aᵀg by Cholesky's method.
inline std::vector<double> least_step(const Dense& A, const std::vector<double>& g, double d) {
  const std::size_t n = A.columns;
  Dense N = dense(n, n);
  std::vector<double> s(n, 0.0);
  for (std::size_t r = 0; r < A.rows; ++r)
    for (std::size_t i = 0; i < n; ++i) {
      if (A(r, i) == 0) continue;
      s[i] -= A(r, i) * g[r];
      for (std::size_t j = 0; j <= i; ++j) N(i, j) += A(r, i) * A(r, j);
    }
  for (std::size_t i = 0; i < n; ++i) {
    N(i, i) += d;
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k < j; ++k) N(i, j) -= N(i, k) * N(j, k);
      N(i, j) = i == j ? std::sqrt(std::fmax(N(i, i), 1e-300)) : N(i, j) / N(j, j);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) s[i] -= N(i, k) * s[k];
    s[i] /= N(i, i);
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) s[i] -= N(k, i) * s[k];
    s[i] /= N(i, i);
  }
  return s;
}

/// Singular values in rising order, and right singular vectors as rows, by turning pairs of columns
/// (Hestenes).
struct Singular {
  std::vector<double> values;
  std::vector<std::vector<double>> vectors;
};
inline Singular singular_of(Dense A) {
  const std::size_t n = A.columns;
  Dense V = dense(n, n);
  for (std::size_t i = 0; i < n; ++i) V(i, i) = 1;
  for (int sweep = 0; sweep < 60; ++sweep) {
    double most = 0;
    for (std::size_t p = 0; p + 1 < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        double pp = 0, qq = 0, pq = 0;
        for (std::size_t r = 0; r < A.rows; ++r)
          pp += A(r, p) * A(r, p), qq += A(r, q) * A(r, q), pq += A(r, p) * A(r, q);
        const double size = std::sqrt(pp * qq);
        if (size < 1e-300 || std::fabs(pq) <= 1e-15 * size) continue;
        most = std::fmax(most, std::fabs(pq) / size);
        const double z = (qq - pp) / (2 * pq);
        const double t = (z < 0 ? -1 : 1) / (std::fabs(z) + std::hypot(1.0, z));
        const double c = 1 / std::hypot(1.0, t), s = c * t;
        const auto turn = [&](Dense& M) {
          for (std::size_t r = 0; r < M.rows; ++r) {
            const double x = M(r, p), y = M(r, q);
            M(r, p) = c * x - s * y;
            M(r, q) = s * x + c * y;
          }
        };
        turn(A);
        turn(V);
      }
    if (most < 1e-14) break;
  }
  std::vector<std::size_t> order(n);
  std::vector<double> sizes(n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    order[j] = j;
    for (std::size_t r = 0; r < A.rows; ++r) sizes[j] = std::hypot(sizes[j], A(r, j));
  }
  std::ranges::sort(order, {}, [&](std::size_t j) { return sizes[j]; });
  Singular result;
  for (const std::size_t j : order) {
    result.values.push_back(sizes[j]);
    std::vector<double>& v = result.vectors.emplace_back();
    for (std::size_t r = 0; r < n; ++r) v.push_back(V(r, j));
  }
  return result;
}

class FileRobot {
 public:
  std::vector<FileJoint> joints{};  ///< each behind its parent's, once `order` has been called
  std::vector<FileLoop> loops{};
  std::vector<std::string> motors{};

  /// Puts joints behind those that their links hang on.
  void order() {
    std::vector<FileJoint> sorted;
    std::vector<FileJoint> rest = std::move(joints);
    while (!rest.empty()) {
      const auto free = std::ranges::find_if(rest, [&](const FileJoint& j) {
        return std::ranges::none_of(rest, [&](const FileJoint& k) { return k.child == j.parent; });
      });
      if (free == rest.end()) throw std::invalid_argument("the joints are no tree");
      sorted.push_back(std::move(*free));
      rest.erase(free);
    }
    joints = std::move(sorted);
    index();
  }

  [[nodiscard]] std::size_t joint(const std::string& name) const { return by_name_.at(name); }
  [[nodiscard]] bool has_joint(const std::string& name) const { return by_name_.contains(name); }
  [[nodiscard]] bool is_motor(const std::string& name) const {
    return std::ranges::find(motors, name) != motors.end();
  }

  [[nodiscard]] Configuration at_zero() const {
    return {std::vector<double>(joints.size(), 0.0), std::vector<Mat>(joints.size(), Frame{}.R)};
  }

  /// The freedoms without those of the motors.
  [[nodiscard]] std::vector<Freedom> passive() const {
    std::vector<Freedom> all;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].moves == Moves::kNot || joints[j].rule || is_motor(joints[j].name)) continue;
      for (std::size_t turn = 0; turn < (joints[j].moves == Moves::kAsABall ? 3U : 1U); ++turn)
        all.push_back({j, turn});
    }
    return all;
  }

  /// Frames of the links, by joint: that of its child.
  [[nodiscard]] std::vector<Frame> frames(const Configuration& at) const {
    std::vector<Frame> result(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const FileJoint& joint = joints[j];
      const Frame before = parent_frame(result, j) * joint.origin * Frame{.p = joint.anchor};
      result[j] = before * motion(j, at) * Frame{.p = -1.0 * joint.anchor};
    }
    return result;
  }

  [[nodiscard]] Frame frame_of(const std::string& link, const Configuration& at) const {
    const auto known = link_joint_.find(link);
    return known == link_joint_.end() ? Frame{} : frames(at)[known->second];
  }

  /// Six numbers of each loop that holds frames, three of others.
  [[nodiscard]] std::vector<double> gap(const Configuration& at) const {
    const std::vector<Frame> where = frames(at);
    std::vector<double> result;
    for (const FileLoop& loop : loops) {
      const Frame a = link_frame(where, loop.first) * loop.at_first;
      const Frame b = link_frame(where, loop.second) * loop.at_second;
      for (std::size_t i = 0; i < 3; ++i) result.push_back(b.p[i] - a.p[i]);
      if (!loop.holds_frames) continue;
      const Vec turn = turn_of(b.R * transposed(a.R));
      result.insert(result.end(), turn.begin(), turn.end());
    }
    return result;
  }
  [[nodiscard]] double largest_gap(const Configuration& at) const {
    double most = 0;
    for (const double x : gap(at)) most = std::fmax(most, std::fabs(x));
    return most;
  }

  void move(Configuration& at, const Freedom& freedom, double by) const {
    if (joints[freedom.joint].moves != Moves::kAsABall) {
      at.values[freedom.joint] += by;
      return;
    }
    Vec axis{};
    axis[freedom.turn] = 1;
    at.balls[freedom.joint] = at.balls[freedom.joint] * turn_about(axis, by);
  }

  /// Derivatives of the gap by central differences.
  [[nodiscard]] Dense differences(const Configuration& at, const std::vector<Freedom>& by) const {
    constexpr double kStep = 1e-6;
    Dense J = dense(gap(at).size(), by.size());
    for (std::size_t c = 0; c < by.size(); ++c) {
      Configuration above = at, below = at;
      move(above, by[c], kStep);
      move(below, by[c], -kStep);
      const std::vector<double> more = gap(above), less = gap(below);
      for (std::size_t r = 0; r < J.rows; ++r) J(r, c) = (more[r] - less[r]) / (2 * kStep);
    }
    return J;
  }

  /// The same where the loops are closed, by the screws of the joints. A joint that carries both ends
  /// of a loop keeps it closed.
  [[nodiscard]] Dense screws(const Configuration& at, const std::vector<Freedom>& by) const {
    const std::vector<Frame> where = frames(at);
    std::size_t rows = 0;
    for (const FileLoop& loop : loops) rows += loop.holds_frames ? 6 : 3;
    Dense J = dense(rows, by.size());
    for (std::size_t c = 0; c < by.size(); ++c)
      for (std::size_t j = 0; j < joints.size(); ++j) {
        const double rate = j == by[c].joint                 ? 1
                            : follows_[j] == by[c].joint + 1 ? joints[j].rule->multiplier
                                                             : 0;
        if (rate == 0) continue;
        const FileJoint& joint = joints[j];
        const Frame before = parent_frame(where, j) * joint.origin * Frame{.p = joint.anchor};
        Vec axis = (1 / norm(joint.axis)) * joint.axis;
        if (joint.moves == Moves::kAsABall) {
          Vec e{};
          e[by[c].turn] = 1;
          axis = at.balls[j] * e;
        }
        axis = rate * (before.R * axis);
        std::size_t row = 0;
        for (std::size_t l = 0; l < loops.size(); ++l) {
          const double sign = (carries_[l][j] & 2 ? 1.0 : 0.0) - (carries_[l][j] & 1 ? 1.0 : 0.0);
          const FileLoop& loop = loops[l];
          if (sign != 0) {
            const bool is_second = (carries_[l][j] & 2) != 0;
            const Vec point = is_second ? (link_frame(where, loop.second) * loop.at_second).p
                                        : (link_frame(where, loop.first) * loop.at_first).p;
            const Vec v =
                joint.moves == Moves::kSlides ? axis : crossed(axis, point + -1.0 * before.p);
            for (std::size_t i = 0; i < 3; ++i) {
              J(row + i, c) += sign * v[i];
              if (loop.holds_frames && joint.moves != Moves::kSlides)
                J(row + 3 + i, c) += sign * axis[i];
            }
          }
          row += loop.holds_frames ? 6 : 3;
        }
      }
    return J;
  }

  /// Moves freedoms until the loops are closed. Returns the largest gap.
  double close(Configuration& at, const std::vector<Freedom>& by, int steps = 60,
               double damping = 1e-6) const {
    std::vector<double> g = gap(at);
    double before = squared(g), most = largest_gap(at);
    for (int step = 0; step < steps && most > 1e-14; ++step) {
      const std::vector<double> s =
          least_step(screws(at, by), g, damping * std::fmin(1, before) + 1e-13);
      Configuration next = at;
      for (std::size_t i = 0; i < by.size(); ++i) move(next, by[i], s[i]);
      std::vector<double> after = gap(next);
      if (squared(after) < before) {
        at = std::move(next);
        g = std::move(after);
        before = squared(g);
        most = largest_gap(at);
        damping = std::fmax(damping / 10, 1e-8);
      } else if (most < 1e-11 || damping > 1e12) {
        break;
      } else {
        damping *= 10;
      }
    }
    return most;
  }

 private:
  static double squared(const std::vector<double>& v) {
    double sum = 0;
    for (const double x : v) sum += x * x;
    return sum;
  }

  Frame parent_frame(const std::vector<Frame>& where, std::size_t j) const {
    return parents_[j] == 0 ? Frame{} : where[parents_[j] - 1];
  }
  Frame link_frame(const std::vector<Frame>& where, const std::string& link) const {
    const auto known = link_joint_.find(link);
    return known == link_joint_.end() ? Frame{} : where[known->second];
  }

  double value(std::size_t j, const Configuration& at) const {
    const auto& rule = joints[j].rule;
    return rule ? rule->multiplier * at.values[follows_[j] - 1] + rule->offset : at.values[j];
  }

  Frame motion(std::size_t j, const Configuration& at) const {
    const FileJoint& joint = joints[j];
    if (joint.moves == Moves::kNot) return {};
    if (joint.moves == Moves::kAsABall) return {.R = at.balls[j]};
    if (joint.moves == Moves::kSlides) return {.p = value(j, at) / norm(joint.axis) * joint.axis};
    return {.R = turn_about(joint.axis, value(j, at))};
  }

  void index() {
    by_name_.clear(), link_joint_.clear();
    for (std::size_t j = 0; j < joints.size(); ++j) {
      by_name_[joints[j].name] = j;
      link_joint_[joints[j].child] = j;
    }
    parents_.assign(joints.size(), 0), follows_.assign(joints.size(), 0);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (const auto up = link_joint_.find(joints[j].parent); up != link_joint_.end())
        parents_[j] = up->second + 1;
      if (joints[j].rule) follows_[j] = by_name_.at(joints[j].rule->leader) + 1;
    }
    carries_.assign(loops.size(), std::vector<char>(joints.size(), 0));
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (const auto& [link, mark] : {std::pair(loops[l].first, 1), std::pair(loops[l].second, 2)})
        for (auto at = link_joint_.find(link); at != link_joint_.end();
             at = link_joint_.find(joints[at->second].parent))
          carries_[l][at->second] = char(carries_[l][at->second] | mark);
  }

  std::map<std::string, std::size_t> by_name_{}, link_joint_{};
  std::vector<std::size_t> parents_{}, follows_{};  ///< 1 + the joint; 0 for none
  std::vector<std::vector<char>> carries_{};  ///< by loop and joint: 1 its first link, 2 its second
};

}  // namespace regulus::detail::test
