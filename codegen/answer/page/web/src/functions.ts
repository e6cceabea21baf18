// SPDX-License-Identifier: GPL-3.0-or-later
// Enclosures of elementary functions. ECMAScript promises nothing about Math.sin and the like, so sine,
// cosine and exponential are Taylor polynomials in interval arithmetic with Lagrange's remainder, and
// inverse functions are guesses of Math that the function itself, or its inverse, confirms.
import {
  absolute,
  add,
  divide,
  down,
  ENTIRE,
  hull,
  interval,
  Interval,
  isBounded,
  multiply,
  negate,
  ONE,
  point,
  power,
  subtract,
  up,
  ZERO,
} from "./interval";

// The double nearest to pi/2, and bounds of pi/2 minus that double (6.1232339957367658...e-17).
const HALF_PI_HIGH = 1.5707963267948966;
const HALF_PI_LOW: Interval = { lo: 6.12323399573676e-17, hi: 6.12323399573677e-17 };
export const HALF_PI = add(point(HALF_PI_HIGH), HALF_PI_LOW);
export const PI = multiply(point(2), HALF_PI);
const FARTHEST_ANGLE = 1e6;

function reciprocalOfFactorial(n: number): Interval {
  let result = ONE;
  for (let i = 2; i <= n; ++i) result = divide(result, point(i));
  return result;
}

const TERMS = 13;
const SINE = Array.from({ length: TERMS }, (_, i) => reciprocalOfFactorial(2 * i + 1));
const COSINE = Array.from({ length: TERMS }, (_, i) => reciprocalOfFactorial(2 * i));
const EXPONENTIAL = Array.from({ length: 2 * TERMS }, (_, i) => reciprocalOfFactorial(i));

/** Returns the alternating sum of c_i s^i, |s| < 1, whose next term bounds the rest. */
function alternatingSeries(coefficients: Interval[], s: Interval): Interval {
  let sum = ZERO;
  for (let i = coefficients.length - 1; i >= 0; --i)
    sum = subtract(coefficients[i], multiply(s, sum));
  const rest = multiply(power(s, coefficients.length), coefficients[coefficients.length - 1]);
  return add(sum, hull(negate(absolute(rest)), absolute(rest)));
}

/** Returns r = x - k pi/2 with |r| < 0.9, and k modulo 4. */
function reduceAngle(x: number): { r: Interval; quarter: number } | null {
  if (!(Math.abs(x) < FARTHEST_ANGLE)) return null;
  const k = Math.round(x / HALF_PI_HIGH);
  const r = subtract(
    subtract(point(x), multiply(point(k), point(HALF_PI_HIGH))),
    multiply(point(k), HALF_PI_LOW),
  );
  return r.lo > -0.9 && r.hi < 0.9 ? { r, quarter: ((k % 4) + 4) % 4 } : null;
}

function clampToUnit(x: Interval): Interval {
  return { lo: Math.max(-1, Math.min(1, x.lo)), hi: Math.min(1, Math.max(-1, x.hi)) };
}

/** sin(x + shift pi/2). */
function sineAtPoint(x: number, shift: number): Interval {
  const reduced = reduceAngle(x);
  if (!reduced) return { lo: -1, hi: 1 };
  const { r } = reduced;
  const quarter = (reduced.quarter + shift) % 4;
  const square = power(r, 2);
  const value =
    quarter % 2 === 0
      ? multiply(r, alternatingSeries(SINE, square))
      : alternatingSeries(COSINE, square);
  return clampToUnit(quarter < 2 ? value : negate(value));
}

/** Encloses sin(x + shift pi/2); its extrema are at (1 - shift) pi/2 + m pi, with the value (-1)^m. */
function sineWithShift(x: Interval, shift: number): Interval {
  if (!isBounded(x)) return ENTIRE;
  if (x.hi - x.lo > 6.5 || Math.max(-x.lo, x.hi) > FARTHEST_ANGLE) return { lo: -1, hi: 1 };
  const turns = subtract(divide(x, PI), point((1 - shift) / 2));
  const first = Math.ceil(turns.lo);
  const last = Math.floor(turns.hi);
  if (last - first >= 1) return { lo: -1, hi: 1 };
  const ends = hull(sineAtPoint(x.lo, shift), sineAtPoint(x.hi, shift));
  if (last < first) return ends;
  return first % 2 === 0 ? { lo: ends.lo, hi: 1 } : { lo: -1, hi: ends.hi };
}

export function sine(x: Interval): Interval {
  return sineWithShift(x, 0);
}

export function cosine(x: Interval): Interval {
  return sineWithShift(x, 1);
}

export function tangent(x: Interval): Interval {
  return divide(sine(x), cosine(x));
}

