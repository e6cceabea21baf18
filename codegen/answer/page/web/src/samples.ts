// SPDX-License-Identifier: GPL-3.0-or-later
// How far a matrix is from singular, in doubles at samples of the motion: for pictures only.
import { approximateDeterminant } from "./matrices";
import { Question } from "./question";
import { roundStep } from "./units";

const COUNT = 512;
const ROUNDING = 1e-12;
const PRIMES = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
/** A parameter that changes the measure by less than this part of its largest change says nothing. */
const LEAST_CHANGE = 0.01;

/** The number i of a sequence that fills 0 to 1 evenly, for each base another. */
function evenly(i: number, base: number): number {
  let result = 0;
  for (let part = 1 / base, rest = i; rest > 0; part /= base, rest = Math.floor(rest / base)) result += part * (rest % base);
  return result;
}

/** det M, or sqrt(det MᵀM) of more rows than columns, with the factors of the rows; 0 is singular. */
export class Samples {
  readonly isSigned: boolean;
  readonly name: string;
  readonly count = COUNT + 1;
  /** Of absolute values. */
  readonly least: number;
  readonly largest: number;
  /** The matrix is singular at all samples but for roundings, which say nothing. */
  readonly isZero: boolean;

  constructor(private readonly question: Question) {
    this.isSigned = question.rows === question.columns;
    this.name = this.isSigned ? "|det|" : "√det(MᵀM)";
    const places = this.places(COUNT);
    const values = places.map((place) => Math.abs(this.at(place))).filter(Number.isFinite);
    this.least = values.reduce((a, b) => Math.min(a, b), Infinity);
    this.largest = values.reduce((a, b) => Math.max(a, b), 0);
    this.isZero = places.every((place) => !(Math.abs(this.at(place)) > ROUNDING * this.bound(place)));
  }

  /** The entries with the factors of their rows, row by row. */
  private matrixAt(parameters: ArrayLike<number>): number[] {
    const { rows, columns, matrix, scale } = this.question;
    const found = this.question.approximateAt(parameters);
    return matrix.map((id, k) => found[id] * (scale.length === rows ? found[scale[Math.floor(k / columns)]] : 1));
  }

  /** What the measure could be with columns of these lengths (Hadamard). */
  private bound(parameters: ArrayLike<number>): number {
    const { columns } = this.question;
    const M = this.matrixAt(parameters);
    const squares = new Array<number>(columns).fill(0);
    M.forEach((x, k) => (squares[k % columns] += x * x));
    return squares.reduce((product, square) => product * Math.sqrt(square), 1);
  }

  /** The measure at values of the motion parameters; NaN where it has none. */
  at(parameters: ArrayLike<number>): number {
    const { rows, columns } = this.question;
    const M = this.matrixAt(parameters);
    if (this.isSigned) return approximateDeterminant(M, columns);
    const square = new Array<number>(columns * columns).fill(0);
    for (let i = 0; i < columns; ++i)
      for (let j = 0; j < columns; ++j)
        for (let r = 0; r < rows; ++r) square[i * columns + j] += M[r * columns + i] * M[r * columns + j];
    return Math.sqrt(Math.max(approximateDeterminant(square, columns), 0));
  }

  /** The parameters that change the measure. */
  changing(): Set<number> {
    const { parameters } = this.question;
    const changes = parameters.map(({ range: { lo, hi } }, k) =>
      this.places(6).reduce((most, place) => {
        const along = Array.from({ length: 9 }, (_, i) => {
          const point = [...place];
          point[k] = lo + ((hi - lo) * i) / 8;
          return this.at(point);
        }).filter(Number.isFinite);
        return along.length === 0 ? most : Math.max(most, Math.max(...along) - Math.min(...along));
      }, 0));
    const most = Math.max(...changes, 0);
    return new Set(changes.flatMap((change, k) => (change > LEAST_CHANGE * most && change > 1e-9 * this.largest ? [k] : [])));
  }

  /** The middle of the motion, and others all over it. */
  private places(count: number): number[][] {
    return Array.from({ length: count + 1 }, (_, i) =>
      this.question.parameters.map(({ range: { lo, hi } }, k) => lo + (hi - lo) * (i === 0 ? 0.5 : evenly(i, PRIMES[k % PRIMES.length]))));
  }
}

/** Values on a square grid, by column and row. */
export type Grid = readonly (readonly number[])[];

/** At most ten levels of round numbers between the least and the largest value of grids; none if they hardly differ. */
export function levelsOf(grids: readonly Grid[]): number[] {
  const values = grids.flat(2).filter(Number.isFinite);
  const lo = values.reduce((a, b) => Math.min(a, b), Infinity);
  const hi = values.reduce((a, b) => Math.max(a, b), 0);
  if (!(hi - lo > 0.01 * hi)) return [];
  const step = roundStep((hi - lo) / 9);
  const levels: number[] = [];
  for (let n = Math.max(Math.ceil(lo / step), 1); n * step < hi; ++n) levels.push(n * step);
  return levels;
}

export type Place = readonly [number, number];

/** The ends of an isoline in each cell that it crosses, in coordinates of the grid, by linear interpolation. */
function crossings(grid: Grid, level: number): [Place, Place][] {
  const found: [Place, Place][] = [];
  for (let i = 0; i + 1 < grid.length; ++i)
    for (let j = 0; j + 1 < grid[i].length; ++j) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([x, y]) => ({ x, y, value: grid[x][y] }));
      if (!corners.every(({ value }) => Number.isFinite(value))) continue;
      const ends = corners.flatMap((a, k): Place[] => {
        const b = corners[(k + 1) % 4];
        if (a.value < level === b.value < level) return [];
        const t = (level - a.value) / (b.value - a.value);
        return [[a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)]];
      });
      for (let k = 0; k + 1 < ends.length; k += 2) found.push([ends[k], ends[k + 1]]);
    }
  return found;
}

/** The isolines of a level, each from one end to the other. */
export function isolines(grid: Grid, level: number): Place[][] {
  const key = ([x, y]: Place): string => `${x.toFixed(6)} ${y.toFixed(6)}`;
  const waiting = new Map<string, Set<Place[]>>();
  const lines: Set<Place[]> = new Set();
  const keep = (line: Place[], isNew: boolean): void => {
    for (const end of [line[0], line[line.length - 1]]) {
      const there = waiting.get(key(end)) ?? new Set();
      if (isNew) there.add(line);
      else there.delete(line);
      waiting.set(key(end), there);
    }
    if (isNew) lines.add(line);
    else lines.delete(line);
  };
  for (const crossing of crossings(grid, level)) {
    let line: Place[] = [...crossing];
    // What ends where this begins or ends becomes one line with it.
    for (const atEnd of [true, false]) {
      const [other] = waiting.get(key(atEnd ? line[line.length - 1] : line[0])) ?? [];
      if (!other) continue;
      keep(other, false);
      if (!atEnd) line.reverse();
      const rest = key(other[0]) === key(line[line.length - 1]) ? other : [...other].reverse();
      line = [...line, ...rest.slice(1)];
    }
    keep(line, true);
  }
  return [...lines];
}
