// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "codegen/model/robot/robot.hpp"

namespace regulus {
namespace detail {
struct ModelOptions;
}  // namespace detail

/// A question: a robot, one of its motions, and changes to them. Numbers are exact texts: "0.1",
/// "1/3", "15*deg".
///
/// A question contains no object of GiNaC: any thread may copy it and ask it.
class Question {
 public:
  /// `motion`: empty if the robot has only one.
  ///
  /// Throws    InputError with the place in C++ for a mistake in the robot.
  explicit Question(const Robot& robot, const std::string& motion = {});
  /// The file is read when the question is asked, and mistakes in it are reported then.
  [[nodiscard]] static Question of_file(const std::string& path, const std::string& motion = {});
  /// The text of a model file. `name`: for reports and messages; way-points are looked for beside
  /// the file of that name. The text is read when the question is asked.
  [[nodiscard]] static Question of_text(const std::string& text, const std::string& name,
                                        const std::string& motion = {});
  Question(const Question& other);
  Question& operator=(const Question& other);
  Question(Question&&) noexcept;
  Question& operator=(Question&&) noexcept;
  ~Question();

  /// Replaces the motion's range of a parameter.
  Question& range(const std::string& parameter, const std::string& lo, const std::string& hi);
  /// Sets the tolerance of every quantity of a group; several groups are separated by commas.
  Question& tolerance(const std::string& groups, const std::string& tolerance);
  /// Sets the control errors of pose parameters; several are separated by commas, empty: all.
  Question& tube(const std::string& parameters, const std::string& error);
  /// Follows the way-points of a file instead of the motion's own poses.
  Question& waypoints(const std::string& file);
  /// Lets the question leave the limits of an arm's joints.
  Question& beyond_limits();
  /// Sets the threshold that |det J⁻¹| must exceed.
  Question& alpha(const std::string& threshold);

  [[nodiscard]] const detail::ModelOptions& options() const noexcept { return *options_; }

 private:
  Question();

  std::unique_ptr<detail::ModelOptions> options_;
};

}  // namespace regulus
