// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/paving_writer.hpp"

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/paving_report.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/answer/report/undefined_report.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

Json json_points(const PreparedSearch& p, const Witness& witness) {
  Json points = Json::array();
  for (const WitnessPoint& point : witness.points) points.push_back(json_point(p, point));
  return points;
}

Json json_determinant(const std::optional<Interval>& determinant) {
  return determinant ? json_interval(*determinant) : Json(nullptr);
}

}  // namespace

void PavingWriter::write(const Json& line) {
  out_ << report_text(line) << '\n';
  if (!out_) failed_ = true;
}

/// If a line cannot be written, the search ends, because its results would be lost.
template <class Line>
void PavingWriter::write_safely(Line line) noexcept {
  if (failed_) return;
  try {
    write(line());
  } catch (const std::exception&) {
    failed_ = true;
  }
  if (failed_) ask_for_end_();
}

PavingWriter::PavingWriter(std::ostream& out, const PreparedSearch& preparation,
                           const PavingOptions& options, std::function<void()> ask_for_end)
    : out_(out),
      preparation_(preparation),
      ask_for_end_(std::move(ask_for_end)),
      claims_(preparation.problem(), preparation.labels.reach),
      definedness_(preparation.stages->natural_formulation()),
      encloses_determinants_(options.encloses_determinants) {
  write_safely([&] { return json_paving_header(preparation, options); });
}

Json PavingWriter::leaf(const OpenBox& box, Rule rule, const Proof& proof) {
  const Claim claim = claims_.of(box.box, rule);
  Json line = {{"kind", name(claim)}, {"box", json_parameters(preparation_, box.box)}};
  if (claim == Claim::kFree || claim == Claim::kOutside || claim == Claim::kUnreachable)
    line["rule"] = name(rule);
  if (claim == Claim::kSingular || claim == Claim::kUndecided)
    line["reason"] = describe(proof.reason);
  if (proof.witness != nullptr) line["points"] = json_points(preparation_, *proof.witness);
  if (claim == Claim::kUndecided && proof.reason == Reason::kUndefined)
    line["undefined"] = json_undefined(preparation_, definedness_.look_at(box.box));
  return line;
}

void PavingWriter::on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept {
  write_safely([&] {
    Json line = leaf(box, rule, proof);
    if (encloses_determinants_ && rule != Rule::kOutside)
      line["determinant"] = json_determinant(proof.determinant);
    return line;
  });
}

void PavingWriter::on_open(const OpenBox& box) noexcept {
  write_safely([&] {
    return Json{{"kind", name(Claim::kUndecided)},
                {"box", json_parameters(preparation_, box.box)},
                {"reason", "the search was stopped before it came to this box"}};
  });
}

void PavingWriter::finish(const Json& summary, const std::string& file) {
  if (!failed_) write({{"summary", summary}});
  if (failed_ && out_) throw FileError(file + " cannot be written: not enough memory");
}

}  // namespace regulus::detail
