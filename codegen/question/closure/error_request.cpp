// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/error_request.hpp"

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

class ErrorRequestBuilder {
 public:
  explicit ErrorRequestBuilder(const Request& given) : request_(given) {
    Motion& motion = request_.motion;
    Model& model = request_.model;
    Closure& closure = *model.closure;
    const std::set<std::string> uncertain = uncertain_names(given);
    std::vector<PoseParameter> pose;
    std::vector<ex> start;
    GiNaC::exmap actual, commanded;
    for (const MotionParameter& p : given.motion.parameters) {
      pose.push_back({p.symbol, p.name, p.unit});
      start.push_back(start_of_parameter(given, p));
    }
    parameters_ = pose.size();
    for (std::size_t i = 0; i < given.model.pose.size(); ++i) {
      const PoseParameter& q = given.model.pose[i];
      actual[q.symbol] = commanded[q.symbol] = given.motion.pose[i];
      if (given.motion.error.empty() || given.motion.error[i].is_zero()) continue;
      const GiNaC::realsymbol error(q.name + "_error");
      actual[q.symbol] = given.motion.pose[i] + error;
      add({error, q.name + "_error", q.unit}, {-given.motion.error[i], given.motion.error[i]}, 0,
          pose, start);
    }
    for (const GeometryParameter& g : given.model.geometry) {
      if (!uncertain.contains(g.name)) continue;
      if (g.ball >= 0)
        throw UsageError("finite errors take tolerances that are ranges; the point of '" + g.name +
                         "' lies in a ball");
      add({g.symbol, g.name, "1"}, {g.value - g.tolerance, g.value + g.tolerance}, g.value, pose,
          start);
    }
    if (pose.size() == parameters_)
      throw UsageError(
          "nothing has an error: give the motion an `error`, or the geometry tolerances");
    std::erase_if(model.geometry,
                  [&](const GeometryParameter& g) { return uncertain.contains(g.name); });
    for (ex& equation : closure.equations) equation = equation.subs(actual);
    for (ex& condition : model.must_be_defined) condition = condition.subs(actual);
    for (auto* conditions : {&motion.constraints, &motion.reach, &motion.must_be_defined})
      for (ex& condition : *conditions) condition = condition.subs(commanded);
    model.pose = pose;
    closure.start_pose = start;
    motion.pose.clear();
    for (const PoseParameter& q : pose) motion.pose.emplace_back(q.symbol);
    motion.error.assign(pose.size(), 0);
  }

  ErrorRequest take() { return {std::move(request_), parameters_}; }

 private:
  static ex start_of_parameter(const Request& given, const MotionParameter& p) {
    for (std::size_t i = 0; i < given.model.pose.size(); ++i)
      if (given.model.pose[i].symbol.is_equal(p.symbol)) return given.model.closure->start_pose[i];
    throw UsageError("finite errors take motions whose parameters are those of [pose]");
  }

  void add(const PoseParameter& error, const Range& range, const ex& middle,
           std::vector<PoseParameter>& pose, std::vector<ex>& start) {
    pose.push_back(error);
    start.push_back(middle);
    request_.motion.parameters.push_back({error.symbol, error.name, error.unit, range});
  }

  Request request_;
  std::size_t parameters_ = 0;
};

}  // namespace

ErrorRequest with_errors_as_parameters(const Request& given) {
  return ErrorRequestBuilder(given).take();
}

}  // namespace regulus
