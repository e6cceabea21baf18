// SPDX-License-Identifier: GPL-3.0-or-later
// The proof that the matrix A of a question is defined and has full column rank all over a box.
//
// The motion parameters are t = t0 + tau, |tau_p| <= r_p; all other variables are u = u0 + delta,
// |delta_k| <= s_k. K is any matrix, D_p are any matrices, K(t) = (I - sum tau_p D_p) K. With
// e = K A(t0, u0) - I, B_p = K dA/dt_p at (t0, u0) and B_pq = K d2A/dt_p dt_q over the box of t at u0,
// Taylor's theorem gives, entry by entry,
//
//   K(t) A(t, u0) - I = e + sum tau_p (B_p - D_p) - sum tau_p D_p e
//                       + sum_{p<q} tau_p tau_q (B_pq - D_p B_q - D_q B_p)
//                       + sum_p tau_p^2 (B_pp - 2 D_p B_p)/2 - (sum tau_p D_p)(sum tau_p tau_q B_pq)/2,
//
// and the mean value theorem adds K(t) sum delta_k dA/du_k, the derivative over the whole box. P is
// the sum of the magnitudes of all these terms. If P v < v for some v > 0, then K(t) A is regular: from
// K(t) A y = 0, |y| <= P |y|, and at the i that maximises |y_i|/v_i, |y_i| <= (P v)_i |y_i|/v_i < |y_i|
// unless y = 0. So A has full column rank. K, D_p and v are guesses; the proof does not depend on how
// they were found.
//
// With a threshold, |det K(t) A| >= prod_i (1 - (P v)_i/v_i) (Ostrowski: I + E scaled by v is strictly
// diagonally dominant), and |det K(t)| <= |det K| (1 + x)^n, x the largest row sum of sum r_p |D_p|.
import { DerivativeForm, ingredients } from "./derivatives";
import { enclose } from "./evaluation";
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
  power,
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
const refused = (split: number): Attempt => ({ isProved: false, isOutside: false, split });

/** A matrix of upper bounds of magnitudes, n x n. */
type Bounds = number[];

function accumulate(sum: Bounds, terms: readonly Interval[], factor: number): void {
  terms.forEach((x, i) => (sum[i] = up(sum[i] + up(magnitude(x) * factor))));
}

export class LeafProver {
  private readonly required: number[];
  private readonly needed: boolean[];
  private readonly threshold: Interval;
  private readonly sides: number[];
  private readonly n: number;

  constructor(private readonly question: Question) {
    const q = question;
    this.n = q.columns;
    this.threshold = q.constant(q.threshold);
    const commanded = q.pose.map((entry) => entry.commanded);
    this.required = [q.matrix, q.defined, q.motionDefined, commanded, this.hasThreshold ? q.scale : []].flat();
    this.needed = ingredients(q.graph, q.matrix);
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
    if (!this.required.every((id) => isBounded(values[id]))) return refused(this.widest(box));
    const center = box.map((range) => point(middle(range)));
    const atCenter = enclose(q.graph, center);
    const K = guessLeftInverse(q.matrix.map((id) => middle(atCenter[id])), q.rows, this.n);
    if (!K) return refused(this.widest(box));
    const { P, shift, shares } = this.bounds(box, center, values, atCenter, K);
    if (!P.every(Number.isFinite)) return refused(this.widest(box));
    const v = this.guessVector(P);
    if (this.isDominated(P, v) && (!this.hasThreshold || this.exceeds(P, v, K, shift, values))) return PROVED;
    return refused(largest(box, shares));
  }

  private isExcluded(values: readonly Interval[]): boolean {
    const q = this.question;
    if (!q.motionDefined.every((id) => isBounded(values[id]))) return false;
    return (
      q.constraints.some((id) => isBounded(values[id]) && values[id].lo > 0) ||
      q.reach.some((id) => isBounded(values[id]) && values[id].hi < 0)
    );
  }

  /** P, the row sums of sum r_p |D_p|, and how much each variable contributes to P. */
  private bounds(box: Box, center: Box, values: readonly Interval[], atCenter: readonly Interval[], K: number[]) {
    const { n, question: q } = this;
    const zero = (): Bounds => new Array<number>(n * n).fill(0);
    const reach = box.map((range, k) => up(Math.max(range.hi - center[k].lo, center[k].lo - range.lo)));
    const wide = box.flatMap((range, k) => (range.lo < range.hi ? [k] : []));
    const moving = wide.filter((k) => q.variables[k].kind === "parameter");
    const fixed = wide.filter((k) => q.variables[k].kind !== "parameter");
    const e = this.product(K, (id) => atCenter[id]).map((x, i) => (i % (n + 1) === 0 ? subtract(x, ONE) : x));
    const P = zero();
    accumulate(P, e, 1);
    const shares = box.map(() => 0);

    const partial = new DerivativeForm(moving, 1).enclose(q.graph, atCenter, this.needed);
    const B = moving.map((_, p) => this.product(K, (id) => partial[id].first?.[p] ?? ZERO));
    const D = B.map((block) => block.map(middle));
    const X = zero();
    moving.forEach((k, p) => {
      accumulate(X, D[p].map(point), reach[k]);
      accumulate(P, B[p].map((x, i) => subtract(x, point(D[p][i]))), reach[k]);
    });
    // Where t moves and u is at its middle; the values there are those of a smaller box.
    const atMiddle = fixed.length > 0 ? enclose(q.graph, box.map((range, k) => (fixed.includes(k) ? center[k] : range))) : values;
    const second = new DerivativeForm(moving, 2).enclose(q.graph, atMiddle, this.needed);
    const rest = zero();
    let pair = 0;
    moving.forEach((k, p) =>
      moving.slice(p).forEach((l, offset) => {
        const at = pair++;
        const Bpq = this.product(K, (id) => second[id].second?.[at] ?? ZERO);
        const cross = add2(this.times(D[p], B[p + offset]), offset === 0 ? this.times(D[p], B[p]) : this.times(D[p + offset], B[p]));
        const factor = up(reach[k] * reach[l] * (offset === 0 ? 0.5 : 1));
        const before = sum(P);
        accumulate(P, Bpq.map((x, i) => subtract(x, cross[i])), factor);
        shares[k] += sum(P) - before;
        shares[l] += sum(P) - before;
        accumulate(rest, Bpq, factor);
      }),
    );
    this.addProduct(P, X, e.map(magnitude));
    this.addProduct(P, X, rest);

    const uncertain = new DerivativeForm(fixed, 1).enclose(q.graph, values, this.needed);
    const U = zero();
    fixed.forEach((k, p) => {
      const before = sum(U);
      accumulate(U, this.product(K, (id) => uncertain[id].first?.[p] ?? ZERO), reach[k]);
      shares[k] += sum(U) - before;
    });
    accumulate(P, U.map(point), 1);
    this.addProduct(P, X, U);
    return { P, shift: X, shares };
  }

