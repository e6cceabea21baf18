// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/command_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/engine/choices.hpp"
#include "codegen/engine/ingredients.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"
#include "regulus/version.hpp"

namespace regulus::inline command {
namespace {

constexpr const char* kDescription =
    "Regulus proves that a parallel robot has no singular pose in a workspace or on a trajectory, "
    "or\n"
    "shows one, whatever the rounding, the manufacturing tolerances and the control errors.\n\n"
    "  regulus check models/robot_1.toml wide_15\n\n"
    "The last line on standard output is the verdict:\n"
    "  NO SINGULARITY    proved for every pose and every uncertain value declared   (exit 0)\n"
    "  SINGULARITY       a witness proves it; the report shows the pose, the twist\n"
    "                    that is lost there and the rows that are dependent         (exit 1)\n"
    "  POSSIBLE PROBLEM  neither could be shown; the report says why and where      (exit 2)";

constexpr const char* kExitCodes =
    "Exit: 0, 1, 2 as the verdict; 64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kLocateExitCodes =
    "Exit: 0 every box is free, 1 some box is certified singular, 2 otherwise;\n"
    "64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kMarginFooter =
    "Give exactly one of --tolerance, --alpha and --scale a range LO:HI. With LO: alone, margin\n"
    "looks for the upper end itself. The last line on standard output is the bracket:\n"
    "  SAFE UP TO a, NOT AT b   proved at a, and so below; a witness shows a singularity at b\n"
    "Exit: 0 the bracket is as narrow as --gap asks, or all of LO:HI is safe; 1 LO is not safe;\n"
    "2 a limit or an interrupt stopped it earlier, or the tests could not decide;\n"
    "64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kVerifyFooter =
    "The last line on standard output is the answer:\n"
    "  VERIFIED    the claim was proved again, by separate code                     (exit 0)\n"
    "  REJECTED    not a certificate, incomplete, or false; standard error says why (exit 1)\n"
    "  UNFINISHED  neither could be shown                                          (exit 2)\n"
    "64 usage, 65 bad model, 70 internal fault, 74 file error. regulus-verify does the same "
    "alone.";

constexpr const char* kGenerateFooter =
    "What to do with the files: codegen/EMBEDDING.md. In CMake, regulus_add_kernel() does it.\n"
    "Exit: 0 written; 64 usage, 65 bad model, 70 internal fault, 74 file error.";

constexpr const char* kShellFooter =
    "A script on standard input stops at its first error; the message names the line. With the "
    "line\n"
    "set keep-going on, it continues.\n"
    "Exit: the code of that error, otherwise of the last check, locate, margin or verify.";

constexpr double kMarginSeconds = 60;

/// Adds an option that takes one of a few words; the message about a mistyped word suggests one.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        const std::string& description) {
  const CLI::Validator known(
      [name](const std::string& word) -> std::string {
        try {
          static_cast<void>(choice_of<Value>(name.c_str(), word));
          return "";
        } catch (const UsageError& error) {
          const std::string text = error.what();
          return text.substr(text.find(": ") + 2);  // CLI11 puts the option's name before it
        }
      },
      "");
  CLI::Option* option = app.add_option_function<std::string>(
      name,
      [name, &value](const std::string& word) { value = choice_of<Value>(name.c_str(), word); },
      description);
  return option->check(known)->check(CLI::IsMember(words_of<Value>()))->default_str(word_of(value));
}

/// Checks the name of an ingredient; the message about a mistyped one suggests a name.
CLI::Validator known_ingredient() {
  return {[](const std::string& word) -> std::string {
            const std::vector<std::string> known = ingredient_names();
            if (std::ranges::find(known, word) != known.end()) return "";
            return "there is no " + in_quotes(word) + "; " +
                   suggestion(word, known, fmt::format("it can be {}", fmt::join(known, ", ")));
          },
          ""};
}

void add_model_arguments(CLI::App& app, ModelOptions& options) {
  app.add_option("MODEL", options.path, "Model file (TOML), or the name of an installed model")
      ->required();
  app.add_option("MOTION", options.motion, "Motion variety; optional if the model has only one");
}

void add_model_options(CLI::App& app, ModelOptions& options) {
  add_model_arguments(app, options);
  add_model_changes(app, options);
}

void add_waypoint_options(CLI::App& app, ModelOptions& options) {
  app.add_option("--waypoints", options.waypoints,
                 "Follow the way-points of FILE (CSV, or moves in G-code) instead of the motion's "
                 "own poses; the motion gives the pose parameters that the file does not")
      ->type_name("FILE");
  app.add_option("--tube", options.tubes,
                 "Control error around the motion, ± on each pose parameter that is named: "
                 "x,y=0.1; without names, on all, if they have one unit")
      ->take_all()
      ->expected(1)
      ->type_name("p=E");
}

void add_method_options(CLI::App& app, Method& method, std::uint64_t& budget) {
  add_choice(app, "--method", method, "Method that decides a box");
  app.add_option("--symbolic-budget", budget,
                 "Limit on the terms of the polynomial of --method closed-form; the default takes "
                 "about one "
                 "second")
      ->check(CLI::PositiveNumber)
      ->type_name("TERMS")
      ->capture_default_str();
}

void add_filter_option(CLI::App& app, SearchOptions& options) {
  app.add_option("--filter", options.filters,
                 "Shared object with your own regularity test, used on the boxes that the method "
                 "leaves undecided; the report names it (regulus/filter.h)")
      ->take_all()
      ->expected(1)
      ->type_name("FILE.so");
}

void add_search_options(CLI::App& app, SearchOptions& options) {
  add_method_options(app, options.method, options.symbolic_budget);
  add_choice(app, "--determinant", options.determinant,
             "How the determinant of an interval matrix is enclosed: by expansion, by Gaussian "
             "elimination, or by expansion first and elimination if that decides nothing (both)");
  add_choice(app, "--entries", options.entries,
             "How a method of the paper encloses the entries of its matrix: as rewritten "
             "(natural), or also narrowed by their derivatives; auto: with derivatives for K·J^-1 "
             "and if uncertain quantities are split");
  add_choice(app, "--bisect", options.bisection, "Which range is split");
  add_choice(app, "--uncertainty", options.uncertainty,
             "Uncertain quantities: kept whole in the matrix elements, or split like variables");
  app.add_option("--without", options.without,
                 "Switch off a part of the method, to see its effect; may be repeated; the result "
                 "stays sound but slower:" +
                     describe_ingredient())
      ->take_all()
      ->expected(1)
      ->check(known_ingredient())
      ->type_name("NAME");
  add_choice(
      app, "--engine", options.engine,
      "How the model's functions run: compiled by LLVM (jit, margin's default), compiled from "
      "their C++ text by Clang (clang), interpreted, or taken from the cache if it has them, else "
      "interpreted and compiled during a long search (auto, the default of other commands)")
      ->default_str("");
  add_choice(app, "--isa", options.isa,
             "Instruction set of the kernel; default: the best of this processor");
  app.add_option("--threads", options.threads, "Use N threads; default: one for each processor")
      ->type_name("N")
      ->check(CLI::Range(1U, kMaxThreads));
  app.add_option(
         "--max-boxes", options.max_boxes,
         "Evaluate at most N boxes; the search may stop up to an eighth earlier, because it "
         "evaluates boxes in rounds")
      ->type_name("N");
  app.add_option("--time-limit", options.time_limit, "Stop after S seconds")
      ->check(CLI::PositiveNumber)
      ->type_name("S");
  app.add_option("--precision", options.precision,
                 "Limit on the bits of precision that are used if doubles cannot decide")
      ->check(CLI::Range(53L, 1L << 20))
      ->type_name("BITS")
      ->capture_default_str();
  app.add_flag_callback(
      "--no-cache", [&options] { options.use_cache = false; }, "Do not read or write the cache");
}

void add_output_options(CLI::App& app, OutputOptions& options) {
  app.add_flag("--json", options.json, "Print the report on standard output, as one JSON object");
  app.add_flag("--quiet", options.quiet, "Print only the verdict (or the JSON report)");
}

void add_checkpoint_options(CLI::App& app, CheckpointOptions& options) {
  app.add_option(
         "--checkpoint", options.path,
         "Save the search to FILE regularly and when it stops; if FILE exists, continue from it")
      ->type_name("FILE");
  app.add_option("--checkpoint-every", options.interval, "Seconds between two saves; default 10")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber);
}

