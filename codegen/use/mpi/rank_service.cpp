// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/mpi/rank_service.hpp"

#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "codegen/answer/rank_question.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/use/mpi/rank_messages.hpp"
#include "runtime/search/thread_workers.hpp"

namespace regulus::detail {
namespace {

class Service {
 public:
  Service(Communicator& communicator, const Asked& asked, const Services& services)
      : communicator_(communicator),
        asked_(asked),
        services_(services),
        threads_(
            std::visit([](const auto& one) { return settings_from(one.search); }, asked).threads) {}

  void prepare(std::optional<std::string_view> topic) {
    question_.reset();
    question_ = prepare_for_rank(asked_, services_, topic);
    if (question_) communicator_.send(0, Tag::kReady, write_ready(threads_));
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
    question_->decide_for_another(description, [&](const Problem& problem, const Settings& settings,
                                                   const cluster::MakeDecider& make) {
      ThreadWorkers threads(threads_);
      threads.begin(problem, settings, description.learned, make);
      decide_units(threads);
    });
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
  const Asked& asked_;
  const Services& services_;
  std::unique_ptr<RankQuestion> question_;
  const unsigned threads_;
  std::uint32_t number_ = 0;
  bool dismissed_ = false;
};

/// Waits for rank 0 to take notice of an error.
void await_dismissal(Communicator& communicator) {
  while (communicator.receive().tag != Tag::kQuit) continue;
}

}  // namespace

void serve_first_rank(Communicator& communicator, const Asked& asked, const Services& services) {
  try {
    Service service(communicator, asked, services);
    service.prepare(std::nullopt);
    service.run();
  } catch (const std::exception& error) {
    communicator.send(0, Tag::kError, error.what());
    await_dismissal(communicator);
  }
  communicator.send(0, Tag::kBye, {});
}

}  // namespace regulus::detail
