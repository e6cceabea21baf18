// SPDX-License-Identifier: GPL-3.0-or-later
// The intervals of a page contain the exact results, which are computed here with whole numbers of any
// length: a double is a whole number of 2^-1074, a function a Taylor series with 400 binary digits.
import assert from "node:assert/strict";
import { build } from "esbuild";

const [sources, work] = process.argv.slice(2);
const file = `${work}/arithmetic.mjs`;
await build({
  stdin: {
    contents: 'export * as intervals from "./interval"; export * as functions from "./functions"; export { readEnd, encloseDecimal } from "./expression"; export { sha256 } from "./sha256";',
    resolveDir: sources,
    loader: "ts",
  },
  bundle: true,
  format: "esm",
  outfile: file,
});
const { intervals, functions, readEnd, encloseDecimal, sha256 } = await import(file);

/** A double as n / 2^1074. */
function whole(x) {
  const bits = new DataView(new ArrayBuffer(8));
  bits.setFloat64(0, x);
  const high = bits.getUint32(0);
  const exponent = (high >>> 20) & 0x7ff;
  const mantissa = (BigInt(high & 0xfffff) << 32n) | BigInt(bits.getUint32(4));
  const n = exponent === 0 ? mantissa : (mantissa | (1n << 52n)) << BigInt(exponent - 1);
  return high >>> 31 ? -n : n;
}
const UNIT = 1n << 1074n;

let state = 12345n;
const random = () => {
  state = (state * 6364136223846793005n + 1442695040888963407n) & ((1n << 64n) - 1n);
  return Number(state >> 11n) / 2 ** 53;
};
const corners = [0, -0, 1, -1, 2 ** -1074, -(2 ** -1074), 2 ** -1022, 2 ** 1023, 0.1, 1 + 2 ** -52, 1 - 2 ** -53];
function double() {
  if (random() < 0.2) return corners[Math.floor(random() * corners.length)];
  const spread = random() < 0.5 ? 30 : 1000;
  return (random() - 0.5) * 2 ** Math.floor((2 * random() - 1) * spread);
}

/** True if lo <= p/q <= hi, q > 0. */
const holds = ({ lo, hi }, p, q) =>
  (lo === -Infinity || whole(lo) * q <= p * UNIT) && (hi === Infinity || p * UNIT <= whole(hi) * q);

let count = 0;
for (let i = 0; i < 20000; ++i) {
  const [a, b] = [double(), double()];
  const [p, q] = [whole(a), whole(b)];
  const [x, y] = [intervals.point(a), intervals.point(b)];
  assert.ok(holds(intervals.add(x, y), p + q, UNIT), `${a} + ${b}`);
  assert.ok(holds(intervals.subtract(x, y), p - q, UNIT), `${a} - ${b}`);
  assert.ok(holds(intervals.multiply(x, y), p * q, UNIT * UNIT), `${a} * ${b}`);
  if (b !== 0) assert.ok(holds(intervals.divide(x, y), q < 0n ? -p : p, q < 0n ? -q : q), `${a} / ${b}`);
  if (Math.abs(a) < 1e60) assert.ok(holds(intervals.power(x, 3), p ** 3n, UNIT ** 3n), `${a}^3`);
  if (a >= 0) {
    const { lo, hi } = functions.squareRoot(x);
    assert.ok(lo >= 0 && whole(lo) ** 2n <= p * UNIT && (hi === Infinity || p * UNIT <= whole(hi) ** 2n), `sqrt ${a}`);
  }
  ++count;
}

// Functions: fixed-point numbers with B binary digits, and errors far below those of doubles.
const B = 400n;
const ONE = 1n << B;
const fixed = (x) => (B > 1074n ? whole(x) << (B - 1074n) : whole(x) >> (1074n - B));
function series(x, first, step) {
  let term = first;
  let sum = 0n;
  for (let k = 0n; term !== 0n; ++k) {
    sum += term;
    term = step(term, k, x);
  }
  return sum;
}
const halvings = 40n;
function exponential(x) {
  let value = series(x >> halvings, ONE, (term, k, r) => (term * r) / ((k + 1n) << B));
  for (let i = 0n; i < halvings; ++i) value = (value * value) >> B;
  return value;
}
const sine = (x) => series(x, x, (term, k, r) => (-term * ((r * r) >> B)) / (((2n * k + 2n) * (2n * k + 3n)) << B));
const cosine = (x) => series(x, ONE, (term, k, r) => (-term * ((r * r) >> B)) / (((2n * k + 1n) * (2n * k + 2n)) << B));

