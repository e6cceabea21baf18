// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/command_tables.hpp"

#include "codegen/use/command/certificate_options.hpp"
#include "codegen/use/command/help_layout.hpp"
#include "codegen/use/command/load_option.hpp"
#include "codegen/use/command/shared_options.hpp"
#include "regulus/version.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kIntroduction =
    "Regulus proves that a robot has no singular pose in a workspace or on a\n"
    "trajectory, or shows one, whatever the rounding, the manufacturing tolerances\n"
    "and the control errors are.\n\n";

constexpr const char* kFirstExample = "  regulus check robot_1 wide_15\n\n";

constexpr const char* kIntroductionOfRanks =
    "regulus-mpi runs these commands of regulus on the processes that MPI starts. The answers are "
    "the\nsame; `man regulus-mpi` and the page CLUSTER of the manual say more.\n\n"
    "  mpirun -n 8 regulus-mpi check robot_1 wide_15\n\n";

constexpr const char* kVerdicts =
    "The last line on standard output is the verdict:\n"
    "  NO SINGULARITY    proved for every pose and every uncertain value\n"
    "                    declared (exit 0)\n"
    "  SINGULARITY       a witness proves it; the report shows the pose, the twist\n"
    "                    that is lost there and the rows that are dependent (exit 1)\n"
    "  POSSIBLE PROBLEM  neither could be shown; the report says why and\n"
    "                    where (exit 2)";

constexpr const char* kExitCodes =
    "Exit: 0, 1, 2 as the verdict; 64 usage, 65 bad model, 70 internal fault, 74 file\n"
    "error.";

constexpr const char* kLocateExitCodes =
    "Exit: 0 every box is free, 1 some pose is singular, 2 otherwise; 64 usage, 65\n"
    "bad model, 70 internal fault, 74 file error.";

constexpr const char* kMarginFooter =
    "Give exactly one of --tolerance, --alpha, --scale, --grow and --tube a range\n"
    "LO:HI. With LO: alone, margin looks for the upper end itself. The last line on\n"
    "standard output is the bracket:\n"
    "  SAFE UP TO a, NOT AT b   proved at a, and so below; a witness\n"
    "                           shows a singularity at b\n"
    "  WITHIN UP TO a, EXCEEDED AT b\n"
    "                           the same for --quantity force --limit 20\n"
    "Exit: 0 the bracket is as narrow as --gap asks, or all of LO:HI is safe; 1 LO is\n"
    "not safe; 2 a limit or an interrupt stopped it earlier, or the tests could not\n"
    "decide; 64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kVerifyFooter =
    "The last line on standard output is the answer:\n"
    "  VERIFIED    the claim was proved again, by separate code (exit 0)\n"
    "  REJECTED    not a certificate, incomplete, or false; standard error says\n"
    "              why (exit 1)\n"
    "  UNFINISHED  neither could be shown (exit 2)\n"
    "regulus-verify does the same alone.\n"
    "Exit: as above; 64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kExplainFooter =
    "Exit: 0 shown; 64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kGenerateFooter =
    "What to do with the files: the page EMBEDDING of the manual. In CMake,\n"
    "regulus_add_kernel() does it.\n"
    "Exit: 0 written; 64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kShellFooter =
    "A script on standard input stops at its first error; the message names the line.\n"
    "With the line set keep-going on, it continues.\n"
    "Exit: the code of that error, otherwise of the last check, locate, margin,\n"
    "bound, datasheet, solve or verify.";

constexpr const char* kReportFooter =
    "The page needs no network and no other file. It proves the verdict again in the\n"
    "browser, as far as it says.\n"
    "Exit: as check: 0, 1, 2 as the verdict; 64 usage, 65 bad model, 70 internal\n"
    "fault, 74 file error.";

constexpr const char* kCheckCertificate = "Write a proof of the verdict";
constexpr const char* kLocateCertificate =
    "Write a proof of the verdict, not of each box: the proof shows that the whole motion is "
    "free, "
    "or that it contains the singular pose of the report. With --load a proof of each box, but "
    "along "
    "way-points of the verdict";
constexpr const char* kMarginCertificate =
    "Write a proof for each end of the bracket: FILE.safe proves that there is no singularity at "
    "a, "
    "FILE.singular that there is one at b. No file is written for an end that is not found";

