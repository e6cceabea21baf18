// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_claim.hpp"

#include "runtime/formal/coq_branch.hpp"
#include "runtime/formal/coq_expression.hpp"
#include "runtime/formal/coq_spectrum.hpp"
#include "runtime/verifier/branch_quantity.hpp"

namespace regulus::verifier {
namespace {

/// The files of the library that a theorem needs.
std::string imports(const Question& q) {
  const std::string parts = q.paves ? " Parts" : "";
  if (q.solutions && !q.closure)
    return "Expressions Questions Search Closures Tubes Branches Poses";
  if (q.closure)
    return std::string("Expressions Questions Search Closures Tubes Branches") +
           (is_finite_error(q)             ? " Distances"
            : is_about_slopes_of_branch(q) ? " Rates Slopes"
            : q.quantity                   ? " Rates"
            : q.solutions                  ? " Solutions"
            : q.is_piecewise               ? " Ways"
                                           : "") +
           parts;
  return std::string("Expressions Questions Search Singularity Threshold Forces") +
         (q.load                 ? " Limits"
          : is_about_spectrum(q) ? " SingularValues"
                                 : "") +
         parts;
}

}  // namespace

std::string coq_heading(const Question& question, const std::string& claim) {
  return "(* A theorem for the verdict of a certificate.\n\n   model   " +
         coq_comment(question.model) + "\n   sha256  " + coq_comment(question.sha256) +
         "\n   motion  " + coq_comment(question.motion) + "\n   claim   " + coq_comment(claim) +
         "\n\n   Check it with: coqc -Q FOLDER Regulus FILE. FOLDER has the compiled library. *)\n"
         "From Coq Require Import List.\n"
         "From Coq Require Import PrimFloat.\n"
         "From Regulus Require Import " +
         imports(question) +
         ".\n"
         "From Regulus Require Import Notations.\n"
         "Import ListNotations.\n\n";
}

std::string coq_heading(const Question& question) {
  return coq_heading(question, question.claim());
}

std::string coq_claim(const std::string& claim, const std::string& check) {
  return "\nTheorem the_claim : " + claim + ".\nProof.\n  apply (" + check +
         ").\n  vm_cast_no_check (eq_refl true).\nQed.\n";
}

}  // namespace regulus::verifier
