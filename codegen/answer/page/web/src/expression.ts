// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions in the language of certificates (runtime/proof/FORMAT.md), as one list of
// operations in which each operation comes after its operands. Equal operations share an entry.
import { down, Interval, interval, negate, point, up } from "./interval";
import { PI } from "./functions";

export type Operation =
  | "constant"
  | "variable"
  | "add"
  | "subtract"
  | "multiply"
  | "divide"
  | "negate"
  | "power"
  | "sqrt"
  | "sin"
  | "cos"
  | "tan"
  | "asin"
  | "acos"
  | "atan"
  | "exp"
  | "log"
  | "abs"
  | "atan2";

const FUNCTIONS: ReadonlySet<string> = new Set([
  "sqrt",
  "sin",
  "cos",
  "tan",
  "asin",
  "acos",
  "atan",
  "exp",
  "log",
  "abs",
  "atan2",
]);

export interface Entry {
  readonly operation: Operation;
  readonly a: number; // an operand, or the number of a variable
  readonly b: number; // an operand, or the exponent of a power
  readonly value: Interval | null; // of a constant
}

/** A mistake in the data of the page. */
export class Damage extends Error {}

export class Graph {
  readonly entries: Entry[] = [];
  private readonly known = new Map<string, number>();

  add(operation: Operation, a = -1, b = -1): number {
    return this.insert(`${operation} ${a} ${b}`, { operation, a, b, value: null });
  }

  constant(value: Interval): number {
    const entry: Entry = { operation: "constant", a: -1, b: -1, value };
    return this.insert(`constant ${value.lo} ${value.hi}`, entry);
  }

  private insert(key: string, entry: Entry): number {
    const found = this.known.get(key);
    if (found !== undefined) return found;
    this.known.set(key, this.entries.length);
    return this.entries.push(entry) - 1;
  }
}

/** Encloses a decimal. ECMAScript may drop the digits after the twentieth. */
export function encloseDecimal(text: string): Interval {
  const value = Number(text);
  if (/^\d{1,15}$/.test(text)) return point(value);
  return interval(down(value), up(value));
}

export type Scope = Map<string, number>;

const TOKEN = /\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|([A-Za-z][A-Za-z0-9_]*)|([-+*/^(),]))/y;
const DEEPEST = 2000;

class Parser {
  private number = "";
  private name = "";
  private sign = "";
  private at = 0;
  private depth = 0;

  constructor(
    private readonly text: string,
    private readonly graph: Graph,
    private readonly scope: Scope,
  ) {
    this.advance();
  }

  whole(): number {
    const result = this.sum();
    if (this.number || this.name || this.sign) this.fail();
    return result;
  }

  private fail(): never {
    throw new Damage(`not an expression: ${this.text.slice(0, 200)}`);
  }

  private advance(): void {
    this.number = this.name = this.sign = "";
    TOKEN.lastIndex = this.at;
    const match = TOKEN.exec(this.text);
    if (match) {
      this.at = TOKEN.lastIndex;
      [this.number, this.name, this.sign] = [match[1] ?? "", match[2] ?? "", match[3] ?? ""];
    } else if (this.text.slice(this.at).trim() !== "") {
      this.fail();
    }
  }

  private take(sign: string): boolean {
    if (this.sign !== sign) return false;
    this.advance();
    return true;
  }

  private require(sign: string): void {
    if (!this.take(sign)) this.fail();
  }

  private sum(): number {
    if (++this.depth > DEEPEST) this.fail();
    let result = this.product();
    for (;;) {
      if (this.take("+")) result = this.graph.add("add", result, this.product());
      else if (this.take("-")) result = this.graph.add("subtract", result, this.product());
      else break;
    }
    --this.depth;
    return result;
  }

  private product(): number {
    let result = this.signed();
    for (;;) {
      if (this.take("*")) result = this.graph.add("multiply", result, this.signed());
      else if (this.take("/")) result = this.graph.add("divide", result, this.signed());
      else return result;
    }
  }

  private signed(): number {
    if (this.take("-")) return this.negated(this.signed());
    if (this.take("+")) return this.signed();
    const base = this.primary();
    if (!this.take("^")) return base;
    const exponent = Number(this.number);
    if (!/^\d+$/.test(this.number) || exponent < 1 || exponent > 1e6) this.fail();
    this.advance();
    return this.graph.add("power", base, exponent);
  }

  private negated(operand: number): number {
    const { value } = this.graph.entries[operand];
    return value ? this.graph.constant(negate(value)) : this.graph.add("negate", operand);
  }

  private primary(): number {
    if (this.number) {
      const value = encloseDecimal(this.number);
      this.advance();
      return this.graph.constant(value);
    }
    if (this.take("(")) {
      const inner = this.sum();
      this.require(")");
      return inner;
    }
    const name = this.name;
    if (!name) this.fail();
    this.advance();
    if (this.sign === "(" && FUNCTIONS.has(name)) return this.call(name as Operation);
    if (name === "pi") return this.graph.constant(PI);
    const meaning = this.scope.get(name);
    if (meaning === undefined) throw new Damage(`the name ${name} is not declared`);
    return meaning;
  }

  private call(name: Operation): number {
    this.require("(");
    const a = this.sum();
    const b = name === "atan2" ? (this.require(","), this.sum()) : -1;
    this.require(")");
    return this.graph.add(name, a, b);
  }
}

/** Reads an expression; `scope` has the entries of the names. */
export function parseExpression(text: string, graph: Graph, scope: Scope): number {
  return new Parser(text, graph, scope).whole();
}

/** Encloses an end of a box: a hexadecimal double as C99 writes it, exactly, or a decimal. */
export function readEnd(text: string): number {
  const match = /^(-?)0x([01])(?:\.([0-9a-f]{1,13}))?p([+-]\d{1,4})$/.exec(text);
  if (!match) {
    if (!/^-?\d+(\.\d+)?([eE][+-]?\d+)?$/.test(text)) throw new Damage(`not a number: ${text}`);
    return Number(text);
  }
  const digits = match[3] ?? "";
  const mantissa = parseInt(match[2], 10) + parseInt(digits || "0", 16) / 16 ** digits.length;
  const exponent = Number(match[4]);
  // Two steps, since 2^exponent alone may underflow.
  const value = mantissa * 2 ** Math.trunc(exponent / 2) * 2 ** (exponent - Math.trunc(exponent / 2));
  return match[1] ? -value : value;
}

