// SPDX-License-Identifier: GPL-3.0-or-later
// The question of a certificate, read from its lines (runtime/proof/FORMAT.md, "The question").
import { approximate, enclose } from "./evaluation";
import { Damage, Graph, parseExpression, Scope } from "./expression";
import { Interval, interval, isBounded, subtract, add } from "./interval";

export type VariableKind = "parameter" | "uncertain" | "error";

export interface Variable {
  readonly name: string;
  readonly kind: VariableKind;
  readonly range: Interval; // outward
}

export interface PoseEntry {
  readonly name: string;
  readonly commanded: number;
}

export class Question {
  readonly graph = new Graph();
  readonly labels = new Map<string, string>();
  readonly variables: Variable[] = [];
  readonly pose: PoseEntry[] = [];
  readonly matrix: number[] = [];
  rows = 0;
  columns = 0;
  readonly scale: number[] = [];
  readonly defined: number[] = [];
  readonly motionDefined: number[] = [];
  readonly reach: number[] = [];
  readonly constraints: number[] = [];
  readonly balls: string[][] = [];
  /** Constants that each piece of a way gives a value, and the number of pieces. */
  readonly pieceNames: string[] = [];
  pieces = 0;
  /** It has equations in the place of a matrix; what they use is not read. */
  isClosure = false;
  /** Of entries, scales and `defined`: poses with their control errors. */
  readonly actual: Scope = new Map();
  /** Of constraints: poses as commanded. */
  readonly commanded: Scope = new Map();

  /** Of a motion along way-points, the question about one piece. */
  constructor(
    text: string,
    private readonly piece = 0,
  ) {
    for (const line of text.split("\n")) if (line !== "") this.read(line);
    if (this.matrix.length !== this.rows * this.columns || this.rows < this.columns)
      throw new Damage("the matrix of the question is not complete");
    if (this.isPiecewise && piece >= this.pieces) throw new Damage("the question has too few pieces");
  }

  get isPiecewise(): boolean {
    return this.pieceNames.length > 0;
  }

  /** Whether it has a determinant, whose values can be sampled. */
  get hasDeterminant(): boolean {
    return this.rows > 0 && this.rows === this.columns;
  }

  get threshold(): string {
    return this.labels.get("alpha") ?? "0";
  }

  get box(): Interval[] {
    return this.variables.map((variable) => variable.range);
  }

  /** Encloses an expression without names. */
  constant(text: string): Interval {
    const graph = new Graph();
    const id = parseExpression(text, graph, new Map());
    const value = enclose(graph, [])[id];
    if (!isBounded(value)) throw new Damage(`a constant has no certain value: ${text}`);
    return value;
  }

  private declare(name: string, id: number): void {
    this.actual.set(name, id);
    this.commanded.set(name, id);
  }

  private addVariable(name: string, kind: VariableKind, range: Interval): number {
    this.variables.push({ name, kind, range });
    return this.graph.add("variable", this.variables.length - 1);
  }

  private spread(middle: string, spread: string): Interval {
    const m = this.constant(middle);
    const s = this.constant(spread);
    return interval(subtract(m, s).lo, add(m, s).hi);
  }

  private read(line: string): void {
    const space = line.indexOf(" ");
    const key = line.slice(0, space);
    const value = line.slice(space + 1);
    switch (key) {
      case "model":
      case "sha256":
      case "motion":
      case "alpha":
        this.labels.set(key, value);
        break;
      case "parameter": {
        const [, name, lo, hi] = this.match(/^(\S+) in (.+) : (.+)$/, line, value);
        const range = interval(this.constant(lo).lo, this.constant(hi).hi);
        this.declare(name, this.addVariable(name, "parameter", range));
        break;
      }
      case "constant": {
        const [, name, text] = this.match(/^(\S+) = (.+)$/, line, value);
        this.declare(name, this.graph.constant(this.constant(text)));
        break;
      }
      case "uncertain": {
        const [, name, middle, spread] = this.match(/^(\S+) = (.+) \+- (.+)$/, line, value);
        this.declare(name, this.addVariable(name, "uncertain", this.spread(middle, spread)));
        break;
      }
      case "ball":
        this.balls.push(value.split(" "));
        break;
      case "piecewise":
        this.pieceNames.push(...value.split(" "));
        break;
      case "piece":
        if (this.pieces++ === this.piece) this.takePiece(value.split(" | "));
        break;
      case "pose":
        this.readPose(line, value);
        break;
      case "unknown":
      case "start":
      case "equation":
        this.isClosure = true;
        break;
      case "let": {
        if (this.isClosure) break;
        const [, name, text] = this.match(/^(\S+) = (.+)$/, line, value);
        this.actual.set(name, parseExpression(text, this.graph, this.actual));
        break;
      }
      case "matrix": {
        const [, rows, columns] = this.match(/^(\d+) (\d+)$/, line, value);
        this.rows = Number(rows);
        this.columns = Number(columns);
        break;
      }
      case "entry":
        this.matrix.push(parseExpression(value, this.graph, this.actual));
        break;
      case "scale":
        this.scale.push(parseExpression(value, this.graph, this.actual));
        break;
      case "defined":
        if (!this.isClosure) this.defined.push(parseExpression(value, this.graph, this.actual));
        break;
      case "motion-defined":
        this.motionDefined.push(parseExpression(value, this.graph, this.commanded));
        break;
      case "reach":
        this.reach.push(parseExpression(value, this.graph, this.commanded));
        break;
      case "constraint":
        this.constraints.push(parseExpression(value, this.graph, this.commanded));
        break;
      default:
        throw new Damage(`a line of the question is not known: ${line.slice(0, 100)}`);
    }
  }

  private takePiece(values: string[]): void {
    if (values.length !== this.pieceNames.length) throw new Damage("a piece has a wrong number of values");
    this.pieceNames.forEach((name, k) => this.declare(name, this.graph.constant(this.constant(values[k]))));
  }

  private match(pattern: RegExp, line: string, value: string): RegExpExecArray {
    const found = pattern.exec(value);
    if (!found) throw new Damage(`a line of the question cannot be read: ${line.slice(0, 100)}`);
    return found;
  }

  private readPose(line: string, value: string): void {
    const [, name, text, error] = this.match(/^(\S+) = (.+?)(?: \+- (.+))?$/, line, value);
    const commanded = parseExpression(text, this.graph, this.commanded);
    let actual = commanded;
    if (error !== undefined) {
      const { lo, hi } = this.spread("0", error);
      actual = this.graph.add("add", commanded, this.addVariable(`error of ${name}`, "error", { lo, hi }));
    }
    this.pose.push({ name, commanded });
    if (!this.commanded.has(name)) this.commanded.set(name, commanded);
    this.actual.set(name, actual);
  }

  /** Approximate values of all entries at a point of the motion parameters; the rest is at its middle. */
  approximateAt(parameters: ArrayLike<number>): Float64Array {
    let next = 0;
    const point = this.variables.map((variable) =>
      variable.kind === "parameter" ? parameters[next++] : (variable.range.lo + variable.range.hi) / 2,
    );
    return approximate(this.graph, point);
  }

  get parameters(): Variable[] {
    return this.variables.filter((variable) => variable.kind === "parameter");
  }
}
