// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/piece_question.hpp"

#include <algorithm>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

bool is_used(const Model& model, const std::string& name) {
  const auto is_named = [&name](const auto& q) { return q.name == name; };
  return std::ranges::any_of(model.pose, is_named) ||
         std::ranges::any_of(model.geometry, is_named) ||
         (model.closure && std::ranges::any_of(model.closure->unknowns, is_named));
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

/// The branch of a closure is followed along a piece from where the piece begins.
void begin_closure_there(Request& request) {
  if (!request.model.closure) return;
  GiNaC::exmap begin;
  for (const MotionParameter& p : request.motion.parameters) begin[p.symbol] = p.range.lo;
  for (std::size_t i = 0; i < request.motion.pose.size(); ++i)
    request.model.closure->start_pose.at(i) = request.motion.pose[i].subs(begin);
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
  // A path that stays at the origin has no other number.
  if (slots.empty())
    slots.push_back({0, 0, GiNaC::realsymbol(unused_name(model, model.pose[0].name + "_c0"))});
  return slots;
}

std::string number_text(const ex& e) {
  if (!e.info(GiNaC::info_flags::rational)) return expression_text(e);
  std::ostringstream text;
  text << e;
  return text.str();
}

/// The lines `piecewise` and `piece`.
std::string piece_lines(const std::vector<PieceConstant>& constants) {
  std::string text = "piecewise";
  for (const PieceConstant& c : constants) text += ' ' + c.quantity.name;
  text += '\n';
  for (std::size_t k = 0; k < constants.front().values.size(); ++k) {
    text += "piece";
    for (const PieceConstant& c : constants)
      text += (&c == constants.data() ? " " : " | ") + number_text(c.values[k]);
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
  begin_closure_there(result);
  return result;
}

PiecesRequest pieces_request(const Request& request) {
  const Trajectory& trajectory = *request.motion.trajectory;
  const GiNaC::realsymbol s(unused_name(request.model, "s"));
  PiecesRequest all{along_parameter(request, s), {}};
  std::vector<PieceOfPose> pose(trajectory.pieces.front().pose.size());
  for (const Slot& slot : slots_of(request.model, trajectory)) {
    PieceOfPose& p = pose[slot.parameter];
    if (slot.coefficient < p.power.size())
      p.power[slot.coefficient] = slot.symbol;
    else
      (slot.coefficient == 4 ? p.cosine : slot.coefficient == 5 ? p.sine : p.turn) = slot.symbol;
    PieceConstant& constant = all.constants.emplace_back();
    constant.quantity = {slot.symbol, slot.symbol.get_name(), "1"};
    for (const TrajectoryPiece& piece : trajectory.pieces)
      constant.values.push_back(coefficient(piece.pose[slot.parameter], slot.coefficient));
  }
  for (const PieceOfPose& p : pose) all.request.motion.pose.push_back(expression_of(p, s));
  append_added_poses(all.request.motion, request.motion);
  begin_closure_there(all.request);
  return all;
}

CertifiedAbout is_regular() {
  return [](const Request& request, const std::set<std::string>& uncertain) {
    return certified_question(request, uncertain);
  };
}

CertifiedQuestion trajectory_question(const Request& request,
                                      const std::set<std::string>& uncertain,
                                      const CertifiedAbout& about) {
  const PiecesRequest all = pieces_request(request);
  CertifiedQuestion question = about(all.request, uncertain);
  const std::size_t poses = question.text.find("\npose ");
  question.text.insert(poses + 1, piece_lines(all.constants));
  return question;
}

}  // namespace regulus::detail
