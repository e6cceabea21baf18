// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/certified_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/cut_sides.hpp"
#include "codegen/answer/certificate/load_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/overrides.hpp"
#include "codegen/model/request.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

/// Returns the texts before and after `mark`, as in "a = b"; both empty if there is no `mark`.
std::pair<std::string, std::string> parted(std::string_view text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return {};
  return {std::string(text.substr(0, at)), std::string(text.substr(at + mark.size()))};
}

struct StatedRange {
  std::string parameter, lo, hi;
};

/// The values that a command line could have changed, as the question states them.
struct Stated {
  std::string alpha;
  std::vector<StatedRange> ranges;            ///< in their order, which is that of the variables
  std::map<std::string, std::string> spread;  ///< of each constant of the robot that varies
  std::map<std::string, std::string> errors;  ///< of each pose parameter
  std::set<std::string> with_error;           ///< the pose parameters with an error, which may be 0
  bool is_without_threshold;                  ///< forces and quantities

  explicit Stated(const CertificateHead& certificate)
      : alpha(certificate.value("alpha")),
        is_without_threshold(!certificate.value("load").empty() ||
                             !certificate.value("quantity").empty()) {
    for (const std::string& line : certificate.lines()) {
      if (const auto text = value_of(line, "parameter"); !text.empty()) {
        const auto [name, range] = parted(text, " in ");
        const auto [lo, hi] = parted(range, " : ");
        ranges.push_back({name, lo, hi});
      }
      if (const auto text = value_of(line, "uncertain"); !text.empty())
        spread[parted(text, " = ").first] = parted(text, " +- ").second;
      if (const auto text = value_of(line, "pose"); !text.empty()) {
        const std::string error = parted(text, " +- ").second;
        const std::string name = parted(text, " = ").first;
        errors[name] = error.empty() ? "0" : error;
        if (!error.empty()) with_error.insert(name);
      }
    }
  }
};

std::string range_text(const Range& range) {
  return expression_text(range.lo) + " : " + expression_text(range.hi);
}

ex spread_of(const Model& model, const GeometryParameter& g) {
  return g.ball >= 0 ? model.balls.at(std::size_t(g.ball)).radius : g.tolerance;
}

/// The request of a model file, changed to the values that a question states.
class CertificateOverrides {
 public:
  CertificateOverrides(Request request, const Stated& stated)
      : request_(std::move(request)), stated_(stated) {
    if (!request_.motion.waypoints) change_ranges();
    change_errors();
    change_tolerances();
    change_threshold();
  }

  [[nodiscard]] const std::vector<std::string>& differences() const { return differences_; }
  /// Returns these differences as options.
  [[nodiscard]] const ModelOptions& options() const { return options_; }
  /// Returns the question's lines from `model` on.
  [[nodiscard]] std::string question(const CertificateHead& certificate) const {
    std::set<std::string> uncertain;
    for (const GeometryParameter& g : request_.model.geometry)
      if (stated_.spread.contains(g.name) || !spread_of(request_.model, g).is_zero())
        uncertain.insert(g.name);
    for (const PoseParameter& p : request_.model.pose)
      if (stated_.with_error.contains(p.name)) uncertain.insert(p.name);
    return question_of(certificate, uncertain) + load_of(certificate);
  }

 private:
  [[nodiscard]] std::string question_of(const CertificateHead& certificate,
                                        const std::set<std::string>& uncertain) const {
    const bool is_piecewise = !certificate.value("piecewise").empty();
    if (!request_.motion.trajectory) {
      const CutSides sides(request_);
      return is_piecewise && !sides.is_empty() ? sides.on_all_sides(uncertain).text
                                               : certified_question(request_, uncertain).text;
    }
    if (is_piecewise) return trajectory_question(request_, uncertain).text;
    return question_of_piece(certificate, uncertain);
  }

  /// Returns the lines about the load and the limits, if the certificate is about forces.
  [[nodiscard]] std::string load_of(const CertificateHead& certificate) const {
    if (!certificate.value("quantity").empty()) return "";
    const std::string_view name = certificate.value("load");
    for (const VectorSet& load : request_.model.loads)
      if (load.name == name) return load_lines(request_.model, load);
    return "";
  }

