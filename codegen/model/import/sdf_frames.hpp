// SPDX-License-Identifier: GPL-3.0-or-later
// The frames of an SDF model: links, joints and named frames, each relative to another.
#pragma once

#include <map>
#include <set>
#include <string>

#include "codegen/model/import/exact_pose.hpp"
#include "codegen/model/import/xml_file.hpp"

namespace regulus::detail {

class SdfFrames {
 public:
  explicit SdfFrames(NumberReader& numbers) : numbers_(numbers) {}

  /// Declares a frame; `relative_to` stands for a pose that names no other. Refuses a name that is
  /// there already.
  void declare(const XmlElement& element, const std::string& relative_to);

  [[nodiscard]] bool has(const std::string& name) const { return frames_.contains(name); }

  /// Returns the frame in that of the model. Refuses a cycle, and a name that is not declared.
  [[nodiscard]] const Placement& placement(const std::string& name, const XmlElement& user);

  /// Reads a <pose>, with the frame that it is relative to.
  struct RelativePose {
    Pose pose;
    std::string relative_to;
  };
  [[nodiscard]] RelativePose read_pose(const XmlElement& element, const std::string& otherwise);

 private:
  struct Frame {
    XmlElement element;
    RelativePose pose;
  };

  NumberReader& numbers_;
  std::map<std::string, Frame> frames_;
  std::map<std::string, Placement> resolved_ = {{"__model__", {}}};
  std::set<std::string> open_;  ///< whose placement is being found
};

}  // namespace regulus::detail
