// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/serial.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "codegen/model/degrees.hpp"
#include "codegen/model/mechanism/constant_rank.hpp"
#include "codegen/model/mechanism/determinant_factors.hpp"
#include "codegen/model/mechanism/joint_screws.hpp"
#include "codegen/model/mechanism/nearly_singular.hpp"
#include "codegen/model/mechanism/serial_drawing.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using Rows = std::vector<std::vector<JointPolynomial>>;

constexpr std::array<const char*, 6> kRowNames = {"v_x", "v_y", "v_z", "w_x", "w_y", "w_z"};

/// The rows of J in one choice of frame, reference point and groups of angles.
struct Candidate {
  std::size_t link = 0;
  Rows rows;
  std::size_t occurrences = std::numeric_limits<std::size_t>::max();
  std::size_t terms = 0;
};

Candidate candidate(std::size_t link, const std::vector<JointScrew>& screws) {
  Candidate result{link, Rows(6), 0, 0};
  for (const JointScrew& screw : screws)
    for (std::size_t i = 0; i < 3; ++i) {
      result.rows[i].push_back(screw.velocity[i]);
      result.rows[3 + i].push_back(screw.spin[i]);
    }
  for (const auto& row : result.rows)
    for (const JointPolynomial& entry : row) {
      result.occurrences += entry.occurrences();
      result.terms += entry.terms().size();
    }
  return result;
}

/// Links near the middle: a joint variable occurs in the columns between it and the link.
bool is_near_the_middle(std::size_t link, std::size_t joints) {
  return 2 * link + 2 >= joints && 2 * link <= joints + 2;
}

/// The one with the fewest occurrences of joint variables, then the fewest terms.
Candidate best_candidate(const Serial& robot, const std::vector<const JointGroups*>& choices) {
  Candidate best;
  for (std::size_t link = 0; link <= robot.joints.size(); ++link) {
    if (!is_near_the_middle(link, robot.joints.size())) continue;
    const std::vector<Point> points = reference_points(robot, link);
    for (const JointGroups* groups : choices) {
      const std::vector<JointScrew> screws = joint_screws(robot, *groups, link);
      for (const Point& point : points) {
        Candidate next = candidate(link, moved_to(screws, point));
        if (std::pair(next.occurrences, next.terms) < std::pair(best.occurrences, best.terms))
          best = std::move(next);
      }
    }
  }
  return best;
}

bool occurs(const GiNaC::matrix& matrix, const GiNaC::realsymbol& symbol) {
  for (unsigned i = 0; i < matrix.rows(); ++i)
    for (unsigned j = 0; j < matrix.cols(); ++j)
      if (matrix(i, j).has(symbol)) return true;
  return false;
}

std::string seen_from(const Serial& robot, std::size_t link) {
  return link == 0 ? "the frame of the base"
                   : "the frame that " + robot.joints[link - 1].name + " moves";
}

/// The kind of motion, if fewer than six rows remain.
std::string describe_motion(const std::vector<std::size_t>& rows) {
  const auto spins = std::ranges::count_if(rows, [](std::size_t row) { return row >= 3; });
  const std::size_t velocities = rows.size() - static_cast<std::size_t>(spins);
  if (rows.size() == 3 && spins == 1) return "a planar arm";
  if (rows.size() == 3 && spins == 3) return "a spherical arm";
  if (rows.size() == 3 && velocities == 3) return "an arm that moves without turning";
  if (rows.size() == 4 && spins == 1) return "an arm that turns about one direction";
  return "the tool's velocities have " + plural(rows.size(), "independent row");
}

void describe_rows(Model& model, const Serial& robot, const std::vector<std::size_t>& rows) {
  const bool wide = model.pose.size() > rows.size();
  std::vector<std::string> names;
  for (const std::size_t row : rows) names.emplace_back(kRowNames[row]);
  model.matrix_kind = wide ? MatrixKind::kForwardTransposed : MatrixKind::kForward;
  std::string note = "forward Jacobian of " + plural(model.pose.size(), "joint") + ", rows " +
                     enumeration(names) + (wide ? "; transposed: more joints than rows" : "");
  model.matrix_notes.push_back(std::move(note));
  const std::size_t followers = robot.joints.size() - model.pose.size();
  if (followers > 0)
    model.matrix_notes.push_back(plural(followers, "more joint") +
                                 (followers == 1 ? " follows these, and adds to their columns"
                                                 : " follow these, and add to their columns"));
  if (rows.size() < 6)
    model.matrix_notes.push_back(describe_motion(rows) +
                                 (rows.size() == 5
                                      ? ": the other row depends on these at every pose"
                                      : ": the other " + std::to_string(6 - rows.size()) +
                                            " rows depend on these at every pose"));
}

void describe_variables(Model& model, const Serial& robot, std::size_t link) {
  std::vector<std::string> absent;
  for (const PoseParameter& p : model.pose)
    if (!occurs(model.matrix, p.symbol)) absent.push_back(p.name);
  model.matrix_notes.push_back("seen from " + seen_from(robot, link));
  if (model.jacobian)
    model.matrix_notes.emplace_back(
        "searched as a matrix of the same determinant, with the factors of it on the diagonal");
  if (!absent.empty())
    model.matrix_notes.push_back("its rank does not depend on " + enumeration(absent));
}

