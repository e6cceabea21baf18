// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/ask.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <type_traits>

#include "codegen/answer/page_of_answers.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/margin/margin_question.hpp"

namespace regulus::detail {
namespace {

/// A pipe gives the text of the model only once, and several steps of a question read it.
Asked with_piped_text(Asked asked) {
  ModelOptions& model = std::visit([](auto& one) -> ModelOptions& { return one.model; }, asked);
  std::error_code error;
  const auto status = std::filesystem::status(model.path, error);
  if (!model.text && (status.type() == std::filesystem::file_type::fifo ||
                      status.type() == std::filesystem::file_type::character))
    model.text = model_text(model);
  return asked;
}

std::unique_ptr<Answer> ask_by_kind(const Asked& asked, const Services& services) {
  return std::visit(
      [&services](const auto& one) -> std::unique_ptr<Answer> {
        // A question without an overload of its own would become an Asked again.
        static_assert(!std::is_same_v<decltype(ask(one, services)), std::unique_ptr<Answer>>);
        return ask(one, services);
      },
      asked);
}

}  // namespace

std::unique_ptr<Answer> ask(const Asked& asked, const Services& services) {
  return ask_by_kind(with_piped_text(asked), services);
}

std::unique_ptr<Answer> ask_and_show(const Asked& given, const Services& services) {
  const Asked asked = with_piped_text(given);
  if (services.page.empty()) return ask_by_kind(asked, services);
  ModelOptions model = std::visit([](const auto& one) { return one.model; }, asked);
  // A range LO:HI is no value that a model could be read with.
  if (const auto* margin = std::get_if<AskMargin>(&asked))
    static_cast<void>(take_question(model, margin->size));
  PageOfAnswers page(PageTemplate::installed(), model, services.typed, subject_of(asked));
  std::unique_ptr<Answer> answer = ask_for_page(asked, services, page);
  answer->write_beside([&] {
    const std::size_t size = page.write(services.page);
    services.tell(fmt::format("page       {}, {:.0f} kB\n", services.page, double(size) / 1000));
  });
  return answer;
}

}  // namespace regulus::detail
