// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <iostream>
#include <optional>
#include <sstream>
#include <system_error>

#include "codegen/analysis/least_singular.hpp"
#include "codegen/bound/bound_report.hpp"
#include "codegen/bound/bound_run.hpp"
#include "codegen/certificate/certificate_file.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/end_command.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/command/shared_options.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/margin/margin_report.hpp"
#include "codegen/margin/prepared_margin.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/page/page_data.hpp"
#include "codegen/page/page_template.hpp"
#include "codegen/page/paving_tree.hpp"
#include "codegen/report/paving_options.hpp"
#include "codegen/report/paving_report.hpp"
#include "codegen/report/progress.hpp"
#include "codegen/report/report.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/scratch_folder.hpp"
#include "runtime/files/atomic_file.hpp"
#include "runtime/problem/observers.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::inline command {
namespace {

/// A certificate beyond this size stays out of the page.
constexpr std::size_t kLongestProof = std::size_t{4} << 20;

/// Runs what the page shows, one part after another.
class PageRun {
 public:
  PageRun(const ReportCommand& command, const std::string& typed)
      : command_(command), typed_(typed) {}

  void run() {
    check();
    if (command_.paves) pave();
    for (const std::string& quantity : command_.bounds) bound(quantity);
    for (const std::string& margin : command_.margins) bracket(margin);
  }

  [[nodiscard]] PageTexts texts() const {
    const std::string claim = data_.report.value("claim", "");
    return {.title = fmt::format("{}, {}: {}", data_.report.value("model", ""),
                                 data_.report.value("motion", ""), name(result_.verdict)),
            .verdict = name(result_.verdict),
            .verdict_class = data_.report.value("verdict", ""),
            .claim = claim,
            .report = text_,
            .data = json_text(data_)};
  }

  /// As `check --json`, with the file of the page.
  [[nodiscard]] nlohmann::ordered_json json_report(const std::string& page) const {
    nlohmann::ordered_json report = data_.report;
    report["page"] = page;
    return report;
  }

  [[nodiscard]] ExitCode end() {
    return end_command(*prepared_, command_.output, result_, interrupted());
  }

 private:
  const std::atomic<bool>& interrupted() const { return interrupt_.requested(); }

  void check() {
    data_.model_text = model_text(command_.model);
    Request request = read_request(data_.model_text, command_.model);
    if (request.motion.trajectory)
      throw UsageError(
          "a page shows no motion along way-points; use `regulus check`, or a motion of "
          "parameters");
    PreparedSearch& p = prepared_.emplace(prepare(command_.model, command_.search, watch()));
    interrupt_.begin_search();
    const std::string model_text = std::move(data_.model_text);
    data_ = begin_page(p, command_.model);
    data_.model_text = model_text;
    data_.command = typed_;
    search(p);
    if (!command_.output.quiet) std::cerr << text_;
  }

  void search(PreparedSearch& p) {
    const ScratchFolder scratch;
    const std::string file = scratch.path() / "certificate";
    CertificateFile certificate(file, p);
    SearchDisplay display(command_.output);
    std::vector<Observer*> watching;
    for (Observer* observer : {certificate.observer(), display.observer()})
      if (observer != nullptr) watching.push_back(observer);
    Observers observers(std::move(watching));
    result_ =
        run_search(p, command_.search, settings_of(p, command_.search, &interrupted()), &observers);
    certificate.finish(result_);
    const auto nearest = nearest_singular(p, result_);
    text_ = text_report(p, command_.search, result_, nearest);
    data_.report = regulus::json_report(p, command_.search, result_, nearest);
    take(certificate, file);
  }

  void take(const CertificateFile& certificate, const std::string& file) {
    nlohmann::ordered_json about;
    certificate.add_to(about);
    data_.certificate_note = about.value("certificate_obstacle", "");
    if (!certificate.written()) return;
    data_.certificate = read_start(file, kLongestProof + 1, Readable::kFile);
    if (data_.certificate.size() <= kLongestProof) return;
    data_.certificate.clear();
    data_.certificate_note =
        "its proof is longer than a page holds; `regulus check --certificate` "
        "writes it to a file";
  }