void add_paving_options(CLI::App& app, LocateCommand& command) {
  app.add_option("--resolution", command.resolution,
                 "Split boxes until each side is at most this part of its range, such as 1/64; the "
                 "default is between 1/512 for one range and 1/4 for six ranges")
      ->type_name("R");
  app.add_option("--output", command.lines,
                 "File for the boxes, one JSON object on each line; - is standard output")
      ->type_name("FILE.jsonl");
  app.add_option("--picture", command.pictures.files,
                 "Draw the paving, by the program gnuplot; may be repeated. A .vtu file, which "
                 "needs no gnuplot, has the boxes of three ranges in space, for ParaView and other "
                 "programs")
      ->take_all()
      ->expected(1)
      ->type_name("FILE.svg|.pdf|.png|.vtu");
  app.add_option(
         "--axes", command.pictures.axes,
         "The two motion parameters to draw; --range p=V sets another parameter to one value "
         "and so draws a slice")
      ->type_name("p,q");
  app.add_option("--slices", command.pictures.slices,
                 "Draw N slices side by side, at the middles of N equal parts of the range of p")
      ->type_name("p=N");
  app.add_option(
         "--shade", command.pictures.shade,
         "What the colour of a place says of all boxes there: the worst of their claims, or "
         "the share of their volume that is free")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Shade>{{"worst", Shade::kWorst},
                                                                       {"share", Shade::kShare}})
                      .description(""))
      ->type_name("{worst,share}")
      ->default_str("worst");
  app.add_flag("--robot", command.pictures.robot,
               "Draw the robot over the map, at the middle of the ranges; a robot in space as seen "
               "along the third axis. The axes are two coordinates of its place, such as x,y");
}

void add_margin_options(CLI::App& app, MarginCommand& command) {
  app.get_option("--tolerance")
      ->description(
          "Tolerance of a group of constants; with a range, base,platform=0:0.2, margin looks for "
          "the largest safe tolerance")
      ->type_name("GROUP=E|GROUP=LO:HI");
  app.get_option("--alpha")
      ->description(
          "Threshold of |det J^-1|; with a range, margin looks for the largest safe threshold")
      ->type_name("A|LO:HI");
  app.get_option("--tube")
      ->description(
          "Control error around the motion, ± on each pose parameter that is named; with a range, "
          "x,y=0:0.1, margin looks for the largest safe one")
      ->type_name("p=E|p=LO:HI");
  app.add_option(
         "--scale", command.size.scale,
         "Factor that scales the ranges of a motion about their midpoints; 1 leaves them as "
         "declared")
      ->type_name("LO:HI");
  app.add_option("--grow", command.size.parameter,
                 "Motion parameter p that grows: its range is from its declared low end to a value "
                 "in LO:HI; the radius of a sphere, for example")
      ->type_name("p=LO:HI");
  app.add_option("--quantity", command.quantity.quantity,
                 "Ask how far the size can grow while this quantity keeps --limit: a QUANTITY of "
                 "regulus bound")
      ->type_name("QUANTITY");
  add_quantity_options(app, command.quantity);
  app.add_option("--limit", command.limit,
                 "The limit that --quantity must keep: every value is below L (with --min, "
                 "sigma-min and determinant: above)")
      ->type_name("L");
  app.add_option("--gap", command.gap, "Stop when (b - a)/b is at most this")
      ->type_name("G")
      ->capture_default_str();
  command.search.time_limit = kMarginSeconds;
  app.get_option("--time-limit")->description("Stop after S seconds")->default_str("60");
  app.get_option("--max-boxes")->description("Evaluate at most N boxes in each search");
}

void add_explain_options(CLI::App& app, ExplainCommand& command) {
  app.add_flag("--all", command.all_entries,
               "Show every entry, not only the first of each kind, and each in full");
  app.add_option(
         "--stage", command.stage,
         "What to show: all forms, only the matrix, only the occurrences, the C++ text of the "
         "kernel, or values over the motion's box: M(B), K·M(B), the determinant by each method")
      ->check(CLI::IsMember({"forms", "matrix", "occurrences", "text", "box"}))
      ->capture_default_str();
  app.add_flag_callback(
      "--box", [&command] { command.stage = "box"; },
      "The same as --stage box; --range changes the box");
  add_method_options(app, command.method, command.symbolic_budget);
  app.add_flag("--json", command.output.json,
               "Print one JSON object on standard output: model, motion, stage, text");
  app.add_flag("--quiet", command.output.quiet, "Do not name the file of an installed model");
}

/// An option that may be repeated would take the model for another value: --range x=0 MODEL.
void give_one_value_each(CLI::App& command) {
  for (CLI::Option* option : command.get_options())
    if (!option->get_positional()) option->allow_extra_args(false);
}

void add_shell_options(CLI::App& app, ShellCommand& command) {
  app.add_option("MODEL", command.path, "Model file to load first");
  app.add_flag("--json", command.json, "Print each result as one JSON object on a line");
}

}  // namespace

