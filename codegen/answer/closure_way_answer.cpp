// SPDX-License-Identifier: GPL-3.0-or-later
// A branch of a closure that is followed along way-points.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/lines_file.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/picture/way_picture.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/answer/report/search_checkpoint.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/closure/closure_way_report.hpp"
#include "codegen/question/closure/paving_certificate.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// Returns everything that the boxes of all pieces depend on. `resolution`: of a paving; 0: of a check.
Json checkpointed_way(const PreparedWay& prepared, const SearchOptions& search, double resolution) {
  Json question = checkpointed_question(prepared.request, search);
  question["closure"] = prepared.common.shape.unknowns;
  question["paves"] = resolution > 0;
  question["resolution"] = resolution;
  return question;
}

/// The file stays if the searches were ended and may go on.
void finish(SearchCheckpoint& checkpoint, const WayFinding& found) {
  checkpoint.finish(!found.is_refuted() && found.result.stopped_by.has_value());
}

/// The answer has no `variables`, as that of other motions along way-points.
class ClosureWayCheck final : public CheckAnswer {
 public:
  ClosureWayCheck(Request request, double model_seconds, const AskCheck& asked,
                  const Services& services)
      : search_(asked.search),
        prepared_(
            prepare_way(std::move(request), model_seconds, search_, watch_of(services, search_))) {
    services.begin_search();
    SearchDisplay display(display_of(services));
    SearchCheckpoint checkpoint(
        services.checkpoint, [&] { return checkpointed_way(prepared_, search_, 0); }, true);
    found_ = check_way(prepared_, search_, watch_of(services, search_),
                       {display.observer(), {}, {checkpoint.file(), checkpoint.interval(), ""}});
    proof = certify_way(services.certificate, prepared_, found_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    write_beside([&] { finish(checkpoint, found_); });
    checkpoint_line_ = checkpoint.line();
    result = found_.result;
  }

  [[nodiscard]] std::string claim() const override { return describe_claim(prepared_, found_); }
  void tell(Facts& facts) const override {
    tell_closure_way(prepared_, search_, found_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  SearchOptions search_;
  PreparedWay prepared_;
  WayFinding found_;
  std::string checkpoint_line_;
};

/// The answer has stretches, and no boxes.
class ClosureWayPaving final : public PavingAnswer {
 public:
  ClosureWayPaving(Request request, double model_seconds, const AskPaving& asked,
                   const Services& services)
      : search_(asked.search),
        lines_(services.lines),
        resolution_(asked.resolution.empty() ? kPathResolution : read_resolution(asked.resolution)),
        prepared_(
            prepare_way(std::move(request), model_seconds, search_, watch_of(services, search_))) {
    WayPictures pictures(services.pictures);
    services.begin_search();
    SearchDisplay display(display_of(services));
    SearchCheckpoint checkpoint(
        services.checkpoint, [&] { return checkpointed_way(prepared_, search_, resolution_); },
        true);
    found_ = pave_way(prepared_, search_, resolution_, watch_of(services, search_),
                      {display.observer(), {}, {checkpoint.file(), checkpoint.interval(), ""}});
    result = found_.result;
    proof = certify_paving(services.certificate, prepared_, found_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    stretches_ = stretches_of(prepared_, found_);
    const Request& request_asked = prepared_.request;
    const Trajectory& trajectory = *request_asked.motion.trajectory;
    for (const PathStretch& stretch : stretches_)
      stretches.push_back({stretch.claim, stretch.begin.piece + 1, stretch.end.piece + 1,
                           stretch.begin.s, stretch.end.s,
                           report_text(json_stretch_of(trajectory, stretch, regulus::name))});
    write_beside([this] { write(); });
    write_beside([&] {
      pictures.draw({fmt::format("{}, {}", request_asked.model.name, request_asked.motion.name),
                     trajectory, stretches_, regulus::name});
    });
    write_beside([&] { finish(checkpoint, found_); });
    checkpoint_line_ = checkpoint.line();
  }

  [[nodiscard]] Json header() const override { return {}; }
  void tell(Facts& facts) const override {
    tell_way_paving(prepared_, search_, resolution_, found_, stretches_, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  void write() {
    if (!lines_.is_wanted()) return;
    for (const StretchOfWay& stretch : stretches) lines_.stream() << stretch.line << '\n';
    lines_.stream() << report_text({{"summary", json()}}) << '\n';
    lines_.finish();
  }

  SearchOptions search_;
  LinesFile lines_;
  double resolution_;
  PreparedWay prepared_;
  WayFinding found_;
  std::vector<PathStretch> stretches_;
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<CheckAnswer> answer_closure_way(Request request, double model_seconds,
                                                const AskCheck& asked, const Services& services) {
  return std::make_unique<ClosureWayCheck>(std::move(request), model_seconds, asked, services);
}

std::unique_ptr<PavingAnswer> answer_closure_way(Request request, double model_seconds,
                                                 const AskPaving& asked, const Services& services) {
  return std::make_unique<ClosureWayPaving>(std::move(request), model_seconds, asked, services);
}

}  // namespace regulus::detail
