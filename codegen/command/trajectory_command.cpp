// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <nlohmann/json.hpp>

#include "codegen/command/answer.hpp"
#include "codegen/command/commands.hpp"
#include "codegen/command/end_command.hpp"
#include "codegen/command/interrupt.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/trajectory/trajectory_certificate.hpp"
#include "codegen/trajectory/trajectory_report.hpp"

namespace regulus::inline command {

std::optional<int> run_trajectory_check(const CheckCommand& command) {
  const std::string text = model_text(command.model);
  // Most models have no way-points: then the model need not be read before the cache is asked.
  if (command.model.waypoints.empty() && text.find("waypoints") == std::string::npos)
    return std::nullopt;
  Stopwatch watch;
  Request request = read_request(text, command.model);
  if (!request.motion.trajectory) return std::nullopt;
  if (!command.checkpoint.path.empty())
    throw UsageError("--checkpoint: a motion along way-points cannot be continued");
  if (command.shard_size > 0)
    throw UsageError("--shard-size: the proof of a motion along way-points is one file");
  InterruptGuard interrupt;
  interrupt.begin_search();
  const double model_seconds = watch.lap();
  const TrajectoryCheck check =
      check_trajectory(std::move(request), model_seconds, command.search,
                       !command.certificate.empty(), &interrupt.requested());
  const TrajectoryCertificate certificate(command.certificate, check);
  if (!command.output.quiet)
    std::cerr << format_trajectory(check, command.search) << certificate.line();
  if (command.output.json) {
    nlohmann::ordered_json report = json_trajectory(check, command.search);
    certificate.add_to(report);
    std::cout << report.dump(command.output.json_indent) << '\n';
  } else {
    print_answer(name(check.verdict), exit_code_of(check.verdict));
  }
  std::cout.flush();
  return exit_code_of(check.verdict);
}

}  // namespace regulus::command
