// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/outputs.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "codegen/answer/report/progress.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

/// Returns the files that a question reads: the model, way-points, filters.
std::vector<std::string> inputs_of(const ModelOptions& model, const SearchOptions& search) {
  std::vector<std::string> files = search.filters;
  if (!search.kernel.empty()) files.push_back(search.kernel);
  files.insert(files.end(), {model.path, model.waypoints});
  return files;
}

}  // namespace

void set_outputs_aside(const ModelOptions& model, const SearchOptions& search,
                       const Services& services) {
  set_outputs_aside(
      model, search, services,
      {{services.dashes + "certificate", services.certificate, true, format::kShardsEnding}});
}

void set_outputs_aside(const ModelOptions& model, const SearchOptions& search,
                       const Services& services, std::vector<OutputFile> certificates) {
  std::vector<OutputFile> outputs = std::move(certificates);
  OutputFile checkpoint{services.dashes + "checkpoint", services.checkpoint.path};
  checkpoint.continues = true;
  outputs.push_back(checkpoint);
  outputs.push_back({services.dashes + "output", services.lines.file});
  outputs.push_back({services.dashes + "page", services.page, true});
  for (const std::string& picture : services.pictures.files)
    outputs.push_back({services.dashes + "picture", picture});
  set_earlier_outputs_aside(inputs_of(model, search), outputs);
}

OutputOptions display_of(const Services& services) {
  return {.json = false, .quiet = !services.shows_progress};
}

FormingWatch watch_of(const Services& services) {
  return forming_watch(display_of(services), services.interrupt);
}

FormingWatch watch_of(const Services& services, const SearchOptions& search) {
  using Clock = FormingWatch::Clock;
  FormingWatch watch{.interrupt = services.interrupt};
  const std::chrono::duration<double> limit(search.time_limit);
  // A limit that no clock reaches is no limit.
  if (search.time_limit > 0 && limit < std::chrono::hours(24 * 365 * 100))
    watch.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
  return watch;
}

}  // namespace regulus::detail
