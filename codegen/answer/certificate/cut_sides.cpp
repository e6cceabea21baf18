// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/cut_sides.hpp"

#include <algorithm>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

bool is_atan2(const ex& e) { return GiNaC::is_the_function<GiNaC::atan2_SERIAL>(e); }

bool has_atan2(const ex& e) {
  return std::any_of(GiNaC::const_preorder_iterator(e.preorder_begin()), e.preorder_end(),
                     [](const ex& part) { return is_atan2(part); });
}

/// Returns the symbols whose value in the matrix is not that in a constraint.
GiNaC::exset varying_symbols(const Request& request) {
  GiNaC::exset result;
  for (const GeometryParameter& g : request.model.geometry)
    if (g.ball >= 0 || !g.tolerance.is_zero()) result.insert(g.symbol);
  for (std::size_t i = 0; i < request.motion.error.size(); ++i)
    if (!request.motion.error[i].is_zero()) result.insert(request.model.pose[i].symbol);
  return result;
}

bool has_any(const ex& e, const GiNaC::exset& symbols) {
  return std::ranges::any_of(symbols, [&e](const ex& symbol) { return e.has(symbol); });
}

/// Writes atan2(Y, X) as s·(π/2 + atan2(−X, s·Y)).
class OnSides final : public GiNaC::map_function {
 public:
  explicit OnSides(const GiNaC::exmap& sign_of) : sign_of_(sign_of) {}
  ex operator()(const ex& e) override {
    if (is_atan2(e))
      if (const auto found = sign_of_.find(e.op(0)); found != sign_of_.end()) {
        const ex& s = found->second;
        return s * (GiNaC::Pi / 2 + GiNaC::atan2(-e.op(1), s * e.op(0)));
      }
    return e.map(*this);
  }

 private:
  const GiNaC::exmap& sign_of_;
};

std::string unused_name(const Request& request, std::string name) {
  const auto is_used = [&](const auto& list) {
    return std::ranges::any_of(list, [&name](const auto& q) { return q.name == name; });
  };
  while (is_used(request.model.pose) || is_used(request.model.geometry) ||
         is_used(request.motion.parameters))
    name += '_';
  return name;
}

}  // namespace

CutSides::CutSides(const Request& request) : request_(request) {
  const GiNaC::exset varying = varying_symbols(request);
  for (const ex& e : request.model.must_be_defined) {
    if (!is_atan2(e) || has_atan2(e.op(0)) || has_atan2(e.op(1)) || has_any(e.op(0), varying))
      continue;
    const bool is_known = std::ranges::any_of(
        signs_, [&e](const Sign& known) { return known.ordinate.is_equal(e.op(0)); });
    if (is_known) continue;
    const std::string name = "side_" + std::to_string(signs_.size() + 1);
    signs_.push_back({e.op(0), GiNaC::realsymbol(unused_name(request, name))});
  }
}

Request CutSides::with_signs(const std::vector<ex>& signs) const {
  Request result = request_;
  GiNaC::exmap sign_of;
  for (std::size_t i = 0; i < signs_.size(); ++i) sign_of[signs_[i].ordinate] = signs[i];
  OnSides on_sides(sign_of);
  Model& model = result.model;
  for (unsigned i = 0; i < model.matrix.rows(); ++i)
    for (unsigned j = 0; j < model.matrix.cols(); ++j)
      model.matrix(i, j) = on_sides(model.matrix(i, j));
  for (auto* list : {&model.row_scale, &model.must_be_defined})
    for (ex& e : *list) e = on_sides(e);
  return result;
}

Request CutSides::on_sides(std::size_t number) const {
  std::vector<ex> signs;
  for (std::size_t i = 0; i < signs_.size(); ++i) signs.push_back(sign(number, i));
  Request result = with_signs(signs);
  for (std::size_t i = 0; i < signs_.size(); ++i)
    result.motion.constraints.push_back(-signs[i] * signs_[i].ordinate);
  return result;
}

CertifiedQuestion CutSides::on_all_sides(const std::set<std::string>& uncertain) const {
  std::vector<ex> signs;
  std::string lines = "piecewise";
  for (const Sign& s : signs_) {
    signs.push_back(s.symbol);
    lines += ' ' + s.symbol.get_name();
  }
  lines += '\n';
  for (std::size_t number = 0; number < count(); ++number) {
    lines += "piece";
    for (std::size_t i = 0; i < signs_.size(); ++i)
      lines += (i == 0 ? " " : " | ") + std::to_string(sign(number, i));
    lines += '\n';
  }
  CertifiedQuestion question = certified_question(with_signs(signs), uncertain);
  question.text.insert(question.text.find("\npose ") + 1, lines);
  // In this form it is seen that a piece differs from another by the sign alone.
  for (const Sign& s : signs_)
    question.text +=
        "constraint -" + s.symbol.get_name() + "*(" + expression_text(s.ordinate) + ")\n";
  return question;
}

std::string CutSides::note() const {
  std::string text;
  for (const Sign& s : signs_)
    text += (text.empty() ? "" : ", ") + expression_text(s.ordinate) + " = 0";
  return "atan2 jumps at " + text + "; on its cut the matrix has either limit";
}

}  // namespace regulus::detail
