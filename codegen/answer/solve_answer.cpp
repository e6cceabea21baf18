// SPDX-License-Identifier: GPL-3.0-or-later
// Answers which configurations, poses or postures there are, at one place or at many.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "codegen/answer/ask.hpp"
#include "codegen/answer/lines_file.hpp"
#include "codegen/answer/outputs.hpp"
#include "codegen/answer/refusals.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/answer/report/search_checkpoint.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/model/way/place_file.hpp"
#include "codegen/question/closure/branch_pieces.hpp"
#include "codegen/question/solve/list_file.hpp"
#include "codegen/question/solve/solution_bytes.hpp"
#include "codegen/question/solve/solve_report.hpp"
#include "codegen/question/solve/solve_run.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

using KeepRoots = decltype(SolveRun::keep);

/// Keeps the searches at a place in the file, which has them by its name and their number.
KeepRoots keep_in(const SearchCheckpoint& checkpoint, const std::string& place) {
  if (checkpoint.file() == nullptr) return {};
  const KeptPieces kept{checkpoint.file(), checkpoint.interval(), place + "search "};
  return [kept, number = std::make_shared<int>(0)](const RootSettings& settings,
                                                   const RootSearch& search) {
    return kept.run(settings, search, std::to_string(++*number));
  };
}

class FoundSolutions final : public SolveAnswer {
 public:
  FoundSolutions(const AskSolve& asked, const Services& services)
      : search_(asked.search),
        held_(asked.held),
        request_(read_solve_request(asked.model, watch_of(services, search_), held_)) {
    set_outputs_aside(asked.model, asked.search, services);
    const SolveAsked about{request_, search_, held_};
    SearchCheckpoint checkpoint(
        services.checkpoint, [&] { return checkpointed_question(about, ""); }, true);
    SearchDisplay display(display_of(services));
    SolveRun run{search_,
                 watch_of(services, search_),
                 services.interrupt,
                 display.observer(),
                 [&services] { services.begin_search(); },
                 held_,
                 keep_in(checkpoint, "")};
    noun = noun_of(request_);
    solutions = solve(request_, run);
    write_beside([&] { checkpoint.finish(solutions.stopped_by.has_value()); });
    checkpoint_line_ = checkpoint.line();
    proof = certify_solutions(services.certificate, request_, solutions);
    if (proof.is_lost()) lost.push_back(proof.obstacle());
  }

