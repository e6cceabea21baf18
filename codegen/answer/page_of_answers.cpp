// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/page_of_answers.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/page/drawing_json.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/model/place.hpp"
#include "codegen/model/request.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/scratch_folder.hpp"
#include "codegen/support/shell_word.hpp"
#include "codegen/support/write_file.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// A page has the proof itself.
Json without_files(Json report) {
  for (const char* key : {"certificate", "certificate_obstacle", "certificate_note", "certificates",
                          "certificate_obstacles", "proof"})
    report.erase(key);
  return report;
}

/// A page says that there are boxes which may hold others, and shows those that its text names.
void leave_out_open_boxes(Json& report) {
  constexpr std::size_t kMost = 16;
  if (const auto open = report.find("open_boxes"); open != report.end() && open->size() > kMost)
    open->erase(open->begin() + kMost, open->end());
  if (const auto places = report.find("places"); places != report.end())
    for (Json& place : *places) leave_out_open_boxes(place);
}

std::string text_or(const Json& report, const char* key) {
  const auto found = report.find(key);
  return found != report.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Cuts the start of a proof of places after the last place that is whole. Returns the number of places
/// that are left; 0: it is no such proof, or has none.
std::size_t keep_first_places(std::string& proof) {
  if (!proof.starts_with(format::kPlacesMagic)) return 0;
  std::size_t count = 0, end = 0;
  for (std::size_t at = 0;; ++count) {
    at = proof.find(fmt::format("\nplace {}\n", count + 1), at);
    if (at == std::string::npos) break;
    end = at + 1;
  }
  if (count < 2) return 0;
  proof.resize(end);
  proof += fmt::format("{}{}\n", format::kPlaces, --count);
  return count;
}

/// Returns the boxes or the stretches of a paving for a page.
Json paving_of(const PavingAnswer& answer, std::string tree) {
  if (tree.size() > kLongestProof)
    throw UsageError("the paving has more boxes than a page holds; use a coarser --resolution");
  Json paving = {{"summary", without_files(answer.json())}};
  if (answer.stretches.empty()) {
    paving["header"] = answer.header();
    paving["tree"] = std::move(tree);
    return paving;
  }
  paving["stretches"] = Json::array();
  for (const StretchOfWay& stretch : answer.stretches)
    paving["stretches"].push_back(Json::parse(stretch.line));
  return paving;
}

ShownAnswer shown(const Asked& asked, const Answer& answer) {
  Facts facts;
  answer.tell(facts);
  return {kind_of(asked), answer.headline(), facts.text(), without_files(facts.report())};
}

/// A proof for the page, whether a file of it is wanted or not.
class ProofForPage {
 public:
  explicit ProofForPage(Services& services) {
    if (services.certificate.empty())
      services.certificate = scratch_.emplace().path() / "certificate";
  }

  /// Adds what is shown, with the proof, and leaves that out of the answer if no file is wanted.
  void add(ShownAnswer what, ProofStatus& proof, PageOfAnswers& page) {
    if (proof.is_written()) what.certificate = proof.path();
    what.no_certificate = proof.obstacle();
    page.add(std::move(what));
    if (scratch_) proof = ProofStatus();
  }

 private:
  std::optional<ScratchFolder> scratch_;
};

std::unique_ptr<Answer> ask_with_proof(const AskCheck& asked, Services services,
                                       PageOfAnswers& page) {
  ProofForPage proof(services);
  std::unique_ptr<CheckAnswer> answer = ask(asked, services);
  proof.add(shown(asked, *answer), answer->proof, page);
  return answer;
}

/// A certificate proves the boxes of a branch.
std::unique_ptr<Answer> ask_with_tree(const AskPaving& asked, Services services,
                                      PageOfAnswers& page) {
  std::string tree;
  services.tree = &tree;
  std::optional<ProofForPage> proof;
  if (page.is_about_branch()) proof.emplace(services);
  std::unique_ptr<PavingAnswer> answer = ask(asked, services);
  ShownAnswer what = shown(asked, *answer);
  what.paving = paving_of(*answer, std::move(tree));
  if (proof)
    proof->add(std::move(what), answer->proof, page);
  else
    page.add(std::move(what));
  return answer;
}

constexpr const char* kSolutions = "solutions";

/// Adds the lines that tell each of many places when it is solved.
std::unique_ptr<Answer> ask_with_lines(const AskSolve& asked, const Services& services,
                                       PageOfAnswers& page) {
  std::string lines;
  Services with_lines = services;
  if (services.on_line)
    with_lines.on_line = [&](const std::string& line) {
      lines += line;
      services.on_line(line);
    };
  std::unique_ptr<SolveAnswer> answer = ask(asked, with_lines);
  ShownAnswer what = shown(asked, *answer);
  what.text = lines + what.text;
  if (answer->proof.is_written()) what.certificate = answer->proof.path();
  what.no_certificate = answer->proof.obstacle();
  what.table = asked.table;
  page.add(std::move(what));
  return answer;
}

}  // namespace

