// SPDX-License-Identifier: GPL-3.0-or-later
// Where has the motion singular poses?
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/box_listener.hpp"
#include "codegen/answer/certificate/certificate_file.hpp"
#include "codegen/answer/closure_answer.hpp"
#include "codegen/answer/lines_file.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/page/paving_tree.hpp"
#include "codegen/answer/picture/pictures.hpp"
#include "codegen/answer/picture/way_picture.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/answer/refused_paving.hpp"
#include "codegen/answer/report/kept_search.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "codegen/answer/report/paving_report.hpp"
#include "codegen/answer/report/paving_writer.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/answer/report/search_checkpoint.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/engine/paving_verdict.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"
#include "codegen/question/way/read_trajectory.hpp"
#include "codegen/question/way/trajectory_paving.hpp"
#include "codegen/support/stopwatch.hpp"
#include "runtime/problem/observers.hpp"
#include "runtime/search/workspace.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// A certificate is about all poses of the motion.
ModelOptions model_of(const AskPaving& asked, const Services& services) {
  ModelOptions model = asked.model;
  model.separates_reach = services.certificate.empty();
  return model;
}

Json checkpointed_paving(const PreparedSearch& prepared, const SearchOptions& search,
                         double resolution) {
  Json question = json_kept_question(prepared, search);
  question["separates_reach"] = prepared.labels.reach;
  question["paves"] = true;
  question["resolution"] = resolution;
  return question;
}

class VarietyPaving final : public PavingAnswer {
 public:
  VarietyPaving(const AskPaving& asked, const Services& services)
      : search_(asked.search),
        prepared_(prepare(model_of(asked, services), search_, watch_of(services))),
        options_(resolve_paving(asked.resolution, search_, prepared_)),
        problem_(prepared_.problem()),
        volumes_(problem_, prepared_.labels.reach) {
    for (const VariableLabel& variable : prepared_.labels.variables)
      variables.push_back(variable.name);
    pave(services);
  }