  void tell(Facts& facts) const override {
    tell_solutions({request_, search_, held_}, solutions, noun, facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override { return proof.line() + checkpoint_line_; }

 private:
  SearchOptions search_;
  std::vector<std::string> held_;
  Request request_;
  std::string checkpoint_line_;
};

/// Notes are about the file, and those of places that have them first.
constexpr std::size_t kMostNotes = 8;

class SolutionsAtPlaces final : public SolveAnswer {
 public:
  SolutionsAtPlaces(const AskSolve& asked, const Services& services)
      : asked_(asked), tells_at_once_(services.on_line) {
    has_places_ = true;
    const FormingWatch watch = watch_of(services, asked.search);
    const Model model = read_model(model_text(asked.model), asked.model, &watch);
    rows_ = rows_of(model);
    const bool is_first = services.places.part == 0;
    if (is_first) set_outputs_aside(asked.model, asked.search, services);
    lines_.emplace(is_first ? services.lines : LinesRequest{});
    is_proved_ = !services.certificate.empty();
    SearchDisplay display(display_of(services));
    // The limit of time is that of each place.
    const NewRun run = [&](std::size_t row) {
      return SolveRun{asked.search,
                      watch_of(services, asked.search),
                      services.interrupt,
                      display.observer(),
                      [&services] { services.begin_search(); },
                      asked.held,
                      keep_in(*checkpoint_, name_of(rows_[row].line) + ", ")};
    };
    const std::string digest = read_places_of(model);
    first_ = request_at(rows_.front(), model);
    open_checkpoint(services, digest);
    noun = noun_of(*first_);
    services.tell(text_of_facts([this](Facts& facts) { tell_head(facts); }));
    share(model, run, services);
    if (!is_first) {
      checkpoint_->finish(is_stopped_);
      return;
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (!places.empty() && services.interrupt != nullptr && services.interrupt->load()) break;
      add(request_at(rows_[k], model), k, run);
      services.tell(line_of(k));
    }
    places_left = rows_.size() - places.size();
    write_beside([this] { checkpoint_->finish(can_continue()); });
    proof = certify_places(services.certificate, proofs_, places_left, services.shard_size);
    if (proof.is_lost()) lost.push_back(proof.obstacle());
    write_beside([&] {
      if (lines_->is_wanted()) lines_->finish();
    });
  }

  void tell(Facts& facts) const override {
    facts.add("verdict", word() == Word::kProved    ? "complete"
                         : word() == Word::kRefuted ? "none"
                                                    : "incomplete");
    Facts head = tells_at_once_ ? Facts(Readers::kPrograms) : facts.part();
    tell_head(head);
    for (std::size_t i = 0; i < places.size() && !tells_at_once_; ++i) head.say_lines(line_of(i));
    if (!tells_at_once_ || facts.are_for_programs()) facts.append(std::move(head));
    tell_numbers(facts);
    proof.tell(facts);
  }
  [[nodiscard]] std::string about_files() const override {
    return proof.line() + checkpoint_->line();
  }

 private:
  /// A mistake is told before the first search. Returns a digest of all places.
  std::string read_places_of(const Model& model) {
    Sha256 digest;
    for (const PlaceRow& row : rows_) {
      const Request request = request_at(row, model);
      note(request.notes);
      for (const PlacedValue& value : placed_values(request))
        digest.add(value.name + ' ' + value.exact + '\n');
    }
    return digest.text();
  }

  /// Each process has a file of its own, with the places that it has solved.
  void open_checkpoint(const Services& services, const std::string& digest) {
    CheckpointOptions options = services.checkpoint;
    if (!options.path.empty() && services.places.part > 0)
      options.path += fmt::format(".{}", services.places.part);
    checkpoint_.emplace(
        options,
        [&] {
          return checkpointed_question({*first_, asked_.search, asked_.held}, digest);
        },
        true);
  }

  [[nodiscard]] bool can_continue() const {
    return places_left > 0 || std::ranges::any_of(places, [](const SolvedPlace& place) {
             return place.solutions.stopped_by.has_value();
           });
  }

  void tell_head(Facts& facts) const {
    tell_places_asked({*first_, asked_.search, asked_.held}, unknowns_, facts);
    if (!asked_.table.empty())
      facts.tell("places_file",
                 {{"file", asked_.table}, {"sha256", sha256_}, {"time_unit", time_unit_}}, "places",
                 fmt::format("{} in {}, each for itself and nothing between them", rows_.size(),
                             asked_.table));
    for (const std::string& note : notes_) facts.say("note", note);
    facts.add("notes", notes_);
  }

  std::vector<PlaceRow> rows_of(const Model& model) {
    if (!asked_.table.empty()) {
      PlaceFile file = read_places(model, asked_.table);
      sha256_ = std::move(file.sha256);
      time_unit_ = std::move(file.time_unit);
      notes_ = std::move(file.notes);
      return std::move(file.rows);
    }
    std::vector<PlaceRow> rows;
    for (const std::vector<std::string>& place : asked_.places) {
      PlaceRow& row = rows.emplace_back();
      row.line = int(rows.size());
      for (const std::string& number : place) {
        const Assignment given = split_assignment(number, "--at");
        row.numbers.push_back({given.name, given.value});
      }
    }
    return rows;
  }

  void note(const std::vector<std::string>& notes) {
    for (const std::string& one : notes)
      if (notes_.size() < kMostNotes && std::ranges::find(notes_, one) == notes_.end())
        notes_.push_back(one);
  }

  using NewRun = std::function<SolveRun(std::size_t row)>;
  struct Found {
    Solutions solutions;
    ListProof proof{};
  };

  [[nodiscard]] Found found_at(const Request& request, const SolveRun& run) const {
    Found found{solve(request, run)};
    if (is_proved_) found.proof = prove_list(request, found.solutions);
    return found;
  }

  /// Solves the part of this process, and gets that of others.
  void share(const Model& model, const NewRun& run, const Services& services) {
    const SharedPlaces& shared = services.places;
    found_.resize(rows_.size());
    if (shared.parts < 2) return;
    for (std::size_t k = shared.part; k < rows_.size(); k += shared.parts) {
      const Found found = found_at(request_at(rows_[k], model), run(k));
      is_stopped_ = is_stopped_ || found.solutions.stopped_by.has_value();
      cluster::ByteWriter bytes;
      bytes.put_text(sha256_);
      put(bytes, found.solutions);
      put(bytes, found.proof);
      found_[k] = bytes.take();
    }
    const bool is_interrupted = services.interrupt != nullptr && services.interrupt->load();
    is_stopped_ = !shared.exchange(found_, is_interrupted) || is_stopped_;
  }

  [[nodiscard]] Found take_found(const std::string& bytes) const {
    cluster::ByteReader reader(bytes);
    if (reader.take_text() != sha256_)
      throw UsageError("the ranks have different files " + asked_.table);
    Found found{take_solutions(reader)};
    found.proof = take_list_proof(reader);
    return found;
  }

  void add(const Request& request, std::size_t row, const NewRun& run) {
    SolvedPlace& place = places.emplace_back();
    place.line = rows_[row].line;
    place.time = rows_[row].time;
    place.place = placed_values(request);
    Found found = found_[row].empty() ? found_at(request, run(row)) : take_found(found_[row]);
    place.solutions = std::move(found.solutions);
    if (places.size() == 1) unknowns_ = place.solutions.unknowns;
    if (is_proved_) proofs_.push_back({name_of(place.line), std::move(found.proof)});
    if (lines_->is_wanted() &&
        !(lines_->stream() << report_text(json_solved(place, request.model, noun)) << '\n'))
      lines_->finish();  // throws, with the reason that the file has
  }

  /// A mistake in a row is told with its place.
  Request request_at(const PlaceRow& row, const Model& model) const {
    try {
      return solve_request_of(model, asked_.model, row.numbers, asked_.held);
    } catch (const InputError& error) {
      if (asked_.table.empty())
        throw UsageError(fmt::format("at: place {}: {}", row.line, error.what()));
      if (error.file().empty() || error.file() == asked_.model.path)
        throw error.at(asked_.table, row.line);
      throw;
    }
  }

  [[nodiscard]] std::string name_of(int line) const {
    return fmt::format("{} {}", asked_.table.empty() ? "place" : "line", line);
  }

  [[nodiscard]] std::string line_of(std::size_t index) const {
    const SolvedPlace& place = places[index];
    return fmt::format("{:11}{}{}: {}\n", index == 0 ? "answers" : "", name_of(place.line),
                       describe_time(place, time_unit_), describe_result(place.solutions, noun));
  }

  void tell_numbers(Facts& facts) const {
    double seconds = 0;
    std::uint64_t boxes = 0;
    for (const SolvedPlace& place : places) {
      seconds += place.solutions.seconds;
      boxes += place.solutions.boxes;
    }
    facts.tell("boxes", boxes, "boxes", fmt::format("{} evaluated", in_thousands(boxes)));
    facts.add("seconds", json_seconds(seconds));
    facts.say("time", fmt::format("search {:.3f} ms", 1e3 * seconds));
    if (places_left > 0) facts.say("left", fmt::format("{} places", places_left));
    facts.add("places_left", places_left);
    if (!facts.are_for_programs()) return;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const SolvedPlace& place : places) list.push_back(json_solved(place, first_->model, noun));
    facts.add("places", std::move(list));
    facts.add("claim", nullptr);
  }

  AskSolve asked_;
  std::optional<LinesFile> lines_;
  std::optional<SearchCheckpoint> checkpoint_;
  bool is_stopped_ = false;  ///< so that the file of this process is kept
  bool tells_at_once_;
  std::vector<PlaceRow> rows_;
  std::string sha256_, time_unit_;
  std::vector<std::string> notes_;
  std::optional<Request> first_;
  std::vector<SolvedUnknown> unknowns_;
  bool is_proved_ = false;          ///< a proof of each place is wanted
  std::vector<std::string> found_;  ///< by row: what another process found; empty: not known
  std::vector<PlaceProof> proofs_;
};

Word word_of_place(const Solutions& solutions) {
  if (solutions.completeness == Completeness::kIncomplete) return Word::kOpen;
  return solutions.found.empty() ? Word::kRefuted : Word::kProved;
}

void refuse_for_one_place(const AskSolve& asked, const Services& services) {
  if (asked.wanted == AskSolve::Places::kMany)
    throw UsageError(
        "there are no places; give the places by lists of numbers, by a table, or by a "
        "motion along way-points");
  if (services.lines.is_wanted())
    throw UsageError(services.dashes +
                     "output: lines are of many places, from waypoints; of one place ask for json");
}

void refuse_two_lists(const AskSolve& asked, const Services& services) {
  if (!asked.table.empty() && !asked.places.empty())
    throw UsageError(services.dashes + "waypoints: places are given, too; give one of them");
}

/// Each way-point of the motion is a place, unless other places are given.
AskSolve with_waypoints_of_motion(AskSolve asked, const Services& services) {
  if (!asked.table.empty() || !asked.places.empty()) return asked;
  const FormingWatch watch = watch_of(services, asked.search);
  ModelOptions options = asked.model;
  options.takes_legs = true;
  asked.table = waypoints_of(read_model(model_text(options), options, &watch), options);
  if (!asked.table.empty() && asked.wanted == AskSolve::Places::kOne)
    throw UsageError("the motion is along way-points, each of which is a place; ask solve_many");
  return asked;
}

}  // namespace