const char* kind_of(const Asked& asked) {
  static constexpr std::array<const char*, std::variant_size_v<Asked>> kWords = {
      "check", "paving", "margin", "bound", "load", "load-paving", "datasheet", kSolutions};
  static_assert(kWords.back() != nullptr, "each question has a word");
  return kWords[asked.index()];
}

PageSubject subject_of(const Asked& asked) { return subject_of(kind_of(asked)); }

PageSubject subject_of(std::string_view kind) {
  return kind == kSolutions ? PageSubject::kPlaces : PageSubject::kMotion;
}

PageOfAnswers::PageOfAnswers(PageTemplate page, const ModelOptions& model, const std::string& typed,
                             PageSubject subject)
    : template_(std::move(page)), paths_(model, typed) {
  data_.command = typed;
  data_.model_text = model_text(model);
  if (subject == PageSubject::kPlaces) {
    data_.again = {typed, command_to_verify(model)};
    data_.drawing = json_drawing_at_solutions(read_model(data_.model_text, model, nullptr));
    return;
  }
  request_ = std::make_unique<Request>(read_request(data_.model_text, model));
  if (request_->motion.trajectory) paths_.add(request_->motion.trajectory->file);
  set_question(data_, *request_, uncertain_names(*request_), model);
}

PageOfAnswers::~PageOfAnswers() = default;

bool PageOfAnswers::is_about_branch() const { return request_ && request_->model.closure; }

void PageOfAnswers::add(ShownAnswer answer) {
  paths_.add(answer.certificate);
  const bool is_closed = is_about_branch();
  if (answer.kind == "bound") data_.bounds.push_back(answer.report);
  if (answer.kind == "datasheet")
    for (const Json& bound : answer.report["bounds"]) data_.bounds.push_back(bound);
  if (answer.kind == "margin") data_.margins.push_back(answer.report);
  if (answer.kind == "paving") data_.paving = std::move(answer.paving);
  if (!data_.kind.empty()) return;
  data_.kind = is_closed && answer.kind == "check" ? "closure" : answer.kind;
  // That of a datasheet is all its lines.
  const bool is_sheet = answer.kind == "datasheet";
  data_.headline = is_sheet ? "DATASHEET" : answer.headline;
  data_.text = is_sheet ? answer.text + answer.headline : answer.text;
  data_.report = without_files(std::move(answer.report));
  if (answer.kind == kSolutions) leave_out_open_boxes(data_.report);
  if (!answer.table.empty()) data_.again.back() += " --waypoints " + shell_word(answer.table);
  data_.certificate_note = answer.no_certificate;
  const bool is_paved_branch = is_closed && answer.kind == "paving";
  if (is_paved_branch) data_.again.front() = data_.command;
  if (answer.kind != "check" && answer.kind != kSolutions && !is_paved_branch) return;
  // A page runs no proof of a closure.
  if (request_ && request_->motion.trajectory && !is_closed && !data_.report["segment"].is_null())
    set_deciding_segment(data_, *request_, uncertain_names(*request_));
  if (!answer.certificate.empty()) take_proof(answer.certificate);
}

void PageOfAnswers::take_proof(const std::string& file) {
  data_.certificate = read_start(file, kLongestProof + 1, Readable::kFile);
  const bool is_index = data_.certificate.starts_with(format::kIndexMagic) ||
                        data_.certificate.starts_with(format::kPlacesIndexMagic);
  if (!is_index && data_.certificate.size() <= kLongestProof) return;
  if (const std::size_t count = is_index ? 0 : keep_first_places(data_.certificate); count > 0) {
    data_.certificate_note = fmt::format(
        "it has the proofs at the first {} of {} places; the option --certificate "
        "writes those at all of them to a file",
        count, data_.report["places"].size());
    data_.again.back() = "regulus verify proof.txt";  // the table has more places
    return;
  }
  data_.certificate.clear();
  data_.certificate_note =
      is_index
          ? "its proof is in several files, which a page does not hold; `regulus verify` checks it"
          : "its proof is longer than a page holds; the option --certificate writes it to a file";
}

std::size_t PageOfAnswers::write(const std::string& file) const {
  PageData data = data_;
  remove_folders(data, paths_);
  const std::string text =
      template_.fill({.title = fmt::format("{}, {}: {}", text_or(data.report, "model"),
                                           text_or(data.report, "motion"), data.headline),
                      .verdict = data.headline,
                      .claim = text_or(data.report, "claim"),
                      .report = data.text,
                      .data = json_text(data)});
  write_file(file, text);
  return text.size();
}

std::unique_ptr<Answer> ask_for_page(const Asked& asked, const Services& services,
                                     PageOfAnswers& page) {
  if (const auto* check = std::get_if<AskCheck>(&asked))
    return ask_with_proof(*check, services, page);
  if (const auto* paving = std::get_if<AskPaving>(&asked))
    return ask_with_tree(*paving, services, page);
  if (const auto* solve = std::get_if<AskSolve>(&asked))
    return ask_with_lines(*solve, services, page);
  std::unique_ptr<Answer> answer = ask(asked, services);
  page.add(shown(asked, *answer));
  return answer;
}

}  // namespace regulus::detail
