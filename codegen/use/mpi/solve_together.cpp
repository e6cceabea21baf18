// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/mpi/solve_together.hpp"

#include <cstdio>
#include <utility>

#include "codegen/answer/ask.hpp"
#include "codegen/use/command/run_question.hpp"
#include "codegen/use/mpi/together.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {
namespace {

/// The ranks give what they found to rank 0 exactly once, whatever happens before: otherwise the others
/// would wait for ever. What a rank does not give, rank 0 solves by itself.
class PlaceExchange {
 public:
  explicit PlaceExchange(Communicator& communicator) : communicator_(communicator) {}

  bool run(std::vector<std::string>& found, bool is_interrupted) {
    is_done_ = true;
    cluster::ByteWriter own;
    own.put_text("");
    own.put_each(found, [&own](const std::string& place) { own.put_text(place); });
    const auto all = gather_parts(communicator_, communicator_.is_first() ? "" : own.bytes(), 0);
    for (std::size_t rank = 1; rank < all.size(); ++rank) take(rank, all[rank].value_or(""), found);
    return communicator_.broadcast(is_interrupted ? "" : kGoesOn) == kGoesOn;
  }

  /// `why`: this rank has found nothing.
  void end(const std::string& why) {
    if (std::exchange(is_done_, true)) return;
    cluster::ByteWriter own;
    own.put_text(why);
    static_cast<void>(gather_parts(communicator_, own.bytes(), 0));
    static_cast<void>(communicator_.broadcast(""));
  }

 private:
  static constexpr const char* kGoesOn = "goes on";  ///< of rank 0

  static void take(std::size_t rank, const std::string& bytes, std::vector<std::string>& found) {
    if (bytes.empty()) return;
    cluster::ByteReader reader(bytes);
    if (const std::string why(reader.take_text()); !why.empty())
      std::fprintf(stderr, "regulus-mpi: rank %zu solves no places: %s\n", rank, why.c_str());
    if (reader.at_end()) return;
    std::size_t k = 0;
    reader.take_each([&] {
      const std::string_view place = reader.take_text();
      if (!place.empty() && k < found.size()) found[k] = place;
      ++k;
    });
  }

  Communicator& communicator_;
  bool is_done_ = false;
};

}  // namespace

int solve_together(Communicator& communicator, const SolveCommand& command,
                   const std::string& typed) {
  unblock_signals();
  PlaceExchange exchange(communicator);
  CommandQuestion question = question_of(command);
  question.services.places = {communicator.rank(), communicator.size(),
                              [&exchange](std::vector<std::string>& found, bool is_interrupted) {
                                return exchange.run(found, is_interrupted);
                              }};
  int code = 0;
  try {
    if (communicator.is_first()) {
      code = run_question(question, typed);
    } else {
      question.services.shows_progress = false;
      question.services.on_line = {};
      static_cast<void>(ask(std::get<AskSolve>(question.asked), question.services));
    }
  } catch (const std::exception& error) {
    exchange.end(error.what());
    if (communicator.is_first()) throw;
  }
  exchange.end("");
  return code;
}

}  // namespace regulus::detail