CommandTables::CommandTables(const std::string& shell_commands)
    : app(std::string(kIntroduction) + kFirstExample + kVerdicts, "regulus") {
  app.set_version_flag("--version", std::string("regulus ") + kVersion);
  app.require_subcommand(1);
  app.footer(kExitCodes);
  app.formatter(std::make_shared<GroupedHelp>());
  add_check();
  add_locate();
  add_margin();
  add_bound();
  add_datasheet();
  add_solve();
  add_report();
  explain_command = app.add_subcommand(
      "explain", "Show the symbolic forms and the occurrences of each variable before and after");
  add_model_options(*explain_command, explain.model);
  add_explain_options(*explain_command, explain);
  explain_command->footer(kExplainFooter);
  generate_command = app.add_subcommand(
      "generate", "Write a kernel as C++ files, for programs that run without Regulus");
  add_model_arguments(*generate_command, generate.model);
  add_model_changes(*generate_command, generate.model);
  add_generate_options(*generate_command, generate);
  generate_command->footer(kGenerateFooter);
  verify_command = app.add_subcommand(
      "verify", "Check a certificate, independently of the program that wrote it");
  add_verify_options(*verify_command, verify);
  verify_command->footer(kVerifyFooter);
  import_command = app.add_subcommand(
      "import", "Make a model of a robot that a file of another program describes");
  add_import_options(*import_command, import);
  list_command = app.add_subcommand(
      "list", "List the installed models, or the motions and tolerance groups of a model");
  add_list_options(*list_command, list);
  list_command->footer("Exit: 0 listed; 64 usage, 65 bad model, 74 file error.");
  shell_command = app.add_subcommand(
      "shell", "Load, show, set, check and plot at a prompt, or as a script on standard input");
  add_shell_options(*shell_command, shell);
  shell_command->footer(shell_commands + kShellFooter);
  for (CLI::App* command : app.get_subcommands(nullptr)) {
    group_options(*command);
    give_one_value_each(*command);
  }
}

void CommandTables::show_ranks() {
  app.name("regulus-mpi");
  app.description(std::string(kIntroductionOfRanks) + kVerdicts);
  for (CLI::App* other : {report_command, explain_command, generate_command, import_command,
                          list_command, shell_command})
    other->group("");
}

void CommandTables::add_report() {
  report.search.engine = Engine::kAuto;
  report_command = app.add_subcommand(
      "report", "Write one page for a browser: verdict, robot, boxes, bounds and proof");
  add_model_options(*report_command, report.model);
  add_waypoint_options(*report_command, report.model);
  add_report_options(*report_command, report);
  add_search_options(*report_command, report.search);
  add_output_options(*report_command, report.output);
  report_command->footer(kReportFooter);
}

void CommandTables::add_check() {
  check.search.engine = Engine::kAuto;
  check_command =
      app.add_subcommand("check", "Prove that a motion has no singular pose, or show one");
  add_model_options(*check_command, check.model);
  add_waypoint_options(*check_command, check.model);
  add_search_options(*check_command, check.search);
  add_filter_option(*check_command, check.search);
  add_kernel_option(*check_command, check.search);
  add_certificate_option(*check_command, check.certificate, kCheckCertificate);
  add_shard_option(*check_command, check.shard_size);
  add_checkpoint_options(*check_command, check.checkpoint);
  add_output_options(*check_command, check.output);
  add_page_option(*check_command, check.output);
  add_load_option(*check_command, check.load);
  check_command->footer(kExitCodes);
}

void CommandTables::add_locate() {
  locate.search.engine = Engine::kAuto;
  locate_command = app.add_subcommand(
      "locate", "Show where a motion is proved free, proved singular, or undecided; draw it");
  add_model_options(*locate_command, locate.model);
  add_waypoint_options(*locate_command, locate.model);
  add_paving_options(*locate_command, locate);
  add_search_options(*locate_command, locate.search);
  add_certificate_option(*locate_command, locate.certificate, kLocateCertificate);
  add_shard_option(*locate_command, locate.shard_size);
  add_checkpoint_options(*locate_command, locate.checkpoint);
  add_output_options(*locate_command, locate.output);
  add_page_option(*locate_command, locate.output);
  add_load_option(*locate_command, locate.load);
  locate_command->footer(kLocateExitCodes);
}

void CommandTables::add_margin() {
  margin_command = app.add_subcommand(
      "margin", "Bracket the largest tolerance, threshold or size of a motion that is safe");
  add_model_options(*margin_command, margin.model);
  add_waypoint_options(*margin_command, margin.model);
  add_search_options(*margin_command, margin.search);
  add_filter_option(*margin_command, margin.search);
  add_margin_options(*margin_command, margin);
  add_certificate_option(*margin_command, margin.certificate, kMarginCertificate);
  add_shard_option(*margin_command, margin.shard_size);
  add_bracket_checkpoint(*margin_command, margin.checkpoint);
  add_output_options(*margin_command, margin.output);
  add_page_option(*margin_command, margin.output);
  margin_command->footer(kMarginFooter);
}

}  // namespace regulus::detail
