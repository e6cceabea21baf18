// SPDX-License-Identifier: GPL-3.0-or-later
// Values with their units, for people: angles in degrees.

/** Six digits. */
export function shortNumber(x: number): string {
  if (!Number.isFinite(x)) return x > 0 ? "∞" : x < 0 ? "−∞" : "no value";
  const text = Number(x.toPrecision(6));
  return Math.abs(text) >= 1e6 || (text !== 0 && Math.abs(text) < 1e-4) ? text.toExponential() : String(text);
}

export function withUnit(text: string, unit: string | undefined): string {
  return unit && unit !== "1" ? `${text} ${unit}` : text;
}

/** Six digits, rounded to one side. A number that has no more stays, although its double is not exactly it. */
export function roundedTo(x: number, round: (y: number) => number): string {
  if (x === 0) return "0";
  const unit = 10 ** (5 - Math.floor(Math.log10(Math.abs(x))));
  const scaled = x * unit;
  const nearest = Math.round(scaled);
  return shortNumber((Math.abs(scaled - nearest) < 1e-6 ? nearest : round(scaled)) / unit);
}

const rounded = (x: number, digits: number): string => shortNumber(Number(x.toPrecision(digits)));

/** Radians as degrees. */
function degrees(x: number, digits: number): string {
  const value = (x * 180) / Math.PI;
  // 1e-9 degrees about a number of three digits are roundings of pi.
  const whole = Math.round(value * 1e3) / 1e3;
  return rounded(Math.abs(value - whole) < 1e-9 ? whole : value, digits);
}

/** Four digits, or more; degrees of an angle. */
export function describeValue(x: number, unit: string | undefined, digits = 4): string {
  if (unit === "rad" && Number.isFinite(x)) return `${degrees(x, digits)}°`;
  return unit === "deg" ? `${rounded(x, digits)}°` : withUnit(rounded(x, digits), unit);
}

export function describeRange(lo: number, hi: number, unit: string | undefined, digits = 4): string {
  const isAngle = unit === "rad" || unit === "deg";
  return `${isAngle ? describeValue(lo, unit, digits) : rounded(lo, digits)} to ${describeValue(hi, unit, digits)}`;
}

/** "25°" of (5/36)*pi; null of what is no multiple of pi, or has no short decimal of degrees. */
export function exactDegrees(exact: string): string | null {
  if (exact === "0") return "0°";
  const [whole, sign, numerator, denominator, factor, divisor] = /^(-?)(?:\(?(\d+)\/(\d+)\)?\*|(\d+)\*)?pi(?:\/(\d+))?$/.exec(exact) ?? [];
  if (whole === undefined) return null;
  const value = (Number(numerator ?? factor ?? 1) * 180) / (Number(denominator ?? 1) * Number(divisor ?? 1));
  const text = String(value);
  // So few digits that equal decimals are equal numbers.
  return exact.length <= 16 && text.length <= 7 && !text.includes("e") ? `${sign}${text}°` : null;
}

/** "0.1" of 1/10; a quotient that has no short decimal stays as it is. */
export function exactDecimal(exact: string): string {
  const [whole, numerator, denominator] = /^(-?\d{1,9})\/(\d{1,9})$/.exec(exact) ?? [];
  if (whole === undefined) return exact;
  let rest = Number(denominator);
  for (const prime of [2, 5]) while (rest % prime === 0) rest /= prime;
  const text = String(Number(numerator) / Number(denominator));
  // So few digits that the decimal is the quotient, and no neighbour of it.
  return rest === 1 && text.length <= 12 && !text.includes("e") ? text : exact;
}

/** An end of a range: its exact text if that is short, otherwise about four digits. */
export function describeEnd(value: number, exact: string | undefined, unit: string | undefined): string {
  const angle = unit === "rad" && exact !== undefined ? exactDegrees(exact) : null;
  if (angle !== null) return angle;
  if (exact === undefined || exact.length > 12) return `≈ ${describeValue(value, unit)}`;
  const decimal = exactDecimal(exact);
  if (unit === "deg") return `${decimal}°`;
  return unit === "rad" ? `${decimal} rad (≈ ${describeValue(value, unit)})` : withUnit(decimal, unit);
}

/** The next of 1, 2 and 5 times a power of ten that is at least x. */
export function roundStep(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x));
  return ([1, 2, 5].find((digit) => digit * power >= x) ?? 10) * power;
}
