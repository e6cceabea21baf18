// SPDX-License-Identifier: GPL-3.0-or-later
// regulus-mpi: the searches of regulus by many processes.
#include <unistd.h>

#include <algorithm>
#include <cfenv>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "codegen/answer/ask.hpp"
#include "codegen/model/file/installed_models.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/support/shell_word.hpp"
#include "codegen/support/visible_text.hpp"
#include "codegen/use/command/commands.hpp"
#include "codegen/use/command/run_command_line.hpp"
#include "codegen/use/command/run_question.hpp"
#include "codegen/use/mpi/agreement.hpp"
#include "codegen/use/mpi/mpi_workers.hpp"
#include "codegen/use/mpi/rank_service.hpp"
#include "codegen/use/mpi/solve_together.hpp"
#include "codegen/use/mpi/verify_together.hpp"

namespace {

using namespace regulus;
using namespace regulus::detail;

constexpr const char* kName = "regulus-mpi: ";

/// Prepared before MPI starts threads, which inherit the mask: only rank 0 handles signals, in a
/// thread of its own, and tells the others.
void block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

/// Returns the command as a shell reads it, without the path of the program, which has no meaning
/// elsewhere.
std::string typed(std::vector<std::string> words) {
  words.front() = "regulus-mpi";
  return shell_command(words);
}

/// Returns the options of the command, which must be one that searches.
template <class Use>
auto with_search(CommandLine& line, const Use& use) {
  if (line.check) return use(*line.check);
  if (line.locate) return use(*line.locate);
  if (line.margin) return use(*line.margin);
  if (line.bound) return use(*line.bound);
  if (line.datasheet) return use(*line.datasheet);
  if (line.solve) return use(*line.solve);
  throw UsageError(
      "check, locate, margin, bound, datasheet, solve and verify run on several ranks; use regulus "
      "for other commands");
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

/// Reads the model once for all ranks, so that all have the same. Mistakes in the words are reported
/// before the other ranks begin. Returns the start of all ranks.
Start read_start(CommandLine& line, std::vector<std::string> words) {
  Start start;
  if (line.exit_code) start.exit_code = line.exit_code;
  if (line.exit_code) return start;
  const auto take_model = [&words](std::string& model) {
    const std::string typed = std::exchange(model, find_model(model));
    for (const std::string option : {"", "--model="})
      std::ranges::replace(words, option + typed, option + model);
  };
  const int code = report_errors(
      [&] {
        if (line.verify) {
          if (!line.verify->model.empty()) take_model(line.verify->model);
          return 0;
        }
        with_search(line, [&start, &take_model](auto& command) {
          if (!command.search.filters.empty())
            throw UsageError("--filter: a filter runs in one process only; use regulus");
          if (!command.search.kernel.empty())
            throw UsageError("--kernel: an edited kernel runs in one process only; use regulus");
          static_cast<void>(settings_from(command.search));
          static_cast<void>(question_of(command));
          const std::string typed = command.model.path;
          take_model(command.model.path);
          if (command.model.path != typed && !command.output.quiet)
            std::cerr << "file       " << visible(command.model.path) << '\n';
          start.model = model_text(command.model);
          command.model.text = start.model;
          const Asked asked = question_of(command).asked;
          if (const auto* solve = std::get_if<AskSolve>(&asked))
            start.shares_places = is_about_places(*solve);
        });
        return 0;
      },
      kName);
  if (code != 0) start.exit_code = code;
  start.words = std::move(words);
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
    start = read_start(line, words);
    if (start.words.empty()) start.words = words;
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
  if (start.shares_places) return solve_together(communicator, *line.solve, typed(start.words));
  if (first) return lead(communicator, line, ranks, typed(start.words));
  with_search(line, [&](auto& command) {
    const CommandQuestion question = question_of(command);
    serve_first_rank(communicator, question.asked, question.services);
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
