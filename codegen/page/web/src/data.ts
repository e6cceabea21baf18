// SPDX-License-Identifier: GPL-3.0-or-later
// The data of a page, as codegen/page/page_data.cpp writes it.
import { Damage } from "./expression";
import { sha256 } from "./sha256";

export type Bounds = readonly [number | null, number | null];

export interface ReportedPoint {
  readonly parameters: Record<string, Bounds>;
  readonly pose: Record<string, Bounds>;
  readonly uncertain: Record<string, Bounds>;
  readonly determinant?: Bounds;
}

export interface TwistColumn {
  readonly column: number;
  readonly name?: string;
  readonly unit?: string;
  readonly kind?: string;
}

export interface Degeneracy {
  readonly nullity?: number;
  readonly singular_values?: readonly number[];
  readonly twist?: { readonly columns: readonly TwistColumn[]; readonly vectors: readonly (readonly number[])[]; readonly normalised?: string };
  readonly rows?: { readonly taking_part: readonly number[]; readonly vectors: readonly (readonly number[])[] };
}

export interface ReportedWitness extends Degeneracy {
  readonly points: readonly ReportedPoint[];
  readonly near?: ReportedPoint;
}

export interface Report {
  readonly verdict: "no-singularity" | "singularity" | "possible-problem";
  readonly claim: string;
  readonly matrix: string;
  readonly alpha: number;
  readonly reason: string;
  readonly blocking_box: Record<string, Bounds> | null;
  readonly model: string;
  readonly model_sha256: string;
  readonly motion: string;
  readonly boxes: number;
  readonly method: string;
  readonly leaves: Record<string, number>;
  readonly witness: ReportedWitness | null;
  readonly nearest?: (Degeneracy & ReportedPoint) | null;
  readonly seconds: Record<string, number>;
}

export interface DrawnPart {
  readonly kind: "base" | "platform" | "leg" | "link" | "rail" | "joint";
  readonly row: number;
  readonly points: readonly number[]; // of `points`
}

export interface DrawingData {
  readonly lets: readonly (readonly [string, string])[];
  readonly points: readonly (readonly [string, string, string])[];
  readonly parts: readonly DrawnPart[];
}

export interface PavingData {
  readonly tree: string;
  readonly shares: readonly { readonly kind: string; readonly share: string; readonly claim: string }[];
}

export interface BoundComponent {
  readonly component?: string;
  readonly name?: string;
  readonly attained?: { value: string; bounds: Bounds } | null;
  readonly proved?: { value: string; bounds: Bounds } | null;
}

export interface PageData {
  readonly format: 1;
  readonly version: string;
  readonly command: string;
  readonly again: readonly string[]; // commands
  readonly report: Report;
  readonly units: Record<string, string>; // by parameter
  readonly question: string;
  readonly certificate: string | null;
  readonly certificate_note: string;
  readonly model: { readonly file: string; readonly text: string };
  readonly drawing: DrawingData | null;
  readonly paving: PavingData | null;
  readonly bounds: readonly any[];
  readonly margins: readonly any[];
}

/** Reads the data of this page. Throws Damage unless they are those that were written. */
export function readPageData(): PageData {
  const element = document.getElementById("data");
  const text = element?.textContent;
  if (!element || !text) throw new Damage("the page has no data");
  if (sha256(text) !== element.dataset.sha256)
    throw new Damage("the data of the page are not those that Regulus wrote: their SHA-256 differs");
  const data = JSON.parse(text) as PageData;
  if (data.format !== 1) throw new Damage("the data of the page have an unknown format");
  if (sha256(data.model.text) !== data.report.model_sha256)
    throw new Damage("the model text is not that of the report: its SHA-256 differs");
  return data;
}
