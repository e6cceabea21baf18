// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/subject.hpp"

#include <random>
#include <stdexcept>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/machine/machine_kernel.hpp"
#include "runtime/regularity/midpoint_inverse.hpp"

namespace regulus::detail::bench {
namespace {

SearchSubject report_labels(Method method) {
  ModelOptions options;
  options.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
  options.motion = "wide_15";
  const Request request = read_request(options);
  const Formulation formulation =
      formulate(request.model, request.motion, functions_needed(method));
  return {lower(formulation),
          enclose_variety(request.model, request.motion, formulation.variables)};
}

Interval part_of(Interval whole, std::mt19937& random) {
  for (unsigned halvings = random() % 3; halvings > 0; --halvings) {
    const Halves halves = bisect(whole).value();
    whole = random() % 2 == 0 ? halves.left : halves.right;
  }
  return whole;
}

/// Returns A at the midpoints of eight boxes, in the layout of points.
PointRows matrix_at_midpoints(const regulus_kernel& kernel, const Interval* boxes) {
  BoxBatch midpoints(kernel.variables);
  for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane)
    for (std::size_t v = 0; v < kernel.variables; ++v)
      midpoints.set(v, lane, mid(boxes[lane * kernel.variables + v]));
  OutputBatch matrix(kernel.rows * kernel.columns);
  if (kernel.matrix(midpoints.data(), nullptr, matrix.data(), kernel.context) != 0)
    throw std::logic_error("the matrix is undefined at a pose of the sample");
  PointRows values(matrix.size());
  for (std::size_t e = 0; e < matrix.size(); ++e)
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane)
      values.set(e, lane, mid(matrix.get(e, lane)));
  return values;
}

}  // namespace

Module kernel_subject() {
  Module module = report_labels(Method::kKj).module;
  std::erase_if(module.functions,
                [](const Function& f) { return f.name != "matrix" && f.name != "left_product"; });
  return module;
}

SearchSubject search_subject() { return report_labels(Method::kAuto); }

const Program& left_product_of(const Module& module) {
  const Function* found = module.find("left_product");
  if (!found) throw std::logic_error("the subject of the kernel benchmarks has no left_product");
  return found->program;
}

Sample make_sample(const Module& module) {
  const Variety variety = report_labels(Method::kKj).variety;
  const machine::MachineKernel interpreted(select(module), best_isa());
  const regulus_kernel& kernel = *interpreted.get();

  Sample sample;
  sample.variables = kernel.variables;
  sample.points = kernel.rows * kernel.columns;
  sample.outputs = kernel.columns * kernel.columns;
  std::mt19937 random(15);
  for (std::size_t b = 0; b < Sample::kBoxes; ++b)
    for (const Interval& range : variety.outer) sample.boxes.push_back(part_of(range, random));

  for (std::size_t b = 0; b < Sample::kBoxes; b += REGULUS_LANES) {
    const PointRows matrix = matrix_at_midpoints(kernel, &sample.boxes[b * sample.variables]);
    LaneNumbers determinant;
    std::vector<LaneRow> inverse(sample.points);
    if (approx_inverse(ConstPointMatrix(matrix.data(), kernel.rows, kernel.columns),
                       PointMatrix(inverse.data()->lane, kernel.columns, kernel.rows),
                       determinant) != 0)
      throw std::logic_error("the matrix has no inverse at a pose of the sample");
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane)
      for (const LaneRow& entry : inverse) sample.K.push_back(entry.lane[lane]);
  }
  return sample;
}

}  // namespace regulus::detail::bench