  /// Returns the question about the piece that has the certificate's poses; about the first if none
  /// has.
  [[nodiscard]] std::string question_of_piece(const CertificateHead& certificate,
                                              const std::set<std::string>& uncertain) const {
    std::vector<std::string> poses;
    for (const std::string& line : certificate.lines())
      if (const auto text = value_of(line, "pose"); !text.empty()) poses.emplace_back(text);
    const std::size_t pieces = request_.motion.trajectory->pieces.size();
    std::size_t k = 0;
    while (k < pieces && !has_poses(piece_request(request_, k), poses)) ++k;
    return certified_question(piece_request(request_, k == pieces ? 0 : k), uncertain).text;
  }

  [[nodiscard]] static bool has_poses(const Request& piece, const std::vector<std::string>& poses) {
    for (std::size_t i = 0; i < piece.model.pose.size(); ++i) {
      const std::string begin =
          piece.model.pose[i].name + " = " + expression_text(piece.motion.pose[i]);
      if (i >= poses.size() || (poses[i] != begin && !poses[i].starts_with(begin + " +- ")))
        return false;
    }
    return true;
  }

  /// Control errors may be larger than those of the file, never smaller: a proof about less than
  /// the model declares is one about another motion.
  void change_errors() {
    for (const auto& [name, now] : stated_.errors) {
      const auto at = std::ranges::find(request_.model.pose, name, &PoseParameter::name);
      if (at == request_.model.pose.end()) continue;
      const auto i = static_cast<std::size_t>(at - request_.model.pose.begin());
      const std::string before =
          request_.motion.error.empty() ? "0" : expression_text(request_.motion.error[i]);
      if (now == before) continue;
      const std::vector<ex> declared = request_.motion.error;
      set_tube(request_.model, request_.motion, name + '=' + now);
      if (certain_sign(request_.motion.error[i] - (declared.empty() ? ex(0) : declared[i])) !=
          CertainSign::kPositive) {
        request_.motion.error = declared;
        continue;
      }
      note("tube " + name, now, before);
      options_.tubes.push_back(name + '=' + now);
    }
  }

  void note(const std::string& what, const std::string& now, const std::string& before) {
    differences_.push_back(fmt::format("{} {} instead of {}", what, now, before));
  }

  /// Returns the range or the value of a parameter.
  [[nodiscard]] std::string range_before(const std::string& name) const {
    const Motion& motion = request_.motion;
    for (const MotionParameter& p : motion.parameters)
      if (p.name == name) return range_text(p.range);
    for (std::size_t i = 0; i < request_.model.pose.size(); ++i)
      if (request_.model.pose[i].name == name) return expression_text(motion.pose[i]);
    return "none";
  }

  void change_ranges() {
    for (const StatedRange& range : stated_.ranges) {
      const std::string now = range.lo + " : " + range.hi;
      const std::string before = range_before(range.parameter);
      if (now == before) continue;
      set_range(request_.model, request_.motion, range.parameter, range.lo + ':' + range.hi);
      note("range " + range.parameter, now, before);
      options_.ranges.push_back(range.parameter + '=' + range.lo + ':' + range.hi);
    }
  }

  /// Changes whole groups, as an option does. If the members of a group differ, the lines do too.
  void change_tolerances() {
    std::set<std::string> changed;
    for (const GeometryParameter& g : std::vector(request_.model.geometry)) {
      const auto stated = stated_.spread.find(g.name);
      const std::string now = stated == stated_.spread.end() ? "0" : stated->second;
      const std::string before = expression_text(spread_of(request_.model, g));
      if (g.group.empty() || now == before || !changed.insert(g.group).second) continue;
      set_tolerance(request_.model, g.group, now);
      note("tolerance " + g.group, now, before);
      options_.tolerances.push_back(g.group + '=' + now);
    }
  }

  void change_threshold() {
    if (stated_.is_without_threshold) request_.motion.alpha = 0;
    const std::string before = expression_text(request_.motion.alpha);
    if (stated_.alpha == before) return;
    set_alpha(request_.motion, stated_.alpha);
    note("alpha", stated_.alpha, before);
    options_.alpha = stated_.alpha;
  }

  Request request_;
  const Stated& stated_;
  std::vector<std::string> differences_;
  ModelOptions options_;
};

bool is_condition(const std::string& line) {
  return !value_of(line, "defined").empty() || !value_of(line, "motion-defined").empty();
}

