// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/mpi/verify_together.hpp"

#include <optional>
#include <utility>

#include "codegen/support/errors.hpp"
#include "codegen/use/command/commands.hpp"
#include "codegen/use/mpi/together.hpp"
#include "runtime/cluster/bytes.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::detail {
namespace {

using cluster::ByteReader;
using cluster::ByteWriter;
using verifier::ShardProof;

void put(ByteWriter& to, const ShardProof& proof) {
  for (const bool is : {proof.is_proved, proof.is_rejected, proof.has_met_variety,
                        proof.has_met_point, proof.is_of_other_model})
    to.put(is);
  for (const std::string* text :
       {&proof.reason, &proof.question, &proof.before, &proof.after, &proof.lines})
    to.put_text(*text);
  to.put_count(proof.leaves);
  to.put_count(proof.boxes);
  to.put(proof.sign);
  for (const std::uint64_t leaves : proof.paved) to.put_count(leaves);
  for (const auto* texts : {&proof.about, &proof.differences})
    to.put_each(*texts, [&to](const std::string& text) { to.put_text(text); });
  to.put_each(proof.of_places, [&to](std::uint64_t count) { to.put_count(count); });
}

ShardProof take_proof(ByteReader& from) {
  ShardProof proof;
  for (bool* is : {&proof.is_proved, &proof.is_rejected, &proof.has_met_variety,
                   &proof.has_met_point, &proof.is_of_other_model})
    *is = from.take<bool>();
  for (std::string* text :
       {&proof.reason, &proof.question, &proof.before, &proof.after, &proof.lines})
    *text = from.take_text();
  proof.leaves = from.take_count();
  proof.boxes = from.take_count();
  proof.sign = from.take<int>();
  for (std::uint64_t& leaves : proof.paved) leaves = from.take_count();
  for (auto* texts : {&proof.about, &proof.differences})
    from.take_each([&] { texts->emplace_back(from.take_text()); });
  from.take_each([&] { proof.of_places.push_back(from.take_count()); });
  return proof;
}

/// The ranks give their proofs to rank 0 exactly once, whatever happens before: otherwise the others
/// would wait for ever.
class Exchange {
 public:
  /// `limit`: of the time of each rank's proofs, in seconds; 0: there is none.
  Exchange(Communicator& communicator, const std::vector<RankIdentity>& ranks, double limit)
      : communicator_(communicator), ranks_(ranks), limit_(limit) {}

  void run(std::vector<ShardProof>& proofs) {
    done_ = true;
    ByteWriter own;
    own.put_text("");
    for (std::size_t i = communicator_.rank(); i < proofs.size(); i += communicator_.size())
      put(own, proofs[i]);
    const auto all = gather_parts(communicator_, own.bytes(), limit_);
    for (std::size_t rank = 1; rank < all.size(); ++rank)
      all[rank] ? take(*all[rank], rank, proofs) : miss(rank, "it does not answer", proofs);
  }

  /// A rank that has no proofs says why.
  void end(const std::string& why) {
    if (std::exchange(done_, true)) return;
    ByteWriter own;
    own.put_text(why.empty() ? "it does not read an index there" : why);
    static_cast<void>(gather_parts(communicator_, own.bytes(), limit_));
  }

 private:
  void take(std::string_view bytes, std::size_t rank, std::vector<ShardProof>& proofs) const {
    ByteReader reader(bytes);
    const std::string failure(reader.take_text());
    miss(rank, failure, proofs);
    for (std::size_t i = rank; i < proofs.size() && !reader.at_end(); i += communicator_.size())
      proofs[i] = take_proof(reader);
  }

  void miss(std::size_t rank, const std::string& failure, std::vector<ShardProof>& proofs) const {
    for (std::size_t i = rank; i < proofs.size(); i += communicator_.size())
      proofs[i].reason = "rank " + std::to_string(rank) + " on " + ranks_[rank].host +
                         " has not proved it" + (failure.empty() ? "" : ": " + failure);
  }

  Communicator& communicator_;
  const std::vector<RankIdentity>& ranks_;
  const double limit_;
  bool done_ = false;
};

}  // namespace

int verify_together(Communicator& communicator, const VerifyCommand& command,
                    const std::vector<RankIdentity>& ranks) {
  unblock_signals();
  Exchange exchange(communicator, ranks, command.time_limit.value_or(0));
  const VerifiedPart part{communicator.rank(), communicator.size(),
                          [&exchange](std::vector<ShardProof>& proofs) { exchange.run(proofs); }};
  int code = 0;
  try {
    if (communicator.is_first())
      code = run_verify(command, part);
    else
      prove_part(command, part);
  } catch (const std::exception& error) {
    exchange.end(error.what());
    if (communicator.is_first()) throw;
  }
  exchange.end("");
  return code;
}

}  // namespace regulus::detail
