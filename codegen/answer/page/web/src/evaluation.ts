// SPDX-License-Identifier: GPL-3.0-or-later
// Values of the entries of a graph: in doubles, for pictures, and enclosed, for proofs.
import { Graph } from "./expression";
import {
  absolute,
  add,
  divide,
  ENTIRE,
  Interval,
  isBounded,
  middle,
  multiply,
  negate,
  power,
  subtract,
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
