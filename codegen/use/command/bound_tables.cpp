// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of `regulus bound`, `regulus datasheet` and `regulus solve`.
#include "codegen/answer/refusals.hpp"
#include "codegen/use/command/certificate_options.hpp"
#include "codegen/use/command/command_tables.hpp"
#include "codegen/use/command/shared_options.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kBoundFooter =
    "With one word after MODEL, that word is QUANTITY. The last line on standard\n"
    "output:\n"
    "  BETWEEN a AND b   every value is below b, and a is attained at the reported\n"
    "                    pose; of a least value: every value is above a, and b is\n"
    "                    attained\n"
    "  UNBOUNDED         the robot is singular at the reported pose\n"
    "  WITHIN, EXCEEDED or POSSIBLE PROBLEM   with --limit\n"
    "Exit: 0 the bracket is as narrow as --gap asks, or WITHIN; 1 UNBOUNDED or\n"
    "EXCEEDED; 2 otherwise; 64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kDatasheetFooter =
    "Every row is a bracket: its outer end is proved, its inner end attained. The\n"
    "model file says what there is to bound: [load.NAME], [twist.NAME], [actuators],\n"
    "characteristic_length.\n"
    "Exit: 0 every bracket is as narrow as --gap asks and no limit is exceeded; 1 the\n"
    "robot is singular, or a limit is exceeded; 2 otherwise; 64 usage, 65 bad model,\n"
    "70 internal fault, 74 file error.";

constexpr const char* kSolveFooter =
    "The last line on standard output:\n"
    "  COMPLETE: 6 poses          these are all, proved (exit 0)\n"
    "  NONE                       there is no solution, proved (exit 1)\n"
    "  INCOMPLETE: at least 2     these are certain, and there may be others; the\n"
    "                             report says why, and where (exit 2)\n"
    "Of many places: how many have each answer; the exit is 2 if one is INCOMPLETE,\n"
    "otherwise 1 if one is NONE.\n"
    "Exit: as above; 64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kSolveCertificate =
    "Write a proof that these are all, or that these are certain, to FILE: of configurations, of "
    "poses, and of postures that were searched";

constexpr const char* kBoundCertificate =
    "Write two proofs for each leg or freedom: FILE.leg_3.safe proves that no value is beyond the "
    "bracket, FILE.leg_3.singular that its other end is attained";

constexpr const char* kDatasheetCertificate =
    "Write two proofs for each bracket: FILE.force_payload.leg_3.safe proves that no value is "
    "beyond it, FILE.force_payload.leg_3.singular that its other end is attained";

constexpr const char* kBoundCheckpoint =
    "Save the outcome of each search to FILE when it ends (of condition --norm 2 the search "
    "itself, "
    "about every ten seconds); if FILE exists, continue from it, and prove again what it says";

/// Help, manual and completion do not show an option that the command always refuses; who types it is
/// told why.
void hide_option(CLI::App& app, std::string_view name) {
  CLI::Option* option = app.get_option_no_throw("--" + std::string(name));
  if (option != nullptr) option->group("");
}

void add_place_options(CLI::App& app, SolveCommand& command) {
  app.add_option(
         "--at", command.model.at,
         "The value of a pose parameter; in its place of a leg's length, rho_1, or of the "
         "tool, x, y, z, roll, pitch, yaw; beside the tool, of a joint that keeps it; may be "
         "repeated. Values of all of them need no MOTION")
      ->take_all()
      ->expected(1)
      ->type_name("NAME=VALUE");
  app.add_option("--hold", command.held,
                 "A joint of an arm that keeps the value of the motion, where more than six move; "
                 "may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("JOINT");
  app.add_option("--tube", command.model.tubes,
                 "Control error, ± on each number of the place that is named: x,y=0.1; without "
                 "names, on all, if they have one unit")
      ->take_all()
      ->expected(1)
      ->type_name("NAME=E");
}

}  // namespace

void CommandTables::add_bound() {
  bound.search.engine = Engine::kAuto;
  bound.search.time_limit = kMarginSeconds;
  bound_command = app.add_subcommand(
      "bound", "Bracket the largest force, error, speed or other quantity, over every pose");
  add_model_options(*bound_command, bound.model);
  add_waypoint_options(*bound_command, bound.model);
  add_bound_options(*bound_command, bound);
  add_search_options(*bound_command, bound.search);
  bound_command->get_option("--time-limit")->default_str("60");
  add_certificate_option(*bound_command, bound.certificate, kBoundCertificate);
  add_shard_option(*bound_command, bound.shard_size);
  add_bracket_checkpoint(*bound_command, bound.checkpoint);
  bound_command->get_option("--checkpoint")->description(kBoundCheckpoint);
  add_output_options(*bound_command, bound.output);
  add_page_option(*bound_command, bound.output);
  hide_option(*bound_command, "alpha");
  bound_command->footer(kBoundFooter);
}

void CommandTables::add_solve() {
  solve.search.engine = Engine::kAuto;
  solve.search.time_limit = kMarginSeconds;
  solve_command = app.add_subcommand(
      "solve",
      "Find all configurations, poses or postures at one place, and prove that these are all");
  add_model_options(*solve_command, solve.model);
  add_place_options(*solve_command, solve);
  solve_command
      ->add_option("--waypoints", solve.table,
                   "A table of places (CSV), one a line: pose parameters, lengths of all legs, or "
                   "the tool. Each is solved for itself, with the limits of its own")
      ->type_name("FILE");
  solve_command
      ->add_option("--output", solve.lines,
                   "With --waypoints: file for the answers, one JSON object on each line; - is "
                   "standard output")
      ->type_name("FILE.jsonl");
  add_search_options(*solve_command, solve.search);
  solve_command->get_option("--time-limit")->default_str("60");
  add_certificate_option(*solve_command, solve.certificate, kSolveCertificate);
  add_shard_option(*solve_command, solve.shard_size);
  add_checkpoint_options(*solve_command, solve.checkpoint);
  add_output_options(*solve_command, solve.output);
  add_page_option(*solve_command, solve.output);
  for (const OptionRefusal& refused : option_refusals_of_solutions())
    hide_option(*solve_command, refused.option);
  solve_command->footer(kSolveFooter);
}

void CommandTables::add_datasheet() {
  datasheet.search.engine = Engine::kAuto;
  datasheet.search.time_limit = 10 * kMarginSeconds;
  datasheet_command = app.add_subcommand(
      "datasheet", "Bracket every quantity that the model has data for, in one table");
  add_model_options(*datasheet_command, datasheet.model);
  add_waypoint_options(*datasheet_command, datasheet.model);
  datasheet_command
      ->add_option("--gap", datasheet.gap,
                   "Stop when each bracket is at most this part of its larger end")
      ->type_name("G")
      ->capture_default_str();
  datasheet_command->add_flag("--markdown", datasheet.markdown,
                              "Print the table as Markdown on standard output");
  add_search_options(*datasheet_command, datasheet.search);
  datasheet_command->get_option("--time-limit")->default_str("600");
  add_certificate_option(*datasheet_command, datasheet.certificate, kDatasheetCertificate);
  add_shard_option(*datasheet_command, datasheet.shard_size);
  add_bracket_checkpoint(*datasheet_command, datasheet.checkpoint);
  datasheet_command->get_option("--checkpoint")->description(kBoundCheckpoint);
  add_output_options(*datasheet_command, datasheet.output);
  add_page_option(*datasheet_command, datasheet.output);
  hide_option(*datasheet_command, "alpha");
  datasheet_command->footer(kDatasheetFooter);
}

}  // namespace regulus::detail