Word SolveAnswer::word() const {
  if (!has_places_) return word_of_place(solutions);
  if (places_left > 0) return Word::kOpen;
  Word worst = Word::kProved;
  for (const SolvedPlace& place : places) worst = std::max(worst, word_of_place(place.solutions));
  return worst;
}

std::string SolveAnswer::headline() const {
  return has_places_ ? describe_places(places, places_left, noun)
                     : describe_result(solutions, noun);
}

bool is_about_places(const AskSolve& asked) {
  const AskSolve resolved = with_waypoints_of_motion(asked, {});
  return !resolved.table.empty() || !resolved.places.empty();
}

std::unique_ptr<SolveAnswer> ask(const AskSolve& asked, const Services& services) {
  refuse_changed_options(option_refusals_of_solutions(), asked.model, asked.search,
                         services.dashes);
  refuse_two_lists(asked, services);
  refuse_services(Kind::kSolve, asked.model, asked.search, services);
  const AskSolve resolved = with_waypoints_of_motion(asked, services);
  const bool is_first = services.places.part == 0;
  if (!resolved.table.empty() || !resolved.places.empty()) {
    auto answer = std::make_unique<SolutionsAtPlaces>(resolved, services);
    return is_first ? std::move(answer) : nullptr;
  }
  refuse_for_one_place(asked, services);
  if (!is_first) return nullptr;
  return std::make_unique<FoundSolutions>(asked, services);
}

}  // namespace regulus::detail
