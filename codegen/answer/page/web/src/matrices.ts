// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices row by row: guesses in doubles, and a certain sign of a determinant.
import { divide, Interval, middle, multiply, negate, ONE, subtract } from "./interval";

/** Guesses a left inverse of an m x n matrix, m >= n; null if elimination finds none. */
export function guessLeftInverse(A: ArrayLike<number>, m: number, n: number): number[] | null {
  if (m === n) return guessInverse(Array.from(A), n);
  const square = new Array<number>(n * n).fill(0);
  for (let i = 0; i < n; ++i)
    for (let j = 0; j < n; ++j)
      for (let r = 0; r < m; ++r) square[i * n + j] += A[r * n + i] * A[r * n + j];
  const inverse = guessInverse(square, n);
  if (!inverse) return null;
  const K = new Array<number>(n * m).fill(0);
  for (let i = 0; i < n; ++i)
    for (let r = 0; r < m; ++r)
      for (let j = 0; j < n; ++j) K[i * m + r] += inverse[i * n + j] * A[r * n + j];
  return K;
}

function guessInverse(A: number[], n: number): number[] | null {
  const B = Array.from({ length: n * n }, (_, k) => (k % (n + 1) === 0 ? 1 : 0));
  const swap = (M: number[], i: number, j: number): void => {
    for (let k = 0; k < n; ++k) [M[i * n + k], M[j * n + k]] = [M[j * n + k], M[i * n + k]];
  };
  for (let c = 0; c < n; ++c) {
    let pivot = c;
    for (let i = c + 1; i < n; ++i)
      if (Math.abs(A[i * n + c]) > Math.abs(A[pivot * n + c])) pivot = i;
    if (!(Math.abs(A[pivot * n + c]) > 0)) return null;
    swap(A, c, pivot);
    swap(B, c, pivot);
    const scale = 1 / A[c * n + c];
    for (let k = 0; k < n; ++k) {
      A[c * n + k] *= scale;
      B[c * n + k] *= scale;
    }
    for (let i = 0; i < n; ++i) {
      const factor = A[i * n + c];
      if (i === c || factor === 0) continue;
      for (let k = 0; k < n; ++k) {
        A[i * n + k] -= factor * A[c * n + k];
        B[i * n + k] -= factor * B[c * n + k];
      }
    }
  }
  return B.every(Number.isFinite) ? B : null;
}

/** Approximates a determinant by elimination. For pictures and searches only. */
export function approximateDeterminant(A: ArrayLike<number>, n: number): number {
  const M = Array.from(A);
  let result = 1;
  for (let c = 0; c < n; ++c) {
    let pivot = c;
    for (let i = c + 1; i < n; ++i)
      if (Math.abs(M[i * n + c]) > Math.abs(M[pivot * n + c])) pivot = i;
    const p = M[pivot * n + c];
    if (p === 0) return 0;
    if (pivot !== c) {
      result = -result;
      for (let k = 0; k < n; ++k) [M[c * n + k], M[pivot * n + k]] = [M[pivot * n + k], M[c * n + k]];
    }
    result *= p;
    for (let i = c + 1; i < n; ++i) {
      const factor = M[i * n + c] / p;
      for (let k = c; k < n; ++k) M[i * n + k] -= factor * M[c * n + k];
    }
  }
  return result;
}

/** Encloses a determinant by elimination; null if a pivot may be zero. */
export function encloseDeterminant(A: readonly Interval[], n: number): Interval | null {
  const M = [...A];
  let result = ONE;
  for (let c = 0; c < n; ++c) {
    let pivot = c;
    for (let i = c + 1; i < n; ++i)
      if (Math.abs(middle(M[i * n + c])) > Math.abs(middle(M[pivot * n + c]))) pivot = i;
    const p = M[pivot * n + c];
    if (!(p.lo > 0 || p.hi < 0)) return null;
    if (pivot !== c) {
      result = negate(result);
      for (let k = 0; k < n; ++k) [M[c * n + k], M[pivot * n + k]] = [M[pivot * n + k], M[c * n + k]];
    }
    result = multiply(result, p);
    for (let i = c + 1; i < n; ++i) {
      const factor = divide(M[i * n + c], p);
      for (let k = c + 1; k < n; ++k)
        M[i * n + k] = subtract(M[i * n + k], multiply(factor, M[c * n + k]));
    }
  }
  return result;
}
