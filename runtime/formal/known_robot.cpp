// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/known_robot.hpp"

#include <algorithm>

#include "runtime/formal/coq_keys.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostLegs = 6;

class KnownRobot : FileKeys {
 public:
  explicit KnownRobot(const WrittenValues& values) : FileKeys(values) {}

  [[nodiscard]] RobotKind kind() const {
    if (has_below("serial.")) return RobotKind::kArm;
    if (has_below("gough.") || has_struts()) return RobotKind::kPlatform;
    if (has_below("legs.")) return RobotKind::kLegs;
    if (has_below("matrix.")) return RobotKind::kMatrix;
    if (has_below("closure.")) refuse_table("closure");
    throw Unfinished(
        "the model file describes no robot: it has none of [gough], [legs], [serial] and [matrix]");
  }

  void require(RobotKind kind, const std::string& motion) const {
    for (const char* table : {"legs", "gough", "serial", "matrix", "pose", "closure"})
      if (has_below(std::string(table) + '.') && !belongs_to(kind, table)) refuse_table(table);
    if (kind == RobotKind::kPlatform) require_platform();
    if (kind == RobotKind::kLegs) require_legs();
    if (kind == RobotKind::kMatrix)
      require_known_keys("matrix.", {"rows", "row_scale", "reduced", "twist"});
    const std::string table = "motion." + motion + '.';
    if (!has_below(table) || motion.find_first_of(".[") != std::string::npos)
      throw Unfinished("the model file has no motion '" + motion + '\'');
    std::set<std::string> known{"alpha", "constraints", "error", "parameters"};
    for (const SectionPose& pose : poses_of_file(values_)) known.insert(pose.name);
    require_known_keys(table, known);
  }

 private:
  /// Returns true for [legs] with legs of variable length alone, which turn in all joints, and a platform
  /// that turns, too.
  [[nodiscard]] bool has_struts() const {
    for (std::size_t i = 0; has_below("legs.leg" + index(i)); ++i) {
      const std::string shared = word("legs.type", "");
      const std::string type = word("legs.leg" + index(i) + ".type", shared.c_str());
      if (type != "UPS" && type != "SPS") return false;
    }
    const std::string orientation = word("legs.orientation", "");
    return has_below("legs.") && orientation != "point" && orientation != "fixed";
  }

  [[noreturn]] static void refuse_table(const std::string& table) {
    refuse_model("the table [" + table + ']');
  }

  [[nodiscard]] bool belongs_to(RobotKind kind, const std::string& table) const {
    switch (kind) {
      case RobotKind::kPlatform:
        return table == (has_below("gough.") ? "gough" : "legs");
      case RobotKind::kArm:
        return table == "serial";
      case RobotKind::kLegs:
        return table == "legs";
      default:
        return table == "matrix" || table == "pose";
    }
  }

  void require_legs() const {
    require_known_keys(
        "legs.", {"orientation", "unit", "angle_unit", "type", "leg", "crank", "rod", "axis", "bar",
                  "hinge", "mode", "zero", "range", "actuated", "base_tolerance",
                  "platform_tolerance", "crank_tolerance", "rod_tolerance", "tolerance_shape"});
  }

  void require_platform() const {
    if (!has_below("gough."))
      return require_known_keys(
          "legs.", {"orientation", "unit", "angle_unit", "type", "leg", "range", "base_tolerance",
                    "platform_tolerance", "tolerance_shape"});
    require_known_keys("gough.", {"orientation", "unit", "angle_unit", "base", "platform",
                                  "base_tolerance", "platform_tolerance", "tolerance_shape"});
    for (const char* side : {"gough.base", "gough.platform"})
      if (has_below(side + index(kMostLegs))) refuse_model("more than six legs");
  }
};

}  // namespace

RobotKind kind_of_robot(const WrittenValues& values) { return KnownRobot(values).kind(); }

std::vector<SectionPose> poses_of_file(const WrittenValues& values) {
  if (const auto section = read_section(values)) return section->pose();
  constexpr std::string_view kTable = "pose.";
  std::vector<WrittenValues::const_iterator> found;
  for (auto at = values.lower_bound(kTable); at != values.end() && at->first.starts_with(kTable);
       ++at)
    found.push_back(at);
  std::ranges::sort(found, {}, [](const auto& at) { return at->second.number; });
  std::vector<SectionPose> poses;
  for (const auto& at : found) poses.push_back({at->first.substr(kTable.size()), at->second.text});
  return poses;
}

void require_known_robot(const WrittenValues& values, RobotKind kind, const std::string& motion) {
  KnownRobot(values).require(kind, motion);
}

}  // namespace regulus::verifier
