// SPDX-License-Identifier: GPL-3.0-or-later
// The answers about mechanisms whose configuration is a solution of equations.
#pragma once

#include <memory>

#include "codegen/answer/asked.hpp"
#include "codegen/answer/kinds.hpp"
#include "codegen/answer/services.hpp"

namespace regulus::detail {

struct MarginQuestion;
struct Request;

/// Requires  request.model.closure.
/// Throws    as ask().
[[nodiscard]] std::unique_ptr<CheckAnswer> answer_closure(Request request, double model_seconds,
                                                          const AskCheck& asked,
                                                          const Services& services);
/// The same of a motion along way-points.
[[nodiscard]] std::unique_ptr<CheckAnswer> answer_closure_way(Request request, double model_seconds,
                                                              const AskCheck& asked,
                                                              const Services& services);
[[nodiscard]] std::unique_ptr<PavingAnswer> answer_closure(Request request, double model_seconds,
                                                           const AskPaving& asked,
                                                           const Services& services);
/// The same of a motion along way-points.
[[nodiscard]] std::unique_ptr<PavingAnswer> answer_closure_way(Request request,
                                                               double model_seconds,
                                                               const AskPaving& asked,
                                                               const Services& services);
/// The same for a margin, over ranges or along way-points.
[[nodiscard]] std::unique_ptr<MarginAnswer> answer_closure(const MarginQuestion& question,
                                                           Request request, const AskMargin& asked,
                                                           const Services& services);
[[nodiscard]] std::unique_ptr<LoadAnswer> answer_closure(Request request, double model_seconds,
                                                         const AskLoad& asked,
                                                         const Services& services);
[[nodiscard]] std::unique_ptr<LoadPavingAnswer> answer_closure(Request request,
                                                               double model_seconds,
                                                               const AskLoadPaving& asked,
                                                               const Services& services);
/// The same of a motion along way-points.
[[nodiscard]] std::unique_ptr<LoadPavingAnswer> answer_closure_way(Request request,
                                                                   double model_seconds,
                                                                   const AskLoadPaving& asked,
                                                                   const Services& services);

}  // namespace regulus::detail
