// SPDX-License-Identifier: GPL-3.0-or-later
// Values of the entries of a graph: in doubles, for pictures, and enclosed with gradients, for proofs.
import { Graph } from "./expression";
import {
  absolute,
  add,
  divide,
  ENTIRE,
  hull,
  Interval,
  isBounded,
  middle,
  multiply,
  negate,
  ONE,
  point,
  power,
  subtract,
  ZERO,
} from "./interval";
import * as functions from "./functions";

/** Approximate values of all entries, NaN where there is none. For pictures only. */
export function approximate(graph: Graph, variables: ArrayLike<number>): Float64Array {
  const values = new Float64Array(graph.entries.length);
  graph.entries.forEach((entry, i) => {
    const a = values[entry.a];
    const b = values[entry.b];
    switch (entry.operation) {
      case "constant": values[i] = middle(entry.value!); break;
      case "variable": values[i] = variables[entry.a]; break;
      case "add": values[i] = a + b; break;
      case "subtract": values[i] = a - b; break;
      case "multiply": values[i] = a * b; break;
      case "divide": values[i] = b === 0 ? NaN : a / b; break;
      case "negate": values[i] = -a; break;
      case "power": values[i] = a ** entry.b; break;
      case "atan2": values[i] = Math.atan2(a, b); break;
      default: values[i] = Math[entry.operation](a);
    }
  });
  return values;
}

/** Encloses the value of every entry over a box. */
export function enclose(graph: Graph, box: readonly Interval[]): Interval[] {
  const values: Interval[] = [];
  for (const entry of graph.entries) {
    const a = values[entry.a];
    const b = values[entry.b];
    let value: Interval;
    switch (entry.operation) {
      case "constant": value = entry.value!; break;
      case "variable": value = box[entry.a]; break;
      case "add": value = add(a, b); break;
      case "subtract": value = subtract(a, b); break;
      case "multiply": value = entry.a === entry.b ? power(a, 2) : multiply(a, b); break;
      case "divide": value = divide(a, b); break;
      case "negate": value = negate(a); break;
      case "power": value = power(a, entry.b); break;
      case "sqrt": value = functions.squareRoot(a); break;
      case "sin": value = functions.sine(a); break;
      case "cos": value = functions.cosine(a); break;
      case "tan": value = functions.tangent(a); break;
      case "asin": value = functions.arcsine(a); break;
      case "acos": value = functions.arccosine(a); break;
      case "atan": value = functions.arctangent(a); break;
      case "exp": value = functions.exponential(a); break;
      case "log": value = functions.logarithm(a); break;
      case "abs": value = isBounded(a) ? absolute(a) : ENTIRE; break;
      case "atan2": value = functions.arctangentOfQuotient(a, b); break;
    }
    values.push(value);
  }
  return values;
}

export type Gradient = Interval[]; // an interval for each direction

/** f'(a) for the functions of one argument, from the enclosures of a and f(a). */
function slope(operation: string, a: Interval, value: Interval): Interval {
  switch (operation) {
    case "sqrt": return divide(ONE, multiply(point(2), value));
    case "sin": return functions.cosine(a);
    case "cos": return negate(functions.sine(a));
    case "tan": return add(ONE, power(value, 2));
    case "asin": return divide(ONE, functions.squareRoot(subtract(ONE, power(a, 2))));
    case "acos": return negate(slope("asin", a, value));
    case "atan": return divide(ONE, add(ONE, power(a, 2)));
    case "exp": return value;
    case "log": return divide(ONE, a);
    case "abs": return a.lo > 0 ? ONE : a.hi < 0 ? negate(ONE) : hull(negate(ONE), ONE);
    default: return ENTIRE;
  }
}

const combination = (s: Interval, g: Gradient, t: Interval, h: Gradient): Gradient =>
  g.map((x, k) => add(multiply(s, x), multiply(t, h[k])));

/**
 * Encloses the partial derivatives of every entry over the box of `values`, by the variables
 * `directions`. The derivative of |a| across 0 is [-1, 1], so that the mean value theorem holds.
 */
export function encloseGradients(
  graph: Graph,
  values: readonly Interval[],
  directions: readonly number[],
): Gradient[] {
  const none: Gradient = directions.map(() => ZERO);
  const gradients: Gradient[] = [];
  graph.entries.forEach((entry, i) => {
    const g = gradients[entry.a];
    const h = gradients[entry.b];
    const a = values[entry.a];
    const b = values[entry.b];
    let result: Gradient;
    switch (entry.operation) {
      case "constant": result = none; break;
      case "variable": result = directions.map((k) => (k === entry.a ? ONE : ZERO)); break;
      case "add": result = g.map((x, k) => add(x, h[k])); break;
      case "subtract": result = g.map((x, k) => subtract(x, h[k])); break;
      case "negate": result = g.map(negate); break;
      case "multiply": result = combination(b, g, a, h); break;
      case "divide": {
        const s = divide(ONE, b);
        result = combination(s, g, negate(multiply(values[i], s)), h);
        break;
      }
      case "power": {
        const n = entry.b;
        const s = n === 1 ? ONE : multiply(point(n), power(a, n - 1));
        result = g.map((x) => multiply(s, x));
        break;
      }
      case "atan2": {
        const square = add(power(a, 2), power(b, 2));
        result = combination(divide(b, square), g, negate(divide(a, square)), h);
        break;
      }
      default: {
        const s = slope(entry.operation, a, values[i]);
        result = g === none ? none : g.map((x) => multiply(s, x));
      }
    }
    gradients.push(result);
  });
  return gradients;
}
