// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/run_command_line.hpp"

#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <set>
#include <system_error>
#include <utility>

#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/symbolic/determinant.hpp"
#include "codegen/model/file/installed_models.hpp"
#include "codegen/model/request.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/support/visible_text.hpp"
#include "codegen/use/command/commands.hpp"
#include "codegen/use/command/run_question.hpp"

namespace regulus::detail {
namespace {

/// Replaces the name of an installed model by its file, and reports the file.
void find(std::string& model, bool quiet) {
  if (model.empty()) return;
  const std::string typed = std::exchange(model, find_model(model));
  if (model != typed && !quiet) std::cerr << "file       " << visible(model) << '\n';
}

/// Returns what prints each warning once, under --quiet too: a command may read its model twice.
std::function<void(const std::string&)> warner() {
  return [given = std::make_shared<std::set<std::string>>()](const std::string& warning) {
    if (given->insert(warning).second) std::cerr << "warning    " << warning << '\n';
  };
}

void find_models(CommandLine& line) {
  const auto find_in = [](auto& command, bool quiet = false) {
    if (!command) return;
    command->model.warn = warner();
    if (!command->model.text) find(command->model.path, quiet);
  };
  if (line.check) find_in(line.check, line.check->output.quiet);
  if (line.locate) find_in(line.locate, line.locate->output.quiet);
  if (line.margin) find_in(line.margin, line.margin->output.quiet);
  if (line.bound) find_in(line.bound, line.bound->output.quiet);
  if (line.datasheet) find_in(line.datasheet, line.datasheet->output.quiet);
  if (line.solve) find_in(line.solve, line.solve->output.quiet);
  if (line.report) find_in(line.report, line.report->output.quiet);
  if (line.explain) find_in(line.explain, line.explain->output.quiet);
  find_in(line.generate);
  if (line.verify) find(line.verify->model, line.verify->output.quiet);
  if (line.list) find(line.list->path, true);
}

FileError no_memory() {
  return FileError(
      "there is not enough memory; raise its limit (see ulimit -v), or use fewer --threads");
}

/// True if there was no room for the stack of a thread, for example.
bool is_want_of_memory(const std::system_error& error) {
  return error.code() == std::errc::resource_unavailable_try_again ||
         error.code() == std::errc::not_enough_memory;
}

/// The answer of a run that ended before there was a question, as while a model was read.
int report_stop(const ReadingStopped& stopped, ErrorFormat format) {
  const char* const reason = stopped.what();
  std::cerr << "claim      none: " << reason << '\n';
  if (format == ErrorFormat::kJson)
    std::cout << R"({"verdict":"possible-problem","reason":")" << reason << "\"}\n";
  else
    std::cout << "POSSIBLE PROBLEM\n";
  return kPossibleProblem;
}

}  // namespace

int run_command_line(CommandLine line, const std::string& typed) {
  if (line.exit_code) return *line.exit_code;
  find_models(line);
  if (line.list) return run_list(*line.list);
  if (line.check) return run_question(question_of(*line.check), typed);
  if (line.locate) return run_question(question_of(*line.locate), typed);
  if (line.margin) return run_question(question_of(*line.margin), typed);
  if (line.bound) return run_question(question_of(*line.bound), typed);
  if (line.datasheet) return run_question(question_of(*line.datasheet), typed);
  if (line.solve) return run_question(question_of(*line.solve), typed);
  if (line.report) return run_report(*line.report, typed);
  if (line.generate) return run_generate(*line.generate, typed);
  if (line.verify) return run_verify(*line.verify);
  if (line.import) return run_import(*line.import);
  if (line.explain) return run_explain(*line.explain, typed);
  throw InternalError("there is no command to run");
}

int report_errors(const std::function<int()>& run, const std::string& where, ErrorFormat format) {
  const auto complain = [&](const std::exception& error, ExitCode code, const char* lead = "") {
    std::cerr << where << lead << visible(error.what(), true) << '\n';
    if (format == ErrorFormat::kJson) std::cout << json_error(error, code) << std::endl;
    return static_cast<int>(code);
  };
  try {
    return run();
  } catch (const UsageError& error) {
    return complain(error, kUsageError);
  } catch (const ClosedFormError& error) {
    return complain(error, kUsageError, "--method closed-form: ");
  } catch (const InputError& error) {
    return complain(error, kBadInput);
  } catch (const FileError& error) {
    return complain(error, kFileError);
  } catch (const NoCompiler& error) {
    return complain(error, kFileError,
                    "no compiler is available; use --engine interpreted, which needs none: ");
  } catch (const CompileError& error) {
    const int code =
        complain(error, kInternalFault, "internal error: the generated kernel did not compile\n");
    if (!error.text().empty()) std::cerr << "--- the text ---\n" << error.text();
    return code;
  } catch (const ReadingStopped& stopped) {
    return report_stop(stopped, format);
  } catch (const std::bad_alloc&) {
    return complain(no_memory(), kFileError);
  } catch (const std::system_error& error) {
    if (is_want_of_memory(error)) return complain(no_memory(), kFileError);
    return complain(error, kInternalFault, "internal error: ");
  } catch (const std::exception& error) {
    return complain(error, kInternalFault, "internal error: ");
  }
}

}  // namespace regulus::detail
