// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the question of an earlier run with that of a page.
#include <algorithm>
#include <set>
#include <sstream>

#include "codegen/certificate/certified_model.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/model/trajectory.hpp"
#include "codegen/page/earlier_run.hpp"
#include "codegen/report/question_report.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::inline page {
namespace {

using Json = nlohmann::ordered_json;

/// A part of a question that differs, and the option that sets it as in the earlier run.
struct Difference {
  enum class Kind { kRange, kTolerance, kTube, kThreshold, kOther };
  Kind kind;
  std::string assignment;  ///< "x=-1:1"; of kOther words for a message
};

std::string text_at(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : "";
}

const Json& part_of(const Json& question, const char* key) {
  static const Json none;
  const auto at = question.find(key);
  return at == question.end() ? none : *at;
}

/// Exact ends if both questions have them, else the doubles.
void compare_ranges(const Json& earlier, const Json& asked, std::vector<Difference>& differences) {
  const bool is_exact = part_of(earlier, "ranges_exact").is_object();
  const Json& before = part_of(earlier, is_exact ? "ranges_exact" : "ranges");
  const Json& now = part_of(asked, is_exact ? "ranges_exact" : "ranges");
  for (const auto& [name, ends] : before.items()) {
    if (part_of(now, name.c_str()) == ends) continue;
    const bool has_texts = ends.is_array() && ends.size() == 2 && ends[0].is_string();
    const std::string text =
        has_texts ? ends[0].get<std::string>() + ':' + ends[1].get<std::string>() : ends.dump();
    differences.push_back(
        {has_texts ? Difference::Kind::kRange : Difference::Kind::kOther, name + '=' + text});
  }
  for (const auto& [name, ends] : now.items())
    if (!before.contains(name))
      differences.push_back({Difference::Kind::kOther, "no range of " + name});
}

Difference tolerance_of(const Json& quantity) {
  const std::string name = text_at(quantity, "name"), group = text_at(quantity, "group");
  const std::string value = text_at(quantity, "shape") == "ball"
                                ? text_at(quantity, "radius_exact")
                                : text_at(quantity, "tolerance_exact");
  constexpr std::string_view kError = "_error";
  if (text_at(quantity, "kind") == "control" && name.ends_with(kError))
    return {Difference::Kind::kTube, name.substr(0, name.size() - kError.size()) + '=' + value};
  if (group.empty() || value.empty())
    return {Difference::Kind::kOther, "another tolerance of " + name};
  return {Difference::Kind::kTolerance, group + '=' + value};
}

const Json* quantity_named(const Json& list, const std::string& name) {
  for (const Json& quantity : list)
    if (text_at(quantity, "name") == name) return &quantity;
  return nullptr;
}

bool is_spread_alike(const Json& a, const Json& b) {
  return std::ranges::all_of(
      std::initializer_list<const char*>{"kind", "shape", "value_exact", "tolerance_exact",
                                         "radius_exact", "range"},
      [&](const char* key) {
        // A prepared question has no exact numbers.
        const bool is_missing = a.contains(key) != b.contains(key);
        return is_missing || part_of(a, key) == part_of(b, key);
      });
}

void compare_tolerances(const Json& earlier, const Json& asked,
                        std::vector<Difference>& differences) {
  std::set<std::string> named;
  const auto add = [&](Difference difference) {
    if (named.insert(difference.assignment).second) differences.push_back(std::move(difference));
  };
  const Json &before = part_of(earlier, "uncertain"), &now = part_of(asked, "uncertain");
  for (const Json& quantity : before) {
    const Json* const other = quantity_named(now, text_at(quantity, "name"));
    if (other == nullptr || !is_spread_alike(quantity, *other)) add(tolerance_of(quantity));
  }
  for (const Json& quantity : now)
    if (quantity_named(before, text_at(quantity, "name")) == nullptr) {
      const std::string group = text_at(quantity, "group");
      if (group.empty())
        add({Difference::Kind::kOther, text_at(quantity, "name") + " exact"});
      else
        add({Difference::Kind::kTolerance, group + "=0"});
    }
}

void compare_thresholds(const Json& earlier, const Json& asked,
                        std::vector<Difference>& differences) {
  const std::string alpha = text_at(earlier, "alpha_exact");
  if (alpha.empty()) {
    if (part_of(earlier, "alpha") != part_of(asked, "alpha"))
      differences.push_back({Difference::Kind::kOther, "another threshold"});
  } else if (alpha != text_at(asked, "alpha_exact")) {
    differences.push_back({Difference::Kind::kThreshold, alpha});
  }
}

std::vector<Difference> differences_of(const EarlierRun& run, const Request& request) {
  const Json asked = json_question(request, {});
  const Json& earlier = run.report["question"];
  std::vector<Difference> differences;
  compare_ranges(earlier, asked, differences);
  // A margin varies them, and says at which value its claims hold.
  if (run.kind == EarlierKind::kMargin) return differences;
  compare_tolerances(earlier, asked, differences);
  for (const char* key : {"where", "constraints"})
    if (part_of(earlier, key) != part_of(asked, key))
      differences.push_back({Difference::Kind::kOther, std::string("other constraints")});
  // A bound has no threshold.
  if (run.kind != EarlierKind::kBound) compare_thresholds(earlier, asked, differences);
  return differences;
}

std::string describe(const Difference& difference) {
  switch (difference.kind) {
    case Difference::Kind::kRange:
      return "--range " + difference.assignment;
    case Difference::Kind::kTolerance:
      return "--tolerance " + difference.assignment;
    case Difference::Kind::kTube:
      return "--tube " + difference.assignment;
    case Difference::Kind::kThreshold:
      return "--alpha " + difference.assignment;
    case Difference::Kind::kOther:
      break;
  }
  return difference.assignment;
}

[[noreturn]] void refuse_run(const EarlierRun& run, const std::string& problem,
                             const std::string& remedy) {
  throw InputError::statement(run.path, 0, std::string("this ") + name(run.kind) + ' ' + problem,
                              remedy);
}

std::string in_quotes(const std::string& text) { return Json(text).dump(-1, ' ', true); }

void require_same_text(const EarlierRun& run, const std::string& text, const std::string& path) {
  if (text_at(run.report, "model_sha256") != sha256(text))
    refuse_run(run,
               "is about the model " + in_quotes(text_at(run.report, "model")) +
                   " in a file with another SHA-256 than " + path,
               "give the model file that it is about; if that was changed, run again");
}

/// Refuses a run about another model or motion.
void require_same_subject(const EarlierRun& run, const Request& request) {
  const std::string model = text_at(run.report, "model"), motion = text_at(run.report, "motion");
  if (model != request.model.name || text_at(run.report, "model_sha256") != request.model.sha256)
    refuse_run(run,
               "is about the model " + in_quotes(model) + " with another SHA-256 than " +
                   request.model.path,
               "give the model file that it is about; if that was changed, run again");
  if (motion != request.motion.name)
    refuse_run(run,
               "is about the motion " + in_quotes(motion) + ", not about " + request.motion.name,
               "give that motion");
  const auto way = run.report.find("waypoints");
  const std::string points = way != run.report.end() ? text_at(*way, "sha256") : "";
  if (points != (request.motion.trajectory ? request.motion.trajectory->sha256 : ""))
    refuse_run(run, "is about other way-points", "give the file with --waypoints, or run again");
}

bool has_changes(const ModelOptions& options) {
  return !options.ranges.empty() || !options.tolerances.empty() || !options.alpha.empty() ||
         !options.tubes.empty();
}

void adopt_report(const EarlierRun& run, ModelOptions& options) {
  const Request request = read_request(options);
  require_same_subject(run, request);
  for (const Difference& difference : differences_of(run, request)) {
    if (difference.kind == Difference::Kind::kRange)
      options.ranges.push_back(difference.assignment);
    if (difference.kind == Difference::Kind::kTolerance)
      options.tolerances.push_back(difference.assignment);
    if (difference.kind == Difference::Kind::kTube) options.tubes.push_back(difference.assignment);
    if (difference.kind == Difference::Kind::kThreshold) options.alpha = difference.assignment;
  }
}

void adopt_certificate(const EarlierRun& run, ModelOptions& options) {
  std::istringstream text(read_start(run.path, CertificateHead::kLongestHead, Readable::kFile));
  const CertificateHead head(text);
  if (!head.value("quantity").empty())
    throw InputError::statement(run.path, 0, "it is the certificate of a bound",
                                "give a certificate of check, locate or margin");
  if (options.motion.empty()) options.motion = head.value("motion");
  if (head.lines().empty() || has_changes(options)) return;
  const ModelConfirmation confirmed = confirm_model(head, options.path, options.waypoints);
  if (!confirmed.refusal.empty())
    throw InputError::statement(run.path, 0, confirmed.refusal,
                                "give the model file that it is about");
  options.ranges = confirmed.options.ranges;
  options.tolerances = confirmed.options.tolerances;
  options.alpha = confirmed.options.alpha;
  options.tubes = confirmed.options.tubes;
}

}  // namespace

void adopt_question(const EarlierRun& run, ModelOptions& options) {
  if (run.kind == EarlierKind::kCertificate) return adopt_certificate(run, options);
  require_same_text(run, model_text(options), options.path);
  if (options.motion.empty()) options.motion = text_at(run.report, "motion");
  if (!has_changes(options)) adopt_report(run, options);
}

void require_same_question(const EarlierRun& run, const Request& request) {
  require_same_subject(run, request);
  std::string list;
  for (const Difference& difference : differences_of(run, request))
    list += (list.empty() ? "" : ", ") + describe(difference);
  if (!list.empty())
    refuse_run(run, "has another question than the page: " + list,
               "give these options, or run it again");
}

}  // namespace regulus::page
