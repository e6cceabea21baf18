// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/mpi/agreement.hpp"

#include <unistd.h>

#include <algorithm>

#include "codegen/question/engine/build_id.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {
namespace {

using cluster::ByteReader;
using cluster::ByteWriter;

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "a host without a name";
}

std::string write_identity(const RankIdentity& identity) {
  ByteWriter bytes;
  bytes.put_text(identity.host);
  bytes.put_text(identity.build);
  bytes.put(identity.best_isa);
  return bytes.take();
}

RankIdentity read_identity(std::string_view text) {
  ByteReader reader(text);
  RankIdentity identity;
  identity.host = reader.take_text();
  identity.build = reader.take_text();
  identity.best_isa = reader.take<Isa>();
  return identity;
}

std::string write_agreement(const Agreement& agreement) {
  ByteWriter bytes;
  bytes.put(agreement.isa);
  bytes.put_text(agreement.refusal);
  return bytes.take();
}

Agreement read_agreement(std::string_view text) {
  ByteReader reader(text);
  Agreement agreement;
  agreement.isa = reader.take<Isa>();
  agreement.refusal = reader.take_text();
  return agreement;
}

bool refuse_silence(const std::vector<unsigned>& ranks, double seconds) {
  if (seconds >= kSecondsOfPatience)
    throw InternalError(describe_silent(ranks) + "; the job ends before its search");
  return false;
}

std::string name_of(std::size_t rank, const RankIdentity& identity) {
  return "rank " + std::to_string(rank) + " on " + identity.host;
}

}  // namespace

std::string write_start(const Start& start) {
  ByteWriter bytes;
  bytes.put(start.exit_code.has_value());
  bytes.put(start.exit_code.value_or(0));
  bytes.put_each(start.words, [&bytes](const std::string& word) { bytes.put_text(word); });
  bytes.put_text(start.model);
  bytes.put(start.shares_places);
  return bytes.take();
}

Start read_start_text(std::string_view text) {
  ByteReader reader(text);
  Start start;
  const bool ends = reader.take<bool>();
  const int code = reader.take<int>();
  if (ends) start.exit_code = code;
  reader.take_each([&] { start.words.emplace_back(reader.take_text()); });
  start.model = reader.take_text();
  start.shares_places = reader.take_flag();
  return start;
}

Agreement compare(const std::vector<RankIdentity>& ranks, std::optional<Isa> wanted) {
  Agreement agreement;
  agreement.isa = wanted.value_or(ranks.front().best_isa);
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    if (ranks[i].build != ranks.front().build)
      agreement.refusal = name_of(i, ranks[i]) + " runs another build of regulus-mpi than " +
                          name_of(0, ranks.front()) + "; install the same one on both";
    else if (wanted && ranks[i].best_isa > *wanted)
      agreement.refusal = name_of(i, ranks[i]) + ": this processor cannot run " +
                          std::string(name(*wanted)) +
                          "; leave out --isa, or name an instruction set that all have";
    if (!agreement.refusal.empty()) return agreement;
    // In the enumeration, better sets come first.
    if (!wanted) agreement.isa = std::max(agreement.isa, ranks[i].best_isa);
  }
  return agreement;
}

Agreement agree(Communicator& communicator, std::optional<Isa> wanted,
                std::vector<RankIdentity>& ranks) {
  const RankIdentity own{host_name(), build_id(), best_isa()};
  for (const auto& text : communicator.gather(write_identity(own), refuse_silence))
    ranks.push_back(read_identity(*text));
  const Agreement decision = ranks.empty() ? Agreement{} : compare(ranks, wanted);
  return read_agreement(communicator.broadcast(write_agreement(decision)));
}

}  // namespace regulus::detail
