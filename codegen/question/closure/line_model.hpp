// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of a closure along a line of places.
#pragma once

#include <optional>
#include <vector>

#include "codegen/question/closure/closure_run.hpp"

namespace regulus::detail {

/// The equations along a line from the start, and what must have a value there, without uncertain
/// quantities; its part, from 0 to 1, is in the place of the motion parameters.
class LineModel {
 public:
  /// Shape     towards: by motion parameter. uncertain: by the other variables, which begin at their
  ///           middles; empty: they stay there.
  LineModel(const PreparedClosure& prepared, const std::vector<double>& towards,
            const std::vector<double>& uncertain);

  [[nodiscard]] const std::vector<GiNaC::ex>& equations() const { return equations_; }
  [[nodiscard]] const Closure& closure() const { return closure_; }
  [[nodiscard]] PoseParameter part_parameter() const { return {part_, "part_of_line", "1"}; }

  /// A system in these unknowns, whose pose parameter is `moves`, if there is one.
  [[nodiscard]] Request system(const std::optional<PoseParameter>& moves, const Range& range,
                               const GiNaC::ex& from, std::vector<PoseParameter> unknowns,
                               std::vector<Range> ranges, std::vector<GiNaC::ex> equations,
                               std::vector<GiNaC::ex> start, std::vector<GiNaC::ex> radius) const;

 private:
  const Request& given_;
  const Closure& closure_;
  const GiNaC::realsymbol part_;
  std::vector<GiNaC::ex> equations_, conditions_;
};

}  // namespace regulus::detail