/** True if the interval holds value ± slack. */
const holdsFixed = ({ lo, hi }, value, slack) =>
  (lo === -Infinity || fixed(lo) - 1n <= value + slack) && (hi === Infinity || value - slack <= fixed(hi) + 1n);
const SLACK = 1n << 200n; // of 2^-400

let widest = 0;
const check = (name, x, interval, value) => {
  assert.ok(holdsFixed(interval, value, SLACK), `${name}(${x}) = [${interval.lo}, ${interval.hi}]`);
  assert.ok(interval.hi - interval.lo < Infinity, `${name}(${x}) is not bounded`);
  widest = Math.max(widest, (interval.hi - interval.lo) / Math.max(1e-3, Math.abs(interval.lo)));
};
for (let i = 0; i < 1500; ++i) {
  const x = i < 40 ? (i - 20) * (Math.PI / 4) : (random() - 0.5) * (i % 3 === 0 ? 200 : 12);
  const at = intervals.point(x);
  check("sin", x, functions.sine(at), sine(fixed(x)));
  check("cos", x, functions.cosine(at), cosine(fixed(x)));
  check("exp", x, functions.exponential(at), exponential(fixed(x)));
  // An inverse function holds x at the exact value of the function: both ends are on its two sides.
  const logarithm = functions.logarithm(intervals.point(Math.abs(x) + 1e-9));
  const argument = fixed(Math.abs(x) + 1e-9);
  assert.ok(exponential(fixed(logarithm.lo)) <= argument + SLACK && argument <= exponential(fixed(logarithm.hi)) + SLACK, `log ${x}`);
  const arc = functions.arctangent(at);
  const side = (y) => sine(fixed(y)) - ((fixed(x) * cosine(fixed(y))) >> B);
  assert.ok(side(arc.lo) <= SLACK && side(arc.hi) >= -SLACK, `atan ${x}`);
  const t = Math.sin(x);
  const { lo, hi } = functions.arcsine(intervals.point(t));
  assert.ok(sine(fixed(lo)) <= fixed(t) + SLACK || lo <= -1.5707, `asin ${t}`);
  assert.ok(sine(fixed(hi)) >= fixed(t) - SLACK || hi >= 1.5707, `asin ${t}`);
  // Over a range: the values at points of it.
  const range = intervals.interval(x, x + random() * 4);
  for (const part of [0, 0.3, 0.5, 0.8, 1]) {
    const y = Math.min(range.lo + part * (range.hi - range.lo), range.hi);
    assert.ok(holdsFixed(functions.sine(range), sine(fixed(y)), SLACK), `sin on [${range.lo}, ${range.hi}]`);
    assert.ok(holdsFixed(functions.cosine(range), cosine(fixed(y)), SLACK), `cos on [${range.lo}, ${range.hi}]`);
  }
}
assert.ok(widest < 1e-9, `the widest is ${widest}`);

// What has no value is never bounded.
for (const interval of [
  functions.squareRoot(intervals.interval(-1e-300, 1)),
  functions.logarithm(intervals.interval(0, 1)),
  functions.arcsine(intervals.interval(0, 1.0000001)),
  intervals.divide(intervals.ONE, intervals.interval(-1, 0)),
  functions.sine(intervals.ENTIRE),
  intervals.multiply(intervals.ZERO, intervals.ENTIRE),
  functions.tangent(intervals.interval(1, 2)),
])
  assert.ok(!intervals.isBounded(interval), JSON.stringify(interval));

assert.equal(readEnd("-0x1.8p+1"), -3);
assert.equal(readEnd("0x0.0000000000001p-1022"), 2 ** -1074);
assert.equal(readEnd("0x1.fffffffffffffp+1023"), Number.MAX_VALUE);
assert.equal(readEnd("0x1.18cb20dc542d9p-1"), 0.5484247464138107);
const tenth = encloseDecimal("0.1");
assert.ok(whole(tenth.lo) * 10n < UNIT && UNIT < whole(tenth.hi) * 10n);
assert.equal(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
assert.equal(sha256("é".repeat(100)).length, 64);
console.log(`${count} operations, functions within ${widest.toExponential(1)}`);