/// 1.5708 in the place of pi/2 can make a matrix regular that is meant to be singular.
void describe_nearness(Model& model, const std::vector<std::size_t>& rows) {
  const auto velocities = std::ranges::count_if(rows, [](std::size_t row) { return row < 3; });
  const auto ratio =
      approx_nearly_singular(model, model.jacobian.value_or(model.matrix), std::size_t(velocities));
  if (!ratio) return;
  std::ostringstream text;
  text.precision(2);
  text << "nearly singular at all poses that were tried: |det| is at most " << *ratio
       << " of the product of the columns' lengths; a number of the file may be rounded";
  model.matrix_notes.push_back(text.str());
}

/// The column of each joint, or of the joint that it follows.
std::vector<unsigned> joint_columns(const Serial& robot) {
  std::vector<unsigned> columns(robot.joints.size());
  unsigned next = 0;
  for (std::size_t j = 0; j < columns.size(); ++j)
    if (!robot.joints[j].follows) columns[j] = next++;
  for (std::size_t j = 0; j < columns.size(); ++j)
    if (robot.joints[j].follows) columns[j] = columns[robot.joints[j].follows->leader];
  return columns;
}

void set_matrix(Model& model, const Serial& robot, const Rows& rows,
                const std::vector<std::size_t>& kept) {
  const std::vector<ex> values = joint_values(model, robot);
  const std::vector<unsigned> columns = joint_columns(robot);
  const auto m = static_cast<unsigned>(kept.size()), n = static_cast<unsigned>(model.pose.size());
  GiNaC::matrix J(m, n);
  for (unsigned i = 0; i < m; ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const std::optional<Following>& follows = robot.joints[j].follows;
      const ex part = rows[kept[i]][j].expression(values);
      J(i, columns[j]) += follows ? follows->multiplier * part : part;
    }
  model.matrix = n > m ? J.transpose() : J;
}

/// Puts the factors of the determinant in the place of a square matrix: each is a function of few
/// joints, so a search has fewer boxes.
void factor_matrix(Model& model) {
  std::optional<GiNaC::matrix> factors =
      matrix_of_factors(determinant_blocks(model.matrix, model.pose));
  if (!factors) return;
  model.jacobian = std::move(model.matrix);
  model.matrix = std::move(*factors);
}

}  // namespace

std::vector<ex> joint_values(const Model& model, const Serial& robot) {
  std::vector<ex> values(robot.joints.size());
  std::size_t next = 0;
  for (std::size_t j = 0; j < values.size(); ++j)
    if (!robot.joints[j].follows) values[j] = model.pose[next++].symbol;
  for (std::size_t j = 0; j < values.size(); ++j)
    if (const auto& follows = robot.joints[j].follows)
      values[j] = follows->multiplier * values[follows->leader] + follows->offset;
  return values;
}

Model serial_model(Model model, const Serial& robot, WorkMeter* meter) {
  for (const SerialJoint& j : robot.joints)
    if (!j.follows)
      model.pose.push_back(
          {GiNaC::realsymbol(j.name), j.name, j.kind == JointKind::kRevolute ? "rad" : robot.unit});
  const auto budget = std::make_shared<TermBudget>(meter);
  const JointGroups merged = parallel_groups(robot, budget), single = single_groups(robot, budget);
  std::vector<const JointGroups*> choices = {&merged};
  if (single.count != merged.count) choices.push_back(&single);
  const Candidate best = best_candidate(robot, choices);
  const std::vector<std::size_t> kept = independent_rows(best.rows, meter);
  set_matrix(model, robot, best.rows, kept);
  factor_matrix(model);
  model.drawing = std::make_shared<Drawing>(serial_drawing(model, robot));
  describe_rows(model, robot, kept);
  describe_nearness(model, kept);
  describe_variables(model, robot, best.link);
  return model;
}

void set_angles_in_degrees(Model& model) {
  GiNaC::exmap angle;
  for (PoseParameter& p : model.pose) {
    if (p.unit != "rad") continue;
    angle[p.symbol] = p.symbol * one_degree();
    p.unit = "deg";
  }
  const auto in_degrees = [&angle](const ex& e) {
    return e.subs(angle, GiNaC::subs_options::no_pattern);
  };
  for (GiNaC::matrix* matrix : {&model.matrix, model.jacobian ? &*model.jacobian : nullptr}) {
    if (matrix == nullptr) continue;
    for (unsigned i = 0; i < matrix->rows(); ++i)
      for (unsigned j = 0; j < matrix->cols(); ++j) (*matrix)(i, j) = in_degrees((*matrix)(i, j));
  }
  Drawing drawing = *model.drawing;
  for (Drawing::Part& part : drawing.parts)
    for (Point& point : part.points)
      for (ex& coordinate : point) coordinate = in_degrees(coordinate);
  model.drawing = std::make_shared<Drawing>(std::move(drawing));
}

}  // namespace regulus::detail