/// Returns true if a condition is about constants alone. The computation of a range, such as the
/// root in sqrt(pi - 3)^2, may have produced a condition that the range itself no longer shows.
bool names_nothing(const std::string& condition) {
  static const std::set<std::string, std::less<>> kKnown{
      "pi", "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "log", "abs"};
  const std::string text = condition.substr(condition.find(' '));
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  for (std::size_t begin = 0, end; begin < text.size(); begin = end) {
    end = begin + 1;
    if (std::isalpha(static_cast<unsigned char>(text[begin])) == 0) continue;
    while (end < text.size() && is_part(text[end])) ++end;
    if (!kKnown.contains(text.substr(begin, end - begin))) return false;
  }
  return true;
}

struct NumberedLine {
  std::size_t number;
  std::string text;
};

/// The lines of a question in two lists: those whose order has a meaning, and conditions.
struct Sorted {
  std::vector<NumberedLine> ordered, conditions;

  Sorted(const std::vector<std::string>& lines, std::size_t first) {
    for (std::size_t i = first; i < lines.size(); ++i)
      (is_condition(lines[i]) ? conditions : ordered).push_back({i + 1, lines[i]});
  }
  [[nodiscard]] std::set<std::string> condition_texts() const {
    std::set<std::string> texts;
    for (const NumberedLine& line : conditions) texts.insert(line.text);
    return texts;
  }
};

std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The first lines are the verdict and the claim, which follow from the other lines.
constexpr std::size_t kFirstOfQuestion = 3;

std::string shortened(const std::string& line) {
  constexpr std::size_t kLong = 200;
  return line.size() <= kLong ? line : line.substr(0, kLong) + " …";
}

std::string line_difference(const NumberedLine& found, const std::string& expected) {
  return fmt::format("line {} reads '{}', where the model file gives '{}'", found.number,
                     shortened(found.text), shortened(expected));
}

/// Returns the lines up to those of a quantity: what they state is compared with the model file by the
/// verifier.
std::vector<std::string> without_quantity(std::vector<std::string> lines) {
  const auto is_quantity = [](const std::string& line) {
    return !value_of(line, "quantity").empty();
  };
  lines.erase(std::ranges::find_if(lines, is_quantity), lines.end());
  return lines;
}

/// Describes the first difference; empty if there is none.
std::string first_difference(const std::vector<std::string>& certificate,
                             const std::string& question) {
  const Sorted found(certificate, kFirstOfQuestion), expected(lines_in(question), 0);
  const NumberedLine end{certificate.size() + 1, "proof"};
  for (std::size_t i = 0; i < std::max(found.ordered.size(), expected.ordered.size()); ++i) {
    const NumberedLine& line = i < found.ordered.size() ? found.ordered[i] : end;
    const std::string text = i < expected.ordered.size() ? expected.ordered[i].text : "proof";
    if (line.text != text) return line_difference(line, text);
  }
  const std::set<std::string> needed = expected.condition_texts(), given = found.condition_texts();
  for (const std::string& condition : needed)
    if (!given.contains(condition)) return "there is no line '" + shortened(condition) + '\'';
  for (const NumberedLine& line : found.conditions)
    if (!needed.contains(line.text) && !names_nothing(line.text))
      return fmt::format("line {}, '{}', is not in the model file", line.number,
                         shortened(line.text));
  return "";
}

}  // namespace

ModelConfirmation confirm_model(const CertificateHead& certificate, const std::string& path,
                                const std::string& waypoints) {
  const std::string text = read_model_text(path);
  const Model model = parse_model(text, path);
  const auto refused = [&path](const std::string& why) {
    return ModelConfirmation{"the certificate is not about " + path + ": " + why, {}, {}};
  };
  if (certificate.value("sha256") != model.sha256)
    return refused("the SHA-256 of that file differs");
  try {
    ModelOptions options;
    options.path = path;
    options.motion = certificate.value("motion");
    options.waypoints = waypoints;
    const Stated stated(certificate);
    const CertificateOverrides changed(read_request(text, options), stated);
    const std::string difference =
        first_difference(without_quantity(certificate.lines()), changed.question(certificate));
    if (!difference.empty()) return refused(difference);
    ModelConfirmation confirmed{"", changed.differences(), changed.options()};
    confirmed.options.motion = options.motion;
    confirmed.options.waypoints = waypoints;
    return confirmed;
  } catch (const UsageError& error) {
    return refused(error.what());
  } catch (const InputError& error) {
    return refused(error.what());
  }
}

}  // namespace regulus
