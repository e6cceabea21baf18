// SPDX-License-Identifier: GPL-3.0-or-later
// Proves the leaves of a certificate again, in steps that leave the page usable.
import { Box, halves, LeafProver } from "./leaf";
import { Question } from "./question";
import { Tree } from "./tree";

export interface Progress {
  readonly proved: number; // boxes of the certificate
  readonly undecided: number;
  readonly total: number;
  readonly outside: number;
  readonly parts: number; // boxes that were tried
}

/** The most boxes that one leaf is split into: then it counts as not decided here. */
const MOST_PARTS = 2000;
/** The most boxes that all leaves together are split into; the rest counts as not decided here. */
const MOST_PARTS_OF_ALL = 40000;

/** Proves one leaf in slices of work; returns undefined while it is not done. */
function* proveLeaf(prover: LeafProver, box: Box): Generator<undefined, { ok: boolean; outside: boolean; parts: number }> {
  const open: Box[] = [box];
  let outside = true;
  let parts = 0;
  while (open.length > 0) {
    const part = open.pop()!;
    const attempt = prover.attempt(part);
    outside = outside && attempt.isOutside;
    if (!attempt.isProved) {
      if (attempt.split < 0 || parts > MOST_PARTS) return { ok: false, outside: false, parts };
      open.push(...halves(part, attempt.split));
    }
    ++parts;
    yield undefined;
  }
  return { ok: true, outside, parts };
}

/**
 * Proves the leaves of a tree one after the other; yields after each part. `before`: the boxes that were
 * tried for other trees of the same proof.
 */
export function* proveTree(question: Question, tree: Tree, before = 0): Generator<Progress, Progress> {
  const prover = new LeafProver(question);
  const total = tree.leaves.length;
  let state: Progress = { proved: 0, undecided: 0, total, outside: 0, parts: 0 };
  for (const leaf of tree.leaves) {
    if (before + state.parts > MOST_PARTS_OF_ALL) {
      state = { ...state, undecided: total - state.proved };
      break;
    }
    const work = proveLeaf(prover, leaf.box);
    let step = work.next();
    for (; !step.done; step = work.next()) yield state;
    const { ok, outside, parts } = step.value;
    state = {
      total,
      proved: state.proved + (ok ? 1 : 0),
      undecided: state.undecided + (ok ? 0 : 1),
      outside: state.outside + (outside ? 1 : 0),
      parts: state.parts + parts,
    };
  }
  return state;
}
