// SPDX-License-Identifier: GPL-3.0-or-later
// The proof that the matrix A of a question is defined and has full column rank all over a box.
//
// By the mean value theorem, entry by entry, A(x) = A(c) + sum_k (x_k - c_k) D_k, where D_k is in the
// enclosure of the partial derivative over the box and |x_k - c_k| <= r_k. For any K,
//
//   |K A(x) - I| <= P := |K A(c) - I| + sum_k r_k |K D_k|.
//
// If P v < v for some v > 0, then K A(x) is regular: from K A(x) y = 0, |y| <= P |y|, and at the i that
// maximises |y_i|/v_i, |y_i| <= (P |y|)_i <= (P v)_i |y_i|/v_i < |y_i| unless y = 0. So A(x) has full
// column rank. K and v are guesses; nothing depends on where they come from.
//
// With a threshold, |det K A(x)| >= prod_i (1 - (P v)_i/v_i) (Ostrowski: I + E scaled by v is strictly
// diagonally dominant), and |det A| is at least that over |det K|.
import { enclose, encloseGradients } from "./evaluation";
import {
  absolute,
  add,
  divide,
  down,
  Interval,
  interval,
  isBounded,
  magnitude,
  middle,
  multiply,
  ONE,
  point,
  subtract,
  up,
  ZERO,
} from "./interval";
import { encloseDeterminant, guessLeftInverse } from "./matrices";
import { Question } from "./question";

export type Box = readonly Interval[];

/** The result for a box: proved, or the variable along which it should be split (-1: none). */
export interface Attempt {
  readonly isProved: boolean;
  readonly isOutside: boolean;
  readonly split: number;
}

const PROVED: Attempt = { isProved: true, isOutside: false, split: -1 };
const OUTSIDE: Attempt = { isProved: true, isOutside: true, split: -1 };

export class LeafProver {
  private readonly required: number[];
  private readonly threshold: Interval;
  private readonly sides: number[];

  constructor(private readonly question: Question) {
    const q = question;
    this.threshold = q.constant(q.threshold);
    this.required = [
      ...q.matrix,
      ...q.defined,
      ...q.motionDefined,
      ...q.pose.map((entry) => entry.commanded),
      ...(this.hasThreshold ? q.scale : []),
    ];
    this.sides = q.variables.map(({ range }) => range.hi - range.lo);
  }

  private get hasThreshold(): boolean {
    return this.question.threshold !== "0";
  }

  /** Tries to prove the claim on a box. */
  attempt(box: Box): Attempt {
    const q = this.question;
    const values = enclose(q.graph, box);
    if (this.isExcluded(values)) return OUTSIDE;
    const refused = { isProved: false, isOutside: false, split: this.widest(box) };
    if (!this.required.every((id) => isBounded(values[id]))) return refused;
    const directions = box.flatMap((range, k) => (range.lo < range.hi ? [k] : []));
    const gradients = encloseGradients(q.graph, values, directions);
    const center = box.map((range) => point(middle(range)));
    const A = enclose(q.graph, center);
    const K = guessLeftInverse(q.matrix.map((id) => middle(A[id])), q.rows, q.columns);
    if (!K) return refused;
    const radii = directions.map((k) => up(Math.max(box[k].hi - center[k].lo, center[k].lo - box[k].lo)));
    const parts = directions.map((_, k) => this.reachOf(K, (id) => gradients[id][k], radii[k]));
    const P = this.residual(K, (id) => A[id]);
    for (const part of parts) part.forEach((x, i) => (P[i] = up(P[i] + x)));
    if (!P.every(Number.isFinite)) return refused;
    const v = this.guessVector(P);
    if (this.isDominated(P, v) && (!this.hasThreshold || this.exceeds(P, v, K, values))) return PROVED;
    return { isProved: false, isOutside: false, split: this.worst(box, directions, parts) };
  }