/// `what` names the subject of the proof.
void add_certificate_option(CLI::App& app, std::string& path, const std::string& what) {
  app.add_option("--certificate", path,
                 what + "; `regulus verify` checks it. An earlier FILE is renamed to FILE.old")
      ->type_name("FILE");
}

constexpr const char* kCheckCertificate = "Write a proof of the verdict";
constexpr const char* kLocateCertificate =
    "Write a proof of the verdict, not of each box: the proof shows that the whole variety is "
    "free, "
    "or that it contains the singular pose of the report";
constexpr const char* kMarginCertificate =
    "Write a proof for each end of the bracket: FILE.safe proves that there is no singularity at "
    "a, "
    "FILE.singular that there is one at b. No file is written for an end that is not found";

/// Adds options of `check` that are refused with a reason, and not as unknown options.
void refuse_checkpoint_options(CLI::App& app, const std::string& why) {
  for (const char* name : {"--checkpoint", "--checkpoint-every"})
    app.add_option_function<std::string>(
           name,
           [name, why](const std::string&) {
             throw CLI::ValidationError(name, "only `regulus check` can be continued; " + why);
           })
        ->group("");
}

void add_verify_options(CLI::App& app, VerifyCommand& command) {
  app.add_option("CERTIFICATE", command.path, "Certificate file")->required();
  app.add_option("--waypoints", command.waypoints,
                 "With --model: the file of way-points that check --waypoints took")
      ->type_name("FILE");
  app.add_option(
         "--model", command.model,
         "Also check that the certificate is about this model file: write the question again "
         "from the file and compare it line by line. Ranges, tolerances and alpha may "
         "differ, because options change them; differences are reported. The verifier's own "
         "reader also reads and compares every number and expression of the file")
      ->type_name("MODEL");
  app.add_option("--time-limit", command.time_limit,
                 "Stop after S seconds; the answer is then UNFINISHED")
      ->check(CLI::PositiveNumber)
      ->type_name("S");
  app.add_option("--max-boxes", command.max_boxes,
                 "Evaluate at most N boxes for all leaves together; default 4194304")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  app.add_flag("--json", command.output.json,
               "Print the report on standard output, as one JSON object");
  app.add_flag("--quiet", command.output.quiet, "Print only the answer (or the JSON report)");
}