  [[nodiscard]] Json header() const override { return json_paving_header(prepared_, options_); }
  void tell(Facts& facts) const override {
    tell_paving(prepared_, prepared_.stages->request(), search_, options_, volumes_, result, facts);
    proof.tell(facts);
    facts.say("map", map_);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  void pave(const Services& services) {
    LinesFile lines(services.lines);
    Pictures pictures(services.pictures, options_, prepared_);
    BoxListener listener(services, problem_, prepared_.labels.reach);
    std::optional<PavingWriter> writer;
    if (lines.is_wanted())
      writer.emplace(lines.stream(), prepared_, options_, [&listener] { listener.ask_for_end(); });
    CertificateFile certificate(services.certificate, prepared_, services.shard_size);
    std::optional<PavingTree> tree;
    if (services.tree != nullptr) tree.emplace(problem_, prepared_.labels.reach);
    SearchDisplay display(display_of(services));
    std::vector<Observer*> watching =
        present({&volumes_, &listener, writer ? &*writer : nullptr, certificate.observer(),
                 tree ? &*tree : nullptr, display.observer()});
    for (Observer* picture : pictures.observers()) watching.push_back(picture);
    Observers observers(std::move(watching));

    Settings settings = settings_of(prepared_, search_, &listener.stop());
    require_paving(options_, settings);
    services.begin_search();
    SearchCheckpoint checkpoint(services.checkpoint, [this] {
      return checkpointed_paving(prepared_, search_, options_.resolution);
    });
    KeptSearch kept(checkpoint.file(), "search", checkpoint.interval());
    result = kept.run(prepared_, search_, settings, observers);
    listener.rethrow();
    const bool can_continue = result.stopped_by.has_value();
    conclude(settings, listener.stop());
    certificate.finish(result);
    proof = certificate.status();
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    if (tree) *services.tree = tree->text();
    write_beside([&] {
      if (writer) writer->finish(json(), lines.name());
      lines.finish();
    });
    write_beside([&] { pictures.draw(volumes_); });
    map_ = pictures.map();
    write_beside([&] { checkpoint.finish(can_continue); });
    checkpoint_line_ = checkpoint.line();
  }

  void conclude(const Settings& settings, const std::atomic<bool>& stop) {
    close_in_on_witness(prepared_, search_, settings, result);
    if (problem_.kernel->constraints > 0) {
      volumes_.set_workspace(measure_workspace(problem_, volumes_, options_.resolution, stop));
      workspace = volumes_.workspace_fraction();
    }
    keep_poses_out_of_reach(prepared_, volumes_, result);
    const auto fraction = [this](Claim claim) { return volumes_.fraction(volumes_.of(claim)); };
    free = fraction(Claim::kFree);
    singular = fraction(Claim::kSingular);
    undecided = fraction(Claim::kUndecided);
    outside = fraction(Claim::kOutside);
    unreachable = fraction(Claim::kUnreachable);
  }

  SearchOptions search_;
  PreparedSearch prepared_;
  PavingOptions options_;
  Problem problem_;
  Volumes volumes_;
  std::string map_, checkpoint_line_;
};

/// The answer for a motion along way-points has stretches, and no boxes.
class WayPaving final : public PavingAnswer {
 public:
  WayPaving(Request request, double model_seconds, const AskPaving& asked, const Services& services)
      : search_(asked.search), lines_(services.lines) {
    WayPictures pictures(services.pictures);
    SearchDisplay display(display_of(services));
    const double resolution =
        asked.resolution.empty() ? kPathResolution : read_resolution(asked.resolution);
    SearchCheckpoint checkpoint(
        services.checkpoint,
        [&] {
          Json question = checkpointed_question(request, search_);
          question["paves"] = true;
          question["resolution"] = resolution;
          return question;
        },
        true);
    paving_ = pave_trajectory(std::move(request), model_seconds, search_, resolution,
                              !services.certificate.empty(),
                              {services.interrupt, display.observer(), &checkpoint});
    proof = certify_path_paving(services.certificate, paving_, {nullptr, services.shard_size});
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    result.verdict = paving_.check.verdict;
    result.reason = paving_.check.reason;
    result.statistics = paving_.check.path.statistics;
    for (const PathStretch& stretch : paving_.stretches)
      stretches.push_back({stretch.claim, stretch.begin.piece + 1, stretch.end.piece + 1,
                           stretch.begin.s, stretch.end.s,
                           report_text(json_stretch(paving_, stretch))});
    write_beside([this] { write(); });
    const Request& asked_about = paving_.check.request;
    write_beside([&] {
      pictures.draw({fmt::format("{}, {}", asked_about.model.name, asked_about.motion.name),
                     *asked_about.motion.trajectory, paving_.stretches, regulus::name});
    });
    write_beside([&] { checkpoint.finish(paving_.check.can_continue); });
    checkpoint_line_ = checkpoint.line();
  }

  [[nodiscard]] Json header() const override { return {}; }
  void tell(Facts& facts) const override {
    tell_path_paving(paving_, search_, facts);
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
  PathPaving paving_;
  std::string checkpoint_line_;
};

}  // namespace

std::unique_ptr<PavingAnswer> ask(const AskPaving& asked, const Services& services) {
  refuse_services(Kind::kPaving, asked.model, asked.search, services);
  refuse_paving(asked.resolution, asked.model, asked.search, services);
  set_outputs_aside(asked.model, asked.search, services);
  Stopwatch watch;
  std::optional<Request> along =
      read_trajectory(model_of(asked, services), watch_of(services, asked.search));
  if (!along) {
    std::optional<Request> closed = read_closure(asked.model, watch_of(services, asked.search));
    if (!closed) return std::make_unique<VarietyPaving>(asked, services);
    return answer_closure(std::move(*closed), watch.lap(), asked, services);
  }
  if (along->model.closure)
    return answer_closure_way(std::move(*along), watch.lap(), asked, services);
  services.begin_search();
  return std::make_unique<WayPaving>(std::move(*along), watch.lap(), asked, services);
}

}  // namespace regulus::detail