  private isExcluded(values: readonly Interval[]): boolean {
    const q = this.question;
    if (!q.motionDefined.every((id) => isBounded(values[id]))) return false;
    return (
      q.constraints.some((id) => isBounded(values[id]) && values[id].lo > 0) ||
      q.reach.some((id) => isBounded(values[id]) && values[id].hi < 0)
    );
  }

  /** |K M| times a radius, where M has the enclosed entries `entry(id)`. */
  private reachOf(K: number[], entry: (id: number) => Interval, radius: number): number[] {
    const { rows, columns } = this.question;
    return this.product(K, entry).map((x) => (columns && rows ? up(magnitude(x) * radius) : 0));
  }

  /** |K A - I|. */
  private residual(K: number[], entry: (id: number) => Interval): number[] {
    const n = this.question.columns;
    return this.product(K, entry).map((x, i) => magnitude(i % (n + 1) === 0 ? subtract(x, ONE) : x));
  }

  private product(K: number[], entry: (id: number) => Interval): Interval[] {
    const { rows: m, columns: n, matrix } = this.question;
    const result: Interval[] = [];
    for (let i = 0; i < n; ++i)
      for (let j = 0; j < n; ++j) {
        let sum = ZERO;
        for (let r = 0; r < m; ++r)
          sum = add(sum, multiply(point(K[i * m + r]), entry(matrix[r * n + j])));
        result.push(sum);
      }
    return result;
  }

  /** Power iteration with P + a small constant. */
  private guessVector(P: number[]): number[] {
    const n = this.question.columns;
    let v = new Array<number>(n).fill(1);
    for (let step = 0; step < 12; ++step) {
      const w = v.map((_, i) => v.reduce((sum, x, j) => sum + P[i * n + j] * x, 1e-9));
      const largest = Math.max(...w);
      v = w.map((x) => Math.max(x / largest, 1e-6));
    }
    return v;
  }

  private rowSum(P: number[], v: number[], i: number): number {
    const n = this.question.columns;
    let sum = 0;
    for (let j = 0; j < n; ++j) sum = up(sum + up(P[i * n + j] * v[j]));
    return sum;
  }

  private isDominated(P: number[], v: number[]): boolean {
    return v.every((x, i) => x > 0 && this.rowSum(P, v, i) < x);
  }

  /** True if |det A . prod scale| is above the threshold. Requires: P v < v. */
  private exceeds(P: number[], v: number[], K: number[], values: readonly Interval[]): boolean {
    const q = this.question;
    const det = encloseDeterminant(K.map(point), q.columns);
    if (!det) return false;
    let least = ONE;
    v.forEach((x, i) => {
      const dominance = down(1 - up(this.rowSum(P, v, i) / x));
      least = multiply(least, interval(dominance, dominance));
    });
    least = divide(least, absolute(det));
    for (const id of q.scale) least = multiply(least, absolute(values[id]));
    return isBounded(least) && least.lo > this.threshold.hi;
  }

  /** The variable whose range contributes most to P, among those that can be halved. */
  private worst(box: Box, directions: number[], parts: number[][]): number {
    let best = -1;
    let most = -1;
    directions.forEach((k, index) => {
      const share = parts[index].reduce((sum, x) => sum + x, 0);
      if (share > most && canHalve(box[k])) [best, most] = [k, share];
    });
    return best;
  }

  private widest(box: Box): number {
    let best = -1;
    let most = -1;
    box.forEach((range, k) => {
      const share = (range.hi - range.lo) / this.sides[k];
      if (share > most && canHalve(range)) [best, most] = [k, share];
    });
    return best;
  }
}

function canHalve(range: Interval): boolean {
  const m = middle(range);
  return range.lo < m && m < range.hi;
}

export function halves(box: Box, variable: number): Box[] {
  const range = box[variable];
  const m = middle(range);
  const part = (half: Interval): Box => box.map((x, k) => (k === variable ? half : x));
  return [part({ lo: range.lo, hi: m }), part({ lo: m, hi: range.hi })];
}
