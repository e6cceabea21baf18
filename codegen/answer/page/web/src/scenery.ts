// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn about a robot: the floor below it, and what an arm stands on.
import { Drawable, Extent, Vector } from "./robot";

export type Segment = readonly [Vector, Vector];

/** The corners of the plate below the first link of an arm. */
export function standOf(robot: Drawable, size: number): Vector[] {
  const [x, y, z] = robot.at(robot.places()[0])[robot.parts[0].points[0]];
  const w = 0.2 * size;
  return [[x - w, y - w, z], [x + w, y - w, z], [x + w, y + w, z], [x - w, y + w, z]];
}

/** Squares below the robot, at multiples of their width. */
export function floorOf({ center, radius, points, isPlanar, size }: Extent, square: number): Segment[] {
  const z = points.reduce((least, p) => Math.min(least, p[2]), Infinity) - (isPlanar ? 0.05 * size : 0);
  if (!Number.isFinite(z)) return [];
  const ends = (axis: number): [number, number] =>
    [square * Math.floor((center[axis] - 0.9 * radius) / square), square * Math.ceil((center[axis] + 0.9 * radius) / square)];
  const multiples = ([from, to]: [number, number]): number[] =>
    Array.from({ length: Math.round((to - from) / square) + 1 }, (_, i) => from + i * square);
  const [across, along] = [ends(0), ends(1)];
  return [
    ...multiples(across).map((x): Segment => [[x, along[0], z], [x, along[1], z]]),
    ...multiples(along).map((y): Segment => [[across[0], y, z], [across[1], y, z]]),
  ];
}
