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

/** Returns the numbers of the coordinates of each point in a graph, whose names a scope has. */
function pointsIn(graph: Graph, drawing: DrawingData, scope: Scope): number[][] {
  for (const [name, text] of drawing.lets) scope.set(name, parseExpression(text, graph, scope));
  return drawing.points.map((point) => point.map((text) => parseExpression(text, graph, scope)));
}

function pointsAt(graph: Graph, points: readonly number[][], variables: readonly number[]): Vector[] {
  const values = approximate(graph, variables);
  return points.map(([x, y, z]) => [values[x], values[y], values[z]]);
}

/** A robot whose points are expressions in some names; each list of their values is a place of it. */
export class SolvedRobot implements Drawable {
  readonly parts: readonly DrawnPart[];
  private readonly graph = new Graph();
  private readonly points: number[][];

  constructor(
    drawing: DrawingData,
    names: readonly string[],
    private readonly solutions: number[][],
  ) {
    this.parts = drawing.parts;
    this.points = pointsIn(this.graph, drawing, new Map(names.map((name, k) => [name, this.graph.add("variable", k)])));
  }

  at(values: ArrayLike<number>): Vector[] {
    return pointsAt(this.graph, this.points, Array.from(values));
  }

  places(): number[][] {
    return this.solutions;
  }
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
    this.points = pointsIn(this.graph, drawing, this.scope());
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
    return pointsAt(this.graph, this.points, this.variables.map((v) => (v.isParameter ? parameters[next++] : v.middle)));
  }

  places(): number[][] {
    const { parameters } = this.question;
    const places = [parameters.map(({ range }) => middle(range))];
    for (let corner = 0; corner < Math.min(64, 2 ** parameters.length); ++corner)
      places.push(parameters.map(({ range }, k) => ((corner >> k) & 1 ? range.hi : range.lo)));
    return places;
  }
}

/** The middle and the radius of some points. */
function sphereOf(points: readonly Vector[]): { center: Vector; radius: number } {
  const end = (pick: (...x: number[]) => number): number[] =>
    [0, 1, 2].map((axis) => points.reduce((best, p) => pick(best, p[axis]), points[0]?.[axis] ?? 0));
  const lo = end(Math.min);
  const hi = end(Math.max);
  const radius = Math.hypot(...lo.map((x, axis) => hi[axis] - x)) / 2;
  return { center: lo.map((x, axis) => (x + hi[axis]) / 2) as unknown as Vector, radius: radius > 0 ? radius : 1 };
}

export interface Extent {
  readonly points: readonly Vector[]; // at all places
  readonly center: Vector;
  readonly radius: number;
  readonly size: number; // the radius of the robot itself, at one place
  readonly isPlanar: boolean;
}

/** Axes are drawn as long as the robot wants them, so they do not count. */
export function extentOf(robot: Drawable): Extent {
  const shown = robot.parts.filter(({ kind }) => kind !== "joint" && kind !== "tool").flatMap((part) => part.points);
  const places = robot.places().map((place) => {
    const points = robot.at(place);
    return shown.map((i) => points[i]).filter((point) => point.every(Number.isFinite));
  });
  const points = places.flat();
  const first = places.find((place) => place.length > 0) ?? [];
  const [lowest, highest] = [Math.min, Math.max].map((pick) => points.reduce((best, p) => pick(best, p[2]), points[0]?.[2] ?? 0));
  return { points, ...sphereOf(points), size: sphereOf(first).radius, isPlanar: !(highest > lowest) };
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
