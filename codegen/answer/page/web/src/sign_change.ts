// SPDX-License-Identifier: GPL-3.0-or-later
// Proves a singularity again: between two points with determinants of opposite signs there is one.
import { enclose } from "./evaluation";
import { Damage, readEnd } from "./expression";
import { hull, Interval, isBounded, magnitude, middle, multiply, point } from "./interval";
import { encloseDeterminant } from "./matrices";
import { Question } from "./question";

export interface Witness {
  readonly reason: string;
  readonly points: readonly (readonly Interval[])[];
}

/** Reads the proof of a certificate of SINGULARITY. */
export function readWitness(text: string, question: Question): Witness {
  const lines = text.split("\n").filter((line) => line !== "");
  const reason = /^reason (\S+)$/.exec(lines[0] ?? "")?.[1];
  if (!reason || lines[lines.length - 1] !== "end") throw new Damage("the witness is not complete");
  const points = lines
    .filter((line) => line.startsWith("point "))
    .map((line) => {
      const values = line.split(" ").slice(2);
      if (values.length !== question.variables.length)
        throw new Damage("the witness has a wrong number of values");
      return values.map((value, k) => readCoordinate(value, question, k));
    });
  if (points.length === 0) throw new Damage("the witness has no point");
  return { reason, points };
}

function readCoordinate(text: string, question: Question, variable: number): Interval {
  const { range } = question.variables[variable];
  if (text.startsWith("=")) return question.constant(text.slice(1));
  if (text === "lower") return point(range.lo);
  if (text === "upper") return point(range.hi);
  const ends = text.split(":").map((end) => point(readEnd(end)));
  return hull(ends[0], ends[ends.length - 1]);
}

export interface SignChange {
  readonly positive: readonly number[];
  readonly negative: readonly number[];
}

/**
 * Looks for two points near the witness where det A has certain, opposite signs, with a box around
 * them in which A is defined and every constraint holds: then A is singular between them. The points
 * of a certificate may be too close to each other for doubles. Returns null if there are none, or if
 * the question has balls of tolerance, whose points this does not check.
 */
export function proveSignChange(question: Question, near: readonly Interval[]): SignChange | null {
  if (question.rows !== question.columns || question.balls.length > 0) return null;
  const center = near.map(middle);
  for (let step = 2 ** -36; step <= 2 ** -3; step *= 4) {
    const found = signsAround(question, center, step);
    if (found) return found;
  }
  return null;
}

/** True if |det A . prod scale| is certainly at most the threshold at a point next to this one. */
export function proveSmallDeterminant(question: Question, near: readonly Interval[]): boolean {
  if (question.rows !== question.columns || question.balls.length > 0) return false;
  const x = movedInside(question, near.map(middle));
  const values = enclose(question.graph, boxAround(question, x, x));
  const entries = question.matrix.map((id) => values[id]);
  const det = entries.every(isBounded) ? encloseDeterminant(entries, question.columns) : null;
  if (!det || !isBoxInSet(question, x, x)) return false;
  const scaled = question.scale.reduce((product, id) => multiply(product, values[id]), det);
  return isBounded(scaled) && magnitude(scaled) <= question.constant(question.threshold).lo;
}

/** True for a single value that is not a double: its range encloses it closely. */
function isSingle({ lo, hi }: Interval): boolean {
  return hi - lo <= Math.abs(lo) * 1e-14;
}

/** A millionth of each range away from its ends, which are rounded outward. */
function movedInside(question: Question, x: readonly number[]): number[] {
  return x.map((value, k) => {
    const { lo, hi } = question.variables[k].range;
    const inset = (hi - lo) * 1e-6;
    return Math.min(Math.max(value, lo + inset), hi - inset);
  });
}

function signsAround(question: Question, center: number[], step: number): SignChange | null {
  const candidates = [center];
  question.variables.forEach(({ range }, k) => {
    if (isSingle(range)) return;
    for (const sign of [-1, 1]) {
      const moved = [...center];
      moved[k] += sign * step * (range.hi - range.lo);
      candidates.push(moved);
    }
  });
  let positive: number[] | null = null;
  let negative: number[] | null = null;
  for (const candidate of candidates) {
    const x = movedInside(question, candidate);
    const sign = signOfDeterminant(question, x);
    if (sign > 0) positive ??= x;
    if (sign < 0) negative ??= x;
  }
  if (!positive || !negative) return null;
  return isBoxInSet(question, positive, negative) ? { positive, negative } : null;
}

/** The box around two points; of a single value its whole range. */
function boxAround(question: Question, p: readonly number[], q: readonly number[]): Interval[] {
  return p.map((x, k) => {
    const { range } = question.variables[k];
    return isSingle(range) ? range : { lo: Math.min(x, q[k]), hi: Math.max(x, q[k]) };
  });
}

/** Returns 0 if the sign is not certain. */
function signOfDeterminant(question: Question, x: readonly number[]): number {
  const values = enclose(question.graph, boxAround(question, x, x));
  const entries = question.matrix.map((id) => values[id]);
  const det = entries.every(isBounded) ? encloseDeterminant(entries, question.columns) : null;
  return !det ? 0 : det.lo > 0 ? 1 : det.hi < 0 ? -1 : 0;
}

function isBoxInSet(question: Question, p: readonly number[], q: readonly number[]): boolean {
  const values = enclose(question.graph, boxAround(question, p, q));
  const commanded = question.pose.map((entry) => entry.commanded);
  const required = [question.matrix, question.defined, question.motionDefined, commanded].flat();
  return (
    required.every((id) => isBounded(values[id])) &&
    question.constraints.every((id) => isBounded(values[id]) && values[id].hi <= 0) &&
    question.reach.every((id) => isBounded(values[id]) && values[id].lo >= 0)
  );
}
