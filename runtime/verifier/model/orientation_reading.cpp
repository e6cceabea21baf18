// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/orientation_reading.hpp"

namespace regulus::verifier {

std::vector<std::string> orientation_names(const std::string& word) {
  if (word == "euler-zxz") return {"psi", "theta", "phi"};
  if (word == "roll-pitch-yaw") return {"roll", "pitch", "yaw"};
  if (word == "quaternion") return {"q0", "q1", "q2", "q3"};
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
  if (word != "quaternion") return {algebra.identity(), one};
  const std::array<NodeId, 4> all = {q[0], q[1], q[2], q[3]};
  return {algebra.scaled_turn(all), algebra.squared_norm(all)};
}

}  // namespace regulus::verifier
