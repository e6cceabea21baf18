// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/piece_question.hpp"

#include <algorithm>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

bool is_used(const Model& model, const std::string& name) {
  const auto is_named = [&name](const auto& q) { return q.name == name; };
  return std::ranges::any_of(model.pose, is_named) || std::ranges::any_of(model.geometry, is_named);
}

std::string unused_name(const Model& model, std::string name) {
  while (is_used(model, name)) name += '_';
  return name;
}

/// Returns the question with a parameter s and without the file.
Request along_parameter(const Request& request, const GiNaC::realsymbol& s) {
  Request result = request;
  result.motion.waypoints.reset();
  result.motion.trajectory = nullptr;
  result.motion.parameters.insert(result.motion.parameters.begin(), {s, s.get_name(), "1", {0, 1}});
  result.motion.pose.clear();
  return result;
}

/// Appends the pose parameters that no piece gives.
void append_added_poses(Motion& motion, const Motion& declared) {
  const std::size_t given = declared.trajectory->pieces.front().pose.size();
  for (std::size_t i = given; i < declared.pose.size(); ++i)
    motion.pose.push_back(declared.pose[i]);
}

/// A coefficient that some piece has, as a symbol of the common question.
struct Slot {
  std::size_t parameter, coefficient;
  GiNaC::realsymbol symbol;
};

std::vector<Slot> slots_of(const Model& model, const Trajectory& trajectory) {
  std::vector<Slot> slots;
  for (std::size_t i = 0; i < trajectory.pieces.front().pose.size(); ++i)
    for (std::size_t c = 0; c < kPieceCoefficients; ++c) {
      const bool is_needed = std::ranges::any_of(trajectory.pieces, [&](const TrajectoryPiece& p) {
        return !coefficient(p.pose[i], c).is_zero();
      });
      if (is_needed)
        slots.push_back(
            {i, c,
             GiNaC::realsymbol(unused_name(model, model.pose[i].name + "_c" + std::to_string(c)))});
    }
  return slots;
}

std::string number_text(const ex& e) {
  if (!e.info(GiNaC::info_flags::rational)) return expression_text(e);
  std::ostringstream text;
  text << e;
  return text.str();
}

/// The lines `piecewise` and `piece`.
std::string piece_lines(const std::vector<Slot>& slots, const Trajectory& trajectory) {
  std::string text = "piecewise";
  for (const Slot& slot : slots) text += ' ' + slot.symbol.get_name();
  text += '\n';
  for (const TrajectoryPiece& piece : trajectory.pieces) {
    text += "piece";
    for (const Slot& slot : slots)
      text += (&slot == slots.data() ? " " : " | ") +
              number_text(coefficient(piece.pose[slot.parameter], slot.coefficient));
    text += '\n';
  }
  return text;
}

}  // namespace

Request piece_request(const Request& request, std::size_t piece) {
  const GiNaC::realsymbol s(unused_name(request.model, "s"));
  Request result = along_parameter(request, s);
  for (const PieceOfPose& p : request.motion.trajectory->pieces.at(piece).pose)
    result.motion.pose.push_back(expression_of(p, s));
  append_added_poses(result.motion, request.motion);
  return result;
}

CertifiedAbout is_regular() {
  return [](const Request& request, const std::set<std::string>& uncertain) {
    return certified_question(request, uncertain);
  };
}

CertifiedQuestion trajectory_question(const Request& request,
                                      const std::set<std::string>& uncertain,
                                      const CertifiedAbout& about) {
  const Trajectory& trajectory = *request.motion.trajectory;
  const std::vector<Slot> slots = slots_of(request.model, trajectory);
  const GiNaC::realsymbol s(unused_name(request.model, "s"));
  Request common = along_parameter(request, s);
  std::vector<PieceOfPose> pose(trajectory.pieces.front().pose.size());
  for (const Slot& slot : slots) {
    PieceOfPose& p = pose[slot.parameter];
    if (slot.coefficient < p.power.size())
      p.power[slot.coefficient] = slot.symbol;
    else
      (slot.coefficient == 4 ? p.cosine : slot.coefficient == 5 ? p.sine : p.turn) = slot.symbol;
  }
  for (const PieceOfPose& p : pose) common.motion.pose.push_back(expression_of(p, s));
  append_added_poses(common.motion, request.motion);
  CertifiedQuestion question = about(common, uncertain);
  const std::size_t poses = question.text.find("\npose ");
  question.text.insert(poses + 1, piece_lines(slots, trajectory));
  return question;
}

}  // namespace regulus
