// SPDX-License-Identifier: GPL-3.0-or-later
// The robot's points at a pose, in doubles: for pictures only.
import { approximate } from "./evaluation";
import { DrawingData, DrawnPart } from "./data";
import { Graph, parseExpression, Scope } from "./expression";
import { middle } from "./interval";
import { Question } from "./question";

export type Vector = readonly [number, number, number];

/** A robot that can be drawn at each value of a list of numbers. */
export interface Drawable {
  readonly parts: readonly DrawnPart[];
  at(values: ArrayLike<number>): Vector[];
  /** Values all over the motion, for the size of the view. */
  places(): number[][];
}

export class Robot implements Drawable {
  readonly parts: readonly DrawnPart[];
  private readonly graph = new Graph();
  private readonly points: number[][];
  private readonly variables: { readonly isParameter: boolean; readonly middle: number }[];

  constructor(
    readonly drawing: DrawingData,
    readonly question: Question,
  ) {
    this.parts = drawing.parts;
    this.variables = question.variables.map(({ kind, range }) => ({
      isParameter: kind === "parameter",
      middle: middle(range),
    }));
    const scope = this.scope();
    for (const [name, text] of drawing.lets) scope.set(name, parseExpression(text, this.graph, scope));
    this.points = drawing.points.map((point) =>
      point.map((text) => parseExpression(text, this.graph, scope)),
    );
  }

  /** The names of the question, with their operations copied into this graph. */
  private scope(): Scope {
    const copies: number[] = [];
    for (const entry of this.question.graph.entries)
      copies.push(
        entry.value
          ? this.graph.constant(entry.value)
          : entry.operation === "variable"
            ? this.graph.add("variable", entry.a)
            : this.graph.add(
                entry.operation,
                copies[entry.a],
                entry.operation === "power" ? entry.b : entry.b >= 0 ? copies[entry.b] : -1,
              ),
      );
    return new Map([...this.question.commanded].map(([name, id]) => [name, copies[id]]));
  }

  /** Returns every point at these values of the motion parameters. */
  at(parameters: ArrayLike<number>): Vector[] {
    let next = 0;
    const values = approximate(
      this.graph,
      this.variables.map((v) => (v.isParameter ? parameters[next++] : v.middle)),
    );
    return this.points.map(([x, y, z]) => [values[x], values[y], values[z]]);
  }

  places(): number[][] {
    const { parameters } = this.question;
    const places = [parameters.map(({ range }) => middle(range))];
    for (let corner = 0; corner < Math.min(64, 2 ** parameters.length); ++corner)
      places.push(parameters.map(({ range }, k) => ((corner >> k) & 1 ? range.hi : range.lo)));
    return places;
  }
}

/** The least and largest coordinates over a motion, for the view. */
export function extentOf(robot: Drawable): { center: Vector; radius: number; isPlanar: boolean } {
  const shown = robot.parts.filter((part) => part.kind !== "joint").flatMap((part) => part.points);
  const all = robot
    .places()
    .map((place) => robot.at(place))
    .flatMap((points) => shown.map((i) => points[i]))
    .filter((point) => point.every(Number.isFinite));
  const end = (pick: (...x: number[]) => number): number[] =>
    [0, 1, 2].map((axis) => all.reduce((best, p) => pick(best, p[axis]), all[0]?.[axis] ?? 0));
  const lo = end(Math.min);
  const hi = end(Math.max);
  const center = lo.map((x, axis) => (x + hi[axis]) / 2) as unknown as Vector;
  const radius = Math.hypot(...lo.map((x, axis) => hi[axis] - x)) / 2;
  return { center, radius: radius > 0 ? radius : 1, isPlanar: !(hi[2] > lo[2]) };
}

export function distance(a: Vector, b: Vector): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** From dark blue by teal to yellow, of even lightness steps; 0 <= t <= 1. */
export function scaleColour(t: number): string {
  const stops = [
    [68, 80, 160],
    [34, 139, 141],
    [122, 190, 90],
    [240, 200, 50],
  ];
  const x = Math.min(Math.max(t, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(x), stops.length - 2);
  const mix = stops[i].map((a, k) => Math.round(a + (stops[i + 1][k] - a) * (x - i)));
  return `rgb(${mix.join(", ")})`;
}
