// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/mpi/mpi_workers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "codegen/support/errors.hpp"
#include "codegen/use/mpi/rank_messages.hpp"
#include "runtime/cluster/search_description.hpp"
#include "runtime/cluster/supervisor.hpp"

namespace regulus::detail {
namespace {

/// With more other ranks, rank 0 is busy enough with their messages.
constexpr unsigned kFewRanks = 16;

constexpr double kSecondsBetweenLines = 10.0;

}  // namespace

MpiWorkers::MpiWorkers(Communicator& communicator, const std::vector<std::string>& hosts,
                       unsigned threads, bool tells)
    : communicator_(communicator),
      ranks_(hosts.size()),
      first_thread_works_(communicator.size() <= kFewRanks),
      local_(threads),
      tells_(tells) {
  for (std::size_t i = 0; i < hosts.size(); ++i) ranks_[i].host = hosts[i];
  ranks_[0].threads = threads;
  asked_at_ = now();
}

std::string MpiWorkers::name_of(unsigned rank) const {
  return "rank " + std::to_string(rank) + " on " + ranks_[rank].host;
}

void MpiWorkers::fail(const Message& message) const {
  throw InternalError(name_of(message.rank) + ": " + message.bytes);
}

void MpiWorkers::tell_all(Tag tag, const std::string& bytes) {
  for (unsigned rank = 1; rank < ranks_.size(); ++rank) communicator_.send(rank, tag, bytes);
}

void MpiWorkers::take_ready(const Message& message) {
  ranks_[message.rank].is_still = false;
  if (message.tag == Tag::kError) fail(message);
  if (message.tag == Tag::kReady) ranks_[message.rank].threads = read_ready(message.bytes);
}

void MpiWorkers::tell_topic() {
  if (topic_ == told_topic_) return;
  told_topic_ = topic_;
  for (unsigned rank = 1; rank < ranks_.size(); ++rank) ranks_[rank].threads = 0;
  tell_all(Tag::kTopic, *topic_);
  asked_at_ = now();
}

void MpiWorkers::await_ranks(const Settings& settings) {
  const auto is_ready = [](const Rank& rank) { return rank.threads > 0 || rank.is_still; };
  Patience patience;
  const double began = now(), patience_seconds = std::max(kSecondsOfPatience, began - asked_at_);
  while (!std::all_of(ranks_.begin(), ranks_.end(), is_ready)) {
    if (settings.interrupt != nullptr && *settings.interrupt) return;
    if (now() - began >= settings.time_limit) return;
    if (now() - began >= patience_seconds) {
      std::set<unsigned> late;
      for (unsigned rank = 0; rank < ranks_.size(); ++rank)
        if (!is_ready(ranks_[rank])) late.insert(rank);
      return name_late(late, "others do its work");
    }
    if (const std::optional<Message> message = communicator_.try_receive())
      take_ready(*message);
    else
      patience.wait();
  }
}

unsigned MpiWorkers::threads_of(unsigned rank) const {
  return ranks_[rank].is_still ? 0 : ranks_[rank].threads;
}

void MpiWorkers::begin(const Problem& problem, const Settings& settings,
                       const cluster::Learned& learned, const cluster::MakeDecider& make) {
  tell_topic();
  await_ranks(settings);
  const auto threads_of_others = [this] {
    unsigned threads = 0;
    for (unsigned rank = 1; rank < ranks_.size(); ++rank) threads += threads_of(rank);
    return threads;
  };
  first_thread_works_ = communicator_.size() <= kFewRanks || threads_of_others() == 0;
  ++search_;
  searching_ = true;
  named_.clear();
  told_at_ = now();
  told_boxes_ = 0;
  local_.begin(problem, settings, learned, make);
  places_.clear();
  first_worker_.assign(ranks_.size(), 0);
  for (auto slot = static_cast<unsigned>(first_thread_works_ ? 0 : 1); slot < local_.count();
       ++slot)
    places_.push_back({0, slot});
  for (unsigned rank = 1; rank < ranks_.size(); ++rank) {
    first_worker_[rank] = places_.size();
    for (unsigned slot = 0; slot < threads_of(rank); ++slot) places_.push_back({rank, slot});
  }
  tell_all(Tag::kSearch, write_for_search(search_, 0, write_search(problem, settings, learned)));
}

void MpiWorkers::end() noexcept {
  if (!searching_) return;
  searching_ = false;
  local_.end();
  tell_all(Tag::kEnd, write_for_search(search_, 0, {}));
}

std::size_t MpiWorkers::count() const { return places_.size(); }

double MpiWorkers::seconds_of_grant() const {
  return cluster::Supervisor::Pace::seconds_for(places_.size());
}

void MpiWorkers::send(std::size_t worker, std::string grant) {
  const auto [rank, slot] = places_.at(worker);
  if (rank == 0) return local_.send(slot, std::move(grant));
  communicator_.send(rank, Tag::kGrant, write_for_search(search_, slot, grant));
}

std::optional<cluster::Received> MpiWorkers::take(const Message& message) {
  take_ready(message);
  if (message.tag != Tag::kAnswer) return std::nullopt;
  ForSearch answer = read_for_search(message.bytes);
  if (answer.search != search_) return std::nullopt;
  return cluster::Received{first_worker_.at(message.rank) + answer.slot, std::string(answer.bytes)};
}

std::optional<cluster::Received> MpiWorkers::receive() {
  while (const std::optional<Message> message = communicator_.try_receive())
    if (auto received = take(*message)) {
      patience_.reset();
      return received;
    }
  const bool worked = local_.caller_has_work();
  if (auto received = local_.receive(false)) {
    received->worker -= first_thread_works_ ? 0 : 1;
    patience_.reset();
    return received;
  }
  worked ? patience_.reset() : patience_.wait();
  return std::nullopt;
}

void MpiWorkers::show(const cluster::Progress& progress) {
  progress_ = progress;
  name_those_that_stand_still();
  if (!tells_) return;
  if (told_boxes_ == 0) told_boxes_ = progress.boxes;
  if (now() - told_at_ >= kSecondsBetweenLines) tell_progress();
}

void MpiWorkers::name_those_that_stand_still() {
  std::set<unsigned> late;
  for (const std::size_t worker : progress_.still)
    if (named_.insert(worker).second && !ranks_[places_.at(worker).rank].is_still)
      late.insert(places_.at(worker).rank);
  name_late(late, "others do its work");
}

/// A rank that stands still gets no work of the next searches until it sends something.
void MpiWorkers::name_late(const std::set<unsigned>& ranks, const char* consequence) {
  for (const unsigned rank : ranks) {
    ranks_[rank].is_still = rank > 0;
    fmt::print(stderr, "regulus-mpi: {} does not answer; {}\n", name_of(rank), consequence);
  }
}

void MpiWorkers::tell_progress() {
  const double seconds = now() - told_at_;
  const std::uint64_t boxes = progress_.boxes - told_boxes_;
  told_at_ += seconds;
  told_boxes_ = progress_.boxes;
  const std::string decided =
      progress_.decided ? fmt::format("{:.2f} % decided, ", 100 * *progress_.decided) : "";
  fmt::print(stderr, "regulus-mpi: {} boxes, {:.3g} boxes/s, {}{}\n", progress_.boxes,
             static_cast<double>(boxes) / seconds, decided, describe());
}

std::string MpiWorkers::describe() const {
  std::string text = std::to_string(ranks_.size()) + " ranks, " +
                     std::to_string(progress_.waiting) + " units waiting";
  for (const std::size_t worker : progress_.still)
    text += ", no answer from " + name_of(places_.at(worker).rank);
  return text;
}

bool MpiWorkers::dismiss() {
  if (std::exchange(dismissed_, true)) return true;
  tell_all(Tag::kQuit, {});
  std::set<unsigned> left;
  for (unsigned rank = 1; rank < ranks_.size(); ++rank) left.insert(rank);
  const double begin = now();
  Patience patience;
  while (!left.empty() && now() - begin < kSecondsOfPatience) {
    const std::optional<Message> message = communicator_.try_receive();
    if (!message) patience.wait();
    if (message && message->tag == Tag::kBye) left.erase(message->rank);
  }
  name_late(left, "the job ends without it");
  return left.empty();
}

}  // namespace regulus::detail
