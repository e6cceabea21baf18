// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/run_command_line.hpp"

#include <iostream>

#include "codegen/command/commands.hpp"
#include "codegen/jit/jit.hpp"
#include "codegen/model/request.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"
#include "codegen/symbolic/determinant.hpp"

namespace regulus::inline command {
namespace {

int complain(const std::string& where, const std::exception& error, ExitCode code) {
  std::cerr << where << error.what() << '\n';
  return code;
}

}  // namespace

int run_command_line(const CommandLine& line, const std::string& typed) {
  if (line.exit_code) return *line.exit_code;
  if (line.check) return run_check(*line.check);
  if (line.locate) return run_locate(*line.locate);
  if (line.margin) return run_margin(*line.margin);
  if (line.generate) return run_generate(*line.generate, typed);
  if (line.verify) return run_verify(*line.verify);
  if (line.import) return run_import(*line.import);
  if (line.explain) return run_explain(*line.explain, typed);
  throw InternalError("there is no command to run");
}

int report_errors(const std::function<int()>& run, const std::string& where) try {
  return run();
} catch (const UsageError& error) {
  return complain(where, error, kUsageError);
} catch (const ClosedFormError& error) {
  return complain(where + "--method closed-form: ", error, kUsageError);
} catch (const InputError& error) {
  return complain(where, error, kBadInput);
} catch (const FileError& error) {
  return complain(where, error, kFileError);
} catch (const NoCompiler& error) {
  return complain(where + "no compiler is available; use --engine interpreted, which needs none: ",
                  error, kInternalFault);
} catch (const CompileError& error) {
  std::cerr << where << "internal error: the generated kernel did not compile\n"
            << error.what() << '\n';
  if (!error.text().empty()) std::cerr << "--- the text ---\n" << error.text();
  return kInternalFault;
} catch (const std::exception& error) {
  return complain(where + "internal error: ", error, kInternalFault);
}

}  // namespace regulus::command
