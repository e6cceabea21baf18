// SPDX-License-Identifier: GPL-3.0-or-later
// Intervals of doubles, rounded outward.
//
// ECMAScript rounds + - * / to nearest (IEEE 754), so that |fl(r) - r| <= 2^-53 |fl(r)| + 2^-1075.
// `down` and `up` move a result by d >= 2^-51 |x| + 2^-1070, less one rounding. That move is rounded
// itself, by at most 2^-53 (|x| + d), so at least 2^-52 |x| + 2^-1072 remains: more than the error.
//
// An operation without a value somewhere in its arguments, or with an infinite bound, gives ENTIRE,
// and so does every operation on ENTIRE. So a result that is not ENTIRE is defined everywhere.

export interface Interval {
  readonly lo: number;
  readonly hi: number;
}

const RELATIVE = 2 ** -51;
const ABSOLUTE = 2 ** -1070;

export function down(x: number): number {
  return x - (Math.abs(x) * RELATIVE + ABSOLUTE);
}

export function up(x: number): number {
  return x + (Math.abs(x) * RELATIVE + ABSOLUTE);
}

export const ENTIRE: Interval = { lo: -Infinity, hi: Infinity };
export const ZERO: Interval = { lo: 0, hi: 0 };
export const ONE: Interval = { lo: 1, hi: 1 };

export function isBounded(x: Interval): boolean {
  return x.hi - x.lo < Infinity;
}

function isZero(x: Interval): boolean {
  return x.lo === 0 && x.hi === 0;
}

/** Returns [lo, hi], or ENTIRE if an end is not a finite number. */
export function interval(lo: number, hi: number): Interval {
  return lo > -Infinity && hi < Infinity && lo <= hi ? { lo, hi } : ENTIRE;
}

export function point(x: number): Interval {
  return interval(x, x);
}

export function add(a: Interval, b: Interval): Interval {
  if (isZero(a)) return b;
  if (isZero(b)) return a;
  return interval(down(a.lo + b.lo), up(a.hi + b.hi));
}

export function negate(a: Interval): Interval {
  return { lo: -a.hi, hi: -a.lo };
}

export function subtract(a: Interval, b: Interval): Interval {
  return add(a, negate(b));
}

export function multiply(a: Interval, b: Interval): Interval {
  if (!isBounded(a) || !isBounded(b)) return ENTIRE;
  if (isZero(a) || isZero(b)) return ZERO;
  const p = a.lo * b.lo;
  const q = a.lo * b.hi;
  const r = a.hi * b.lo;
  const s = a.hi * b.hi;
  return interval(down(Math.min(p, q, r, s)), up(Math.max(p, q, r, s)));
}

export function divide(a: Interval, b: Interval): Interval {
  if (!isBounded(a) || !isBounded(b) || (b.lo <= 0 && b.hi >= 0)) return ENTIRE;
  if (isZero(a)) return ZERO;
  const p = a.lo / b.lo;
  const q = a.lo / b.hi;
  const r = a.hi / b.lo;
  const s = a.hi / b.hi;
  return interval(down(Math.min(p, q, r, s)), up(Math.max(p, q, r, s)));
}

/** Returns the least and the largest absolute value. */
export function absolute(a: Interval): Interval {
  if (a.lo >= 0) return a;
  if (a.hi <= 0) return negate(a);
  return { lo: 0, hi: Math.max(-a.lo, a.hi) };
}

export function magnitude(a: Interval): number {
  return Math.max(-a.lo, a.hi);
}

/** Returns x^n. Requires: n is a positive integer. */
export function power(x: Interval, n: number): Interval {
  if (!isBounded(x)) return ENTIRE;
  const base = n % 2 === 0 ? absolute(x) : x;
  const ends = [point(base.lo), point(base.hi)].map((end) => powerOfPoint(end, n));
  return interval(n % 2 === 0 ? Math.max(0, ends[0].lo) : ends[0].lo, ends[1].hi);
}

function powerOfPoint(x: Interval, n: number): Interval {
  let result = ONE;
  let square = x;
  for (let rest = n; rest > 0; rest = Math.floor(rest / 2)) {
    if (rest % 2 === 1) result = multiply(result, square);
    if (rest > 1) square = multiply(square, square);
  }
  return result;
}

export function hull(a: Interval, b: Interval): Interval {
  return { lo: Math.min(a.lo, b.lo), hi: Math.max(a.hi, b.hi) };
}

export function middle(a: Interval): number {
  const m = a.lo / 2 + a.hi / 2;
  return Math.min(Math.max(m, a.lo), a.hi);
}
