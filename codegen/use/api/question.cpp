// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/question.hpp"

#include <utility>

#include "codegen/model/request.hpp"
#include "codegen/use/api/algebra_lock.hpp"

namespace regulus {

using namespace detail;

Question::Question() : options_(std::make_unique<ModelOptions>()) {}

Question::Question(const Robot& robot, const std::string& motion) : Question() {
  const AlgebraLock lock;
  // Reports mistakes with the place in C++, not in the generated file.
  static_cast<void>(robot.model());
  options_->path = robot.name();
  options_->text = robot.model_file();
  options_->motion = motion;
}

Question Question::of_file(const std::string& path, const std::string& motion) {
  Question question;
  question.options_->path = path;
  question.options_->motion = motion;
  return question;
}

Question Question::of_text(const std::string& text, const std::string& name,
                           const std::string& motion) {
  Question question = of_file(name, motion);
  question.options_->text = text;
  return question;
}

Question::Question(const Question& other)
    : options_(std::make_unique<ModelOptions>(*other.options_)) {}
Question& Question::operator=(const Question& other) {
  *this = Question(other);
  return *this;
}
Question::Question(Question&&) noexcept = default;
Question& Question::operator=(Question&&) noexcept = default;
Question::~Question() = default;

Question& Question::range(const std::string& parameter, const std::string& lo,
                          const std::string& hi) {
  options_->ranges.push_back(parameter + '=' + lo + ':' + hi);
  return *this;
}

Question& Question::tolerance(const std::string& groups, const std::string& tolerance) {
  options_->tolerances.push_back(groups + '=' + tolerance);
  return *this;
}

Question& Question::tube(const std::string& parameters, const std::string& error) {
  options_->tubes.push_back(parameters.empty() ? error : parameters + '=' + error);
  return *this;
}

Question& Question::waypoints(const std::string& file) {
  options_->waypoints = file;
  return *this;
}

Question& Question::beyond_limits() {
  options_->beyond_limits = true;
  return *this;
}

Question& Question::alpha(const std::string& threshold) {
  options_->alpha = threshold;
  return *this;
}

}  // namespace regulus
