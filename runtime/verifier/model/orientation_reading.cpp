// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/orientation_reading.hpp"

namespace regulus::verifier {

std::vector<std::string> orientation_names(const std::string& word) {
  if (word == "euler-zxz") return {"psi", "theta", "phi"};
  if (word == "roll-pitch-yaw") return {"roll", "pitch", "yaw"};
  if (word == "quaternion") return {"q0", "q1", "q2", "q3"};
  if (word == kAngleInPlane) return {"phi"};
  return {};
}

OrientationNodes read_orientation(const std::string& word, const Scope& scope, bool in_degrees,
                                  GraphAlgebra& algebra) {
  std::vector<NodeId> q;
  for (const std::string& name : orientation_names(word)) {
    const auto pose = scope.find(name);
    if (pose == scope.end()) throw Unfinished("the certificate has no pose parameter " + name);
    q.push_back(in_degrees ? algebra.degrees(pose->second) : pose->second);
  }
  const NodeId one = algebra.number(1);
  if (word == "roll-pitch-yaw") return {algebra.turn_of_roll_pitch_yaw({q[0], q[1], q[2]}), one};
  if (word == "euler-zxz")
    return {algebra.product(algebra.turn(2, q[0]),
                            algebra.product(algebra.turn(0, q[1]), algebra.turn(2, q[2]))),
            one};
  if (word == kAngleInPlane) return {algebra.turn(2, q[0]), one};
  if (word != "quaternion") return {algebra.identity(), one};
  const std::array<NodeId, 4> all = {q[0], q[1], q[2], q[3]};
  return {algebra.scaled_turn(all), algebra.squared_norm(all)};
}

NodeId squared_length_at(const SectionLeg& leg, const std::string& word, bool in_degrees,
                         const Scope& scope, Graph& graph) {
  GraphAlgebra algebra(graph);
  if (orientation_names(word).empty())
    throw Unfinished("the orientation '" + word + "' is not known");
  const OrientationNodes R = read_orientation(word, scope, in_degrees, algebra);
  VectorNodes X = algebra.zero();
  for (std::size_t i = 0; i < (word == kAngleInPlane ? 2 : 3); ++i) {
    const auto pose = scope.find(std::string_view("xyz").substr(i, 1));
    if (pose == scope.end()) throw Unfinished("the motion has no position");
    X[i] = pose->second;
  }
  // All lengths are multiplied by the size of R.
  const VectorNodes d = algebra.sum(algebra.scaled(R.size, algebra.difference(X, leg.base.value)),
                                    algebra.product(R.scaled, leg.platform.value));
  return algebra.quotient(algebra.dot(d, d), algebra.square(R.size));
}

}  // namespace regulus::verifier
