// SPDX-License-Identifier: Apache-2.0
// The expressions of a model file as nodes of a question's graph.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "runtime/verifier/model/model_file.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

class FileExpressions {
 public:
  /// Returns kNoNode for a name that it does not know.
  using OtherNames = std::function<NodeId(std::string_view, const Scope&)>;

  /// `degrees`: the pose parameters in that unit. `hidden`: names of a scope that are the
  /// certificate's own, and none of the file's. All must outlive this object.
  FileExpressions(Question& question, const WrittenValues& values, const Names& degrees,
                  const Names& hidden, OtherNames others)
      : q_(question),
        values_(values),
        degrees_(degrees),
        hidden_(hidden),
        others_(std::move(others)) {}

  /// Returns the value at a place. Its names are those of [let], of `scope`, which is
  /// Question::actual, Question::commanded or an empty one, but for hidden ones, and the others.
  /// Throws Unfinished or Rejection for a text that it does not understand.
  [[nodiscard]] NodeId at(const std::string& place, const Scope& scope, bool is_in_degrees = false);

 private:
  [[nodiscard]] NodeId meaning(std::string_view name, const Scope& scope);
  [[nodiscard]] NodeId let(std::string_view name, const Scope& scope);

  Question& q_;
  const WrittenValues& values_;
  const Names &degrees_, &hidden_;
  const OtherNames others_;
  std::map<const Scope*, std::map<std::string, NodeId, std::less<>>> lets_;
  int depth_ = 0, open_lets_ = 0;
};

}  // namespace regulus::verifier
