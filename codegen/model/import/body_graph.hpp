// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies, which are links without motion between them, and the joints that connect them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/model/import/exact_pose.hpp"

namespace regulus::detail {

/// The freedoms of a connection.
enum class ConnectionKind { kRevolute, kPrismatic, kUniversal, kBall, kOther };

/// A joint between two bodies, where it is with every joint at zero.
struct Connection {
  std::string name;
  ConnectionKind kind = ConnectionKind::kOther;
  std::size_t first = 0, second = 0;  ///< bodies
  Point point;                        ///< in the frame of the world
  Point axis;                         ///< of a revolute or prismatic joint
  int line = 0;
  double gap = 0;  ///< between its two sides with every joint at zero, beyond rounding
  std::optional<std::string> mimics{};  ///< the joint that this one follows
};

/// @throws InputError for a joint of a leg that follows another: the legs move by the loops alone.
void require_independent(const Connection& connection, const std::string& file);

class BodyGraph {
 public:
  explicit BodyGraph(const Mechanism& mechanism);

  [[nodiscard]] const std::vector<Connection>& connections() const noexcept { return connections_; }
  [[nodiscard]] std::size_t body_of(const std::string& link) const { return body_.at(link); }
  /// Returns the connections of a body, by their indices.
  [[nodiscard]] std::vector<std::size_t> of_body(std::size_t body) const;
  /// Returns the first link of a body.
  [[nodiscard]] const std::string& link_of(std::size_t body) const { return links_.at(body); }
  [[nodiscard]] std::size_t bodies() const noexcept { return links_.size(); }
  [[nodiscard]] const Placement& placement(const std::string& link) const {
    return placements_.at(link);
  }

 private:
  void place_links(const Mechanism& mechanism);
  void unite_links(const Mechanism& mechanism);
  void connect(const Mechanism& mechanism);

  std::map<std::string, Placement> placements_;
  std::map<std::string, std::size_t> body_;
  std::vector<std::string> links_;
  std::vector<Connection> connections_;
};

}  // namespace regulus::detail