  /** K M, where M has the entries `entry(id)`. */
  private product(K: number[], entry: (id: number) => Interval): Interval[] {
    const { rows: m, columns: n, matrix } = this.question;
    const entries = matrix.map(entry);
    const result: Interval[] = [];
    for (let i = 0; i < n; ++i)
      for (let j = 0; j < n; ++j) {
        let total = ZERO;
        for (let r = 0; r < m; ++r) total = add(total, multiply(point(K[i * m + r]), entries[r * n + j]));
        result.push(total);
      }
    return result;
  }

  /** D M, n x n. */
  private times(D: readonly number[], M: readonly Interval[]): Interval[] {
    const { n } = this;
    return M.map((_, at) => {
      const i = Math.floor(at / n);
      let total = ZERO;
      for (let r = 0; r < n; ++r) total = add(total, multiply(point(D[i * n + r]), M[r * n + (at % n)]));
      return total;
    });
  }

  /** P += X Y, rounded up. */
  private addProduct(P: Bounds, X: Bounds, Y: readonly number[]): void {
    const { n } = this;
    for (let at = 0; at < n * n; ++at)
      for (let r = 0; r < n; ++r) P[at] = up(P[at] + up(X[Math.floor(at / n) * n + r] * Y[r * n + (at % n)]));
  }

  /** Power iteration with P + a small constant. */
  private guessVector(P: Bounds): number[] {
    let v = new Array<number>(this.n).fill(1);
    for (let step = 0; step < 12; ++step) {
      const w = v.map((_, i) => v.reduce((total, x, j) => total + P[i * this.n + j] * x, 1e-9));
      const most = Math.max(...w);
      v = w.map((x) => Math.max(x / most, 1e-6));
    }
    return v;
  }

  /** (P v)_i, rounded up. */
  private rowSum(P: Bounds, v: readonly number[], i: number): number {
    let total = 0;
    for (let j = 0; j < this.n; ++j) total = up(total + up(P[i * this.n + j] * v[j]));
    return total;
  }

  private isDominated(P: Bounds, v: readonly number[]): boolean {
    return v.every((x, i) => x > 0 && this.rowSum(P, v, i) < x);
  }

  /** True if |det A . prod scale| is above the threshold. Requires: P v < v. */
  private exceeds(P: Bounds, v: readonly number[], K: number[], X: Bounds, values: readonly Interval[]): boolean {
    const det = encloseDeterminant(K.map(point), this.n);
    if (!det) return false;
    let least = ONE;
    v.forEach((x, i) => {
      const dominance = down(1 - up(this.rowSum(P, v, i) / x));
      least = multiply(least, interval(dominance, dominance));
    });
    const ones = v.map(() => 1);
    const shift = Math.max(...v.map((_, i) => this.rowSum(X, ones, i)));
    least = divide(least, multiply(absolute(det), power(add(ONE, point(shift)), this.n)));
    for (const id of this.question.scale) least = multiply(least, absolute(values[id]));
    return isBounded(least) && least.lo > this.threshold.hi;
  }

  private widest(box: Box): number {
    return largest(box, box.map((range, k) => (range.hi - range.lo) / this.sides[k]));
  }
}

const sum = (values: readonly number[]): number => values.reduce((total, x) => total + x, 0);
const add2 = (x: readonly Interval[], y: readonly Interval[]): Interval[] => x.map((value, i) => add(value, y[i]));

function canHalve(range: Interval): boolean {
  const m = middle(range);
  return range.lo < m && m < range.hi;
}

/** The variable with the largest share, among those that can be halved; -1: none. */
function largest(box: Box, shares: readonly number[]): number {
  let best = -1;
  box.forEach((range, k) => {
    if (canHalve(range) && (best < 0 || shares[k] > shares[best])) best = k;
  });
  return best;
}

export function halves(box: Box, variable: number): Box[] {
  const range = box[variable];
  const m = middle(range);
  const part = (half: Interval): Box => box.map((x, k) => (k === variable ? half : x));
  return [part({ lo: range.lo, hi: m }), part({ lo: m, hi: range.hi })];
}