function exponentialAtPoint(x: number): Interval {
  if (!(Math.abs(x) < 700)) return ENTIRE;
  const halvings = Math.max(0, Math.ceil(Math.log2(Math.abs(x) + 1)) + 1);
  const r = divide(point(x), point(2 ** halvings)); // |r| <= 1/2
  let sum = ZERO;
  for (let i = EXPONENTIAL.length - 1; i >= 0; --i) sum = add(EXPONENTIAL[i], multiply(r, sum));
  // Lagrange: at most e^(1/2) |r|^n / n!, n the number of terms.
  const rest = multiply(
    point(2),
    multiply(power(absolute(r), EXPONENTIAL.length), EXPONENTIAL[EXPONENTIAL.length - 1]),
  );
  let value = add(sum, hull(negate(rest), rest));
  for (let i = 0; i < halvings; ++i) value = multiply(value, value);
  return value.lo > 0 ? value : { lo: 0, hi: value.hi };
}

export function exponential(x: Interval): Interval {
  if (!isBounded(x)) return ENTIRE;
  return interval(exponentialAtPoint(x.lo).lo, exponentialAtPoint(x.hi).hi);
}

/**
 * Returns bounds of the y with f(y) = x, for a guess of it. `isBelow(y)` proves y <= the true value,
 * `isAbove(y)` proves y >= it. The guess is moved away until both are shown.
 */
function confirm(
  guess: number,
  isBelow: (y: number) => boolean,
  isAbove: (y: number) => boolean,
): Interval {
  if (!Number.isFinite(guess)) return ENTIRE;
  let lo = guess;
  let hi = guess;
  let step = Math.abs(guess) * 2 ** -50 + 2 ** -100;
  for (let i = 0; i < 60 && !isBelow(lo); ++i, step *= 2) lo = guess - step;
  step = Math.abs(guess) * 2 ** -50 + 2 ** -100;
  for (let i = 0; i < 60 && !isAbove(hi); ++i, step *= 2) hi = guess + step;
  return isBelow(lo) && isAbove(hi) ? interval(lo, hi) : ENTIRE;
}

export function squareRoot(x: Interval): Interval {
  if (!isBounded(x) || x.lo < 0) return ENTIRE;
  const root = (a: number): Interval =>
    a === 0
      ? ZERO
      : confirm(
          Math.sqrt(a),
          (y) => y <= 0 || up(y * y) <= a,
          (y) => y >= 0 && down(y * y) >= a,
        );
  return interval(Math.max(0, root(x.lo).lo), root(x.hi).hi);
}

export function logarithm(x: Interval): Interval {
  if (!isBounded(x) || x.lo <= 0) return ENTIRE;
  const at = (a: number): Interval =>
    confirm(
      Math.log(a) || 2 ** -60,
      (y) => exponentialAtPoint(y).hi <= a,
      (y) => exponentialAtPoint(y).lo >= a,
    );
  return interval(at(x.lo).lo, at(x.hi).hi);
}

export function arcsine(x: Interval): Interval {
  if (!isBounded(x) || x.lo < -1 || x.hi > 1) return ENTIRE;
  const at = (a: number): Interval =>
    confirm(
      Math.asin(a),
      (y) => y <= -HALF_PI.hi || (y <= HALF_PI.lo && y >= -HALF_PI.lo && sineAtPoint(y, 0).hi <= a),
      (y) => y >= HALF_PI.hi || (y <= HALF_PI.lo && y >= -HALF_PI.lo && sineAtPoint(y, 0).lo >= a),
    );
  return interval(at(x.lo).lo, at(x.hi).hi);
}

export function arccosine(x: Interval): Interval {
  return subtract(HALF_PI, arcsine(x));
}

export function arctangent(x: Interval): Interval {
  if (!isBounded(x)) return ENTIRE;
  // For |y| < pi/2, where cos y > 0: y <= atan a if sin y <= a cos y.
  const inside = (y: number): boolean => y <= HALF_PI.lo && y >= -HALF_PI.lo;
  const difference = (y: number, a: number): Interval =>
    subtract(sineAtPoint(y, 0), multiply(point(a), sineAtPoint(y, 1)));
  const at = (a: number): Interval =>
    confirm(
      Math.atan(a),
      (y) => y <= -HALF_PI.hi || (inside(y) && difference(y, a).hi <= 0),
      (y) => y >= HALF_PI.hi || (inside(y) && difference(y, a).lo >= 0),
    );
  return interval(at(x.lo).lo, at(x.hi).hi);
}

/** Off the negative x axis, where atan2 jumps. */
export function arctangentOfQuotient(y: Interval, x: Interval): Interval {
  if (!isBounded(x) || !isBounded(y)) return ENTIRE;
  if (x.lo > 0) return arctangent(divide(y, x));
  if (y.lo > 0) return subtract(HALF_PI, arctangent(divide(x, y)));
  if (y.hi < 0) return subtract(negate(HALF_PI), arctangent(divide(x, y)));
  return ENTIRE;
}