  void pave() {
    ModelOptions model = command_.model;
    model.separates_reach = true;
    PreparedSearch p = prepare(model, command_.search, watch());
    const PavingOptions options = resolve_paving(command_.resolution, command_.search, p);
    const Problem problem = p.problem();
    Volumes volumes(problem, p.labels.reach);
    PavingTree tree(problem, p.labels.reach);
    Observers observers({&volumes, &tree});
    Settings settings = settings_of(p, command_.search, &interrupted());
    require_paving(options, settings);
    const Result paved = run_search(p, command_.search, settings, &observers);
    data_.paving = {{"header", json_paving_header(p, options)},
                    {"summary", json_paving_summary(p, command_.search, options, volumes, paved)},
                    {"tree", tree.text()}};
    if (data_.paving["tree"].get_ref<const std::string&>().size() > kLongestProof)
      throw UsageError("the paving has more boxes than a page holds; use a coarser --resolution");
  }

  void bound(const std::string& quantity) {
    ModelOptions model = command_.model;
    QuantityOptions options{.quantity = quantity, .load = command_.load, .twist = command_.twist};
    refuse_threshold(model);
    if (!kind_of(quantity)) model.asked = quantity;
    BoundSettings settings;
    settings.gap = read_gap(command_.gap);
    settings.search = search_of_bracket();
    settings.output = command_.output;
    settings.interrupt = &interrupted();
    const Request request = read_request(model);
    const Bound found = bound_quantity(request, quantity_of(request.model, options), settings,
                                       [](const ComponentBound&) {});
    data_.bounds.push_back(json_bound(request, found, settings));
  }

  void bracket(const std::string& margin) {
    ModelOptions model = command_.model;
    model.tolerances.push_back(margin);
    const MarginQuestion question = take_question(model, {});
    PreparedMargin prepared(question, read_request(model), 0, compiled_first(search_of_bracket()),
                            watch());
    prepared.settings.interrupt = &interrupted();
    MarginCertificates none("", prepared.request, prepared.prepared.labels);
    MarginRun run(prepared.prepared, question, prepared.request, prepared.search, command_.output,
                  prepared.settings, read_gap(command_.gap), none, [](const MarginStep&) {});
    const Margin found = run.run();
    auto report = json_margin(prepared.prepared, prepared.search, prepared.request.nominal(),
                              question, found, read_gap(command_.gap));
    report["bracket"] = describe_bracket(question, found);
    data_.margins.push_back(std::move(report));
  }

  /// Each bracket has a time limit of its own, as `bound` and `margin` have.
  SearchOptions search_of_bracket() const {
    SearchOptions search = command_.search;
    if (!search.time_limit) search.time_limit = kMarginSeconds;
    return search;
  }

  FormingWatch watch() const { return forming_watch(command_.output, &interrupted()); }

  const ReportCommand& command_;
  const std::string& typed_;
  InterruptGuard interrupt_;
  std::optional<PreparedSearch> prepared_;
  Result result_;
  std::string text_;
  PageData data_;
};

void write_page(const std::string& path, const std::string& text) try {
  AtomicFile file(path, path + ".partial");
  file.write(text);
  file.put_in_place();
} catch (const std::system_error& error) {
  throw FileError(path + " cannot " + error.what());
}

}  // namespace

int run_report(const ReportCommand& command, const std::string& typed) {
  const PageTemplate page = PageTemplate::installed();
  static_cast<void>(read_gap(command.gap));
  set_earlier_outputs_aside(command.model.path, {{"--output", command.page, true}});
  PageRun run(command, typed);
  run.run();
  const PageTexts texts = run.texts();
  const std::string text = page.fill(texts);
  write_page(command.page, text);
  if (!command.output.quiet)
    std::cerr << fmt::format("page       {}, {:.0f} kB\n", command.page,
                             double(text.size()) / 1000);
  if (command.output.json)
    std::cout << run.json_report(command.page).dump(command.output.json_indent) << '\n';
  else
    std::cout << texts.verdict << '\n';
  return run.end();
}

}  // namespace regulus::command
