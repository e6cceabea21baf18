// SPDX-License-Identifier: GPL-3.0-or-later
// regulus-mpi: the searches of regulus by many processes.
#include <unistd.h>

#include <cfenv>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/answer/refusals.hpp"
#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/bound/bracket_topic.hpp"
#include "codegen/question/condition/box_judge.hpp"
#include "codegen/question/condition/condition_kernel.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/load/feasibility_run.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/use/command/commands.hpp"
#include "codegen/use/command/run_command_line.hpp"
#include "codegen/use/command/run_question.hpp"
#include "codegen/use/mpi/agreement.hpp"
#include "codegen/use/mpi/mpi_workers.hpp"
#include "codegen/use/mpi/rank_service.hpp"
#include "codegen/use/mpi/verify_together.hpp"
#include "runtime/search/box_judges.hpp"

namespace {

using namespace regulus;

constexpr const char* kName = "regulus-mpi: ";

/// Prepared before MPI starts threads, which inherit the mask: only rank 0 handles signals, in a
/// thread of its own, and tells the others.
void block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

/// Returns the words without the path of the program, which has no meaning elsewhere.
std::string typed(const std::vector<std::string>& words) {
  std::string command = "regulus-mpi";
  for (std::size_t i = 1; i < words.size(); ++i) command += " " + words[i];
  return command;
}

/// Returns the options of the command, which must be one that searches.
template <class Use>
auto with_search(CommandLine& line, const Use& use) {
  if (line.check) return use(*line.check);
  if (line.locate) return use(*line.locate);
  if (line.margin) return use(*line.margin);
  if (line.bound) return use(*line.bound);
  throw UsageError(
      "check, locate, margin, bound and verify run on several ranks; use regulus for other "
      "commands");
}

/// True if the searches are about matrices that rank 0 names one after the other.
bool has_topics(const CommandLine& line) {
  return line.bound || (line.margin && !line.margin->limit.empty());
}

RankQuestion condition_question(const BracketTopic& topic, const Request& request,
                                const SearchOptions& search) {
  RankQuestion question{prepare_condition(topic, request, search)};
  question.judges = [scaling =
                         question.prepared.stages->formulation().scaling](const Problem& problem) {
    return unit_judges<BoxJudge>({problem, scaling});
  };
  return question;
}

RankQuestion force_question(const ModelOptions& model, const std::string& load,
                            const SearchOptions& search) {
  PreparedForces forces = prepare_forces(model, load, search, {});
  RankQuestion question{std::move(forces.preparation)};
  question.judges = [problem_of_forces = std::move(forces.forces),
                     scaling = std::move(forces.scaling)](const Problem& problem) {
    return unit_judges<BoxForces>({problem_of_forces, problem, scaling});
  };
  return question;
}

RankQuestion prepare_topic_of(const CommandLine& line, const BracketTopic& topic) {
  if (line.bound) {
    const BoundCommand bound = with_quantity(*line.bound);
    const BoundQuestion question = read_bound_question(bound.model, bound.quantity, bound.limit);
    if (is_about_condition(topic)) return condition_question(topic, question.request, bound.search);
    return {std::move(
        prepare_topic(topic, question.request, question.quantity, question.limit, bound.search)
            .prepared)};
  }
  MarginCommand margin = *line.margin;
  const MarginQuestion question = take_question(margin.model, margin.size);
  const Request request = read_asked(margin.model, margin.quantity);
  const Quantity quantity = quantity_of(request.model, margin.quantity);
  const GiNaC::ex limit = read_limit(margin.limit, quantity);
  return {
      std::move(prepare_topic(topic, request, question, quantity, limit, margin.search).prepared)};
}

RankQuestion prepare_question(const CommandLine& line, std::optional<std::string_view> topic) {
  if (topic) return prepare_topic_of(line, read_topic(*topic));
  const auto prepared = [](const auto& command) {
    return command.load ? force_question(command.model, *command.load, command.search)
                        : RankQuestion{prepare(command.model, command.search)};
  };
  if (line.check) return prepared(*line.check);
  if (line.locate) return prepared(*line.locate);
  const MarginCommand& margin = *line.margin;
  ModelOptions model = margin.model;
  const MarginQuestion question = take_question(model, margin.size);
  return {
      std::move(PreparedMargin(question, read_request(model), 0, compiled_first(margin.search), {})
                    .prepared)};
}

/// The work of rank 0. Other ranks have been told to begin.
int lead(Communicator& communicator, CommandLine& line, const std::vector<RankIdentity>& ranks,
         const std::string& typed) {
  std::vector<std::string> hosts;
  for (const RankIdentity& rank : ranks) hosts.push_back(rank.host);
  const unsigned threads =
      with_search(line, [](auto& command) { return settings_from(command.search).threads; });
  // A terminal has its own display.
  const bool tells = ::isatty(STDERR_FILENO) == 0 &&
                     with_search(line, [](auto& command) { return !command.output.quiet; });
  MpiWorkers workers(communicator, hosts, threads, tells);
  with_search(line, [&workers](auto& command) { command.search.workers = &workers; });
  const int code = report_errors([&] { return run_command_line(line, typed); }, kName);
  std::cout.flush();
  if (!workers.dismiss()) communicator.abort(code);
  return code;
}

/// Before the other ranks form the matrix.
void refuse_what_ranks_cannot_share(CommandLine& line, const std::string& text) {
  const auto refuse = [&text](auto& command) {
    auto question = question_of(command);
    std::visit([&text](auto& asked) { asked.model.text = text; }, question.asked);
    if (const auto why = refusal_of_ranks(question.asked)) throw UsageError(std::string(*why));
  };
  with_search(line, refuse);
}

/// Reads the model once for all ranks, so that all have the same. Mistakes in the words are reported
/// before the other ranks begin. Returns the start of all ranks.
Start read_start(CommandLine& line) {
  Start start;
  if (line.exit_code) start.exit_code = line.exit_code;
  if (line.exit_code || line.verify) return start;
  const int code = report_errors(
      [&] {
        with_search(line, [&start](auto& command) {
          if (!command.search.filters.empty())
            throw UsageError("--filter: a filter runs in one process only; use regulus");
          static_cast<void>(settings_from(command.search));
          start.model = model_text(command.model);
        });
        refuse_what_ranks_cannot_share(line, start.model);
        return 0;
      },
      kName);
  if (code != 0) start.exit_code = code;
  return start;
}

CommandLine parse(const std::vector<std::string>& words) {
  std::vector<const char*> pointers;
  for (const std::string& word : words) pointers.push_back(word.c_str());
  return parse_command_line(static_cast<int>(pointers.size()), pointers.data());
}

/// Returns how all ranks begin. Rank 0 parses the command line first, so that mistakes are reported
/// once.
Start begin_together(Communicator& communicator, const std::vector<std::string>& words) {
  Start start;
  if (communicator.is_first()) {
    CommandLine line = parse(words);
    start = read_start(line);
    start.words = words;
  }
  return read_start_text(communicator.broadcast(write_start(start)));
}

/// Returns false, after a message of rank 0, if a rank cannot take part.
bool is_agreed(const Communicator& communicator, const Agreement& agreement) {
  if (!agreement.refusal.empty() && communicator.is_first())
    std::cerr << kName << agreement.refusal << '\n';
  return agreement.refusal.empty();
}

int run_verify_together(Communicator& communicator, const VerifyCommand& command) {
  std::vector<RankIdentity> ranks;
  if (!is_agreed(communicator, agree(communicator, std::nullopt, ranks)))
    return communicator.is_first() ? kUsageError : 0;
  return verify_together(communicator, command, ranks);
}

int run_together(Communicator& communicator, const Start& start) {
  CommandLine line = parse(start.words);
  if (line.verify) return run_verify_together(communicator, *line.verify);
  std::vector<RankIdentity> ranks;
  const Agreement agreed = with_search(line, [&](auto& command) {
    command.model.text = start.model;
    // The compiler of a later time would still be at work when the ranks end.
    command.search.boxes_before_compiling = 0;
    Agreement agreement = agree(communicator, command.search.isa, ranks);
    command.search.isa = agreement.isa;
    return agreement;
  });
  const bool first = communicator.is_first();
  if (!is_agreed(communicator, agreed)) return first ? kUsageError : 0;
  if (first) return lead(communicator, line, ranks, typed(start.words));
  with_search(line, [&](auto& command) {
    serve_first_rank(
        communicator, command.search, has_topics(line),
        [&line](std::optional<std::string_view> topic) { return prepare_question(line, topic); });
  });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);
  block_signals();
  // mpirun gives the first rank a terminal of its own, which is not the user's.
  setenv("NO_COLOR", "1", 1);
  Communicator communicator;
  std::fesetenv(FE_DFL_ENV);
  return communicator.end(report_errors(
      [&] {
        const Start start = begin_together(communicator, {argv, argv + argc});
        if (!start.exit_code) return run_together(communicator, start);
        return communicator.is_first() ? *start.exit_code : 0;
      },
      kName));
}
