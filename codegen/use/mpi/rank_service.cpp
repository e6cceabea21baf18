// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/mpi/rank_service.hpp"

#include <exception>
#include <optional>
#include <utility>

#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/use/mpi/rank_messages.hpp"
#include "runtime/search/thread_workers.hpp"

namespace regulus {
namespace {

class Service {
 public:
  Service(Communicator& communicator, const PrepareQuestion& prepare_question,
          const SearchOptions& search)
      : communicator_(communicator),
        prepare_question_(prepare_question),
        search_(search),
        threads_(settings_from(search).threads) {}

  void prepare(std::optional<std::string_view> topic) {
    question_.reset();
    question_.emplace(prepare_question_(topic));
    // Rank 0 may have prepared it in time, and this kernel is for reports only.
    if (question_->prepared.stopped)
      throw InternalError("the time limit was reached before the question was prepared");
    communicator_.send(0, Tag::kReady, write_ready(threads_));
  }

  /// Returns when rank 0 dismisses this rank.
  void run() {
    for (;;) {
      const Message message = communicator_.receive();
      if (message.tag == Tag::kQuit) return;
      if (message.tag == Tag::kTopic) prepare(message.bytes);
      if (message.tag == Tag::kSearch) take_part(message.bytes);
      if (dismissed_) return;
    }
  }

 private:
  void take_part(std::string_view bytes) {
    const ForSearch begin = read_for_search(bytes);
    const cluster::SearchDescription description = cluster::read_search(begin.bytes);
    number_ = begin.search;
    if (!question_) throw InternalError("a search begins before its question is known");
    if (question_->judges) return judge_boxes(description);
    decide_for_another(question_->prepared, search_, description,
                       [&](const Problem& problem, const Settings& settings) {
                         ThreadWorkers threads(threads_);
                         threads.begin(problem, settings, description.learned, nullptr);
                         decide_units(threads);
                       });
  }

  void judge_boxes(const cluster::SearchDescription& description) {
    const Problem problem = question_->prepared.problem();
    if (problem.outer != description.problem.outer || problem.inner != description.problem.inner)
      throw InternalError("the ranks have prepared different questions");
    ThreadWorkers threads(threads_);
    threads.begin(problem, description.settings, description.learned, question_->judges(problem));
    decide_units(threads);
  }

  void decide_units(ThreadWorkers& threads) {
    Patience patience;
    for (;;) {
      if (const std::optional<Message> message = communicator_.try_receive()) {
        patience.reset();
        if (!pass_on(*message, threads)) return;
        continue;
      }
      const bool worked = threads.caller_has_work();
      if (const auto answer = threads.receive(false)) {
        const auto slot = static_cast<std::uint32_t>(answer->worker);
        communicator_.send(0, Tag::kAnswer, write_for_search(number_, slot, answer->message));
        patience.reset();
      } else if (!worked) {
        patience.wait();
      }
    }
  }

  /// Returns false if the search is over.
  bool pass_on(const Message& message, ThreadWorkers& threads) {
    dismissed_ = message.tag == Tag::kQuit;
    if (dismissed_ || message.tag == Tag::kEnd) return false;
    if (message.tag != Tag::kGrant) return true;
    const ForSearch grant = read_for_search(message.bytes);
    // If this rank could start fewer threads than it promised, the others do the work.
    threads.send(grant.slot % threads.count(), std::string(grant.bytes));
    return true;
  }

  Communicator& communicator_;
  const PrepareQuestion& prepare_question_;
  std::optional<RankQuestion> question_;
  const SearchOptions& search_;
  const unsigned threads_;
  std::uint32_t number_ = 0;
  bool dismissed_ = false;
};

/// Waits for rank 0 to take notice of an error.
void await_dismissal(Communicator& communicator) {
  while (communicator.receive().tag != Tag::kQuit) continue;
}

}  // namespace

void serve_first_rank(Communicator& communicator, const SearchOptions& search, bool has_topics,
                      const PrepareQuestion& prepare_question) {
  try {
    Service service(communicator, prepare_question, search);
    if (!has_topics) service.prepare(std::nullopt);
    service.run();
  } catch (const std::exception& error) {
    communicator.send(0, Tag::kError, error.what());
    await_dismissal(communicator);
  }
  communicator.send(0, Tag::kBye, {});
}

}  // namespace regulus
