// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/list_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

std::string body_of(const std::vector<PlaceProof>& places) {
  std::string body;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const ListProof& list = places[k].list;
    body += fmt::format("{}{}\n", format::kPlace, k + 1);
    if (list.obstacle.empty()) body += list.head + list.proof;
  }
  return body + fmt::format("{}{}\n", format::kPlaces, places.size());
}

/// Says what the first place lacks that has such a text, and how many have one; empty if none has.
std::string note_of(const std::vector<PlaceProof>& places, std::string ListProof::*text,
                    const std::string& lacks) {
  const auto has = [text](const PlaceProof& place) { return !(place.list.*text).empty(); };
  const auto count = std::ranges::count_if(places, has);
  if (count == 0) return "";
  const auto first = std::ranges::find_if(places, has);
  return fmt::format("{} at {} of {} places; {}: {}", lacks, count, places.size(), first->name,
                     first->list.*text);
}

}  // namespace

ProofStatus certify_solutions(const std::string& path, const Request& request,
                              const Solutions& solutions) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  const ListProof list = prove_list(request, solutions);
  status.set_obstacle(list.obstacle);
  if (!list.obstacle.empty()) return status;
  status.attempt([&] { write_witness(path, list.head, list.proof, {}); });
  if (status.obstacle().empty()) status.set_written(list.doubt);
  return status;
}

ProofStatus certify_places(const std::string& path, const std::vector<PlaceProof>& places,
                           std::uint64_t left, std::uint64_t shard_size) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  if (left > 0) {
    status.set_obstacle(fmt::format("{} places were not asked; a proof is about all", left));
    return status;
  }
  const std::string without =
      note_of(places, &ListProof::obstacle, "the verifier will not finish: there is no proof");
  if (std::ranges::none_of(places, [](const PlaceProof& p) { return p.list.obstacle.empty(); })) {
    status.set_obstacle(places.front().list.obstacle);
    return status;
  }
  status.attempt([&] {
    write_witness(path, std::string(format::kPlacesMagic) + '\n', body_of(places),
                  {nullptr, shard_size});
  });
  const std::string doubt = note_of(places, &ListProof::doubt, "a doubt");
  if (status.obstacle().empty()) status.set_written(without.empty() ? doubt : without);
  return status;
}

}  // namespace regulus::detail
