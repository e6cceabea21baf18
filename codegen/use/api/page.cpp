// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/page.hpp"

#include "codegen/answer/page/robot_picture.hpp"
#include "codegen/answer/page_of_answers.hpp"
#include "codegen/model/request.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/use/api/algebra_lock.hpp"

namespace regulus {

using namespace detail;

void write_page(const Question& question, const PageContents& contents, const std::string& file) {
  const AlgebraLock lock;
  const ModelOptions& model = question.options();
  set_earlier_outputs_aside(
      {model.path, model.waypoints, contents.certificate, contents.page_template},
      {{"page", file, true}});
  auto report = nlohmann::ordered_json::parse(contents.json, nullptr, false);
  if (report.is_discarded()) throw UsageError("page: `json` is no JSON object");
  PageOfAnswers page(contents.page_template.empty() ? PageTemplate::installed()
                                                    : PageTemplate::of_file(contents.page_template),
                     model, "", subject_of(contents.kind));
  page.add({contents.kind, contents.headline, contents.report, std::move(report),
            contents.certificate, contents.no_certificate});
  static_cast<void>(page.write(file));
}

std::string robot_picture(const Question& question) {
  const AlgebraLock lock;
  return robot_picture(read_request(question.options()));
}

}  // namespace regulus
