// SPDX-License-Identifier: GPL-3.0-or-later
// Enclosures of first and second partial derivatives of the entries of a graph, forward.
import { Graph } from "./expression";
import * as functions from "./functions";
import {
  add,
  divide,
  ENTIRE,
  hull,
  Interval,
  multiply,
  negate,
  ONE,
  point,
  power,
  subtract,
  ZERO,
} from "./interval";

/** f and its derivatives by p and q, the latter for p <= q, row by row; null: all are zero. */
export interface Derivatives {
  readonly first: readonly Interval[] | null;
  readonly second: readonly Interval[] | null;
}

const NONE: Derivatives = { first: null, second: null };

/** f' and f'' of the functions of one argument, from the enclosures of a and f(a). */
function slopes(operation: string, a: Interval, value: Interval): [Interval, Interval] {
  const inverse = (x: Interval): Interval => divide(ONE, x);
  const two = point(2);
  switch (operation) {
    case "sqrt": {
      const first = inverse(multiply(two, value));
      return [first, negate(divide(first, multiply(two, a)))];
    }
    case "sin": return [functions.cosine(a), negate(value)];
    case "cos": return [negate(functions.sine(a)), negate(value)];
    case "tan": {
      const first = add(ONE, power(value, 2));
      return [first, multiply(multiply(two, value), first)];
    }
    case "asin":
    case "acos": {
      const slope = inverse(functions.squareRoot(subtract(ONE, power(a, 2))));
      const first = operation === "asin" ? slope : negate(slope);
      return [first, multiply(a, power(first, 3))];
    }
    case "atan": {
      const first = inverse(add(ONE, power(a, 2)));
      return [first, negate(multiply(multiply(two, a), power(first, 2)))];
    }
    case "exp": return [value, value];
    case "log": {
      const first = inverse(a);
      return [first, negate(power(first, 2))];
    }
    case "abs":
      // Across 0 the slope is in [-1, 1], as the mean value theorem needs; there is no second derivative.
      return a.lo > 0 ? [ONE, ZERO] : a.hi < 0 ? [negate(ONE), ZERO] : [hull(negate(ONE), ONE), ENTIRE];
    default: return [ENTIRE, ENTIRE];
  }
}

/** Derivatives by some variables; `order` is 1 or 2. */
export class DerivativeForm {
  private readonly pairs: [number, number][] = [];

  constructor(
    private readonly directions: readonly number[],
    private readonly order: 1 | 2,
  ) {
    if (order === 2)
      directions.forEach((_, p) => directions.slice(p).forEach((__, q) => this.pairs.push([p, p + q])));
  }

  /** Encloses those of every entry that `needed` marks, over the box of `values`. */
  enclose(graph: Graph, values: readonly Interval[], needed: readonly boolean[]): Derivatives[] {
    const results: Derivatives[] = [];
    graph.entries.forEach((_, i) => results.push(needed[i] ? this.entry(graph, values, results, i) : NONE));
    return results;
  }

  private entry(graph: Graph, values: readonly Interval[], known: readonly Derivatives[], i: number): Derivatives {
    const { operation, a: left, b: right } = graph.entries[i];
    const f = known[left];
    const g = known[right];
    const a = values[left];
    const b = values[right];
    switch (operation) {
      case "constant": return NONE;
      case "variable": {
        const place = this.directions.indexOf(left);
        return place < 0 ? NONE : { first: this.directions.map((_, k) => (k === place ? ONE : ZERO)), second: null };
      }
      case "add": return this.combine(ONE, f, ONE, g);
      case "subtract": return this.combine(ONE, f, negate(ONE), g);
      case "negate": return this.combine(negate(ONE), f, ZERO, NONE);
      case "multiply": return this.product(a, f, b, g);
      case "divide": {
        const inverse = divide(ONE, b);
        const square = power(inverse, 2);
        const reciprocal = this.chain(negate(square), multiply(point(2), multiply(square, inverse)), g);
        return this.product(a, f, inverse, reciprocal);
      }
      case "power": {
        const n = right;
        const first = n === 1 ? ONE : multiply(point(n), power(a, n - 1));
        const second = n === 1 ? ZERO : multiply(point(n * (n - 1)), n === 2 ? ONE : power(a, n - 2));
        return this.chain(first, second, f);
      }
      case "atan2": {
        const square = add(power(a, 2), power(b, 2));
        const flat = this.combine(divide(b, square), { ...f, second: null }, negate(divide(a, square)), { ...g, second: null });
        return flat.first ? { first: flat.first, second: this.pairs.map(() => ENTIRE) } : NONE;
      }
      default: {
        if (!f.first) return NONE;
        const [first, second] = slopes(operation, a, values[i]);
        return this.chain(first, second, f);
      }
    }
  }

  /** s f + t g, for constants s and t. */
  private combine(s: Interval, f: Derivatives, t: Interval, g: Derivatives): Derivatives {
    const sum = (x: readonly Interval[] | null, y: readonly Interval[] | null): readonly Interval[] | null => {
      if (!x) return y && y.map((value) => multiply(t, value));
      if (!y) return x.map((value) => multiply(s, value));
      return x.map((value, k) => add(multiply(s, value), multiply(t, y[k])));
    };
    return { first: sum(f.first, g.first), second: this.order === 2 ? sum(f.second, g.second) : null };
  }

  private product(a: Interval, f: Derivatives, b: Interval, g: Derivatives): Derivatives {
    const { first, second } = this.combine(b, f, a, g);
    if (this.order === 1 || !f.first || !g.first) return { first, second };
    const u = f.first;
    const v = g.first;
    const mixed = this.pairs.map(([p, q]) => add(multiply(u[p], v[q]), multiply(u[q], v[p])));
    return { first, second: second ? mixed.map((x, k) => add(x, second[k])) : mixed };
  }

  /** Those of h(f), from the enclosures of h' and h''. */
  private chain(slope: Interval, curve: Interval, f: Derivatives): Derivatives {
    if (!f.first) return NONE;
    const u = f.first;
    const first = u.map((x) => multiply(slope, x));
    if (this.order === 1) return { first, second: null };
    const bent = this.pairs.map(([p, q]) => multiply(curve, p === q ? power(u[p], 2) : multiply(u[p], u[q])));
    const { second } = f;
    return { first, second: second ? bent.map((x, k) => add(x, multiply(slope, second[k]))) : bent };
  }
}

/** Marks the entries that the value of one of `roots` depends on. */
export function ingredients(graph: Graph, roots: readonly number[]): boolean[] {
  const needed = graph.entries.map(() => false);
  for (const root of roots) needed[root] = true;
  for (let i = needed.length - 1; i >= 0; --i) {
    const { operation, a, b } = graph.entries[i];
    if (!needed[i] || operation === "variable" || operation === "constant") continue;
    needed[a] = true;
    if (operation !== "power" && b >= 0) needed[b] = true;
  }
  return needed;
}
