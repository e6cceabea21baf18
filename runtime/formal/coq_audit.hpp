// SPDX-License-Identifier: Apache-2.0
// Is a file what it looks like? Only a file of the plain grammar is given to Coq: the imports that
// `regulus-verify --coq` writes, definitions of the names that it writes, in words that the library
// gives their meaning, and its theorem. So no notation, option, axiom or second meaning of a name can
// stand between the text and what Coq proves.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regulus::verifier {

/// The folder and the file of the audited text have these names in Coq.
inline constexpr const char* kAuditedFolder = "RegulusAudited";
inline constexpr const char* kAuditedFile = "audited";

/// A theorem about the robot of a model file: as written, with single spaces.
struct PlainGeometry {
  std::string name, statement;
};

struct PlainTheorem {
  std::string statement;  ///< as written, with single spaces
  std::string type;       ///< the same, each name by its whole path
  /// A file with theorems about a robot has these: the import of Geometry.v or Arms.v, the definitions that
  /// the theorems use, as sentences that need this import alone, and the theorems.
  std::string geometry_import{}, definitions{};
  std::vector<PlainGeometry> geometry{};
  /// They are about all points of a set, and nothing says that there is one.
  bool may_be_empty = false;
};

/// Throws Rejection, with the line and what is not plain.
[[nodiscard]] PlainTheorem read_plain_theorem(std::string_view text);

}  // namespace regulus::verifier
