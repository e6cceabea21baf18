// SPDX-License-Identifier: GPL-3.0-or-later
// Forward kinematics of serial arms in doubles, written for tests, without any of the code under
// test; and what two Jacobians have in common that are seen from different links.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace regulus::detail::test {

using Vec = std::array<double, 3>;
using Mat = std::array<Vec, 3>;  // by rows

inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator*(double f, const Vec& a) { return {f * a[0], f * a[1], f * a[2]}; }
inline double inner(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec operator*(const Mat& A, const Vec& v) {
  return {inner(A[0], v), inner(A[1], v), inner(A[2], v)};
}
inline Mat operator*(const Mat& A, const Mat& B) {
  Mat C{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) C[i][j] += A[i][k] * B[k][j];
  return C;
}

/// The turn about an axis of any length, by Rodrigues.
inline Mat turn_about(const Vec& axis, double angle) {
  const double length = std::sqrt(inner(axis, axis));
  const Vec a = (1 / length) * axis;
  const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
  return {Vec{c + d * a[0] * a[0], d * a[0] * a[1] - s * a[2], d * a[0] * a[2] + s * a[1]},
          Vec{d * a[1] * a[0] + s * a[2], c + d * a[1] * a[1], d * a[1] * a[2] - s * a[0]},
          Vec{d * a[2] * a[0] - s * a[1], d * a[2] * a[1] + s * a[0], c + d * a[2] * a[2]}};
}

inline Mat of_rpy(const Vec& rpy) {
  return turn_about({0, 0, 1}, rpy[2]) *
         (turn_about({0, 1, 0}, rpy[1]) * turn_about({1, 0, 0}, rpy[0]));
}

struct Frame {
  Mat R = {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  Vec p{};
};
inline Frame operator*(const Frame& a, const Frame& b) { return {a.R * b.R, a.R * b.p + a.p}; }

struct ChainJoint {
  Frame origin{};
  Vec axis{0, 0, 1};
  bool moves = true, slides = false;
};

inline Frame tool_frame(const std::vector<ChainJoint>& chain, const std::vector<double>& q) {
  Frame frame;
  std::size_t variable = 0;
  for (const ChainJoint& joint : chain) {
    frame = frame * joint.origin;
    if (!joint.moves) continue;
    const double value = q[variable++];
    const double length = std::sqrt(inner(joint.axis, joint.axis));
    frame = frame * (joint.slides ? Frame{.p = value / length * joint.axis}
                                  : Frame{.R = turn_about(joint.axis, value)});
  }
  return frame;
}

/// A column of a Jacobian.
struct Twist {
  Vec velocity{}, spin{};
};

/// Central differences of a frame, which is a function of the joints.
template <typename FrameOf>
std::vector<Twist> difference_twists(const FrameOf& frame_of, const std::vector<double>& q) {
  constexpr double kStep = 1e-6;
  const Mat R = frame_of(q).R;
  std::vector<Twist> twists;
  for (std::size_t j = 0; j < q.size(); ++j) {
    std::vector<double> up = q, down = q;
    up[j] += kStep;
    down[j] -= kStep;
    const Frame a = frame_of(up), b = frame_of(down);
    Mat rate{};  // dR/dq · Rᵀ, skew
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l)
          rate[i][k] += (a.R[i][l] - b.R[i][l]) / (2 * kStep) * R[k][l];
    twists.push_back({(1 / (2 * kStep)) * (a.p + -1.0 * b.p),
                      {(rate[2][1] - rate[1][2]) / 2, (rate[0][2] - rate[2][0]) / 2,
                       (rate[1][0] - rate[0][1]) / 2}});
  }
  return twists;
}

/// Of the tool's frame.
inline std::vector<Twist> difference_twists(const std::vector<ChainJoint>& chain,
                                            const std::vector<double>& q) {
  return difference_twists([&chain](const auto& at) { return tool_frame(chain, at); }, q);
}

/// The products of two columns that no change of frame or reference point changes: ω·ω', and
/// v·ω' + ω·v'. They determine the columns up to such a change.
struct Invariants {
  double spins = 0, reciprocal = 0;
};
inline Invariants invariants(const Twist& a, const Twist& b) {
  return {inner(a.spin, b.spin), inner(a.velocity, b.spin) + inner(a.spin, b.velocity)};
}

}  // namespace regulus::detail::test
