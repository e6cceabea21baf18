// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes that MJCF elements take from default classes.
#pragma once

#include <map>
#include <string>

#include "codegen/model/import/xml_file.hpp"

namespace regulus::detail {

class JointDefaults {
 public:
  /// Reads the <default> elements of a <mujoco> element.
  explicit JointDefaults(const XmlElement& mujoco);

  /// Returns the attribute of the joint: its own, or that of its class, else of `body_class`; empty
  /// if there is none.
  [[nodiscard]] std::string attribute(const XmlElement& joint, const std::string& body_class,
                                      const char* key) const;

 private:
  using Attributes = std::map<std::string, std::string>;
  void read(const XmlElement& element, const std::string& name, Attributes inherited);

  std::map<std::string, Attributes> classes_;
};

}  // namespace regulus::detail