void add_paving_options(CLI::App& app, LocateCommand& command) {
  app.add_option("--resolution", command.resolution,
                 "Split boxes until each side is at most this part of its range, such as 1/64; the "
                 "default is between 1/512 for one range and 1/4 for six ranges")
      ->type_name("R");
  app.add_option(
         "--output", command.lines,
         "File for the boxes, one JSON object on each line; - is standard output, the default "
         "unless --json")
      ->type_name("FILE.jsonl");
  app.add_option("--picture", command.pictures, "Draw the paving; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("FILE.svg|FILE.png");
  app.add_option(
         "--axes", command.axes,
         "The two motion parameters to draw; --range p=V sets another parameter to one value "
         "and so draws a slice")
      ->type_name("p,q");
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
  app.add_option(
         "--scale", command.scale,
         "Factor that scales the ranges of a box variety about their midpoints; 1 leaves them as "
         "declared")
      ->type_name("LO:HI");
  app.add_option("--gap", command.gap, "Stop when (b - a)/b is at most this")
      ->type_name("G")
      ->capture_default_str();
  command.search.time_limit = kMarginSeconds;
  app.get_option("--time-limit")->description("Stop after S seconds")->default_str("60");
  app.get_option("--max-boxes")->description("Evaluate at most N boxes in each search");
}

void add_explain_options(CLI::App& app, ExplainCommand& command) {
  app.add_flag("--all", command.all_entries, "Show every entry, not only the first of each kind");
  app.add_option(
         "--stage", command.stage,
         "What to show: all forms, only the matrix, only the occurrences, or the C++ text of the "
         "kernel")
      ->check(CLI::IsMember({"forms", "matrix", "occurrences", "text"}))
      ->capture_default_str();
  add_method_options(app, command.method, command.symbolic_budget);
  app.add_flag("--json", command.output.json,
               "Print one JSON object on standard output: model, motion, stage, text");
}

void add_shell_options(CLI::App& app, ShellCommand& command) {
  app.add_option("MODEL", command.path, "Model file to load first");
  app.add_flag("--json", command.json, "Print each result as one JSON object on a line");
}

}  // namespace

CommandTables::CommandTables(const std::string& shell_commands) : app(kDescription, "regulus") {
  app.set_version_flag("--version", std::string("regulus ") + kVersion);
  app.require_subcommand(1);
  app.footer(kExitCodes);
  add_check();
  add_locate();
  add_margin();
  explain_command = app.add_subcommand(
      "explain", "Show the symbolic forms and the occurrences of each variable before and after");
  add_model_options(*explain_command, explain.model);
  add_explain_options(*explain_command, explain);
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
}

void CommandTables::add_check() {
  check.search.engine = Engine::kAuto;
  check_command =
      app.add_subcommand("check", "Prove that a motion variety has no singular pose, or show one");
  add_model_options(*check_command, check.model);
  add_waypoint_options(*check_command, check.model);
  add_search_options(*check_command, check.search);
  add_filter_option(*check_command, check.search);
  add_certificate_option(*check_command, check.certificate, kCheckCertificate);
  add_checkpoint_options(*check_command, check.checkpoint);
  add_output_options(*check_command, check.output);
  check_command->footer(kExitCodes);
}

void CommandTables::add_locate() {
  locate.search.engine = Engine::kAuto;
  locate_command = app.add_subcommand(
      "locate", "Pave a motion variety: certified free, certified singular, undecided; draw it");
  add_model_options(*locate_command, locate.model);
  add_paving_options(*locate_command, locate);
  add_search_options(*locate_command, locate.search);
  add_certificate_option(*locate_command, locate.certificate, kLocateCertificate);
  refuse_checkpoint_options(
      *locate_command, "the output of a paving that was stopped lists the boxes it did not reach");
  add_output_options(*locate_command, locate.output);
  locate_command->footer(kLocateExitCodes);
}

void CommandTables::add_margin() {
  margin_command = app.add_subcommand(
      "margin", "Bracket the largest tolerance, threshold or size of a motion that is safe");
  add_model_options(*margin_command, margin.model);
  add_search_options(*margin_command, margin.search);
  add_filter_option(*margin_command, margin.search);
  add_margin_options(*margin_command, margin);
  add_certificate_option(*margin_command, margin.certificate, kMarginCertificate);
  refuse_checkpoint_options(*margin_command,
                            "start margin again with the two ends of the bracket as LO:HI");
  add_output_options(*margin_command, margin.output);
  margin_command->footer(kMarginFooter);
}

}  // namespace regulus::command
