// SPDX-License-Identifier: GPL-3.0-or-later
// A model with a [closure] beside the robot of the file that it was made of.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "codegen/model/file/model_file.hpp"
#include "tests/support/evaluate.hpp"
#include "tests/support/loops/file_robot.hpp"
#include "tests/support/loops/formula_tape.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

class ComparedClosure {
 public:
  ComparedClosure(const FileRobot& robot, const Model& model)
      : robot_(robot),
        model_(model),
        names_(names_of(model)),
        tape_(model.closure->equations, names_) {
    for (const std::string& name : names_) joints_.push_back(joint_called(name));
    for (const Freedom& freedom : robot.passive()) {
      passive_.push_back(freedom);
      const auto known = std::ranges::find(joints_, freedom.joint);
      column_of_.push_back(known == joints_.end() ? names_.size()
                                                  : std::size_t(known - joints_.begin()));
      if (known == joints_.end()) others_.push_back(freedom);
    }
  }

  /// The file's configuration at the start of the model; nullopt if its loops are open there by more
  /// than some length.
  [[nodiscard]] std::optional<Configuration> start(RandomSource& random, double tolerance) const {
    Configuration begin = robot_.at_zero();
    for (std::size_t i = 0; i < joints_.size(); ++i)
      begin.values[joints_[i]] = evaluate(
          i < pose() ? model_.closure->start_pose[i] : model_.closure->start[i - pose()], {});
    for (int trial = 0; trial < 60; ++trial) {
      Configuration at = begin;
      if (trial > 0)
        for (const Freedom& f : others_) robot_.move(at, f, random.between(-3, 3));
      if (robot_.close(at, others_, 200, 1e-3) > tolerance) continue;
      robot_.close(at, passive_);
      return at;
    }
    return std::nullopt;
  }

  /// Moves the motors to some values in steps that Newton's method follows. Returns false where it
  /// does not: the branch may end.
  [[nodiscard]] bool drive(Configuration& at, const std::vector<double>& motors,
                           double longest) const {
    double way = 0;
    for (std::size_t i = 0; i < pose(); ++i)
      way = std::fmax(way, std::fabs(motors[i] - at.values[joints_[i]]));
    const int steps = std::max(1, int(std::ceil(way / longest)));
    std::vector<double> from;
    for (std::size_t i = 0; i < pose(); ++i) from.push_back(at.values[joints_[i]]);
    for (int step = 1; step <= steps; ++step) {
      for (std::size_t i = 0; i < pose(); ++i)
        at.values[joints_[i]] = from[i] + (motors[i] - from[i]) * step / steps;
      if (robot_.close(at, passive_) > 1e-10) return false;
    }
    return true;
  }

  [[nodiscard]] std::vector<double> values(const Configuration& at) const {
    std::vector<double> v;
    for (const std::size_t j : joints_) v.push_back(at.values[j]);
    return v;
  }

  /// The largest equation of the model at a configuration of the file.
  [[nodiscard]] double residual(const Configuration& at) const {
    double most = 0;
    for (const double x : tape_.at(values(at))) most = std::fmax(most, std::fabs(x));
    return most;
  }

  /// The least singular value of the model's ∂Φ/∂unknowns, by central differences.
  [[nodiscard]] double least_of_model(const Configuration& at) const {
    std::vector<double> v = values(at);
    const std::size_t n = model_.closure->unknowns.size();
    Dense J = dense(n, n);
    for (std::size_t c = 0; c < n; ++c) {
      const double kept = v[pose() + c];
      v[pose() + c] = kept + 1e-6;
      const std::vector<double> above = tape_.at(v);
      v[pose() + c] = kept - 1e-6;
      const std::vector<double> below = tape_.at(v);
      v[pose() + c] = kept;
      for (std::size_t r = 0; r < n; ++r) J(r, c) = (above[r] - below[r]) / 2e-6;
    }
    return singular_of(J).values.front();
  }

  /// What the file's joints can do while the motors are locked.
  struct Locked {
    std::size_t freedoms = 0;
    double moves_unknown = 0;  ///< the most that a unit motion of them turns or slides an unknown
  };
  [[nodiscard]] Locked locked(const Configuration& at) const {
    const Singular s = singular_of(robot_.differences(at, passive_));
    Locked result;
    for (std::size_t k = 0; k < s.values.size() && s.values[k] < 1e-7; ++k) {
      ++result.freedoms;
      for (std::size_t i = 0; i < passive_.size(); ++i)
        if (column_of_[i] < names_.size())
          result.moves_unknown = std::fmax(result.moves_unknown, std::fabs(s.vectors[k][i]));
    }
    return result;
  }

  /// Random values of the motors within a motion of the model.
  [[nodiscard]] std::vector<double> drives(const Motion& motion, RandomSource& random) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < pose(); ++i) {
      const auto p = std::ranges::find(motion.parameters, names_[i], &MotionParameter::name);
      if (p == motion.parameters.end())
        result.push_back(evaluate(motion.pose[i], {}));
      else
        result.push_back(random.between(evaluate(p->range.lo, {}), evaluate(p->range.hi, {})));
    }
    return result;
  }

  [[nodiscard]] const std::vector<Freedom>& passive() const { return passive_; }

 private:
  [[nodiscard]] std::size_t pose() const { return model_.pose.size(); }

  static std::vector<std::string> names_of(const Model& model) {
    std::vector<std::string> names;
    for (const PoseParameter& p : model.pose) names.push_back(p.name);
    for (const PoseParameter& u : model.closure->unknowns) names.push_back(u.name);
    return names;
  }

  /// Names of joints may have characters that names of a model have not.
  [[nodiscard]] std::size_t joint_called(const std::string& name) const {
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      std::string plain = robot_.joints[j].name;
      for (char& c : plain)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      if (plain == name || "q_" + plain == name) return j;
    }
    throw std::invalid_argument("the file has no joint " + name);
  }

  const FileRobot& robot_;
  const Model& model_;
  const std::vector<std::string> names_;  ///< of pose parameters and unknowns
  const FormulaTape tape_;
  std::vector<std::size_t> joints_;  ///< by name
  std::vector<Freedom> passive_, others_;
  std::vector<std::size_t> column_of_;  ///< of a passive freedom: its name's, or names_.size()
};

}  // namespace regulus::detail::test
