// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/serial_reading.hpp"

#include <algorithm>

#include "runtime/verifier/model/arm_comparison.hpp"

namespace regulus::verifier {
namespace {

class SerialReading final : public SectionReading {
 public:
  explicit SerialReading(const WrittenValues& values)
      : names_(chain_names(values)), angle_unit_(is_arm_in_degrees(values) ? "deg" : "rad") {
    const auto unit = values.find("serial.unit");
    if (unit != values.end()) unit_ = unit->second.text;
  }

  [[nodiscard]] std::vector<SectionPose> pose() const override {
    std::vector<SectionPose> result;
    for (const ChainName& joint : names_)
      result.push_back({joint.name, joint.slides ? unit_ : angle_unit_});
    return result;
  }

  [[nodiscard]] std::string place_in_motion(const std::string& motion,
                                            const std::string& pose) const override {
    const auto joint = std::ranges::find(names_, pose, &ChainName::name);
    return motion != "limits" || joint == names_.end() ? "" : joint->range;
  }

  [[nodiscard]] SectionArm arm(SectionComparer& comparer) override {
    const ReadArm chain = read_arm(comparer);
    std::vector<std::size_t> leaders;
    for (std::size_t k = 0; k < chain.joints.size(); ++k)
      if (!chain.joints[k].follows) leaders.push_back(k);
    SectionArm arm{{}, chain.tool};
    for (std::size_t k = 0; k < chain.joints.size(); ++k) {
      const ChainJoint& joint = chain.joints[k];
      if (leaders.size() != names_.size() || (!joint.follows && leaders[joint.column] != k))
        throw Unfinished("the joints of the arm are not those that have names");
      const ChainName& leader = names_[joint.column];
      SectionJoint& read = arm.joints.emplace_back(SectionJoint{
          leader.name, joint.slides, joint.origin, joint.axis, joint.value, leader.range});
      if (!joint.follows) continue;
      read.leader = leaders[joint.column];
      read.multiplier = joint.rate;
      read.offset = joint.offset;
    }
    return arm;
  }

  void compare(SectionComparer& comparer) override {
    compare_arm(comparer, read_chain(comparer), names_.size());
  }

 private:
  const std::vector<ChainName> names_;
  const std::string angle_unit_;
  std::string unit_ = "1";
};

}  // namespace

std::unique_ptr<SectionReading> serial_reading(const WrittenValues& values) {
  return std::make_unique<SerialReading>(values);
}

}  // namespace regulus::verifier
